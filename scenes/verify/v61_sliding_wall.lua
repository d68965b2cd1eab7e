-- V61: a wall slides as one on its lowest bed while its mortar trembles
--
-- What happens   A wall of strong mortar stands on a bed without bond. The ground moves to and fro along it, faster than friction can drive
--                the wall. The bed cracks all over, and undamped waves run through the wall: the pressure of the bed trembles by more than
--                its own size. Yet friction on average is mu times the weight, so the wall slides as a rigid block.
-- Source         Coulomb's law for a block on a base with acceleration a sin(w t): it slides from sin(w t1) = mu g / a on, by
--                a / w^2 (-sin x + sin x1 + (x - x1) cos x1) - mu g (x - x1)^2 / (2 w^2) with x = w t, until it stands on the base
--                again (Westermo and Udwadia 1983, Earthquake Engng Struct. Dyn. 11, 135)
-- How to run     erbs run scenes/verify/v61_sliding_wall.lua [-D damping=.1 -D kn=1e11 -D rows=8]
-- What to look at  metrics.slip_over_paper
local cols = param("cols", 20, "bricks in a course")
local rows = param("rows", 4, "courses")
local kn = param("kn", 1e12, "[Pa/m] of the lowest bed")
local mortar_kn = param("mortar_kn", 1e12, "[Pa/m] of the others")
local mu = param("mu", 0.6)
local peak = param("peak", 1, "[g] of the ground")
local frequency = param("frequency", 5, "[Hz]")
local damping = param("damping", 0, "of critical, of the cracked bed")
local angle = param("angle", 0, "[degrees] of the wall from x")
family({ cols = { 10, 60 }, rows = { 1, 2, 8 }, kn = { 1e9, 1e10, 1e11 }, mortar_kn = { 1e10, 1e11 }, mu = { 0.4, 0.7 }, peak = { 1.3 },
  frequency = { 2, 10 }, damping = { 0.02, 0.3 }, angle = { 30, 90 } }, { combinations = 12 })
gravity(g)
material { name = "brick", density = 1800, friction = mu, restitution = 0.2, kn = 5e10, ks = 2e10 }
local e, size = { math.cos(math.rad(angle)), math.sin(math.rad(angle)) }, { 0.3, 0.2, 0.1 }
local turned = { 0, 0, angle * deg }
box { name = "base", group = "base", material = "brick", size = { 2 * cols * size[1] + 2, 1, 0.2 }, center = { 0, 0, -0.1 }, rotation = turned, fixed = true }
for i = 1, cols do
  local x = (i - (cols + 1) / 2) * size[1]
  for k = 0, rows - 1 do
    box { group = "wall", material = "brick", size = size, center = { x * e[1], x * e[2], (k + 0.5) * size[3] }, rotation = turned }
  end
end
joint { law = mortar { kn = mortar_kn, ks = 0.4 * mortar_kn, mu = mu, ft = 20 * MPa, c = 30 * MPa } }
joint { between = { "base", "wall" }, law = mortar { kn = kn, ks = 0.4 * kn, mu = mu, ft = 0, c = 0, damping = damping } }
ground_motion { wave = sine { amplitude = peak * g, frequency = frequency }, direction = { e[1], e[2], 0 } }
recorder { name = "slip", quantity = "displacement", group = "wall" }
analysis { duration = 0.6 / frequency }

-- The rigid block: x = w t where it stands again, and its slip until then.
local ratio = mu / peak
local from = math.asin(ratio)
local function speed(x) return math.cos(from) - math.cos(x) - ratio * (x - from) end
local low, high = math.pi - from, 2 * math.pi
for _ = 1, 60 do
  local x = (low + high) / 2
  if speed(x) > 0 then low = x else high = x end
end
local w = 2 * math.pi * frequency
local paper = peak * g / w ^ 2 * ((low - from) * math.cos(from) - math.sin(low) + math.sin(from) - ratio * (low - from) ^ 2 / 2)
local function slip(run, t) return -(e[1] * run.at("slip_ux_rel_m", t) + e[2] * run.at("slip_uy_rel_m", t)) end
metric("slip_over_paper", "", function(run) return slip(run, low / w) / paper end)
expect("metrics.slip_over_paper", 1, { abs = 0.2, source = "Coulomb; what trembles also creeps while a rigid block would stand" })
expect("energy.residual_relative", 1e-3, { below = true, source = "gate" })
