-- Four mitred walls under a ring of reinforced concrete, on ground that shakes as a sine: how much does the ring help?
--
-- What happens   Four walls without bond stand on a base, mitred at the corners. The ground moves as a sine that begins at the phase at which a
--                wall lifts off. The wall across the motion leans outwards and takes the ring along; the walls along it hold the ring by friction.
-- Source         P. J. S. Gomes, Modelling of masonry structures by means of the discrete element method (IST Lisbon): geometry, cases, contacts
--                between walls (50 MPa/m, frictionless) and under the ring (1 GPa/m, 30 degrees), phase and both criteria. Its calibrated
--                contact of wall and base is not printed: ours is fitted to Housner 1963 by scenes/studies/calibrate_wall.lua and
--                calibrate_wall_pena.lua. Density of the ring with its share of the roof from its Table 2.
-- How to run     erbs run scenes/box_lintel.lua [-D case=3] [-D method=2] [-D omega=1] [-D amplitude=2] [-D 'direction="y"']
--                [-D side_friction=0] [-D 'criterion="alpha"'];  all of Figs. 9 and 10: erbs sweep scenes/studies/box_collapse_relation.lua
-- What to look at  metrics.collapse_wall (1: the criterion is met), metrics.turn_at_zero, metrics.turn_front, _back and _side (over alpha)
local case = param("case", 2, "1 no ring, 2 ring, 3 ring with the roof, 4 ring with three times the roof")
local method = param("method", 1, "calibration of the contact of wall and base: 1 stiffness and friction, 2 stiffness and damping after Pena")
local omega = param("omega", 1, "circular frequency of the ground over p of a wall [-]")
local amplitude = param("amplitude", 2, "of the ground over g alpha [-]")
local direction = param("direction", "x", "of the ground, x or y")
local side_friction = param("side_friction", 1, "1: the ring rubs on the walls along the motion; 0: it does not, and the rocking frame stands alone")
local criterion = param("criterion", "alpha_at_zero", "alpha_at_zero: theta = alpha when the acceleration first vanishes; alpha: at any time of the run")
local cycles = param("cycles", 3, "of the sine, for the criterion alpha")
local angle = param("angle", 30, "of friction under the ring [deg]")
local kn_bed = param("kn_bed", 0, "stiffness of the contact of wall and base, 0: that of the method [Pa/m]")

local function one_of(name, value, ...)
  for _, allowed in ipairs { ... } do if value == allowed then return end end
  error(string.format("%s is %s; it may be %s", name, value, table.concat({ ... }, ", ")), 0)
end
one_of("case", case, 1, 2, 3, 4)
one_of("method", method, 1, 2)
one_of("direction", direction, "x", "y")
one_of("side_friction", side_friction, 0, 1)
one_of("criterion", criterion, "alpha_at_zero", "alpha")
if omega <= 0 then error("omega must be above 0: at 0 the acceleration never vanishes; take 0.05", 0) end
gravity(9.8)  -- the source's, by which its densities are weights

local width, height, outer = 0.6, 3.0, 4.0   -- m
local ring_height, overhang, base_height = 0.7, 1.5, 0.4
local alpha = math.atan(width / height)
local p = rocking { width = width, height = height, duration = 1e-3, gravity = 9.8 }.p
if amplitude * alpha < math.sin(alpha) then
  error(string.format("amplitude = %g does not lift a wall: the phase of the start is asin(g sin(alpha) / a), so a must be at least %.4f g alpha", amplitude, math.sin(alpha) / alpha), 0)
end

-- The contact of wall and base, by the calibration of each method; restitution exp(-pi xi / sqrt(1 - xi^2)) is that of the damping ratio xi.
local bed = ({ { kn = 1e12, ks = 1e12, mu = math.tan(30 * deg), restitution = 1, damping = 0 },
  { kn = 1e12, ks = 1e12, mu = math.tan(30 * deg), restitution = 0.26, damping = 0.39 } })[method]
if kn_bed > 0 then bed.kn, bed.ks = kn_bed, kn_bed end

