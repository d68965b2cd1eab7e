-- V62: a wall of undamped mortar slides down a slope as a block does
--
-- What happens   A wall of strong mortar stands on a bed without bond, steeper than its friction angle. It slides off, and waves run through
--                it, since nothing damps them: the pressure of the bed trembles by more than its own size. Its mean acceleration is that
--                of a rigid block, on the joints of the bed and on the contacts that replace them after a slip of 3 mm. On a slope below
--                the friction angle it stands, although it trembles as well. Friction is less than mu only where bricks swing faster than
--                the wall slides (mortar_kn = 1e10).
-- Source         Coulomb: acceleration g (sin(slope) - mu cos(slope)), from which the coefficient of friction follows
-- How to run     erbs run scenes/verify/v62_wall_on_a_slope.lua [-D slope=33 -D kn=1e11 -D rows=8]
-- What to look at  metrics.friction_of_joints and friction_of_contacts, over mu; metrics.drift (m) where it stands
local slope = param("slope", 40, "[degrees]")
local bed = {
  cols = param("cols", 20, "bricks in a course"), rows = param("rows", 4, "courses"), mu = param("mu", 0.6),
  kn = param("kn", 1e12, "[Pa/m] of the lowest bed"), mortar_kn = param("mortar_kn", 1e12, "[Pa/m] of the others"),
  damping = param("damping", 0, "of critical, of the cracked bed"), angle = param("angle", 0, "[degrees] of the wall from x"),
}
family({ cols = { 5, 60 }, rows = { 1, 2, 8 }, kn = { 1e9, 1e10, 1e11 }, mortar_kn = { 1e11, 1e13 }, mu = { 0.3, 0.5 }, slope = { 20, 29, 36, 50 },
  damping = { 0.02, 0.3 }, angle = { 30, 180 } }, { combinations = 12 })
local steep, duration = slope * deg, 0.3
local turn = bed.angle * deg
gravity { -g * math.sin(steep) * math.cos(turn), -g * math.sin(steep) * math.sin(turn), -g * math.cos(steep) }
local wall = include "parts/wall_on_bed.lua"(bed)
analysis { duration = duration, start = "rest" }

local acceleration = g * (math.sin(steep) - bed.mu * math.cos(steep))
-- The coefficient of friction over mu that the change of speed from t0 to t1 tells.
local function friction(run, t0, t1)
  local measured = (wall.speed(run, t1) - wall.speed(run, t0)) / (t1 - t0)
  return (math.tan(steep) - measured / (g * math.cos(steep))) / bed.mu
end
if acceleration > 0 then
  local hands_over = math.sqrt(2 * 0.01 * wall.size[1] / acceleration)  -- s, after a slip of 1 % of a brick
  metric("friction_of_joints", "", function(run) return friction(run, 0, 0.9 * math.min(hands_over, duration)) end)
  metric("friction_of_contacts", "", function(run) return friction(run, duration / 2, duration) end)
  expect("metrics.friction_of_joints", 1, { abs = 0.1, source = "Coulomb, on joints that start without shear" })
  expect("metrics.friction_of_contacts", 1, { abs = 0.05, source = "Coulomb" })
else
  metric("drift", "m", function(run) return wall.moved(run, duration) - wall.moved(run, duration / 2) end)
  expect("metrics.drift", 0, { abs = 1e-5, source = "Coulomb: it stands, and the springs of its beds swing" })
end
expect("energy.residual_relative", 1e-3, { below = true, source = "gate" })
