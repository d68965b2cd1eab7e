-- V19, the other side: the same chain with a time step 0.1 % beyond its limit grows without bound and is stopped.
--
-- What happens   Each step multiplies the fastest mode by exp(2 acosh(1.001)) = 1.094. The run must end as "diverged", not with a result.
-- How to run     erbs run scenes/verify/v19_past_the_limit.lua [-D excess=1.01]; without unstable = true such a step is refused.
-- What to look at  status, and the number of steps until the divergence is detected.
label("quick")
local n, kn, excess = param("n", 30, "blocks of the chain"), param("kn", 1e10, "[Pa/m]"), param("excess", 1.001, "dt over its limit")
local density, edge = param("density", 1800, "[kg/m3]"), param("edge", 0.1, "of the cubes [m]")
gravity(0)
material { name = "brick", density = density }
joint { law = mortar { kn = kn, ks = 0.01 * kn, ft = 1e9, c = 1e9, mu = 0.6 } }
box { name = "foot", size = { edge, edge, edge }, at = { 0, 0, -edge }, fixed = true }
for i = 1, n do
  box { name = "chain" .. i, size = { edge, edge, edge }, at = { 0, 0, (i - 1) * edge }, initial = i == n and { position = { 0, 0, 1e-9 } } or nil }
end
local limit = math.sqrt(density * edge / kn) / math.cos(pi / (2 * n + 1))
analysis { duration = 100000 * limit, dt = { excess * limit, unstable = true }, start = "rest", output_dt = 100 * limit }
metric("steps_to_detection", "", function(run) return run.steps end)
expect("status", "diverged")
-- From 1e-9 m, growing by 1.094 per step, the speed passes 1e6 m/s after about 300 steps; rows come every 100.
expect("metrics.steps_to_detection", 5000, { below = true, source = "exp(2 acosh(excess)) per step" })
