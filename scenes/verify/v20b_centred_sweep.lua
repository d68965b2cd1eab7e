-- V20b by the centred sweep: a rigid drift causes no force in the mean; the remaining error wanders with the order of the blocks.
--
-- How to run     erbs run scenes/verify/v20b_centred_sweep.lua
-- What to look at  momentum_factor: about 1, but not to round-off; momentum_residual.
label("quick", "fixed_dt")
drift_scheme = 2
include "v20b_drifting_chain.lua"
-- The forces at both ends still differ: a random walk of the momentum, here by a tenth in a thousand steps.
expect("metrics.momentum_factor", 1, { abs = 0.25, source = "mean damping dt K / 2: nothing on a rigid translation" })
