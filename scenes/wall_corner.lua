-- A bonded corner of two walls, shaken out of plane
--
-- What happens   Two free-standing walls, 1.5 m long and 1.26 m high, meet in a bonded corner. One sine wave of acceleration along x
--                pushes the wall along y out of its plane. Every second course of the other wall holds it at the corner. A stepped
--                crack climbs from its foot to the corner, and what lies beyond falls with a wedge of the other wall. At 0.9 g the
--                corner still holds it. With bonded = 0 an open gap separates the same two walls, and 0.3 g is enough.
-- How to run     erbs run scenes/wall_corner.lua --video
--                erbs run scenes/wall_corner.lua -D peak=0.9*g -o runs/wall_corner_stands
--                erbs run scenes/wall_corner.lua -D bonded=0 -D peak=0.3*g -o runs/wall_corner_apart
-- What to look at  metrics.free_end_peak_m and metrics.corner_peak_m: the largest displacement of the wall's top at its two ends.

local bonded = param("bonded", 1, "1: corner laid in bond, 0: two walls with an open gap")
local peak = param("peak", 1.1 * g, "amplitude of the one sine wave [m/s2]")
local frequency = param("frequency", 2 * Hz, "of the wave [Hz]")
local ft = param("ft", 0.02 * MPa, "tensile strength of a weak lime mortar, assumed [Pa]")
local Gf1 = param("Gf1", 2, "its fracture energy in tension, assumed; ten times that in shear [J/m2]")

local t, courses, length = 10 * mm, 18, 1.5
local brick = { length = 240 * mm, width = 115 * mm, height = 60 * mm }

material { name = "brick", density = 1800, friction = 0.6, restitution = 0.2 }
ground {}
joint {
  law = mortar { E = 1e9 * Pa, nu = 0.2, thickness = t, ft = ft, c = 1.5 * ft, mu = 0.6, Gf1 = Gf1, Gf2 = 10 * Gf1 },
  thickness = t, tolerance = t / 2,
}

-- Plan: `side` runs along x from its free end to the corner, `face` along y from the corner to its free end.
local corners = { { -length, 0 }, { 0, 0 }, { 0, length } }
local face_group, top
if bonded == 1 then
  local walls = building { plan = corners, closed = false, walls = { "side", "face" }, courses = courses, brick = brick, joint = t }
  face_group, top = walls.walls[2], walls.height
else
  wall { name = "side", length = length - brick.width - 30 * mm, at = { -length, 0, 0 }, courses = courses, brick = brick, joint = t }
  local face = wall { name = "face", length = length, axis = "y", at = { -brick.width, 0, 0 }, courses = courses, brick = brick, joint = t }
  face_group, top = face.walls[1], face.height
end

gravity(g)
ground_motion { wave = full_sine { amplitude = peak, frequency = frequency, start = 0.1 }, direction = "x" }
damping { mass = 2 }
analysis { duration = 3, stop_after_collapse = 1.5 }

-- The topmost bricks of the face, at the corner and at the free end.
local stem = string.format("face.c%02d.b", courses)
recorder { name = "free_end", quantity = "displacement", block = stem .. "06", axis = "x" }
recorder { name = "corner", quantity = "displacement", block = stem .. "01", axis = "x" }
metric("free_end_peak_m", "m", function(run) return run.peak("free_end_ux_rel_m") end)
metric("corner_peak_m", "m", function(run) return run.peak("corner_ux_rel_m") end)
metric("height_m", "m", top)

camera { name = "corner", eye = { 2.7, -2.7, 2.0 }, target = { -0.45, 0.45, 0.5 }, fov = 35 * deg }
camera { name = "along", eye = { 0.3, -3.6, 1.1 }, target = { -0.45, 0.5, 0.5 }, fov = 35 * deg }
