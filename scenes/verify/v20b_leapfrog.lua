-- V20b by leapfrog: every spring is read once for both its ends, and the free chain conserves its momentum to round-off.
--
-- How to run     erbs run scenes/verify/v20b_leapfrog.lua
-- What to look at  momentum_factor beside that of v20b_drifting_chain.lua.
label("quick", "fixed_dt")
drift_scheme = 3
include "v20b_drifting_chain.lua"
expect("metrics.momentum_factor", 1, { abs = 1e-12, source = "Newton's third law, step by step" })
