-- Four mitred walls of .6 x 3 x 4 m on a base, with or without a ring of reinforced concrete on top, on ground that shakes as a sine.
--
-- box_of_walls { case =, method =, omega =, amplitude =, direction =, side_friction =, criterion =, ... }, keys as the params of box_lintel.lua
-- of the same names, and beds = include "parts/calibrated_beds.lua". It builds everything, analysis{} included, and returns
--   alpha, p     of a wall as thick all along: rad, rad/s
--   zero         s, when the acceleration first vanishes
--   turn(run, which)  greatest rotation of "front", "back" or "side" (out of its plane), over alpha
--   turn_at_zero(run), collapsed(run)   of the walls across the motion, over alpha; by the criterion
-- The walls follow +sin: the ground moves by -sin, and the front wall is the one at + x or + y.
local width, height, outer = 0.6, 3.0, 4.0  -- m
local ring_height, overhang, base_height = 0.7, 1.5, 0.4
local gravity_of_source = 9.8  -- m/s2, by which its densities are weights

-- Corners of the mitred side that faces `quarter` times 90 degrees from +x, between the heights z0 and z1.
local function side(quarter, z0, z1)
  local vertices, a, b = {}, outer / 2, outer / 2 - width
  local c, s = ({ 1, 0, -1, 0 })[quarter + 1], ({ 0, 1, 0, -1 })[quarter + 1]
  for _, xy in ipairs { { b, -b }, { a, -a }, { a, a }, { b, b } } do
    for _, z in ipairs { z0, z1 } do vertices[#vertices + 1] = { c * xy[1] - s * xy[2], s * xy[1] + c * xy[2], z } end
  end
  return { vertices = vertices }
end

local function one_of(name, value, ...)
  for _, allowed in ipairs { ... } do if value == allowed then return end end
  error(string.format("%s is %s; it may be %s", name, value, table.concat({ ... }, ", ")), 0)
end

return function(keys)
  local case, method, omega, amplitude, direction = keys.case, keys.method or 1, keys.omega, keys.amplitude, keys.direction or "x"
  local side_friction, criterion = keys.side_friction or 1, keys.criterion or "alpha_at_zero"
  one_of("case", case, 1, 2, 3, 4)
  one_of("method", method, 1, 2)
  one_of("direction", direction, "x", "y")
  one_of("side_friction", side_friction, 0, 1)
  one_of("criterion", criterion, "alpha_at_zero", "alpha")
  if omega <= 0 then error("omega must be above 0: at 0 the acceleration never vanishes; take 0.05", 0) end
  if amplitude <= 0 then error("amplitude must be above 0, such as 1.5", 0) end
  gravity(gravity_of_source)
  local alpha, p = math.atan(width / height), rocking { width = width, height = height, duration = 1e-3, gravity = gravity_of_source }.p

  local bed = keys.beds[method]
  local kn, ks = keys.kn_bed or bed.kn, keys.kn_bed or bed.ks
  local rub = math.tan((keys.angle or 30) * deg)
  local smooth, along_rub = math.tan((keys.mitre_angle or 0) * deg), side_friction * rub
  -- Faces that part and meet again rub as they did: a mitre as a mitre, under the ring as under the ring.
  -- No joint is stiffer than the contact that follows it, so none softens.
  local function stone(name, density, friction_with, color)
    material { name = name, density = density, kn = math.max(kn, 1e9), ks = math.max(ks, 1e9), friction = bed.mu, restitution = bed.restitution,
      friction_with = friction_with, color = color }
  end
  stone("base", 1800)
  stone("across", 1800, { across = smooth, along = smooth, ring = case > 1 and rub or nil })
  stone("along", 1800, { along = smooth, ring = case > 1 and along_rub or nil })
  box { name = "base", group = "base", material = "base", fixed = true, size = { outer + 2 * overhang, outer + 2 * overhang, base_height },
    at = { -outer / 2 - overhang, -outer / 2 - overhang, -base_height } }
  local names = { "east", "north", "west", "south" }  -- +x, +y, -x, -y
  local across = direction == "x" and { east = true, west = true } or { north = true, south = true }
  for quarter, name in ipairs(names) do
    block { name = name, group = across[name] and "across" or "along", material = across[name] and "across" or "along", vertices = side(quarter - 1, 0, height).vertices }
  end
  joint { law = dry { kn = kn, ks = ks, mu = bed.mu, damping = bed.damping } }
  local mitre = keys.mitre_kn or 50e6
  joint { law = dry { kn = mitre, ks = mitre, mu = smooth, damping = 0 }, between = { "across", "along" } }
  if case > 1 then
    local parts = {}
    for quarter = 0, 3 do parts[#parts + 1] = side(quarter, height, height + ring_height) end
    stone("ring", ({ [2] = 2551.02, [3] = 3408.51, [4] = 5123.48 })[case], nil, { 0.75, 0.75, 0.78 })
    block { name = "ring", group = "ring", material = "ring", parts = parts }
    joint { law = dry { kn = 1e9, ks = 1e9, mu = rub, damping = 0.1 }, between = { "across", "ring" } }
    joint { law = dry { kn = 1e9, ks = 1e9, mu = along_rub, damping = 0.1 }, between = { "along", "ring" } }
  end

  -- a sin psi = g sin(alpha): the phase at which a wall as thick all along lifts off. Mitred walls lift off earlier, since their centroid lies
  -- .018 m nearer to the outer edge; amplitudes below g sin(alpha) begin at the peak.
  local rate, psi = omega * p, math.asin(math.min(1, math.sin(alpha) / (amplitude * alpha)))
  local zero = (math.pi - psi) / rate
  ground_motion { wave = sine { amplitude = -amplitude * gravity_of_source * alpha, frequency = rate / (2 * pi), phase = psi }, direction = direction }
  local at_zero = criterion == "alpha_at_zero"
  analysis { duration = at_zero and zero or (keys.cycles or 3) * 2 * pi / rate, output_dt = at_zero and zero / 200 or 0.01, frame_dt = 0.05,
    stop_after_collapse = at_zero and 0 or 0.5 }

  local walls = direction == "x" and { front = "east", back = "west", side = { "north", "south" } } or { front = "north", back = "south", side = { "east", "west" } }
  local about, other = direction == "x" and "y" or "x", direction == "x" and "x" or "y"
  for _, name in ipairs(names) do recorder { name = name, quantity = "rotation", block = name, axis = "xy" } end
  if case > 1 then recorder { name = "ring", quantity = "displacement", block = "ring" } end
  local function column(name, axis) return name .. "_r" .. axis .. "_rad" end
  local function turn(run, which)
    if which == "side" then return math.max(run.peak(column(walls.side[1], other)), run.peak(column(walls.side[2], other))) / alpha end
    return run.peak(column(walls[which], about)) / alpha
  end
  local function turn_at_zero(run)
    local function of(which) return math.abs(run.at(column(walls[which], about), math.min(zero, run.time_s))) end
    return math.max(of "front", of "back") / alpha
  end
  local function collapsed(run)
    if at_zero then return turn_at_zero(run) >= 1 end
    return math.max(turn(run, "front"), turn(run, "back")) >= 1
  end
  return { alpha = alpha, p = p, zero = zero, turn = turn, turn_at_zero = turn_at_zero, collapsed = collapsed }
end
