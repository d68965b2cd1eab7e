-- A long arcade of mortared masonry with about 30,000 blocks: larger than the cache of a processor
--
-- What happens   A brick wall with two levels of openings under lintels, like an aqueduct, sways a little under a weak ground motion.
--                Nothing cracks.
-- How to run     erbs bench scenes/bench/aqueduct.lua
-- What to look at  Nanoseconds per point and step compared with house_951; bytes per point.

local bays = param("bays", 46, "")
local courses = param("courses", 111, "")
local t = 10 * mm

material { name = "brick", density = 1800, friction = 0.6, restitution = 0.2 }
local openings = {}
for bay = 1, bays do
  for level = 0, 1 do
    openings[#openings + 1] = { at = (bay - 1) * 2.17 + 0.62, width = 0.93, sill = level * 5.5 + 0.55, height = 3.3, kind = "window" }
  end
end
wall {
  length = bays * 2.17 - t, courses = courses, brick = { length = 0.3, width = 0.125, height = 0.1 }, joint = t, openings = openings,
  lintel = { bearing = 0.3 }, base = { thickness = 0.1, margin = 0.1 }, quiet = true,
}
joint { law = mortar { E = 1.07e10, nu = 0.2, thickness = t, ft = 2 * MPa, c = 3 * MPa, mu = 0.6 }, thickness = t, tolerance = 5 * mm }
gravity(g)
ground_motion { wave = sine { amplitude = 0.02 * g, frequency = 5 }, direction = "x" }
analysis { duration = 1, start = "rest" }
