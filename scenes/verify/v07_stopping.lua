-- V07: blocks thrown along a flat floor in sixteen directions come to rest after v0^2 / (2 mu g).
--
-- What happens   All blocks have the same orientation and are thrown outwards from a common centre. Friction must not prefer an axis of the
--                world or of the block.
-- Source         Coulomb: stop distance v0^2 / (2 mu g), stop time v0 / (mu g).
-- How to run     erbs run scenes/verify/v07_stopping.lua [-D v0=3] [-D mu=0.3] [-D kn=...] [-D directions=32]
-- What to look at  distance_largest, distance_smallest, spread, time_error, sideways (displacement across the throw).
label("quick")
local v0, mu = param("v0", 2, "[m/s]"), param("mu", 0.5, "")
local directions = param("directions", 16, "")
local kn = param("kn", 1e9, "[Pa/m]")
local size = param("size", 0.2, "longer side of the blocks, a twentieth of it high: they do not tip [m]")
local distance, stop_time = v0 ^ 2 / (2 * mu * g), v0 / (mu * g)

material { name = "stone", density = 1800, friction = mu, kn = kn, ks = 0.4 * kn }
local radius = directions * 1.3 * size / (2 * pi)
box { name = "floor", group = "floor", size = { 2.6 * (radius + distance + size), 2.6 * (radius + distance + size), 0.2 },
  center = { 0, 0, -0.1 }, fixed = true }
for i = 1, directions do
  local a = 2 * pi * (i - 1) / directions + 0.05
  local e = { math.cos(a), math.sin(a) }
  box { name = "block" .. i, group = "block", size = { size, size / 1.5, size / 20 }, center = { radius * e[1], radius * e[2], size / 40 },
    initial = { velocity = { v0 * e[1], v0 * e[2], 0 } } }
  recorder { name = "block" .. i, quantity = "displacement", block = "block" .. i, axis = "xy" }
  recorder { name = "block" .. i, quantity = "velocity", block = "block" .. i, axis = "xy" }
end
joint { law = dry { kn = kn, mu = mu }, between = { "floor", "block" } }
local function along(run, i, column, row)
  local a = 2 * pi * (i - 1) / directions + 0.05
  local x, y = run.history("block" .. i .. "_" .. column:format("x")), run.history("block" .. i .. "_" .. column:format("y"))
  row = row or #x
  return x[row] * math.cos(a) + y[row] * math.sin(a), -x[row] * math.sin(a) + y[row] * math.cos(a)
end
local function over(run, pick)
  local low, high = math.huge, -math.huge
  for i = 1, directions do
    local x = pick(i)
    low, high = math.min(low, x), math.max(high, x)
  end
  return low, high
end
local function distances(run) return over(run, function(i) return (along(run, i, "u%s_rel_m")) / distance end) end
metric("distance_smallest", "", function(run) return (distances(run)) end)
metric("distance_largest", "", function(run) return (select(2, distances(run))) end)
metric("spread", "", function(run) local low, high = distances(run) return high - low end)
metric("sideways", "", function(run)
  return select(2, over(run, function(i) return math.abs(select(2, along(run, i, "u%s_rel_m"))) / distance end))
end)
metric("time_error", "", function(run)  -- the straight line through the speeds at 0.2 and 0.6 of the rows, extended to zero
  local low, high = over(run, function(i)
    local r1, r2 = math.floor(0.2 * #run.time), math.floor(0.6 * #run.time)
    local v1, v2 = along(run, i, "v%s_rel_m_s", r1), along(run, i, "v%s_rel_m_s", r2)
    return run.time[r1] + v1 * (run.time[r2] - run.time[r1]) / (v1 - v2)
  end)
  return math.max(math.abs(low - stop_time), math.abs(high - stop_time)) / stop_time
end)
analysis { duration = 1.2 * stop_time, start = "equilibrium", output_dt = stop_time / 200 }
-- Friction follows slip, so the first half step has no brake: v0 dt / 2 more distance, with a step of 1.8 / omega of the bed. And 0.05 %:
-- the vibration of the bed at the start, and the deformation of the shear spring at the stop.
local late = 5e-4 + mu * g * 1.8 * math.sqrt(1800 * size / 20 / kn) / v0
expect("metrics.distance_smallest", 1, { abs = late, source = "v0^2 / (2 mu g)" })
expect("metrics.distance_largest", 1, { abs = late, source = "v0^2 / (2 mu g)" })
expect("metrics.spread", 1e-3, { below = true, source = "isotropy" })
expect("metrics.sideways", 1e-3, { below = true, source = "isotropy" })
expect("metrics.time_error", late, { below = true, source = "v0 / (mu g)" })
