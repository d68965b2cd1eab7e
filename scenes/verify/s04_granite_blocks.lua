-- S04: granite blocks under harmonic motion beside Housner's equation, and one with a cut edge that rocks unevenly.
--
-- What happens   Three blocks on feet are shaken by sines from rest. They come to a steady state of two impacts a cycle (Spanos and Koh's mode 1,1),
--                whose amplitude is that of the equation. Bisection finds the least amplitude of three cycles that overturns each. A fourth block, with
--                a cut at one lower edge, is tilted and released: the time of each half cycle is that of the edge it rocks on.
-- Source         Blocks of Pena et al. 2007 (EESD 36, 2383); Housner 1963, exact equation by rocking{} and rocking_overturning{}; steady modes:
--                Spanos and Koh 1984 (J. Eng. Mech. 110, 1627). Of the block with the cut only the cut of 43 mm at 45 degrees is printed (Gomes, IST
--                Lisbon, 2.2); its width, height and the place of the cut are assumed.
-- How to run     erbs run scenes/verify/s04_granite_blocks.lua [-D frequency=3] [-D level=2]
-- What to look at  <block>_amplitude, <block>_falls: over theory; <block>_cycle: impacts a cycle; left, right: half cycles over theirs
label("quick")
local frequency, level = param("frequency", 4, "of the sine [Hz]"), param("level", 1.5, "its peak over g tan(alpha)")
local width, height, cut = param("width", 0.16, "of the block with the cut [m]"), param("height", 1, "[m]"), param("cut", 0.043, "leg of the cut [m]")
family({ frequency = { 3.3, 5 }, width = { 0.2 }, height = { 1.4 }, cut = { 0.02 } }, { combinations = 1 })
local cycles, watched, unchanged = 30, 8, -1
local rocking_block = include "parts/rocking_block.lua"
local density, chosen = 2670, nil
local rows = { { "pena1", 0.25, 1.0, 0.754 }, { "pena2", 0.17, 1.0, 0.502 }, { "pena3", 0.12, 1.0, 0.375 } }
for _, row in ipairs(rows) do
  row.share = param("share_" .. row[1], unchanged, "amplitude over the least one of theory that overturns")
  if row.share ~= unchanged then chosen = row end
end

local duration = chosen and 3 / frequency + 2.5 or cycles / frequency
for i, row in ipairs(rows) do
  local name, width, height, depth = table.unpack(row)
  local unit = g * width / height
  local lowest = rocking_overturning { width = width, height = height, wave = sine { amplitude = unit, frequency = frequency, duration = 3 / frequency },
    from = 1, to = 15, points = 1400 }.lowest
  local amplitude, lasts = level * unit, cycles / frequency
  if chosen then amplitude, lasts = row.share * lowest * unit, 3 / frequency end
  local it
  if not chosen or chosen == row then
    it = rocking_block { name = name, width = width, height = height, depth = depth, density = density, at = { 0, 3 * i }, duration = duration,
      wave = sine { amplitude = amplitude, frequency = frequency, duration = lasts } }
    local mass = density * width * height * depth * (1 - 1e-3 + 2 * 0.008 * 1e-3)
    force { block = name, direction = "x", wave = sine { amplitude = -amplitude * mass, frequency = frequency, duration = lasts } }
  end
  local function last(peaks)  -- mean of the last whole half cycles
    local sum = 0
    for k = #peaks - watched, #peaks - 1 do sum = sum + peaks[k] / watched end
    return sum
  end
  metric(name .. "_limit", "g tan alpha", lowest)
  bisect { param = "share_" .. name, name = name .. "_falls", lo = 0.9, hi = 1.1, rel = 0.005, points = 2 }
  if not chosen then
    metric(name .. "_amplitude", "", function(run)
      local _, peaks = it.impacts(run)
      return last(peaks) / last(it.theory.amplitudes)
    end)
    metric(name .. "_cycle", "", function(run)
      local n = 0
      for _, t in ipairs((it.impacts(run))) do if t > (cycles - 10) / frequency then n = n + 1 end end
      return n / 10
    end)
    -- 3 %: the toe and the foot are a share of so small rotations, .05 to .1 alpha.
    expect("metrics." .. name .. "_amplitude", 1, { rel = 0.03, source = "exact equation, after " .. cycles - watched / 2 .. " cycles" })
    expect("metrics." .. name .. "_cycle", 2, { abs = 0.101, source = "Spanos and Koh 1984, mode (1,1); an impact more or less at the end of ten cycles" })
    -- Of the static threshold the toe takes 3 (h d0 / (9 b^2))^(1/3), h and b halves of height and width, d0 / b = 1.7e-6; of this one about as much.
    expect("metrics." .. name .. "_falls", 1, { rel = 1.2 * 3 * (1.7e-6 * height / width / 9) ^ (1 / 3), source = "exact equation: the least of three cycles" })
  end
end

-- The block with a cut edge, at rest on its foot at -b and that at b - cut.
if not chosen then
  local b, depth, phi = width / 2, 3 * width, 0.5
  local foot, hollow, settlement = 0.008 * width, 1e-3 * height, 1.7e-6
  local kn = density * g * height / (settlement * b)
  material { name = "cut", density = density, kn = kn, ks = 0.4 * kn, friction = 2, restitution = 0.24 }
  local function part(...)
    local v = {}
    for _, corner in ipairs { ... } do
      for _, y in ipairs { -depth / 2, depth / 2 } do v[#v + 1] = { corner[1], y, corner[2] } end
    end
    return { vertices = v }
  end
  local function foot_at(x) return part({ x, 0 }, { x + foot, 0 }, { x + foot, hollow }, { x, hollow }) end
  -- Section less a triangle of leg c at the lower edge +b: centroid, and second moment about it over the area.
  local whole, corner = width * height, cut ^ 2 / 2
  local area = whole - corner
  local x_c, z_c = -corner * (b - cut / 3) / area, (whole * height / 2 - corner * cut / 3) / area
  local polar = whole * (width ^ 2 + height ^ 2) / 12 + whole * (x_c ^ 2 + (height / 2 - z_c) ^ 2)
    - corner * (cut ^ 2 / 9 + (b - cut / 3 - x_c) ^ 2 + (cut / 3 - z_c) ^ 2)
  local sides = {}
  for name, arm in pairs { left = b + x_c, right = b - cut - x_c } do
    local R2 = arm ^ 2 + z_c ^ 2
    sides[name] = { alpha = math.atan(arm / z_c), p = math.sqrt(g * math.sqrt(R2) / (polar / area + R2)) }
  end
  box { name = "base", material = "cut", fixed = true, size = { 4, 2 * depth, 0.25 }, at = { -2, -10 - depth, -0.25 } }
  block { name = "cut", material = "cut", free = true, at = { 0, -10, 0 },
    parts = { foot_at(-b), foot_at(b - cut - foot), part({ -b, hollow }, { b - cut + hollow, hollow }, { b, cut }, { b, height }, { -b, height }) },
    initial = { rotation = { 0, phi * sides.right.alpha, 0 }, about = { b - cut, -10, 0 } } }
  recorder { name = "cut", quantity = "rotation", block = "cut", axis = "y" }
  -- Times of half cycles on one edge over 2 / p arcosh(1 / (1 - peak / alpha)) of that edge (Housner 1963, eq. 8), the mean of the first three.
  local function half_cycles(name)
    return function(run)
      local theta, t, before, peak, sum, n = run.history("cut_ry_rad"), run.time, nil, 0, 0, 0
      for i = 2, #theta do
        if theta[i - 1] * theta[i] < 0 then
          local now = t[i - 1] + (t[i] - t[i - 1]) * theta[i - 1] / (theta[i - 1] - theta[i])
          if before and n < 3 and (peak > 0) == (name == "right") then
            local side = sides[name]
            local x = 1 / (1 - math.abs(peak) / side.alpha)
            sum, n = sum + (now - before) / (2 / side.p * math.log(x + math.sqrt(x ^ 2 - 1))), n + 1
          end
          before, peak = now, 0
        end
        if math.abs(theta[i]) > math.abs(peak) then peak = theta[i] end
      end
      return n == 3 and sum / 3 or nil
    end
  end
  for name, side in pairs(sides) do
    metric(name, "", half_cycles(name))
    metric("alpha_" .. name, "rad", side.alpha)
    expect("metrics." .. name, 1, { rel = 0.02, source = "Housner 1963, eq. (8), of the block's own R and alpha on this edge" })
  end
end

analysis { duration = duration, start = "rest", dt = param("dt", 4e-5), output_dt = 1e-3, frame_dt = 0.2, stop_after_collapse = chosen and 0.05 or -1 }
