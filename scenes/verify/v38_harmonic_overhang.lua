-- V38: greatest overhang of n equal blocks over the edge of a table.
--
-- What happens   The k-th block from the top extends over the one below by 1/(2k) of its length; the whole overhang is scaled. A little
--                less stands, a little more falls.
-- Source         The harmonic stack: greatest overhang (1/2) sum 1/k lengths: n = 4 1.0417, n = 5 1.1417.
-- How to run     erbs run scenes/verify/v38_harmonic_overhang.lua [-D kn=...] [-D blocks_4=1.002]
-- What to look at  *_over_paper: overhang found over that on paper.
--
-- In the last stable pose the weight N lies above an edge. The edge is pressed in over a length a with a^3 = 12 h N / (kn depth), h the
-- height of the weight over the edge. Its resultant is a/3 inside, and the lowest of n joints feels 2n times that: thin light blocks on a
-- stiff bed keep it below 0.2 %.
local kn = param("kn", 4e12, "[Pa/m]")
local length, height, depth, density = 1, 0.05, 0.5, 1000
material { name = "stone", density = density, kn = kn, ks = 0.4 * kn, friction = 0.7 }

local function stack(n)
  return function(scale)
    box { name = "table", size = { 2, 2, 1 }, at = { -2, -1, -1 }, fixed = true, material = "stone" }
    joint { law = dry { kn = kn, ks = 0.4 * kn, mu = 0.7 } }
    local reach = 0
    for level = 1, n do  -- the block on the table is the n-th from the top
      reach = reach + scale / (2 * (n - level + 1)) * length
      box { name = "block" .. level, size = { length, depth, height }, at = { reach - length, -depth / 2, (level - 1) * height }, material = "stone" }
    end
    analysis { duration = 2.5, output_dt = 0.02, frame_dt = 0.05, stop_when_moved = 0.02 * length }
  end
end
-- 0.2 %: the edge pressed in.
local cases = {}
for _, n in ipairs { 4, 5 } do
  cases[#cases + 1] = { name = "blocks_" .. n, value = 1, build = stack(n), lo = 0.997, hi = 1.003, rel = 1e-3, show = 1.01, expect = { rel = 0.002, source = "sum 1/(2k)" } }
end
(include "parts/cases.lua")(cases)
