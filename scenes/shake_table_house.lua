-- A brick house on a shaking table, El Centro 1940
--
-- What happens   A model of 1525 x 1830 x 4260 mm has walls half a brick thick with interlocked corners, three precast slabs, a door and
--                eleven windows. It starts in equilibrium on its mortar. The whole record shakes it, with its time scaled by 0.707. At
--                the default peak it should stay up; raise the peak until it falls.
-- Source         Gu and Miao, parameter study on computer simulation of collapse responses for masonry structures: outer size, brick
--                and half brick (300/150 x 125 x 100 mm), mortar (E = 10.7 GPa, cube 9.81 MPa), record, time factor, peak of 0.4 g.
--                Their G exceeds E/2, which no isotropic solid has; here G = E / (2 (1 + nu)).
--                The source does not give densities, strengths, slabs, openings, number of storeys and damping: they are params below.
--                4260 = 3 x 1420 and 1420 = 13 courses of 105 + joint 5 + slab 50 mm: three equal storeys.
-- How to run     erbs run scenes/shake_table_house.lua                        the whole record (22 s)
--                erbs run scenes/shake_table_house.lua -D duration=2*s        its beginning
--                erbs run scenes/shake_table_house.lua -D pga=1.2*g --video   a stronger one
--                erbs run scenes/shake_table_house.lua -D damping=30          another mass damping (1/s), as in Fig. 6 of the source
-- What to look at  metrics.json: collapse (time_s, direction), first_crack_s, drift_storey1..3, base_shear_*, floor1..3_*.
--                The first cracks run along the bed joints at the feet of the ground-storey piers and at the corners of the door.
-- Layout         The plan is 5 mm longer than five bricks with their joints: 1525 = 5 x 305, but 5 bricks with joints of 5 mm make 1520. So
--                the wall that runs through a corner has head joints of 6.25 mm (along x) and 6 mm (along y). Cut bricks close the wall
--                between the corners. The summary printed at the start lists them all.

-- Assumed: not given by the source --------------------------------------------------------------------------------------------------
local brick_density = param("brick_density", 1800, "solid clay brick with its share of mortar, assumed [kg/m3]")
local concrete_density = param("concrete_density", 2400, "slabs and lintels, reinforced concrete, assumed [kg/m3]")
local ft = param("ft", 0.20 * MPa, "tensile strength of the bed, assumed: about 2 % of the mortar's cube strength [Pa]")
local c = param("c", 0.30 * MPa, "cohesion of the bed, assumed: 1.5 ft [Pa]")
local mu = param("mu", 0.6, "friction of the bed, assumed, before and after failure")
local Gf1 = param("Gf1", 10, "fracture energy in tension, assumed; 0 is brittle: one crack then runs through the whole house at 0.4 g [J/m2]")
local Gf2 = param("Gf2", 100, "fracture energy in shear, assumed ten times that in tension [J/m2]")
local kn_cracked = param("kn_cracked", 0, "normal stiffness of beds without bond; 0: as with bond [Pa/m]")
-- Bricks are rigid and the mortar of the source is stiff: the first mode along x is at 123.5 Hz (measured by a short pulse), ten times
-- that of a real house. 5 % of critical damping at 10 Hz is 0.4 % there; 5 % there would be 78 1/s and would brake all rocking.
local damping_ratio = param("damping_ratio", 0.05, "share of critical damping, assumed: usual for masonry")
local damping_frequency = param("damping_frequency", 10 * Hz, "where that share holds, assumed: a real house of three storeys [Hz]")
local slab_thickness = param("slab_thickness", 50 * mm, "what three storeys of 13 courses leave of 4260 mm [m]")
local bearing = param("bearing", 100 * mm, "of lintels, at least; assumed [m]")
local closer = param("closer", 90 * mm, "shortest cut brick: 45 mm would do with one cut a course, but makes the step a sixth smaller [m]")

-- Varied from run to run ------------------------------------------------------------------------------------------------------------
local pga = param("pga", 0.4 * g, "peak acceleration of the table along x [m/s2]")
local time_factor = param("time_factor", 0.707, "time scale of the record: a 1:2 model with accelerations kept")
local duration = param("duration", 1559 * 0.02 * 0.707, "of the run; the whole record by default [s]")
local damping_mass = param("damping", 2 * damping_ratio * 2 * pi * damping_frequency, "mass damping c/m; default 2 ratio omega [1/s]")
local after_collapse = param("after_collapse", 4 * s, "how long to watch the debris [s]")

-- The house -------------------------------------------------------------------------------------------------------------------------
local width, length, storeys, courses, t = 1525 * mm, 1830 * mm, 3, 13, 5 * mm

material { name = "brick", density = brick_density, friction = mu, restitution = 0.2, color = { 0.74, 0.43, 0.32 } }
material { name = "concrete", density = concrete_density, friction = mu, restitution = 0.2, color = { 0.62, 0.61, 0.58 } }
material { name = "table", density = 2400, friction = mu, restitution = 0.2, color = { 0.34, 0.35, 0.36 } }
ground { z = 0, size = 20, material = "table" }

