-- V33: of two blocks of the same shape the larger rocks slower by the square root of the scale, and otherwise alike.
--
-- What happens   A block and one `scale` times as large get the same half sine in units of their own g tan(alpha) and p, near the amplitude that
--                overturns, as inertia forces. theta of the larger at sqrt(scale) t is that of the smaller at t; so their overturning
--                amplitudes at equal omega/p are equal, and the larger one needs a longer pulse: the scale effect.
-- Source         Housner 1963: p = sqrt(3 g / (4 R)), and nothing else in the dimensionless equation.
-- How to run     erbs run scenes/verify/v33_rocking_scale.lua [-D scale=4] [-D w=3] [-D share=0.97]
-- What to look at  difference_*: largest difference of theta / alpha; time_ratio: of the first impacts over sqrt(scale).
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
  force { block = it.name, direction = "x", wave = half_sine { amplitude = -share * lowest * threshold * mass, frequency = frequency } }
  metric("lowest_" .. i, "g tan alpha", lowest)
  pairs_of[i] = it
  duration = math.max(duration, 5.5 / p)
end
local small, large = pairs_of[1], pairs_of[2]
local stretch = math.sqrt(scale)
local function difference(run)
  local worst = 0
  for i, t in ipairs(run.time) do
    if t * stretch <= duration then
      worst = math.max(worst, math.abs(run.history(small.column)[i] - run.at(large.column, stretch * t)))
    end
  end
  return worst / small.theory.alpha
end
metric("difference", "alpha", difference)
metric("time_ratio", "", function(run) return large.impacts(run)[1] / small.impacts(run)[1] / stretch end)
-- .5 %: the steps of the two are not in the ratio of their times.
expect("metrics.difference", 0.005, { below = true, source = "scale" })
expect("metrics.time_ratio", 1, { rel = 0.005, source = "sqrt(scale)" })
analysis { duration = duration, start = "rest", dt = param("dt", 5e-5), output_dt = 4e-3, frame_dt = 0.05 }
