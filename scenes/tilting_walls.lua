-- Dry walls on a table that tilts: the bond at the corners holds the face
--
-- What happens   A face between two side walls, all of dry bricks laid in bond, stands on a table. The table turns slowly until the face
--                falls outwards. A face alone falls when its weight passes its edge, at atan(t / H). The sides brace the bonded face, which
--                takes part of them along when it falls.
-- Source         Tilting tests of dry walls: Restrepo-Velez, Magenes and Griffith (2014, Int. J. Archit. Herit. 8, 325).
--                atan(t / H): the limit of a rigid wall of thickness t and height H (tests/README.md, V44).
-- How to run     erbs run scenes/tilting_walls.lua --video       a table that turns until the walls fall
--                erbs run scenes/tilting_walls.lua -D bonded=0   the face alone
--                erbs render runs/tilting_walls --tilt camera    the same, from a camera that stays level with the table
-- What to look at  metrics.fall_deg: tilt when the top of the face has moved by a hundredth of its height (the largest tilt if it
--                stands); metrics.alone_deg: atan(t / H).

local bonded = param("bonded", 1, "1: corners laid in bond, 0: the face alone")
local rate = param("rate", 4, "of the table, slow beside the fall [deg/s]")
local most = param("most", 36, "tilt at which the table stops [deg]")
local mu = param("mu", 0.7, "friction of dry bricks, assumed")
local kn = param("kn", 1e10, "normal stiffness of dry beds, assumed [Pa/m]")

local courses, length, depth = 16, 2.0, 1.0
local brick = { length = 250 * mm, width = 125 * mm, height = 75 * mm }

material { name = "brick", density = 1800, friction = mu, restitution = 0.2, kn = kn }
ground { size = 6 }
joint { law = dry { kn = kn, ks = 0.4 * kn, mu = mu } }

local top
if bonded == 1 then
  local plan = { { -depth, 0 }, { 0, 0 }, { 0, length }, { -depth, length } }
  top = building { plan = plan, closed = false, walls = { "side_a", "face", "side_b" }, courses = courses, brick = brick, joint = 0 }.height
else
  top = wall { name = "face", length = length, axis = "y", at = { -brick.width, 0, 0 }, courses = courses, brick = brick, joint = 0 }.height
end

-- Gravity turns the face outwards, to +x: about -y.
tilt { wave = table_wave { times = { 0, 0.5, 0.5 + most / rate }, values = { 0, 0, -most * deg }, hold = true }, axis = "y" }
gravity(g)
damping { mass = 1 }
analysis { duration = 1.5 + most / rate, stop_after_collapse = 1.2 }

recorder { name = "top", quantity = "displacement", block = string.format("face.c%02d.b04", courses), axis = "x" }
metric("alone_deg", "deg", math.atan(brick.width, top) / deg)
metric("fall_deg", "deg", function(run)
  local leaves = run.crossings("top_ux_rel_m", top / 100, true)[1]
  return leaves and math.asin(run.at("gravity_ax_m_s2", leaves) / g) / deg or most
end)

camera { name = "corner", eye = { 4.6, -4.6, 2.6 }, target = { -0.2, 0.9, 0.7 }, fov = 35 * deg }
