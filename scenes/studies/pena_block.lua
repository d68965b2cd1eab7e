-- A granite block of Pena et al. that rocks freely, under a harmonic or a random motion, for the study pena_blocks.lua
--
-- What happens   The block starts turned and rocks to rest, or its base is shaken. One trace says little: small differences grow with each impact.
-- Source         Pena, Prieto, Lourenco, Campos Costa and Lemos 2007 (EESD 36, 2383): blocks 1 to 3. Their records are not at hand; the random
--                motion is white between 1 and 8 Hz under a trapezium, from a seed.
-- How to run     erbs run scenes/studies/pena_block.lua -D specimen=2 -D motion='"harmonic"'
-- What to look at  metrics.peak: largest rotation over alpha; metrics.overturned; metrics.rest: time after which it stays below .05 alpha
local specimen = param("specimen", 1, "1, 2 or 3")
local motion = param("motion", "free", "free, harmonic or random")
local seed, level = param("seed", 1, "of the random motion"), param("level", 1.5, "peak acceleration over g tan(alpha)")
local frequency, phi0 = param("frequency", 3, "of the harmonic motion [Hz]"), param("phi0", 0.5, "first rotation over alpha, free")
local sizes = { { 0.25, 1.0, 0.754 }, { 0.17, 1.0, 0.502 }, { 0.12, 1.0, 0.375 } }
local width, height, depth = table.unpack(sizes[specimen] or error("specimen must be 1, 2 or 3", 0))
local alpha, density, b = math.atan(width / height), 2670, width / 2

local settlement, foot, hollow = 1e-5, 0.008 * width, 1e-3 * height
local kn = density * g * height / (settlement * b)
material { name = "granite", density = density, kn = kn, ks = 0.4 * kn, friction = 0.6, restitution = 0.24 }
box { name = "base", material = "granite", fixed = true, size = { 4, 2 * depth, 0.25 }, at = { -2, -depth, -0.25 } }
local function part(x0, x1, z0, z1)
  local v = {}
  for _, x in ipairs { x0, x1 } do
    for _, y in ipairs { -depth / 2, depth / 2 } do
      for _, z in ipairs { z0, z1 } do v[#v + 1] = { x, y, z } end
    end
  end
  return { vertices = v }
end
block { name = "block", material = "granite", free = true,
  initial = motion == "free" and { rotation = { 0, phi0 * alpha, 0 }, about = { b, 0, 0 } } or nil,
  parts = { part(-b, -b + foot, 0, hollow), part(b - foot, b, 0, hollow), part(-b, b, hollow, height) } }

local duration = motion == "free" and 6 or 12
if motion == "harmonic" then
  ground_motion { wave = sine { amplitude = level * g * math.tan(alpha), frequency = frequency, duration = 6 }, direction = "x" }
elseif motion == "random" then
  local state = seed * 7919 + 1
  local function random() state = (state * 1103515245 + 12345) % 2147483648; return state / 2147483648 end
  local waves, times, values, peak = {}, {}, {}, 0
  for i = 1, 80 do waves[i] = { 2 * pi * (1 + 7 * random()), 2 * pi * random() } end
  for i = 0, 800 do
    local t, sum = i * 0.01, 0
    for _, w in ipairs(waves) do sum = sum + math.cos(w[1] * t + w[2]) end
    times[#times + 1] = t
    values[#values + 1] = sum * math.min(1, t, (8 - t) / 2)
    peak = math.max(peak, math.abs(values[#values]))
  end
  for i = 1, #values do values[i] = values[i] / peak * level * g * math.tan(alpha) end
  ground_motion { wave = table_wave { times = times, values = values }, direction = "x" }
end
recorder { name = "block", quantity = "rotation", block = "block", axis = "y" }
-- A block that starts turned counts as fallen once its centre is lower than there, so that a free run goes on to its end.
analysis { duration = duration, start = "rest", output_dt = 0.01, frame_dt = 1, stop_after_collapse = motion == "free" and -1 or 0.5 }
metric("overturned", "", function(run) return run.peak("block_ry_rad") > 1.5 * alpha and 1 or 0 end)
metric("peak", "", function(run) return run.peak("block_ry_rad") / alpha end)
metric("rest", "s", function(run)
  local last = 0
  for i, theta in ipairs(run.history("block_ry_rad")) do
    if math.abs(theta) > 0.05 * alpha then last = run.time[i] end
  end
  return last
end)
