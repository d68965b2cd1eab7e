-- A brick house of about 950 blocks and 2,800 joints: the benchmark of the step kernel
--
-- What happens   Three storeys of walls, half a brick thick with interlocked corners, sway under a weak ground motion. Their mortar beds of
--                10 mm never fail.
-- How to run     erbs bench scenes/bench/house_951.lua
--                erbs run scenes/bench/house_951.lua -D peak=0.3*g -D duration=20 --threads 2        El Centro, standing
--                erbs run scenes/bench/house_951.lua -D peak=2*g -D ft=0.2*MPa -D c=0.3*MPa -D duration=20 --threads 2   falling
-- What to look at  Nanoseconds per point and step against the reference kernel, with intact joints and with all joints broken.

local debris = param("debris", 5e10, "normal stiffness of contacts; softer debris takes longer steps and overlaps more [Pa/m]")
material { name = "brick", density = 1800, friction = 0.6, restitution = 0.2, kn = debris, ks = 0.4 * debris }
ground { z = 0, size = 60 }
building {
  plan = { param("x", 2.47), param("y", 2.47) }, storeys = 3, courses = param("courses", 10),
  brick = { length = 0.30, width = 0.125, height = 0.10 }, joint = 10 * mm, quiet = true,
  openings = { { wall = "south", storey = 1, centre = 1.2, width = 0.6, sill = 0.2, height = 0.5, kind = "window" } },
  lintel = { bearing = 0.15 },
}
joint {
  law = mortar {
    E = 1.07e10, nu = 0.2, thickness = 10 * mm, mu = 0.6,
    ft = param("ft", 20 * MPa, "tensile strength, by default such that nothing gives way [Pa]"),
    c = param("c", 30 * MPa, "cohesion, likewise [Pa]"),
    kn_cracked = param("kn_cracked", 0, "normal stiffness of beds without bond; 0: as with bond [Pa/m]"),
  },
  thickness = 10 * mm, tolerance = 5 * mm,
}
gravity(g)
local peak = param("peak", 0, "of El Centro along x; 0: a sine of 0.1 g and 5 Hz instead [m/s2]")
local wave = peak > 0 and record { file = "../records/elcentro_1940_ns.csv", peak = peak } or sine { amplitude = 0.1 * g, frequency = 5 }
ground_motion { wave = wave, direction = "x" }
analysis { duration = param("duration", 1, "[s]") }
