-- A wall with a door and a window, shaken in its plane
--
-- What happens   A wall of 3 x 2.1 m carries a heavy plate (the mass of a floor). Three sine waves shake it along its plane. Piers rock
--                and shear, cracks climb in steps of half a brick along bed and head joints, the lintels stay whole.
-- How to run     erbs run scenes/window_wall.lua --video
--                erbs run scenes/window_wall.lua -D peak=3*g              falls 0.9 s after the start
--                erbs run scenes/window_wall.lua -D shift=1               the other of the two alternating courses at the bottom
-- What to look at  The opened joints as dark cracks; metrics.broken_share and metrics.drift.

local peak = param("peak", 0.7 * g, "amplitude of the sine [m/s2]")
local frequency = param("frequency", 4 * Hz, "of the sine [Hz]")
local plate_thickness = param("plate", 0.25, "concrete plate on top, stands for the storey above [m]")
local ft = param("ft", 0.02 * MPa, "tensile strength of a weak lime mortar, assumed [Pa]")
local c = param("c", 0.03 * MPa, "its cohesion, assumed [Pa]")
local Gf1 = param("Gf1", 2, "its fracture energy in tension, assumed; with 0 (brittle) the first crack shatters every joint [J/m2]")
local Gf2 = param("Gf2", 20, "in shear, assumed [J/m2]")
local shift = param("shift", 0, "1: start with the other of the two alternating courses")

local t = 10 * mm
material { name = "brick", density = 1800, friction = 0.6, restitution = 0.2 }
material { name = "concrete", density = 2400, friction = 0.6, restitution = 0.2, color = { 0.62, 0.61, 0.58 } }
ground {}
joint {
  law = mortar { E = 2e9 * Pa, nu = 0.2, thickness = t, ft = ft, c = c, mu = 0.65, Gf1 = Gf1, Gf2 = Gf2 },
  thickness = t, tolerance = t / 2,
}

local built = wall {
  length = 3, courses = 30, at = { -1.5, 0, 0 }, shift = shift,
  brick = { length = 240 * mm, width = 115 * mm, height = 60 * mm }, joint = t,
  lintel = { bearing = 115 * mm, courses = 2, material = "concrete" },
  openings = {
    { kind = "door", at = 0.49, width = 0.75, height = 1.55 },
    { kind = "window", at = 1.865, width = 0.625, sill = 0.7, height = 0.85 },
  },
}
box { name = "plate", size = { 3, 115 * mm, plate_thickness }, at = { -1.5, 0, built.height + t }, material = "concrete", group = "plate" }

gravity(g)
ground_motion { wave = sine { amplitude = peak, frequency = frequency, start = 0.1, duration = 3 / frequency }, direction = "x" }
damping { mass = 2 }
analysis { duration = 2.5, stop_after_collapse = 1.5 }

recorder { name = "plate", quantity = "displacement", block = "plate", axis = "x" }
metric("drift", "", function(run) return run.peak("plate_ux_rel_m") / built.height end)
metric("broken_share", "", function(run) return run.joints_broken / run.joints end)

camera { name = "front", eye = { 0, -5.2, 1.5 }, target = { 0, 0, 1.05 }, fov = 34 * deg }
camera { name = "corner", eye = { 3.4, -3.9, 2.3 }, target = { 0, 0, 0.95 }, fov = 35 * deg }
