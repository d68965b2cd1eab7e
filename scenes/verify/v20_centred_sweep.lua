-- V20: the centred sweep, which reads the force on a block half a step ahead on its path, feeds no energy.
--
-- What happens   The chain of v20_sequential_growth.lua, fixed order. The mean effect is a damping dt K / 2: none on rigid motion. The
--                amplitude of the lowest mode falls at the rate dt w_1^2 / 4, and the limit is about that of leapfrog. Random orders
--                scatter some of the slow motion into fast modes, where it decays: twice the decay rate. No order gains energy.
-- Source         dt L + dt D / 2, over random orders dt K / 2.
-- How to run     erbs run scenes/verify/v20_centred_sweep.lua [-D share=0.25]
-- What to look at  decay_over_formula; collapse_share: limit over that of leapfrog.
label("fixed_dt")
include "lib_spring_chain.lua"
local share = param("share", 0.1, "dt over 2 / omega_max")
local seed = param("seed", 0, "of random orders; 0: the fixed order")
local n = param("n", 30, "blocks")
local chain = spring_chain { n = n, share = share }
local w1 = 2 / chain.tau * math.sin(pi / 2 / (n + 1))
local duration = 6 * 2 * pi / w1
analysis { duration = duration, dt = chain.dt, unstable = true, start = "rest", output_dt = duration / 60, frame_dt = duration,
  solver = "sequential", variant = "centred", order = seed > 0 and "random" or "fixed", seed = seed }
metric("growth", "", chain.growth)
metric("decay_over_formula", "", function(run) return -chain.growth(run) / (chain.dt * w1 ^ 2 / 4 * chain.tau) end)
bisect { param = "share", lo = 0.8, hi = 1.2, rel = 0.005, collapsed_when = function(run) return run.status == "diverged" or chain.growth(run) > 0 end }
ensemble { n = 20, seed = 1, name = "orders", value = function(run) return chain.energy(run, #run.time) / chain.energy(run, 1) end }
-- 3 %: the noise of the start decays along with the mode. The formula is the first term in the step; the next is share^2, twice.
expect("metrics.decay_over_formula", 1, { rel = 0.03 + 2 * share ^ 2, source = "dt w_1^2 / 4" })
expect("metrics.orders_failed", 0, { abs = 0, source = "every run ends" })
expect("metrics.orders_most", 1, { below = true, source = "no order of 20 gains energy" })
expect("metrics.collapse_share", 1, { rel = 0.03, source = "the leapfrog's limit" })
