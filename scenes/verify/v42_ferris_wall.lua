-- V42: the dry wall of Ferris and Tin-Loi under a horizontal load in its plane, in both bonds.
--
-- What happens   Blocks of 0.4 x 0.175 m, five wide and six courses high, mu 0.65; a force of lambda times its weight pushes each. With
--                halves at the ends of the lowest course a corner rotates off along a stepped crack; with five whole blocks there the wall
--                slides at mu.
-- Source         Ferris and Tin-Loi 2001 (Int. J. Mech. Sci. 43, 209): 0.6429 associative, about 0.640 not; linear programming 0.64286 and,
--                without friction in the head joints, 0.63997.
-- How to run     erbs run scenes/verify/v42_ferris_wall.lua [-D halves=1.02] [-D kn=...]
-- What to look at  *_over_paper; the mechanism of the run.
local kn = param("kn", 1.6e12, "[Pa/m]")
local courses, wide, mu = 6, 5, 0.65

local slow_load = include "parts/slow_load.lua"
local function build(halves)
  return function(lambda)
    material { name = "brick", density = 2000, kn = kn, ks = 0.4 * kn, friction = mu }
    box { name = "floor", size = { 8, 1, 0.5 }, at = { -4, -0.5, -0.5 }, fixed = true, material = "brick" }
    wall { brick = { length = 0.4, width = 0.2, height = 0.175 }, length = wide * 0.4, courses = courses, joint = 0, shift = halves and 0 or 1, closer = 0.1,
      at = { -wide * 0.2, -0.1, 0 }, material = "brick", quiet = true }
    joint { law = dry { kn = kn, ks = 0.4 * kn, mu = mu } }
    slow_load { lambda = lambda, grow = 1, hold = 2.5, moved = 0.001 }
  end
end
(include "parts/cases.lua") {
  -- 2 %: between associative and non-associative; toes pressed in (0.9 %; at 4e11 Pa/m 1.8 %).
  { name = "halves", value = 0.64, build = build(true), lo = 0.96, hi = 1.04, rel = 0.01, expect = { rel = 0.02, source = "Ferris and Tin-Loi 2001, non-associative" } },
  { name = "whole", value = mu, build = build(false), lo = 0.96, hi = 1.04, rel = 0.01, expect = { rel = 0.02, source = "slides at mu" } },
}
