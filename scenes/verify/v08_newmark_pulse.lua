-- V08: Newmark's sliding block under a rectangular pulse of the ground, for several coefficients of friction.
--
-- What happens   The ground accelerates by a g for t0 and then keeps its speed. A block with mu < a lags behind by s = (g a t0^2 / 2)(a/mu
--                - 1); a block with mu > a moves with the ground.
-- Source         Newmark 1965, Geotechnique 15, 139. mu 0.3, a 0.5, t0 0.4 s: 0.26160 m.
-- How to run     erbs run scenes/verify/v08_newmark_pulse.lua [-D a=0.8] [-D t0=0.2] [-D kn=...]
-- What to look at  slip_mu*: final slip over the formula (metres for the block that moves with the ground).
label("quick")
local a, t0 = param("a", 0.5, "pulse of the ground, of g"), param("t0", 0.4, "its length [s]")
local kn = param("kn", 1e10, "the shear spring delays friction by about 1 / omega, a part 2 / (omega t0 (a / mu - 1)) of the slip [Pa/m]")
local size = param("size", 0.3, "longer side of the blocks [m]")
local start = 0.02  -- s

local longest = 0
for i, mu in ipairs { 0.2, 0.3, 0.4, 0.6 } do
  local name, slip = string.format("mu%d", math.floor(10 * mu + 0.5)), g * a * t0 ^ 2 / 2 * (a / mu - 1)
  local plate, block = "plate_" .. name, "block_" .. name
  local reach = math.max(0, slip)
  material { name = "stone_" .. name, density = 1800, friction = mu, kn = kn, ks = 0.4 * kn }
  box { name = plate, group = plate, material = "stone_" .. name, size = { 2 * size + 1.5 * reach, size, 0.2 }, at = { -size - 1.4 * reach, i - size / 2, -0.2 }, fixed = true }
  box { name = block, group = block, material = "stone_" .. name, size = { size, size / 2, size / 15 }, at = { -size / 2, i - size / 4, 0 } }
  joint { law = dry { kn = kn, mu = mu }, between = { plate, block } }
  recorder { name = name, quantity = "displacement", block = block, axis = "xy" }
  if mu < a then
    longest = math.max(longest, a * t0 / mu)
    metric("slip_" .. name, "", function(run) return -run.last(name .. "_ux_rel_m") / slip end)
    -- 0.3 %: the deformation of the joint's shear spring and its vibration after the stop; the pulse itself is exact at its edges.
    expect("metrics.slip_" .. name, 1, { abs = 3e-3, source = "(g a t0^2 / 2)(a / mu - 1)" })
  else
    metric("slip_" .. name, "m", function(run) return run.peak(name .. "_ux_rel_m") end)
    -- m a g / (ks A), doubled by the sudden start of the pulse and again by its end; rocking of the flat block adds a tenth.
    expect("metrics.slip_" .. name, 4.4 * 1800 * size / 15 * a * g / (0.4 * kn), { below = true, source = "mu > a: no slip" })
  end
end
ground_motion { wave = pulse { amplitude = a * g, start = start, duration = t0 }, direction = "x" }
analysis { duration = start + longest + 0.1, start = "equilibrium", output_dt = 0.005 }