-- Friction of debris is that of the ring's contact: former joints keep their own as long as they touch.
local rub = math.tan(angle * deg)
material { name = "wall", density = 1800, kn = bed.kn, ks = bed.ks, friction = bed.mu, restitution = bed.restitution }
material { name = "ring", density = ({ 2551.02, 2551.02, 3408.51, 5123.48 })[case], kn = bed.kn, ks = bed.ks, friction = rub, restitution = bed.restitution, color = { 0.75, 0.75, 0.78 } }
box { name = "base", group = "base", material = "wall", fixed = true, size = { outer + 2 * overhang, outer + 2 * overhang, base_height },
  at = { -outer / 2 - overhang, -outer / 2 - overhang, -base_height } }

-- Corners of the mitred side that faces `quarter` times 90 degrees from +x, between the heights z0 and z1.
local function side(quarter, z0, z1)
  local vertices, a, b = {}, outer / 2, outer / 2 - width
  local c, s = ({ 1, 0, -1, 0 })[quarter + 1], ({ 0, 1, 0, -1 })[quarter + 1]
  for _, xy in ipairs { { b, -b }, { a, -a }, { a, a }, { b, b } } do
    for _, z in ipairs { z0, z1 } do vertices[#vertices + 1] = { c * xy[1] - s * xy[2], s * xy[1] + c * xy[2], z } end
  end
  return { vertices = vertices }
end
local names = { "east", "north", "west", "south" }  -- +x, +y, -x, -y
local across = direction == "x" and { east = true, west = true } or { north = true, south = true }
for quarter, name in ipairs(names) do
  block { name = name, group = across[name] and "across" or "along", material = "wall", vertices = side(quarter - 1, 0, height).vertices }
end
if case > 1 then
  local parts = {}
  for quarter = 0, 3 do parts[#parts + 1] = side(quarter, height, height + ring_height) end
  block { name = "ring", group = "ring", material = "ring", parts = parts }
end
local mitre = dry { kn = 50e6, ks = 50e6, mu = 0, damping = 0 }
joint { law = dry { kn = bed.kn, ks = bed.ks, mu = bed.mu, damping = bed.damping } }
joint { law = mitre, between = { "across", "along" } }
if case > 1 then
  joint { law = dry { kn = 1e9, ks = 1e9, mu = rub, damping = 0.1 }, between = { "across", "ring" } }
  joint { law = dry { kn = 1e9, ks = 1e9, mu = side_friction * rub, damping = 0.1 }, between = { "along", "ring" } }
end

-- a sin psi = g sin(alpha). The walls follow +sin: the ground moves by -sin.
local rate, psi = omega * p, math.asin(math.sin(alpha) / (amplitude * alpha))
local zero = (math.pi - psi) / rate  -- s, the acceleration first vanishes
ground_motion { wave = sine { amplitude = -amplitude * 9.8 * alpha, frequency = rate / (2 * pi), phase = psi }, direction = direction }
local at_zero = criterion == "alpha_at_zero"
analysis { duration = at_zero and zero or cycles * 2 * pi / rate, output_dt = at_zero and zero / 200 or 0.01, frame_dt = 0.05, stop_after_collapse = 0.5 }

local front, back = direction == "x" and "east" or "north", direction == "x" and "west" or "south"
local sides = direction == "x" and { "north", "south" } or { "east", "west" }
local about = direction == "x" and "y" or "x"
for _, name in ipairs(names) do recorder { name = name, quantity = "rotation", block = name, axis = "xy" } end
if case > 1 then recorder { name = "ring", quantity = "displacement", block = "ring" } end
local function column(name, axis) return name .. "_r" .. axis .. "_rad" end
metric("turn_front", "", function(run) return run.peak(column(front, about)) / alpha end)
metric("turn_back", "", function(run) return run.peak(column(back, about)) / alpha end)
metric("turn_side", "", function(run)  -- out of their plane
  local other = about == "x" and "y" or "x"
  return math.max(run.peak(column(sides[1], other)), run.peak(column(sides[2], other))) / alpha
end)
local function turn_at_zero(run)
  local most = 0
  for _, name in ipairs { front, back } do most = math.max(most, math.abs(run.at(column(name, about), math.min(zero, run.time_s)))) end
  return most / alpha
end
metric("turn_at_zero", "", turn_at_zero)
metric("collapse_wall", "", function(run)
  if at_zero then return turn_at_zero(run) >= 1 and 1 or 0 end
  return math.max(run.peak(column(front, about)), run.peak(column(back, about))) >= alpha and 1 or 0
end)
metric("zero_s", "s", zero)
metric("p", "rad/s", p)
camera { name = "box", eye = { 11, -11, 7 }, target = { 0, 0, 1.5 } }
