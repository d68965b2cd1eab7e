-- V43: running-bond walls of dry bricks under a horizontal load in their plane.
--
-- What happens   Walls 4 bricks wide, of bricks 0.3 x 0.1 m, mu 0.6, are pushed by lambda times their weight. Tall walls (16 courses)
--                rotate off along a stepped crack below mu; low ones (8 and 12 courses) slide at mu. Both bonds: whole bricks or halves at
--                the ends of the lowest course.
-- Source         Limit analysis by linear programming, with and without friction in the head joints: whole 0.57950 / 0.57546, halves
--                0.56562 / 0.56087.
-- How to run     erbs run scenes/verify/v43_running_bond.lua [-D whole_16=1.02] [-D kn=...]
-- What to look at  *_over_paper; the mechanism of the run.
--
-- Damping: without damping, blocks that slide on each other under load flutter (v10_flutter.lua), and the wall may walk apart at loads as
-- low as 0.95, at random. The dashpots of dry joints that have opened or slid prevent this. A wall that moves travels some distance before
-- it stands again (3 mm at 0.98), so only a centimetre counts. Stiffness: the compressed toes of a wall that rotates off cost 1.6 % of the
-- load at 1e12, 1.1 % at 4e12 and 0.7 % at 1.6e13. They follow the cube root of the softness, as V30 has it on paper.
local kn, kn_sliding = param("kn", 4e12, "of walls that turn off [Pa/m]"), param("kn_sliding", 1e12, "of those that slide [Pa/m]")
local mu = 0.6

local slow_load = include "parts/slow_load.lua"
local function build(courses, halves, kn)
  return function(lambda)
    material { name = "brick", density = 2000, kn = kn, ks = 0.4 * kn, friction = mu }
    box { name = "floor", size = { 8, 1, 0.5 }, at = { -4, -0.5, -0.5 }, fixed = true, material = "brick" }
    wall { brick = { length = 0.3, width = 0.15, height = 0.1 }, length = 1.2, courses = courses, joint = 0, shift = halves and 0 or 1, closer = 0.1,
      at = { -0.6, -0.075, 0 }, material = "brick", quiet = true }
    joint { law = dry { kn = kn, ks = 0.4 * kn, mu = mu } }
    slow_load { lambda = lambda, grow = 0.7, hold = 1.3, moved = 0.01 }
  end
end
(include "parts/cases.lua") {
  -- Of its own bond: between without and with friction in the head joints, 1 % on either side.
  { name = "whole_16", value = 0.57748, build = build(16, false, kn), lo = 0.98, hi = 1.01, rel = 0.004, expect = { between = { 0.57546 * 0.99 / 0.57748, 0.57950 * 1.01 / 0.57748 }, source = "limit analysis" } },
  { name = "halves_16", value = 0.56325, build = build(16, true, kn), lo = 0.98, hi = 1.01, rel = 0.004, expect = { between = { 0.56087 * 0.99 / 0.56325, 0.56562 * 1.01 / 0.56325 }, source = "limit analysis" } },
  { name = "whole_8", value = mu, build = build(8, false, kn_sliding), lo = 0.985, hi = 1.01, rel = 0.005, expect = { rel = 0.01, source = "slides at mu" } },
}
