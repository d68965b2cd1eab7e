-- V28: the period of free rocking depends on its amplitude.
--
-- What happens   Blocks of several slendernesses are tilted by several shares of alpha and released. The time to the first impact is a
--                quarter of the period.
-- Source         Housner 1963, eq. (2): T = (4/p) acosh(1 / (1 - phi0)) for small angles; rocking{} integrates the exact equation. 0.25 x
--                1.0 m at phi0 = 0.5: 1.39423 s (linear); 0.6 x 3 m at 0.05 rad: 1.46278 s (linear), 1.46576 s (exact).
-- How to run     erbs run scenes/verify/v28_rocking_period.lua [-D settlement=...] [-D foot=...]
-- What to look at  period_<block>_<phi>: over the exact one; linear_*: over Housner's formula (for information).
label("quick")
local settlement, foot = param("settlement", 1.7e-6, "of the full base over half the width"), param("foot", 0.008, "width of a foot over that of the block")

local rocking_block = include "parts/rocking_block.lua"
local duration = 0
for i, row in ipairs { { "pena1", 0.25, 1.0, 0.5 }, { "pena1", 0.25, 1.0, 0.2 }, { "pena1", 0.25, 1.0, 0.8 }, { "pena3", 0.12, 1.0, 0.5 }, { "wall", 0.6, 3.0, 0.05 / 0.19740 }, { "makris", 0.4, 1.2, 0.7 } } do
  local width, height, phi = row[2], row[3], row[4]
  local name = string.format("%s_%02d", row[1], math.floor(100 * phi + 0.5))
  local theta = phi * math.atan(width / height)
  local it = rocking_block { name = name, width = width, height = height, theta = theta, at = { 0, 3 * i }, settlement = settlement, foot = foot, duration = 4 }
  local small = rocking { width = width, height = height, theta = theta, duration = 4, linear = true }
  duration = math.max(duration, 1.1 * it.theory.impacts[1])
  metric("period_" .. name, "", function(run) return it.impacts(run)[1] / it.theory.impacts[1] end)
  metric("linear_" .. name, "", function(run) return it.impacts(run)[1] / small.impacts[1] end)
  metric("exact_s_" .. name, "s", 4 * it.theory.impacts[1])
  -- 2 %: the toe sinks into the bed, which moves the centre of rotation, and with it alpha, inwards by up to half a foot.
  expect("metrics.period_" .. name, 1, { rel = 0.02, source = "Housner's exact equation" })
end
analysis { duration = duration, start = "rest", dt = param("dt", 4e-5), output_dt = 1e-3, frame_dt = 0.05 }
