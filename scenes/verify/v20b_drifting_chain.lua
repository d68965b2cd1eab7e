-- V20b: a free chain of twenty cubes drifts, and the literal sequential scheme multiplies its momentum by ten thousand.
--
-- What happens   Nothing acts from outside. Within a sweep the two ends of a spring read its force at different instants, and the
--                differences add up: momentum grows as exp(dt sum D_ii t / (2 m N)). With n sweeps per step the exponent is divided by n.
--                With v20b_centred_sweep.lua and v20b_leapfrog.lua the chain drifts on.
-- Source         mean over orders of dt (K - D) / 2 on a rigid translation, K v = 0.
-- How to run     erbs run scenes/verify/v20b_drifting_chain.lua [-D iterations=16] [-D scheme=2]
-- What to look at  momentum_factor over the formula; momentum_residual; converge_iterations_slope.
label("fixed_dt")
include "lib_spring_chain.lua"
local asked, given = pcall(function() return drift_scheme end)
local scheme = param("scheme", asked and given or 1, "1 literal, 2 centred, 3 leapfrog")
local iterations = param("iterations", 1, "sweeps per step")
local seed = param("seed", 1, "of the random order")
local n = param("n", 20, "blocks")
local dt, duration = 0.1, param("time", 100, "over sqrt(m / k)")

local chain = spring_chain { n = n, share = 0.1, free = true, drift = 1e-6 }
analysis { duration = duration * chain.tau, dt = dt * chain.tau, unstable = true, start = "rest", output_dt = duration * chain.tau / 20,
  frame_dt = duration * chain.tau, solver = scheme == 3 and "leapfrog" or "sequential", variant = scheme == 2 and "centred" or "literal",
  iterations = iterations, seed = seed }
recorder { name = "all", quantity = "momentum", axis = "x" }
local function factor(run) return run.last("all_px_kg_m_s") / run.first("all_px_kg_m_s") end
metric("momentum_factor", "", factor)
local exponent = dt / iterations * 2 * (n - 1) * duration / (2 * n)  -- sum D_ii = 2 (n - 1) k
metric("formula", "", math.exp(exponent))
if scheme == 1 then
  metric("factor_over_formula", "", function(run) return factor(run) / math.exp(exponent) end)
  ensemble { n = 20, seed = 1, name = "orders", value = function(run) return factor(run) / math.exp(exponent) end }
  converge { param = "iterations", values = { 1, 4, 16 }, error = function(run) return math.log(factor(run)) end }
  -- 5 %: the next order of dt, and the scatter of random orders.
  expect("metrics.factor_over_formula", 1, { rel = 0.05, source = "exp(dt sum D_ii T / (2 m N))" })
  expect("metrics.orders_failed", 0, { abs = 0, source = "every run ends" })
  expect("metrics.orders_mean", 1, { rel = 0.05, source = "the same, mean of 20 orders" })
  expect("metrics.converge_iterations_slope", -1, { abs = 0.01, source = "the exponent is that of the sweep's own step" })
  expect("momentum_residual", 0.01, { above = true, source = "action and reaction at different instants: the ledger says so" })
end
