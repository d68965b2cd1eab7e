-- V44: gravity tilts slowly: free-standing walls overturn out of plane at atan(t/H), and a slice of a dome needs its least thickness.
--
-- What happens   A wall of one piece and a wall of courses are tilted; bisection finds the angle. A slice of a hemispherical dome, two
--                opposite lunes of its shell without hoops, stands slightly above its least t/R.
-- Source         atan(t/H) of a rigid wall. Dome: 0.042 (Heyman 1967), for the slice with straight voussoirs by parts/thrust_line.lua with
--                weights that grow with the distance from the axis.
-- How to run     erbs run scenes/verify/v44_tilt.lua [-D wall=1.01] [-D dome=1.02]
-- What to look at  *_over_paper; the mechanism of the run.
local H, density = param("height", 3, "[m]"), 1800

local function tilt_to(angle, moved)
  local times, values = {}, {}
  for i = 0, 20 do
    local x = i / 20
    times[i + 1], values[i + 1] = 2 * x, angle * x * x * (3 - 2 * x)
  end
  tilt { wave = table_wave { times = times, values = values, hold = true }, axis = "y" }
  analysis { duration = 5, output_dt = 0.02, frame_dt = 0.05, stop_when_moved = moved }
end
-- The bed takes the share 1.89 (4/9 d0 h/b^2)^(1/3) off (V30): a wall of one piece on a bed of 4e14 Pa/m loses 0.2 %.
local function wall_of(courses, thickness, kn)
  return function(angle)
    material { name = "brick", density = density, kn = kn, ks = 0.4 * kn, friction = 0.8 }
    box { name = "floor", size = { 10, 2, 0.5 }, at = { -5, -1, -0.5 }, fixed = true, material = "brick" }
    column { name = "wall", blocks = courses, size = { thickness, 1, H / courses }, material = "brick" }
    joint { law = dry { kn = kn, ks = 0.4 * kn, mu = 0.8 } }
    tilt_to(angle, 0.01 * H)
  end
end

local thrust_line = include "parts/thrust_line.lua"
-- A lune's width grows with the distance from the axis: weight int x dA, centroid int x^2 dA / int x dA.
local function lune(corners)
  local x1, x2 = 0, 0
  for i, p in ipairs(corners) do
    local q = corners[i % #corners + 1]
    local cross = p[1] * q[2] - q[1] * p[2]
    x1, x2 = x1 + (p[1] + q[1]) * cross / 6, x2 + (p[1] ^ 2 + p[1] * q[1] + q[1] ^ 2) * cross / 12
  end
  return math.abs(x1), x2 / x1
end
local pieces, R = 15, 10  -- of the two lunes, which share the keystone
local function dome(thickness)
  local kn, spread = 5e12, math.tan(10 * deg)
  material { name = "stone", density = 2000, kn = kn, ks = 0.4 * kn, friction = 2 }
  joint { law = dry { kn = kn, ks = 0.4 * kn, mu = 2 } }
  local joints = thrust_line.half_arch(pieces, pi, 0, thickness)
  local function corners(joint, side)
    local v = {}
    for _, p in ipairs(joint) do
      for _, y in ipairs { -1, 1 } do v[#v + 1] = { side * R * p[1], y * R * p[1] * spread, R * p[2] } end
    end
    return v
  end
  local function hull_of(a, b, side)
    local v = corners(a, side)
    for _, p in ipairs(corners(b, side)) do v[#v + 1] = p end
    return v
  end
  local top, first = joints[1], joints[2]
  local function tip(side)
    local v = corners(first, side)
    for _, p in ipairs(top) do v[#v + 1] = { 0, 0, R * p[2] } end
    return { vertices = v }
  end
  block { name = "key", material = "stone", parts = { tip(1), tip(-1) } }
  for _, side in ipairs { 1, -1 } do
    local name = side > 0 and "right" or "left"
    for k = 3, #joints do block { name = string.format("%s%02d", name, k - 2), material = "stone", vertices = hull_of(joints[k - 1], joints[k], side) } end
    local last, t = joints[#joints], thickness * R
    local below = corners(last, side)
    for _, p in ipairs(corners(last, side)) do below[#below + 1] = { p[1], p[2], p[3] - t } end
    block { name = name .. "_foot", fixed = true, material = "stone", vertices = below }
  end
  analysis { duration = 4, output_dt = 0.02, frame_dt = 0.1, stop_when_moved = 0.005 * R }
end
(include "parts/cases.lua") {
  { name = "wall", value = math.atan(0.3 / H), build = wall_of(1, 0.3, 4e14), lo = 0.99, hi = 1.005, rel = 0.003, unit = "rad", expect = { rel = 0.005, source = "atan(t/H); toe of the bed -.2 %" } },
  { name = "thick_wall", value = math.atan(0.6 / H), build = wall_of(1, 0.6, 1.5e14), lo = 0.99, hi = 1.005, rel = 0.003, unit = "rad", expect = { rel = 0.005, source = "atan(t/H); toe of the bed -.2 %" } },
  -- 2 %: the toes of ten softer beds.
  { name = "courses", value = math.atan(0.3 / H), build = wall_of(10, 0.3, 3e12), lo = 0.97, hi = 1.01, rel = 0.005, unit = "rad", expect = { rel = 0.02, source = "atan(t/H)" } },
  { name = "dome", value = thrust_line.least_thickness(pieces, pi, 0, lune), build = dome, lo = 1.05, hi = 0.98, rel = 0.01, unit = "t/R", expect = { between = { 0.999, 1.04 }, source = "thrust line of a lune" } },
}
