-- V39: least thickness at which an arch of straight-sided voussoirs stands under its own weight.
--
-- What happens   An arch of N voussoirs stands at 2 % above its least thickness over radius t/R, and falls by hinges slightly below it. The
--                value of the DEM must not lie below paper and at most 2 % above: its hinges are pressed in.
-- Source         Statics of the thrust line: semicircle of N = 10 voussoirs 0.10701, 27 0.10672 (Milankovitch, infinite: 0.1075). Here by
--                parts/thrust_line.lua for any number, embrace and pointed shape, checked against those two.
-- How to run     erbs run scenes/verify/v39_arch_thickness.lua [-D round_10=1.01] [-D kn=...]
-- What to look at  *_over_paper; hinges_*; the mechanism of the run (at 0.97 of the least thickness): five hinges.
local R = param("R", 10, "radius of the centre line [m]")
local kn = param("kn", 6e12, "[Pa/m]")
local density, width = 2000, 1

local thrust_line = include "parts/thrust_line.lua"
material { name = "stone", density = density, kn = kn, ks = 0.4 * kn, friction = 2 }
local function build(n, embrace, offset)
  return function(thickness)
    arch { radius = R, thickness = thickness * R, width = width, voussoirs = n, embrace = embrace, offset = offset * R, material = "stone" }
    joint { law = dry { kn = kn, ks = 0.4 * kn, mu = 2 } }
    analysis { duration = 5, output_dt = 0.02, frame_dt = 0.1, stop_when_moved = 0.01 * R }
  end
end
local cases = {}
for _, row in ipairs { { 10, 180, 0 }, { 27, 180, 0 }, { 15, 150, 0 }, { 14, 180, 0.3 } } do
  local n, embrace, offset = row[1], row[2] * deg, row[3]
  local kind = offset > 0 and "pointed" or row[2] == 180 and "round" or "segment"
  local least = thrust_line.least_thickness(n, embrace, offset)
  cases[#cases + 1] = { name = kind .. "_" .. n, value = least, build = build(n, embrace, offset), lo = 1.03, hi = 0.985, show = 0.97, rel = 0.005, unit = "t/R",
    expect = { between = { 0.999, 1.02 }, source = "thrust line" } }
end
(include "parts/cases.lua")(cases)
expect("collapse.mechanism.hinges", 5, { abs = 0.1, source = "five hinges, by symmetry" })
metric("paper_10", "t/R", thrust_line.least_thickness(10, pi, 0))
metric("paper_27", "t/R", thrust_line.least_thickness(27, pi, 0))
metric("paper_100", "t/R", thrust_line.least_thickness(100, pi, 0))
expect("metrics.paper_10", 0.10701, { abs = 1e-5, source = "limit analysis by linear programming" })
expect("metrics.paper_27", 0.10672, { abs = 1e-5, source = "limit analysis by linear programming" })
expect("metrics.paper_100", 0.10746, { abs = 1e-5, source = "limit analysis by linear programming" })
