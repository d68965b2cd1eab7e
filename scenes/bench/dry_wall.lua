-- A dry wall in running bond, shaken across its plane: the wall on which other codes are timed
--
-- What happens   Dry bricks of 0.30 x 0.125 x 0.10 m stand on a plate that moves by a sine of 2 Hz and 0.3 g across the wall. The wall
--                rocks and slides a little; joints open and close.
-- How to run     erbs bench scenes/bench/dry_wall.lua -D bricks=40 -D courses=25
--                erbs run scenes/bench/dry_wall.lua -D duration=2
-- What to look at  Processor seconds per simulated second; tests/bench/peers runs the same wall in other codes. For a dry wall the bench
--                lets every brick search for neighbours from the start, as those codes do; a run does so once bricks come loose.

local bricks = param("bricks", 40, "in a course")
local courses = param("courses", 25, "")
local kn = 5e9

material { name = "brick", density = 1800, friction = 0.6, restitution = 0.2, kn = kn, ks = 0.4 * kn }
wall {
  length = bricks * 0.3, courses = courses, brick = { length = 0.3, width = 0.125, height = 0.1 }, joint = 0,
  base = { thickness = 0.1, margin = 0.1 }, quiet = true,
}
joint { law = dry { kn = kn, ks = 0.4 * kn, mu = 0.6 }, points = { 2, 2 }, rule = "trapezoid" }
gravity(g)
ground_motion { wave = sine { amplitude = 0.3 * g, frequency = 2 }, direction = "y" }
analysis { duration = param("duration", 1, "[s]"), dt = { 5e-5, unstable = true } }
