-- A brick house of some 950 blocks and 2,800 joints: what the step kernel is timed on
--
-- What happens   Three storeys of walls half a brick thick with interlocked corners, on mortar beds of 10 mm that never give way, sway
--                under a weak ground motion.
-- How to run     erbs bench scenes/bench/house_951.lua
-- What to look at  Nanoseconds a point and step against the reference kernel, while sound and with every joint broken.

material { name = "brick", density = 1800, friction = 0.6, restitution = 0.2 }
ground { z = 0, size = 60 }
building {
  plan = { param("x", 2.47), param("y", 2.47) }, storeys = 3, courses = param("courses", 10),
  brick = { length = 0.30, width = 0.125, height = 0.10 }, joint = 10 * mm, quiet = true,
  openings = { { wall = "south", storey = 1, centre = 1.2, width = 0.6, sill = 0.2, height = 0.5, kind = "window" } },
  lintel = { bearing = 0.15 },
}
joint { law = mortar { E = 1.07e10, nu = 0.2, thickness = 10 * mm, ft = 20 * MPa, c = 30 * MPa, mu = 0.6 }, thickness = 10 * mm, tolerance = 5 * mm }
gravity(g)
ground_motion { wave = sine { amplitude = 0.1 * g, frequency = 5 }, direction = "x" }
analysis { duration = 1 }
