-- V09: Newmark's sliding block under one full sine of the ground, for several coefficients of friction.
--
-- What happens   The ground accelerates as A g sin(2 pi f t) for one cycle. A block with mu < A slips one way, sticks, slips back and keeps
--                a residual slip. lib_sliding.lua integrates the rigid answer from event to event; all lengths scale with 1 / f^2.
-- Source         Newmark 1965, Geotechnique 15, 139. mu 0.3, A 0.6, f 2 Hz: largest slip 0.047179 m, residual 0.002362 m, at rest at 0.5871
--                s.
-- How to run     erbs run scenes/verify/v09_newmark_sine.lua [-D f=3] [-D A=0.8] [-D spring=1000*Hz] [-D share=0.9]
-- What to look at  largest_error_*, residual_error_* (over the largest slip), stop_error_mu30 [s]. v09_order.lua has the order of the step
--                and the error of the spring.
label("quick")
local A, f = param("A", 0.6, "of the ground, of g"), param("f", 2, "of the ground [Hz]")
local spring = param("spring", 2000, "frequency of the block on its shear spring [Hz]")
local share = param("share", 0.5, "dt over the limit")
local size = param("size", 0.3, "longer side of the blocks, a twentieth of it high [m]")
local density = 1800
if A <= 0.45 then error("A must be above 0.45, the coefficient of friction of the roughest block, or nothing slips", 0) end
include "lib_sliding.lua"

local height = size / 20
local ks = density * height * (2 * pi * spring) ^ 2
local kn = 2.5 * ks
local duration, cases = 1.6 / f, {}
for i, mu in ipairs { 0.2, 0.3, 0.45 } do
  local name = string.format("mu%d", math.floor(100 * mu + 0.5))
  local rigid = sliding { drive = function(t) return t < 1 / f and A * g * math.sin(2 * pi * f * t) or 0 end, limit = mu * g, ends = duration }
  local plate, block, reach = "plate_" .. name, "block_" .. name, 2 * size + 3 * rigid.largest
  material { name = "stone_" .. name, density = density, friction = mu, kn = kn, ks = ks }
  box { name = plate, group = plate, material = "stone_" .. name, size = { reach, size, 0.1 }, at = { -reach / 2, i - size / 2, -0.1 }, fixed = true }
  box { name = block, group = block, material = "stone_" .. name, size = { size, size / 2, height }, at = { -size / 2, i - size / 4, 0 } }
  joint { law = dry { kn = kn, ks = ks, mu = mu }, between = { plate, block } }
  recorder { name = name, quantity = "displacement", block = block, axis = "x" }
  recorder { name = name, quantity = "velocity", block = block, axis = "x" }
  local column = name .. "_ux_rel_m"
  metric("largest_" .. name, "m", function(run) return run.peak(column) end)
  metric("residual_" .. name, "m", function(run) return math.abs(run.last(column)) end)
  metric("largest_error_" .. name, "", function(run) return run.peak(column) / rigid.largest - 1 end)
  metric("residual_error_" .. name, "", function(run) return (math.abs(run.last(column)) - math.abs(rigid.at_end)) / rigid.largest end)
  metric("rigid_largest_" .. name, "m", rigid.largest)
  metric("rigid_residual_" .. name, "m", math.abs(rigid.at_end))
  metric("rigid_stop_" .. name, "s", rigid.stops[#rigid.stops])
  -- 0.5 %: the deformation of the spring (its vibration of the friction force at the ends of slip) and the step.
  expect("metrics.largest_error_" .. name, 0, { abs = 5e-3, source = "rigid sliding, of the largest slip" })
  expect("metrics.residual_error_" .. name, 0, { abs = 5e-3, source = "rigid sliding, of the largest slip" })
  cases[name] = rigid
end
-- The last moment at which the block slips faster than 2 % of its largest speed.
metric("stop_error_mu30", "s", function(run)
  local v, last = run.history("mu30_vx_rel_m_s"), 0
  local bound = 0.02 * cases.mu30.speed
  for i, time in ipairs(run.time) do if math.abs(v[i]) > bound then last = time end end
  return last - cases.mu30.stops[#cases.mu30.stops]
end)
if A == 0.6 and f == 2 then
  expect("metrics.rigid_largest_mu30", 0.047179, { abs = 1e-6, source = "Newmark 1965, by an independent integration" })
  expect("metrics.rigid_residual_mu30", 0.0023619, { abs = 1e-7, source = "the same in closed form (another integration has .002360)" })
  expect("metrics.rigid_stop_mu30", 0.5871, { abs = 1e-4, source = "Newmark 1965, by an independent integration" })
end
ground_motion { wave = full_sine { amplitude = A * g, frequency = f }, direction = "x" }
analysis { duration = duration, start = "equilibrium", dt_fraction = share, output_dt = 1e-3 / f, frame_dt = duration / 20 }
-- Before the stop the speed falls at mu g: 2 % of the largest speed is about 5 ms before it; rows are 0.5 ms apart.
expect("metrics.stop_error_mu30", 0, { abs = 0.01, source = "rigid sliding" })