-- Openings in half scale, assumed: door 0.9 x 2.1 m, windows 0.9 x 1.3 m along x and 0.8 x 1.3 m along y, sills at 0.84 m.
local window_height, sill = 635 * mm, 420 * mm
local house = building {
  plan = { width, length },
  at = { -width / 2, -length / 2, 0 },
  storeys = storeys,
  courses = courses,
  brick = { length = 300 * mm, width = 125 * mm, height = 100 * mm },
  joint = t,
  closer = closer,
  slab = { thickness = slab_thickness, material = "concrete" },
  lintel = { bearing = bearing, material = "concrete" },
  openings = {
    { wall = "south", name = "door", kind = "door", storey = 1, centre = width / 2, width = 450 * mm, height = 1055 * mm },
    { wall = "south", name = "window", storey = { 2, 3 }, centre = width / 2, width = 450 * mm, sill = sill, height = window_height },
    { wall = "north", name = "window", centre = width / 2, width = 450 * mm, sill = sill, height = window_height },
    { wall = "east", name = "window", centre = length / 2, width = 400 * mm, sill = sill, height = window_height },
    { wall = "west", name = "window", centre = length / 2, width = 400 * mm, sill = sill, height = window_height },
  },
}

-- The tolerance includes the head joints of 6 and 6.25 mm; they get the stiffness of 5 mm.
joint {
  name = "mortar",
  law = mortar { E = 1.07e10 * Pa, nu = 0.2, thickness = t, ft = ft, c = c, mu = mu, Gf1 = Gf1, Gf2 = Gf2, kn_cracked = kn_cracked },
  thickness = t,
  tolerance = 1.5 * mm,
}

-- The shaking -----------------------------------------------------------------------------------------------------------------------
ground_motion { wave = record { file = "records/elcentro_1940_ns.csv", peak = pga, time_factor = time_factor }, direction = "x" }
gravity(g)
damping { mass = damping_mass, scope = "bonded" }
-- Rows every 2 ms: peaks, drifts and frequencies are taken from the rows, and the first mode is at 123.5 Hz.
analysis { duration = duration, stop_after_collapse = after_collapse, output_dt = 2 * ms }

-- Recorders and metrics -------------------------------------------------------------------------------------------------------------
local weight = g * (house.report.brick_volume * brick_density + (house.report.lintel_volume + house.report.slab_volume) * concrete_density)
metric("weight_N", "N", weight)

for floor, slab in ipairs(house.slabs) do
  for _, frame in ipairs { "rel", "abs" } do
    for quantity, column in pairs { displacement = "ux_%s_m", acceleration = "ax_%s_m_s2" } do
      local name = "floor" .. floor
      local stem = name .. "_" .. column:format(frame)
      recorder { name = name, quantity = quantity, block = slab, axis = "xy", frame = frame }
      metric(stem .. "_peak", column:match("_m_s2$") and "m/s2" or "m", function(run) return run.peak(stem) end)
      metric(stem .. "_rms", column:match("_m_s2$") and "m/s2" or "m", function(run) return run.rms(stem) end)
      metric(stem .. "_frequency", "Hz", function(run) return run.frequency(stem) end)
    end
  end
  metric("drift_storey" .. floor, "", function(run)  -- largest difference of neighbouring floors over the storey's height
    local above = run.history("floor" .. floor .. "_ux_rel_m")
    local below = floor > 1 and run.history("floor" .. floor - 1 .. "_ux_rel_m")
    local largest = 0
    for i, u in ipairs(above) do largest = math.max(largest, math.abs(u - (below and below[i] or 0))) end
    return largest / (house.tops[floor] - (house.tops[floor - 1] or 0))
  end)
end

recorder { name = "base", quantity = "reaction" }  -- no block named: the sum over all supports
metric("base_shear_peak_N", "N", function(run) return run.peak("base_fx_N") end)
metric("base_shear_peak_of_weight", "", function(run) return run.peak("base_fx_N") / weight end)

recorder { name = "mortar", quantity = "damage" }         -- as a share of the area of all joints
recorder { name = "mortar", quantity = "joints_broken" }
metric("first_crack_s", "s", function(run) return run.first_crack and run.first_crack.time end)  -- resolved to one row
metric("collapse_time_s", "s", function(run) return run.collapse.time_s end)
metric("collapse_direction_deg", "deg", function(run)  -- of the mean displacement of the fallen blocks, from x towards y
  local d = run.collapse.direction
  return d and math.atan(d[2], d[1]) / deg
end)

camera { name = "three_quarter", eye = { 6.2, -7.4, 3.9 }, target = { 0, 0, 2.02 }, fov = 31 * deg }
camera { name = "front", eye = { 0, -9.5, 2.4 }, target = { 0, 0, 2.08 }, fov = 30 * deg }
camera { name = "side", eye = { 9.5, 0.6, 2.4 }, target = { 0, 0, 2.08 }, fov = 30 * deg }
camera { name = "base", eye = { 2.3, -2.7, 1.25 }, target = { 0.1, -0.4, 0.75 }, fov = 38 * deg }
