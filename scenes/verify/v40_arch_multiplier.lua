-- V40: horizontal load, as a share of the weight, at which arches turn into a mechanism of four hinges.
--
-- What happens   The ground acceleration grows slowly to lambda g. Friction is high. A tilting table would find atan(lambda).
-- Source         Limit analysis: 7 voussoirs, t/R = 0.15, embrace 157.5 degrees 0.37361 (Oppenheim 1992: 0.37); 27 voussoirs 0.35385. Other
--                arches by parts/arch_hinges.lua, which tries every set of four hinges and is checked against those two.
-- How to run     erbs run scenes/verify/v40_arch_multiplier.lua [-D voussoirs_7=1.02] [-D kn=...]
-- What to look at  *_over_paper; the mechanism of the run (7 voussoirs at 1.05 of the load): four hinges.
local R = param("R", 10, "radius of the centre line [m]")
local kn = param("kn", 6e12, "[Pa/m]")
local density = 2000

local hinges = include "parts/arch_hinges.lua"
local slow_load = include "parts/slow_load.lua"
material { name = "stone", density = density, kn = kn, ks = 0.4 * kn, friction = 3 }
local cases = {}
for _, row in ipairs { { 7, 0.15, 157.5 }, { 27, 0.15, 157.5 }, { 11, 0.2, 140 } } do
  local n, t, embrace = row[1], row[2], row[3] * deg
  cases[#cases + 1] = { name = "voussoirs_" .. n, value = hinges.multiplier(n, t, embrace), unit = "g", lo = 0.96, hi = 1.02, rel = 0.007,
    build = function(lambda)
      arch { radius = R, thickness = t * R, width = 1, voussoirs = n, embrace = embrace, material = "stone" }
      joint { law = dry { kn = kn, ks = 0.4 * kn, mu = 3 } }
      slow_load { lambda = lambda, grow = 2, hold = 3, moved = 0.01 * R }
    end,
    -- -3 %: the hinges are pressed in; never above by more than the bracket.
    expect = { between = { 0.97, 1.005 }, source = "four hinges, virtual work" } }
end
(include "parts/cases.lua")(cases)
expect("collapse.mechanism.hinges", 4, { abs = 0.1, source = "four hinges make a mechanism" })
metric("paper_7", "g", hinges.multiplier(7, 0.15, 157.5 * deg))
metric("paper_27", "g", hinges.multiplier(27, 0.15, 157.5 * deg))
expect("metrics.paper_7", 0.37361, { abs = 2e-5, source = "limit analysis by linear programming; Oppenheim 1992: .37" })
expect("metrics.paper_27", 0.35385, { abs = 2e-5, source = "limit analysis by linear programming" })
