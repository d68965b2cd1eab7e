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
local peak, frequency = param("peak", 1, "[g] of the ground"), param("frequency", 5, "[Hz]")
local bed = {
  cols = param("cols", 20, "bricks in a course"), rows = param("rows", 4, "courses"), mu = param("mu", 0.6),
  kn = param("kn", 1e12, "[Pa/m] of the lowest bed"), mortar_kn = param("mortar_kn", 1e12, "[Pa/m] of the others"),
  damping = param("damping", 0, "of critical, of the cracked bed"), angle = param("angle", 0, "[degrees] of the wall from x"),
}
family({ cols = { 10, 60 }, rows = { 1, 2, 8 }, kn = { 1e9, 1e10, 1e11 }, mortar_kn = { 1e10, 1e11 }, mu = { 0.4, 0.7 }, peak = { 1.3 },
  frequency = { 2, 10 }, damping = { 0.02, 0.3 }, angle = { 30, 90 } }, { combinations = 12 })
gravity(g)
local wall = include "parts/wall_on_bed.lua"(bed)
ground_motion { wave = sine { amplitude = peak * g, frequency = frequency }, direction = { wall.along[1], wall.along[2], 0 } }
analysis { duration = 0.6 / frequency }

-- The rigid block: x = w t where it stands again, and its slip until then.
local ratio = bed.mu / peak
local from = math.asin(ratio)
local function speed(x) return math.cos(from) - math.cos(x) - ratio * (x - from) end
local low, high = math.pi - from, 2 * math.pi
for _ = 1, 60 do
  local x = (low + high) / 2
  if speed(x) > 0 then low = x else high = x end
end
local w = 2 * math.pi * frequency
local paper = peak * g / w ^ 2 * ((low - from) * math.cos(from) - math.sin(low) + math.sin(from) - ratio * (low - from) ^ 2 / 2)
metric("slip_over_paper", "", function(run) return wall.moved(run, low / w) / paper end)
expect("metrics.slip_over_paper", 1, { abs = 0.2, source = "Coulomb; what trembles also creeps while a rigid block would stand" })
expect("energy.residual_relative", 1e-3, { below = true, source = "gate" })
