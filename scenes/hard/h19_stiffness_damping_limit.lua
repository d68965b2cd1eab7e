-- H19: stiffness-proportional dashpots shorten the explicit step to (2/w) (sqrt(1 + xi^2) - xi), about 1/(b w^2) for heavy damping.
--
-- What happens   A chain of cubes with strong dashpots, 1 % below its limit, comes to rest. h19_past_the_limit.lua runs 1 % beyond the
--                limit and must diverge. The fastest mode of the chain, w = 2 cos(pi / (2 n + 1)) sqrt(k/m), sets the limit.
-- Source         leapfrog with the velocity of half a step before: (w dt / 2)^2 + 2 xi (w dt / 2) = 1 at the limit.
-- How to run     erbs run scenes/hard/h19_stiffness_damping_limit.lua [-D xi=2] [-D n=30] [-D fraction=0.99]
-- What to look at  limit_over_formula; left_over_start: remaining share of the displacement.
label("fixed_dt")
local asked, past = pcall(function() return past_the_limit end)  -- set by h19_past_the_limit.lua
past = asked and past or false
local n, kn = param("n", 20, "blocks of the chain"), param("kn", 1e10, "[Pa/m]")
local xi = param("xi", 0.7, "damping ratio of the fastest mode")
local fraction = param("fraction", past and 1.01 or 0.99, "of the limit")
local steps = param("steps", 4000, "of the run")
local density, edge = param("density", 1800, "[kg/m3]"), param("edge", 0.1, "of the cubes [m]")

gravity(0)
material { name = "brick", density = density }
joint { law = mortar { kn = kn, ks = 0.01 * kn, ft = 1e9, c = 1e9, mu = 0.6 } }
local w = 2 * math.cos(pi / (2 * n + 1)) * math.sqrt(kn / (density * edge))
local limit = 2 / w * (math.sqrt(1 + xi ^ 2) - xi)
damping { stiffness = 2 * xi / w }
box { name = "foot", size = { edge, edge, edge }, at = { 0, 0, -edge }, fixed = true }
local start = 1e-9
for i = 1, n do
  box { name = "chain" .. i, size = { edge, edge, edge }, at = { 0, 0, (i - 1) * edge }, initial = i == n and { position = { 0, 0, start } } or nil }
end
recorder { name = "top", quantity = "displacement", block = "chain" .. n, axis = "z" }
local dt = fraction * limit
analysis { duration = (past and 25 or 1) * steps * dt, dt = past and { dt, unstable = true } or dt, start = "rest", output_dt = 20 * limit }
metric("limit_over_formula", "", function(run) return run.dt_critical_s / limit end)
-- The Lanczos residual is added, so the computed limit can only be too small, by a share of 1e-3.
expect("metrics.limit_over_formula", 0, { between = { 0.999, 1 + 1e-6 }, source = "(2/w) (sqrt(1 + xi^2) - xi)" })
if past then
  expect("status", "diverged")
else
  metric("left_over_start", "", function(run) return math.abs(run.last("top_uz_rel_m")) / start end)
  expect("metrics.left_over_start", 0.5, { below = true, source = "damped" })
  expect("energy.residual_relative", 1e-6, { below = true, source = "dashpots book their own work" })
  expect("status", "completed")
end
