-- The METU house: a room under a heavy roof, tilted one way, then the other until it falls
--
-- What happens   Eight logs along x carry 55 kN on the two walls across x. The table turns towards -x and back, then towards +x through
--                states of equilibrium, until there is none. The walls across the tilt lean and overturn, those along it crack in steps from the openings.
-- Source         Tilting test of a full-scale house at METU, Ankara, and its model of discrete elements. Given: 3 x 4 x 2.4 m (width,
--                length, height), two windows and a door, perforated clay brick, mortar 1:1:7, roof of 55 kN on logs in the direction
--                of the tilt, joints every .15 m, kn = E / h, ks = kn / (2 (1 + nu)), nu = .12, cohesion lost with the first slip,
--                friction kept. Observed: walls across the tilt overturn, diagonal cracks in the walls along it. Not given, and assumed
--                here, each a param: E, ft, c, mu, densities, angle of the first tilt, size of the openings. Their place, the size of
--                the brick, and that x is the width are assumed as well.
-- How to run     erbs run scenes/metu_house.lua
--                erbs run scenes/metu_house.lua -D first=0             towards +x only
--                erbs run scenes/metu_house.lua -D dynamic=1 --video   the table turns in time
--                erbs render runs/metu_house --color damage --tilt camera --stills 7
-- What to look at  capacity.multiplier: tangent of the tilt, which is the acceleration over g; curve.svg; cracks of the walls south and north;
--                which walls fall first.

local first = param("first", 8, "tilt towards -x before the return, assumed [deg]")
local most = param("most", 40, "tilt towards +x at which the table stops [deg]")
local dynamic = param("dynamic", 0, "1: the table turns in time, for films")
local rate = param("rate", 4, "dynamic: of the table, slow beside the house [deg/s]")
local roof = param("roof", 55 * kN, "weight of the roof, on eight logs [N]")
local roof_height = param("roof_height", 0.3, "of the weights on the logs, assumed [m]")
local E = param("E", 1.5 * GPa, "of the masonry, assumed [Pa]")
local nu = param("nu", 0.12, "reading of the source, where two symbols are lost")
local spacing = param("spacing", 0.15, "of the bed joints, a brick of 135 mm and a joint of 15 mm; the other reading [m]")
local ft = param("ft", 0.08 * MPa, "tensile strength of the joints, assumed [Pa]")
local c = param("c", 0.12 * MPa, "cohesion, assumed: 1.5 ft [Pa]")
local mu = param("mu", 0.65, "friction of the joints, assumed: 33 degrees")
local Gf1 = param("Gf1", 0, "fracture energy in tension; 0: brittle, as in the source [J/m2]")
local Gf2 = param("Gf2", 0, "in shear; 0: brittle, as in the source [J/m2]")
local density = param("density", 1200, "of perforated bricks with their mortar, assumed [kg/m3]")
local mu_logs = param("mu_logs", 0.5, "friction of the logs on the walls, assumed")
local door = param("door", 0.9, "width of the door, in the middle of the wall south, assumed [m]")
local window = param("window", 0.9, "width of the windows, in the middle of the walls north and east, assumed [m]")

local width, long, t = 3, 4, 15 * mm
local brick = { length = 290 * mm, width = 190 * mm, height = 135 * mm }  -- the usual perforated brick, 190 mm wide; assumed
local courses = 16                                                       -- of 150 mm: 2.4 m

material { name = "brick", density = density, friction = mu, restitution = 0.2, color = { 0.72, 0.40, 0.28 } }
material { name = "concrete", density = 2400, friction = mu, restitution = 0.2, color = { 0.62, 0.61, 0.58 } }

local kn = E / spacing
local beds = mortar { kn = kn, ks = kn / (2 * (1 + nu)), ft = ft, c = c, mu = mu, Gf1 = Gf1, Gf2 = Gf2 }
joint { law = beds, thickness = t, tolerance = t / 2 }
joint { between = { "log", "" }, law = dry { kn = kn, ks = kn / (2 * (1 + nu)), mu = mu_logs } }

ground { size = 7, depth = 0.3 }
local built = building {
  plan = { width, long }, at = { -width / 2, -long / 2, 0 }, brick = brick, joint = t, courses = courses, closer = 60 * mm,
  lintel = { bearing = 0.2, material = "concrete" },
  openings = {
    { wall = "south", kind = "door", centre = width / 2, width = door, height = 2.1 },
    { wall = "north", centre = width / 2, width = window, sill = 0.9, height = 1.05 },
    { wall = "east", centre = long / 2, width = window, sill = 0.9, height = 1.05 },
  },
}

-- Logs over both walls across x, clear of the walls along it. Each carries its share of the roof as one piece with it.
local logs, thick, over = 8, 0.16, 0.1
local deep = 0.4                                                   -- m, of a weight
local volume = (width + 2 * over) * thick * thick + (width - 1) * deep * roof_height
material { name = "roof", density = roof / g / logs / volume, friction = mu_logs, restitution = 0.1, color = { 0.45, 0.36, 0.28 } }
local function corners(x, y, z, dx, dy, dz)
  local v = {}
  for i = 0, 7 do v[i + 1] = { x + (i % 2) * dx, y + (i // 2 % 2) * dy, z + i // 4 * dz } end
  return { vertices = v }
end
for i = 1, logs do
  local y = -long / 2 + 0.4 + (long - 0.8) * (i - 1) / (logs - 1)
  block { name = "log" .. i, group = "log", material = "roof", parts = {
    corners(-width / 2 - over, y - thick / 2, built.height, width + 2 * over, thick, thick),
    corners(-width / 2 + 0.5, y - deep / 2, built.height + thick, width - 1, deep, roof_height),
  } }
end

local function top_of(wall)
  local names = {}
  for _, name in ipairs(built.top) do
    if name:find(wall, 1, true) then names[#names + 1] = name end
  end
  return names
end
gravity(g)
if dynamic == 1 then
  -- A positive angle about y pulls towards -x.
  local turn = first / rate
  local times, values = { 0, 0.2 }, { 0, 0 }
  if first > 0 then
    times, values = { 0, 0.2, 0.2 + turn, 0.2 + 2 * turn }, { 0, 0, first * deg, 0 }
  end
  times[#times + 1], values[#values + 1] = times[#times] + most / rate, -most * deg
  tilt { wave = table_wave { times = times, values = values, hold = true }, axis = "y" }
  damping { mass = 1 }
  analysis { duration = times[#times] + 0.5, stop_after_collapse = 1.2, output_dt = 0.02, frame_dt = 0.05 }
else
  local east = top_of("east")
  analysis { kind = "tilt", direction = "x", path = first > 0 and { -first * deg } or nil, step = 1 * deg, up_to = most * deg,
    monitor = { block = east[(#east + 1) // 2] } }
end
recorder { name = "east", quantity = "displacement", blocks = top_of("east"), axis = "x" }
recorder { name = "west", quantity = "displacement", blocks = top_of("west"), axis = "x" }

camera { name = "corner", eye = { 7.6, -8.4, 4.4 }, target = { 0.2, 0, 1.3 }, fov = 32 * deg }
camera { name = "south", eye = { 0.3, -11, 1.6 }, target = { 0.3, 0, 1.3 }, fov = 32 * deg }
