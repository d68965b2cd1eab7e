-- V44: walls of U-shaped plan, tilted until they fall out of plane: the effect of the bond at the corners.
--
-- What happens   A front wall has two side walls that run backwards from its ends. Gravity tilts outwards, with the front ahead, or
--                backwards. A U of one piece, or of rings with one piece per course, rotates about the edge of its base. A front without
--                bond to its sides falls as if it stood alone. Dry bricks with bonded corners lie between: the steps of the bond carry load
--                along the sides and brace the front. The U of one piece is the upper limit of bond.
-- Source         tan(angle) = x / z of the centroid from the edge: outwards x = sum A x / sum A of the plan, backwards depth - x, alone t /
--                2; z = H / 2. Bricks: a mechanism of the U of one piece is also one of the bricks, so it bounds them from above (kinematic
--                theorem). Plans like those tilted by Restrepo-Velez, Magenes and Griffith (2014, Int. J. Archit. Herit. 8, 325).
-- How to run     erbs run scenes/verify/v44_u_wall.lua [-D courses=12] [-D outwards=1.02] [-D front=7] [-D sides=3] [-D thick=0.12]
-- What to look at  *_over_paper, *_on_paper (angle, rad); bonded_over_paper: angle of the bricks over that of a front alone.
local courses, front, sides = param("courses", 8, ""), param("front", 5, "bricks of the front wall"), param("sides", 2, "bricks of a side wall")
local t, h = param("thick", 0.1, "of walls; bricks are twice as long [m]"), param("high", 0.1, "of a brick [m]")
local mu = param("mu", 1, "below it, walls slide")
local density = 1800
local l, H = 2 * t, courses * h
local width, depth = front * l, t + sides * l
local centre = (width * t * t / 2 + 2 * sides * l * t * (t + sides * l / 2)) / (width * t + 2 * sides * l * t)  -- from the face of the front

-- Bed of one piece: the softness at which the toe takes the share `loss` of the angle, 1.89 (4/9 d0 (H/2) / b^2)^(1/3) (V30).
local loss = 0.005
local function bed(arm) return density * g * H / ((loss / 1.89) ^ 3 * 9 / 4 * arm ^ 2 / (H / 2)) end

local function begin(kn)
  material { name = "brick", density = density, kn = kn, ks = 0.4 * kn, friction = mu }
  box { name = "floor", size = { depth + 2, width + 2, 0.2 }, at = { -1, -1, -0.2 }, fixed = true }
  joint { law = dry { kn = kn, ks = 0.4 * kn, mu = mu } }
end
local function tilt_to(angle, side)
  local times, values, slowly = {}, {}, 1 + 4 * angle  -- s
  for i = 0, 200 do
    local x = i / 200
    times[i + 1], values[i + 1] = slowly * x, side * angle * x * x * (3 - 2 * x)
  end
  tilt { wave = table_wave { times = times, values = values, hold = true }, axis = "y" }
  analysis { duration = slowly + 2.5, output_dt = 0.02, frame_dt = 0.05, stop_when_moved = 0.01 * H }
end
local function slab(x, y, a, b, z, high)
  local v = {}
  for i = 0, 7 do v[i + 1] = { x + (i % 2) * a, y + (i // 2 % 2) * b, z + i // 4 * high } end
  return { vertices = v }
end

-- side 1: outwards, the front ahead (gravity leans to -x); -1: backwards.
local function rings(number, side, arm)
  return function(angle)
    begin(bed(arm))
    local high = H / number
    for k = 0, number - 1 do
      block { name = "ring" .. k, material = "brick", parts = { slab(0, 0, t, width, k * high, high), slab(t, 0, depth - t, t, k * high, high),
        slab(t, width - t, depth - t, t, k * high, high) } }
    end
    tilt_to(angle, side)
  end
end

local function unbonded(angle)  -- a small gap keeps the front from leaning on its sides by friction
  begin(bed(t / 2))
  local room = 1 * mm
  box { name = "front", size = { t, width, H }, at = { 0, 0, 0 } }
  box { name = "left", size = { depth - t - room, t, H }, at = { t + room, 0, 0 } }
  box { name = "right", size = { depth - t - room, t, H }, at = { t + room, width - t, 0 } }
  tilt_to(angle, 1)
end

-- Corners alternate: the bricks of the front reach round them in one course, those of the sides in the next.
local function bonded(angle)
  begin(1e10)
  for c = 0, courses - 1 do
    local odd, n = c % 2, 0
    local function lay(x, y, a, b)
      n = n + 1
      box { name = string.format("c%02d_%02d", c, n), size = { a, b, h }, at = { x, y, c * h } }
    end
    for i = 0, front - 1 - odd do lay(0, odd * t + i * l, t, l) end
    for _, y in ipairs { 0, width - t } do
      for i = 0, sides - 1 do lay((1 - odd) * t + i * l, y, l, t) end
      if odd == 1 then lay(sides * l, y, t, t) end
    end
  end
  tilt_to(angle, 1)
end

local alone, whole = math.atan(t / H), math.atan(2 * centre / H)
-- The softness counts one bed of one rectangle; the bracket ends within 0.4 %.
local rel = { between = { 1 - loss - 0.005, 1 - loss + 0.005 }, source = "x / z of the centroid, less the toe of its bed" }
(include "parts/cases.lua") {
  { name = "outwards", value = whole, build = rings(1, 1, centre), lo = 0.98, hi = 1.01, rel = 0.004, unit = "rad", expect = rel },
  { name = "backwards", value = math.atan(2 * (depth - centre) / H), build = rings(1, -1, depth - centre), lo = 0.98, hi = 1.01, rel = 0.004, unit = "rad", expect = rel },
  { name = "rings", value = whole, build = rings(4, 1, centre), lo = 0.96, hi = 1.01, rel = 0.005, unit = "rad", expect = { rel = 0.02, source = "x / z of the centroid; toes of four beds" } },
  { name = "unbonded", value = alone, build = unbonded, lo = 0.98, hi = 1.01, rel = 0.004, unit = "rad", expect = rel },
  { name = "bonded", value = alone, build = bonded, lo = 1, hi = 1.05 * whole / alone, rel = 0.02, unit = "rad", expect = { between = { 1, whole / alone }, source = "the front alone; the U of one piece" } },
}
