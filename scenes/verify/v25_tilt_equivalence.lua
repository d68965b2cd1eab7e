-- V25: the same wall on a rotating table and under rotating gravity overturns at the same angle.
--
-- What happens   A free-standing wall of dry courses stands on a base that rotates (turning{}); in a child run gravity rotates the other
--                way instead (tilt{}). Both are slow, at `rate`. Seen from the wall the two are the same, apart from the accelerations of
--                the slow base (rate squared times the height: 1e-5 g). A rigid wall overturns on its edge at atan(t / H).
-- Source         relative motion: a body on a table at angle b feels g rotated by -b.
-- How to run     erbs run scenes/verify/v25_tilt_equivalence.lua [-D rate=0.2*deg] [-D courses=10]
-- What to look at  angle_deg: angle of the table at which the top has moved by 2 % of the thickness, seen from the table; difference_deg;
--                rigid_angle_deg.
label("quick")
local turned = param("gravity_turns", 0, "above 0: gravity turns instead of the base")
local courses = param("courses", 5, "")
local width, thick, height = param("width", 0.6, "[m]"), param("thick", 0.2, "[m]"), param("height", 0.24, "of a course [m]")
local kn = param("kn", 2e10, "[Pa/m]")
local rate = param("rate", 1 * deg, "of the table [rad/s]")
local from = param("from", 0.9, "of the rigid wall's angle: where the slow part begins")

material { name = "stone", density = 1800, friction = 0.8, kn = kn, ks = 0.4 * kn }
local H = courses * height
local rigid = math.atan(thick / H)
-- Quickly and smoothly to `from`, then at a steady rate: the angle of the table as a table of times. The corners of this polyline lie about
-- a step apart; a coarser one would give an impulse at every corner, and only to the base.
local angles, times, n = {}, {}, 30000
local fast = 6.0
local function smooth(s) return s ^ 3 * (10 - 15 * s + 6 * s ^ 2) end
for i = 0, n do times[#times + 1], angles[#angles + 1] = fast * i / n, from * rigid * smooth(i / n) end
local rest = 0.3
times[#times + 1], angles[#angles + 1] = fast + rest, from * rigid
-- the corner to the steady rate, rounded
for i = 1, 5000 do times[#times + 1], angles[#angles + 1] = fast + rest + i / 5000, from * rigid + rate * 0.5 * (i / 5000) ^ 2 end
local t0, a0 = times[#times], angles[#angles]
local t1 = t0 + (1.15 * rigid - a0) / rate
times[#times + 1], angles[#angles + 1] = t1, 1.15 * rigid
local function angle_at(time)
  local low, high = 2, #times
  while low < high do
    local middle = (low + high) // 2
    if time <= times[middle] then high = middle else low = middle + 1 end
  end
  local part = math.min(1, (time - times[low - 1]) / (times[low] - times[low - 1]))
  return angles[low - 1] + (angles[low] - angles[low - 1]) * part
end
local table_of_angles = table_wave { times = times, values = angles, hold = true }
-- The wall leans towards +x: the table rotates by +angle about y through the foot of the wall, or gravity by -angle.
box { name = "base", group = "base", size = { 3 * thick, 2 * width, 0.2 }, at = { -1.5 * thick, -width, -0.2 }, fixed = turned > 0 }
for i = 1, courses do
  box { name = "course" .. i, group = "wall", size = { thick, width, height }, at = { -thick / 2, -width / 2, (i - 1) * height } }
end
joint { law = dry { kn = kn, mu = 0.8 } }
if turned > 0 then tilt { wave = table_wave { times = times, values = (function() local v = {} for i, a in ipairs(angles) do v[i] = -a end return v end)(), hold = true }, axis = "y" }
else turning { block = "base", wave = table_of_angles, axis = "y", about = { 0, 0, 0 } } end
local top = "course" .. courses
recorder { name = "top", quantity = "displacement", block = top, axis = "xz" }
damping { mass = 0 }
analysis { duration = t1, output_dt = 0.01, frame_dt = 0.5, collapse_fraction = 0.3, stop_after_collapse = 0.05 }
-- Displacement of the top seen from the table: x' = R(-angle) (rest + u) - rest, across the wall.
local function overturning(run)
  local x, z = run.history("top_ux_rel_m"), run.history("top_uz_rel_m")
  local high = (courses - 0.5) * height
  for i, time in ipairs(run.time) do
    local b = turned > 0 and 0 or angle_at(time)
    local across = x[i] * math.cos(b) - (high + z[i]) * math.sin(b)
    if across > 0.02 * thick then return angle_at(time) / deg end
  end
end
metric("angle_deg", "deg", overturning)
ensemble { n = 1, seed = 1, param = "gravity_turns", name = "gravity", value = overturning }
metric("difference_deg", "deg", function(run) return overturning(run) - run.metrics.metrics.gravity_mean end)
metric("rigid_angle_deg", "deg", rigid / deg)
expect("metrics.difference_deg", 0, { abs = 0.1, source = "relative motion" })
-- The elastic toe takes the share 1.89 (4/9 d0 h / b^2)^(1/3) of the angle for one block (V30), and more for several courses.
expect("metrics.angle_deg", rigid / deg, { rel = 0.1, source = "atan(t / H), softened by the bed" })
