-- P2: the lowest frequency of a cantilever wall of blocks, and its decay.
--
-- What happens   A wall 3 m high and 0.3 m thick, cut into blocks on elastic joints, swings from a start in Euler's first mode, damped by
--                2 % of critical. Blocks of d = 0.3 m by default, unit times that: their joints have E / d, the lowest twice that (half a
--                block hangs on it).
-- Source         Timoshenko's beam, kappa 5/6: 8.451 Hz; decay a / 2 of mass damping a. Joints of n equal midpoints are too soft in bending
--                by 1/n^2, trapezoids too stiff by 2/(n - 1)^2, so f errs with n^-2; blocks err with d^2.
-- How to run     erbs accuracy scenes/accuracy/p2_cantilever.lua
-- What to look at  slopes 2 of the step, of midpoints, of the block size; Simpson and Gauss are exact.
local unit = param("unit", 1, "size of the blocks over 0.3 m")
local L, t, B, E, nu, rho = 3.0, 0.3, 1.0, 5e9, 0.2, 2000
local d = 0.3 * unit
local n, f1 = math.floor(L / d + 0.5), 8.451
local kn, ks = E / d, 5 / 6 * E / (2 * (1 + nu)) / d
gravity(0)
material { name = "wall", density = rho }
box { name = "base", group = "base", size = { t, B, d }, at = { 0, 0, -d }, fixed = true }
local beta = 1.8751040687 / L
local ratio = (math.sinh and 0) or ((math.exp(beta * L) + math.exp(-beta * L)) / 2 + math.cos(beta * L)) / ((math.exp(beta * L) - math.exp(-beta * L)) / 2 + math.sin(beta * L))
local function shape(z)
  local e, c = math.exp(beta * z), math.exp(-beta * z)
  return (e + c) / 2 - math.cos(beta * z) - ratio * ((e - c) / 2 - math.sin(beta * z))
end
for i = 1, n do
  local z = (i - 0.5) * d
  local slope = (shape(z + 1e-4) - shape(z - 1e-4)) / 2e-4
  box { name = "b" .. i, group = "wall", size = { t, B, d }, at = { 0, 0, (i - 1) * d }, initial = { velocity = { 1e-4 * shape(z), 0, 0 }, spin = { 0, 1e-4 * slope, 0 } } }
end
joint { law = mortar { kn = kn, ks = ks, ft = 1e9, c = 1e9, mu = 0.6 } }
joint { law = mortar { kn = 2 * kn, ks = 2 * ks, ft = 1e9, c = 1e9, mu = 0.6 }, between = { "base", "wall" } }
local a = 2 * 0.02 * 2 * pi * f1
damping { mass = a }
recorder { name = "top", quantity = "displacement", block = "b" .. n, axis = "x" }
local column = "top_ux_rel_m"
metric("frequency", "Hz", function(run) return 1 / run.period(column) end)
metric("decay", "1/s", function(run)
  local u, t_first, first, t_last, last = run.history(column), nil, nil, nil, nil
  for i = 2, #u - 1 do
    if u[i] > 0 and u[i] > u[i - 1] and u[i] >= u[i + 1] and u[i] > 1e-9 then
      if not first then first, t_first = u[i], run.time[i] end
      last, t_last = u[i], run.time[i]
    end
  end
  return math.log(first / last) / (t_last - t_first)
end)
-- N = 10 blocks are .45 % too soft, Simpson's joints exact.
expect("metrics.frequency", f1, { rel = 0.01, source = "Timoshenko" })
expect("metrics.decay", a / 2, { rel = 0.02, source = "mass damping" })
analysis { duration = 10.3 / f1, start = "rest", output_dt = 1e-9, frame_dt = 1 }
