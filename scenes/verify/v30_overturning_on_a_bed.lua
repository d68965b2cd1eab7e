-- V30: a block on an elastic bed overturns below g tan(alpha), because its toe is pressed in.
--
-- What happens   The ground acceleration grows slowly to lambda g. A rigid block on rigid ground overturns at lambda = b/h. On a bed it
--                turns about the edge of the compressed length and overturns at b/h [1 - 1.89 (4/9 d0 h / b^2)^(1/3)], d0 the settlement
--                under its weight. A stiffer bed brings the two closer, but only by the cube root.
-- Source         Bed of springs without tension, largest moment over the angle (derived here: the moment N (b - a/3) - N h theta with a =
--                sqrt(2 N / (kn theta)) per depth has its maximum at a^3 = 12 h N / kn ... to first order in a/b).
-- How to run     erbs run scenes/verify/v30_overturning_on_a_bed.lua [-D width=...] [-D height=...] [-D kn_1e10=1.01]
-- What to look at  kn_*_over_paper: over the formula; kn_*_on_paper / (b/h) shows the approach to the rigid block.
local width, height = param("width", 0.25, "[m]"), param("height", 1.0, "[m]")
local density = 2670
local b, h = width / 2, height / 2

local slow_load = include "parts/slow_load.lua"
local cases = {}
for _, kn in ipairs { 1e9, 1e10, 1e11, 1e12 } do
  local settlement = density * g * height / kn
  local paper = b / h * (1 - 1.89 * (4 / 9 * settlement * h / b ^ 2) ^ (1 / 3))
  cases[#cases + 1] = { name = string.format("kn_1e%d", math.floor(math.log(kn, 10) + 0.5)), value = paper, lo = 0.97, hi = 1.03, rel = 0.003,
    expect = { rel = 0.01, source = "toe on a bed of springs" },  -- 1 %: the formula is first order in the compressed length
    build = function(lambda)
      material { name = "stone", density = density, kn = kn, ks = 0.4 * kn, friction = 2 }
      box { name = "floor", size = { 4, 1, 0.5 }, at = { -2, -0.5, -0.5 }, fixed = true, material = "stone" }
      box { name = "block", size = { width, 0.754, height }, at = { -b, -0.377, 0 }, material = "stone" }
      joint { law = dry { kn = kn, ks = 0.4 * kn, mu = 2 } }
      slow_load { lambda = lambda, grow = 2, hold = 2, moved = 0.05 * height }
    end }
end
(include "parts/cases.lua")(cases)
