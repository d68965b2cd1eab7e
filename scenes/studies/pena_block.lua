-- A granite block of Pena et al. that rocks freely, under a harmonic or a random motion, for the study pena_blocks.lua
--
-- What happens   The block starts turned and rocks to rest, or its base is shaken. One trace says little: small differences grow with each impact.
-- Source         Pena, Prieto, Lourenco, Campos Costa and Lemos 2007 (EESD 36, 2383), as Gomes (IST Lisbon, 2.2) tells of them: four blocks about
--                three times as thick as wide, one with a cut of 45 degrees and 43 mm. Sizes of 1 to 3 are known. Those of block 4, where its cut is (at the
--                lower edge towards +x) and its length (of either leg) are assumed, as are frequency, duration and level of the harmonic
--                motion. The records are not at hand; the random motion is white between 1 and 8 Hz under a trapezium, from a seed.
-- How to run     erbs run scenes/studies/pena_block.lua -D specimen=2 -D motion=harmonic -D level=3
-- What to look at  metrics.peak: largest rotation over alpha; metrics.overturned; metrics.rest: time after which it stays below .05 alpha;
--                metrics.theory_overturned, theory_peak: the same by Housner's exact equation under the same motion (of block 4: with both edges cut)
local specimen = param("specimen", 1, "1 to 4; 4 has a cut edge")
local motion = param("motion", "free", "free, harmonic or random")
local seed, level = param("seed", 1, "of the random motion"), param("level", 1.5, "peak acceleration over g tan(alpha)")
local frequency, phi0 = param("frequency", 3, "of the harmonic motion [Hz]"), param("phi0", 0.5, "first rotation over alpha, free")
local cycles = param("cycles", 18, "of the harmonic motion")
local width_4, height_4 = param("width_4", 0.16, "of block 4 [m]"), param("height_4", 1, "of block 4 [m]")
local leg = param("cut", 0.043, "leg of the cut of block 4 [m]")
local sizes = { { 0.25, 1.0, 0.754 }, { 0.17, 1.0, 0.502 }, { 0.12, 1.0, 0.375 }, { width_4, height_4, 3 * width_4 } }
local width, height, depth = table.unpack(sizes[specimen] or error("specimen must be 1, 2, 3 or 4", 0))
local cut, density, b = specimen == 4 and leg or 0, 2670, width / 2
if cut < 0 or cut > 0.9 * b then error("cut must be from 0 to 0.9 of half the width of block 4", 0) end

-- Slenderness towards either side, from the centroid of the section. Levels count from the lesser one.
local area, corner = width * height, cut ^ 2 / 2
local x_c, z_c = -corner * (b - cut / 3) / (area - corner), (area * height / 2 - corner * cut / 3) / (area - corner)
local alpha_left, alpha_right = math.atan((b + x_c) / z_c), math.atan((b - cut - x_c) / z_c)
local alpha = math.min(alpha_left, alpha_right)

local settlement, foot, hollow = 1e-5, 0.008 * width, 1e-3 * height
local kn = density * g * height / (settlement * b)
material { name = "granite", density = density, kn = kn, ks = 0.4 * kn, friction = 0.6, restitution = 0.24 }
box { name = "base", material = "granite", fixed = true, size = { 4, 2 * depth, 0.25 }, at = { -2, -depth, -0.25 } }
local function part(...)  -- a prism over corners { x, z }
  local v = {}
  for _, corner in ipairs { ... } do
    for _, y in ipairs { -depth / 2, depth / 2 } do v[#v + 1] = { corner[1], y, corner[2] } end
  end
  return { vertices = v }
end
local function foot_at(x) return part({ x, 0 }, { x + foot, 0 }, { x + foot, hollow }, { x, hollow }) end
local body = cut > 0 and part({ -b, hollow }, { b - cut + hollow, hollow }, { b, cut }, { b, height }, { -b, height })
  or part({ -b, hollow }, { b, hollow }, { b, height }, { -b, height })
block { name = "block", material = "granite", free = true, parts = { foot_at(-b), foot_at(b - cut - foot), body },
  initial = motion == "free" and { rotation = { 0, phi0 * alpha, 0 }, about = { b - cut, 0, 0 } } or nil }

local duration, wave = motion == "free" and 6 or 12, nil
if motion == "harmonic" then
  duration = cycles / frequency + 6
  wave = sine { amplitude = level * g * math.tan(alpha), frequency = frequency, duration = cycles / frequency }
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
  wave = table_wave { times = times, values = values }
elseif motion ~= "free" then
  error("motion must be free, harmonic or random, not " .. motion, 0)
end
if wave then ground_motion { wave = wave, direction = "x" } end
recorder { name = "block", quantity = "rotation", block = "block", axis = "y" }
-- A block that starts turned counts as fallen once its centre is lower than there, so that a free run goes on to its end.
analysis { duration = duration, start = "rest", output_dt = 0.01, frame_dt = 1, stop_after_collapse = motion == "free" and -1 or 0.5 }
metric("overturned", "", function(run) return run.peak("block_ry_rad") > 1.5 * math.max(alpha_left, alpha_right) and 1 or 0 end)
metric("peak", "", function(run) return run.peak("block_ry_rad") / alpha end)
metric("rest", "s", function(run)
  local last = 0
  for i, theta in ipairs(run.history("block_ry_rad")) do
    if math.abs(theta) > 0.05 * alpha then last = run.time[i] end
  end
  return last
end)
-- Housner's equation knows no cut edge: block 4 is compared with the block whose both edges are cut.
local theory
local function by_theory()
  theory = theory or rocking { alpha = alpha, p = math.sqrt(3 * g / (2 * math.sqrt(width ^ 2 + height ^ 2))), wave = wave,
    theta = motion == "free" and phi0 * alpha or 0, duration = duration }
  return theory
end
metric("theory_overturned", "", function() return by_theory().overturned and 1 or 0 end)
metric("theory_peak", "", function()
  local most = 0
  for _, theta in ipairs(by_theory().theta) do most = math.max(most, math.abs(theta)) end
  return most / alpha
end)
