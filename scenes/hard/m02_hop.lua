-- Hard case: the base drops away under a block faster than the block can fall
--
-- What happens   The base moves by a half sine of 1.2 g downwards, 50 ms long. While it falls faster than g the block flies; then it lands
--                and its bounces decay.
-- Source         Block and base separate when the base reaches g. Then the block flies freely above it: v = A/w (cos w t1 - cos w t) - g (t
--                - t1), plus the speed at which its bed expands at that moment. A dashpot of ratio z that cannot pull returns the share
--                exp(-z / r (pi - atan2(2 z r, 1 - 2 z^2))) of the impact speed, r = sqrt(1 - z^2) (Schwager and Poeschel 2007). A contact,
--                which takes over from a joint that has opened wide, returns its restitution.
-- How to run     erbs run scenes/hard/m02_hop.lua [-D kn=...] [-D height=...] [-D amplitude=2*g]
-- What to look at  hop (over that of the free flight), rebound (over the hop), returned (share of the speed of the first impact).
label("quick")
local kn = param("kn", 1e11, "[Pa/m]")
local length, height = param("length", 0.4, "[m]"), param("height", 0.05, "[m]")
local amplitude = param("amplitude", 1.2 * g, "of the base, downwards [m/s2]")
local ratio = param("ratio", 0.1, "of the dashpot of the joint")
family({ kn = { 1e9, 1e10, 1e12 }, length = { 0.1, 2 }, height = { 0.02, 0.3, 1 }, amplitude = { 1.5 * g, 2 * g, 3 * g },
  ratio = { 0.05, 0.3 } }, { combinations = 8 })
local frequency, density = 10, 2000
local settled = density * g * height / kn  -- m, settlement of the block; its release starts the flight
local w = 2 * pi * frequency
if amplitude <= g then error("amplitude must be above g, or nothing parts", 0) end

local t1, over = math.asin(g / amplitude) / w, pi / w
local release = settled * amplitude / g * w * math.cos(w * t1)  -- m/s, of the expanding bed when the last of the weight leaves it
local function flight(t)  -- height and speed above the base
  local s = math.min(t, over)
  local v = release + amplitude / w * (math.cos(w * t1) - math.cos(w * s)) - g * (s - t1)
  local z = release * (s - t1) + amplitude / w * ((s - t1) * math.cos(w * t1) - (math.sin(w * s) - math.sin(w * t1)) / w) - g * (s - t1) ^ 2 / 2
  local rest = t - s
  return z + v * rest - g * rest ^ 2 / 2, v - g * rest
end
local function zero(lo, hi, what)
  for _ = 1, 100 do
    local mid = (lo + hi) / 2
    if what(mid) > 0 then lo = mid else hi = mid end
  end
  return lo
end
local top = zero(t1 + 1e-9, t1 + 10 * over, function(t) local _, v = flight(t) return v end)
local lands = zero(top, top + 10 * over, function(t) return (flight(t)) end)
local hop, speed = flight(top), select(2, flight(lands))

material { name = "stone", density = density, friction = 0.6, restitution = 0.3 }
box { name = "base", size = { 3 * length, 1, 0.2 }, center = { 0, 0, -0.1 }, fixed = true }
box { name = "block", size = { length, 0.2, height }, center = { 0, 0, height / 2 } }
joint { law = dry { kn = kn, mu = 0.6, damping = ratio } }
ground_motion { wave = half_sine { amplitude = -amplitude, frequency = frequency }, direction = "z" }
recorder { name = "block", quantity = "displacement", block = "block", axis = "z" }
local column = "block_uz_rel_m"
-- The highest point between two times.
local function highest(run, from, to)
  local most, times = -math.huge, run.time
  for i, z in ipairs(run.history(column)) do
    if times[i] >= from and times[i] <= to then most = math.max(most, z - settled) end
  end
  return most
end
local again = 2 * math.abs(speed) / g  -- s, duration of a flight that starts as fast as this one ends
local function rebound(run) return highest(run, lands + 0.1 * (lands - t1), lands + again) end
metric("hop", "", function(run) return highest(run, 0, lands) / hop end)
metric("rebound", "", function(run) return rebound(run) / hop end)
metric("returned", "", function(run) return math.sqrt(2 * g * math.max(0, rebound(run))) / math.abs(speed) end)
local root = math.sqrt(1 - ratio ^ 2)
local by_joint, by_contact = math.exp(-ratio / root * (pi - math.atan(2 * ratio * root, 1 - 2 * ratio ^ 2))), 0.3
metric("off", "", function(run)
  local returned = math.sqrt(2 * g * math.max(0, rebound(run))) / math.abs(speed)
  return math.min(math.abs(returned - by_joint), math.abs(returned - by_contact))
end)
metric("later", "", function(run) return highest(run, lands + again, 1e9) / hop end)
metric("damped", "J", function(run) return run.energy.damping_J + run.energy.contact_damping_J end)
analysis { duration = lands + 4 * again + 0.1, output_dt = 1e-4, frame_dt = 1 }
expect("metrics.hop", 1, { abs = 0.01 + 2 * settled / hop, source = "free flight above a base that drops" })
expect("metrics.rebound", 1, { below = true, source = "dashpots take" })
expect("metrics.later", 1, { below = true, source = "dashpots take" })
expect("metrics.off", 0, { abs = 0.05, source = "half a swing of a damped spring, or the restitution of the contact" })
expect("metrics.damped", 0, { above = true, source = "dashpots take" })
expect("energy.residual_relative", 1e-3, { below = true, source = "nothing is made" })
