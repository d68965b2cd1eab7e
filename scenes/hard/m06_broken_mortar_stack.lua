-- Hard case: a stack whose mortar breaks in a bump comes to rest
--
-- What happens   Bricks in weak mortar stand on a slope. A bump breaks every bed; only friction is left, and the stack comes to rest on it.
-- Source         as m04_stack_after_bump without mortar: a broken joint sticks like a dry one.
-- How to run     erbs run scenes/hard/m06_broken_mortar_stack.lua [-D bricks=9 -D share=0.2] [-D Gf=0.01] [-D kn=...]
-- What to look at  broken (share of the beds), drift (of the length, per second, in the last half second; 0: all have come to rest, or swing to rest about a place that stays), energy.residual_relative.
local bricks, share, mu = param("bricks", 6, ""), param("share", 0.3, "of the angle of friction"), param("mu", 0.7, "")
local kn, Gf = param("kn", 2e10, "[Pa/m]"), param("Gf", 0, "fracture energy in tension and in shear [J/m2]")
local ft = param("ft", 300, "tensile strength and cohesion [Pa]")
local amplitude, rest = param("amplitude", 2 * g, "[m/s2]"), param("rest", 3, "after the bump [s]; looked at from 2 s on")
family({ bricks = { 1, 3 }, share = { 0.1, 0.2 }, mu = { 0.4, 1 }, kn = { 1e9, 1e11, 1e12 }, Gf = { 1e-4, 1e-2 }, ft = { 100, 1000 } }, { combinations = 8 })
local size, slope = { 0.3, 0.15, 0.08 }, share * math.atan(mu)
if math.tan(slope) * bricks * size[3] > 0.4 * size[1] then error("the weight of the stack passes beside its foot; take fewer bricks or lower share", 0) end
material { name = "brick", density = 1800, friction = mu }
transform { rotation = { 0, slope, 0 }, function()
  box { name = "base", size = { 1.5, 0.5, 0.2 }, center = { 0, 0, -0.1 }, fixed = true }
  for i = 1, bricks do box { name = "brick" .. i, group = "stack", size = size, center = { 0, 0, (i - 0.5) * size[3] } } end
end }
joint { law = mortar { kn = kn, ks = 0.4 * kn, ft = ft, c = ft, mu = mu, Gf1 = Gf, Gf2 = Gf } }
ground_motion { wave = half_sine { amplitude = -amplitude, frequency = 10, start = 0.1 }, direction = "z" }
local names = {}
for i = 1, bricks do
  names[i] = "brick" .. i
  recorder { name = names[i], quantity = "displacement", block = names[i] }
end
local drift = include "parts/walk.lua"
metric("broken", "", function(run) return run.joints_broken / bricks end)
metric("drift", "1/s", function(run) return drift(run, names, 0.5) / size[1] end)
analysis { duration = 0.15 + rest, output_dt = 5e-3, frame_dt = 1 }
expect("metrics.broken", 0.5, { above = true, source = "the bump asks for more than the mortar bears" })
expect("metrics.drift", 1e-6, { below = true, source = "below the angle of friction it sticks" })
expect("energy.residual_relative", 1e-3, { below = true, source = "nothing is made" })
