-- V41: least friction with which an arch stands under its own weight.
--
-- What happens   A semicircle of 27 voussoirs, t/R = 0.15, stands with mu slightly above the least friction and slides apart below it.
-- Source         Associative limit analysis (linear programming): mu = 0.3511. Friction without dilatancy may need a little more: +5 / -1
--                %.
-- How to run     erbs run scenes/verify/v41_arch_friction.lua [-D friction=0.34] [-D voussoirs=...]
-- What to look at  friction_over_paper; the mechanism of the run (at 0.93 of the least friction): sliding at the springings and hinges.
local R = param("R", 10, "radius of the centre line [m]")
local kn = param("kn", 2e12, "[Pa/m]")
local n, t, density = 27, 0.15, 2000

(include "parts/cases.lua") {
  { name = "friction", value = 0.3511, lo = 1.06, hi = 0.94, show = 0.93, rel = 0.014, expect = { between = { 0.99, 1.05 }, source = "associative limit analysis" },
    build = function(mu)
      material { name = "stone", density = density, kn = kn, ks = 0.4 * kn, friction = mu }
      arch { radius = R, thickness = t * R, width = 1, voussoirs = n, material = "stone" }
      joint { law = dry { kn = kn, ks = 0.4 * kn, mu = mu } }
      analysis { duration = 5, output_dt = 0.02, frame_dt = 0.1, stop_when_moved = 0.005 * R }
    end },
}
