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
local frequency, level = param("frequency", 3.3, "of the sine [Hz]"), param("level", 2, "its peak over g tan(alpha)")
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
  local alpha = math.atan(width / height)
  local unit = g * math.tan(alpha)
  local lowest = rocking_overturning { width = width, height = height, wave = sine { amplitude = unit, frequency = frequency, duration = 3 / frequency },
    from = 1, to = 15, points = 1400 }.lowest
  if not chosen or chosen == row then
    local amplitude = chosen and row.share * lowest * unit or level * unit
    local lasts = (chosen and 3 or cycles) / frequency
    local it = rocking_block { name = name, width = width, height = height, depth = depth, density = density, at = { 0, 3 * i }, duration = duration,
      wave = sine { amplitude = amplitude, frequency = frequency, duration = lasts } }
    local mass = density * width * height * depth * (1 - 1e-3 + 2 * 0.008 * 1e-3)
    force { block = name, direction = "x", wave = sine { amplitude = -amplitude * mass, frequency = frequency, duration = lasts } }
    local theory, sum = it.theory.amplitudes, 0
    for k = #theory - watched, #theory - 1 do sum = sum + theory[k] / watched end
    metric(name .. "_amplitude", "", function(run)
      local _, peaks = it.impacts(run)
      local mean = 0
      for k = #peaks - watched, #peaks - 1 do mean = mean + peaks[k] / watched end
      return mean / sum
    end)
    metric(name .. "_cycle", "", function(run)
      local n = 0
      for _, t in ipairs((it.impacts(run))) do if t > (cycles - 10) / frequency then n = n + 1 end end
      return n / 10
    end)
    metric(name .. "_over_alpha", "alpha", sum)
  end
  metric(name .. "_limit", "g tan alpha", lowest)
  bisect { param = "share_" .. name, name = name .. "_falls", lo = 0.9, hi = 1.1, rel = 0.005, points = 2 }
end

analysis { duration = duration, start = "rest", dt = param("dt", 4e-5), output_dt = 1e-3, frame_dt = 0.2, stop_after_collapse = chosen and 0.05 or -1 }
