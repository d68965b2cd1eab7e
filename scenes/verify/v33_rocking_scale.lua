-- V33: of two blocks of the same shape the larger rocks more slowly by the square root of the scale, and otherwise alike.
--
-- What happens   A block and a block `scale` times as large get the same half sine of inertia forces, in units of their own g tan(alpha)
--                and p. Its amplitude is near the one that overturns. theta of the larger at sqrt(scale) t equals theta of the smaller at
--                t. So their overturning amplitudes at equal omega/p are equal, and the larger one needs a longer pulse: the scale effect.
-- Source         Housner 1963: p = sqrt(3 g / (4 R)), and nothing else in the dimensionless equation.
-- How to run     erbs run scenes/verify/v33_rocking_scale.lua [-D scale=4] [-D w=3] [-D share=0.97]
-- What to look at  falls_ratio: overturning amplitude of one over that of the other; difference: largest of theta / alpha; time_ratio: of
--                the first impacts over sqrt(scale).
label("quick")
local scale, w = param("scale", 2, "of the larger block"), param("w", 2, "omega / p of the pulse")
local share = param("share", 0.97, "amplitude over the one that overturns")
local width, height, density, depth = 0.4, 1.2, 2500, 0.4

local rocking_block = include "parts/rocking_block.lua"
local pairs_of, duration = {}, 0
for i, size in ipairs { 1, scale } do
  local it = rocking_block { name = "block" .. i, width = size * width, height = size * height, depth = size * depth, density = density, at = { 0, 5 * i * scale }, duration = 1 }
  local p, frequency, threshold = it.theory.p, w * it.theory.p / (2 * pi), g * math.tan(it.theory.alpha)
  local lowest = rocking_overturning { width = size * width, height = size * height, wave = half_sine { amplitude = threshold, frequency = frequency }, points = 200 }.lowest
  local mass = density * size ^ 3 * width * height * depth * (1 - 1e-3 + 2 * 0.008 * 1e-3)
  local own = param("share_" .. i, share, "the same of one of the blocks, for its study")
  force { block = it.name, direction = "x", wave = half_sine { amplitude = -own * lowest * threshold * mass, frequency = frequency } }
  metric("lowest_" .. i, "g tan alpha", lowest)
  pairs_of[i] = it
  duration = math.max(duration, 5.5 / p)
  bisect { param = "share_" .. i, name = "falls_" .. i, lo = 0.96, hi = 1.03, rel = 0.002, points = 2, collapsed_when = function(run)
    local theta = run.history(it.column)
    for k, t in ipairs(run.time) do
      if t < 5.5 / p and math.abs(theta[k]) > 1.3 * it.theory.alpha then return true end
    end
    return false
  end }
end
local small, large = pairs_of[1], pairs_of[2]
local stretch = math.sqrt(scale)
local function difference(run)
  local worst, theta, other, times, j = 0, run.history(small.column), run.history(large.column), run.time, 1
  for i, t in ipairs(times) do
    while times[j + 1] and times[j + 1] < stretch * t do j = j + 1 end
    if not times[j + 1] then break end
    local s = (stretch * t - times[j]) / (times[j + 1] - times[j])
    worst = math.max(worst, math.abs(theta[i] - other[j] - s * (other[j + 1] - other[j])))
  end
  return worst / small.theory.alpha
end
metric("difference", "alpha", difference)
metric("time_ratio", "", function(run) return large.impacts(run)[1] / small.impacts(run)[1] / stretch end)
metric("falls_ratio", "", function(run) return run.metrics.metrics.falls_1 / run.metrics.metrics.falls_2 end)
expect("metrics.falls_ratio", 1, { rel = 0.005, source = "the same amplitude at the same omega / p" })
-- 1.5 %: the reference speed and the memory of a blow do not scale with the block, and an amplitude near the one that overturns magnifies
-- it: .9 % of alpha at share = .97, .4 % at .9, .1 % at .7, at any step.
expect("metrics.difference", 0.015, { below = true, source = "scale" })
expect("metrics.time_ratio", 1, { rel = 0.005, source = "sqrt(scale)" })
-- A faster pulse comes closer to the edge: a finer step.
analysis { duration = duration, start = "rest", dt = param("dt", math.min(5e-5, 7.5e-5 / w)), output_dt = 4e-3, frame_dt = 0.05 }
