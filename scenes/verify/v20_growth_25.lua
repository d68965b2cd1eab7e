-- V20 at 0.25 of leapfrog's limit: the growth exceeds its first-order value, the characteristic equation still holds.
--
-- How to run     erbs run scenes/verify/v20_growth_25.lua
-- What to look at  as in v20_sequential_growth.lua, which explains the numbers.
label("fixed_dt")
growth_share = 0.25
include "v20_sequential_growth.lua"
expect("metrics.random_mean", 1, { abs = 0.15, source = "random orders grow a little slower than a fixed one; 20 of them" })
