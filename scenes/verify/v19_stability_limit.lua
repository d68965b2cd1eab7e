-- V19: with a time step just below its limit, a chain of thirty blocks stays bounded for many thousand steps.
--
-- What happens   The top block starts at rest, displaced. Its displacement is a sum of cosines with positive amplitudes, so it never
--                exceeds its initial value if dt is below the limit. The limit itself: 2 / omega_max of a chain fixed at one end is
--                sqrt(m/k) / cos(pi / (2 n + 1)), 1.0013 sqrt(m/k) for n = 30. v19_past_the_limit.lua is the other side.
-- Source         Courant, Friedrichs and Lewy 1928; eigenvalues of the uniform chain, e.g. Rayleigh, Theory of Sound, section 120.
-- How to run     erbs run scenes/verify/v19_stability_limit.lua [-D n=100] [-D kn=...] [-D fraction=0.999]
-- What to look at  dt_critical_s beside the formula, largest_over_start.
label("quick")
local n = param("n", 30, "blocks of the chain")
local kn = param("kn", 1e10, "[Pa/m]")
local fraction = param("fraction", 0.999, "of the limit")
local steps = param("steps", 10000, "of the run")
local density, edge = param("density", 1800, "[kg/m3]"), param("edge", 0.1, "of the cubes [m]")

gravity(0)
material { name = "brick", density = density }
-- Soft shear keeps rocking and sway of the cubes far below the axial modes of the chain.
joint { law = mortar { kn = kn, ks = 0.01 * kn, ft = 1e9, c = 1e9, mu = 0.6 } }
box { name = "foot", size = { edge, edge, edge }, at = { 0, 0, -edge }, fixed = true }
local start = 1e-9
for i = 1, n do
  -- The top block starts displaced: every axial mode takes part.
  box { name = "chain" .. i, size = { edge, edge, edge }, at = { 0, 0, (i - 1) * edge }, initial = i == n and { position = { 0, 0, start } } or nil }
end
recorder { name = "top", quantity = "displacement", block = "chain" .. n, axis = "z" }
local limit = math.sqrt(density * edge / kn) / math.cos(pi / (2 * n + 1))
analysis { duration = steps * fraction * limit, dt_fraction = fraction, start = "rest", output_dt = limit * 17 }
metric("largest_over_start", "", function(run) return run.peak("top_uz_rel_m") / start end)
metric("limit_over_formula", "", function(run) return run.dt_critical_s / limit end)
-- The Lanczos residual is added, so the computed limit can only be too small, by a share of 1e-3.
expect("metrics.limit_over_formula", 0, { between = { 0.999, 1 + 1e-9 }, source = "1 / cos(pi / (2 n + 1)) sqrt(m / k)" })
-- The start is half a kick, so mode j stays c_j cos(j-th phase) with c_j >= 0 and sum 1: the bound is 1, apart from round-off.
expect("metrics.largest_over_start", 1 + 1e-6, { below = true, source = "leapfrog below its limit" })
expect("energy.residual_relative", 1e-6, { below = true, source = "elastic" })
expect("status", "completed")
