-- V46: a cantilever wall of rigid blocks vibrates in its first mode with mass damping: the logarithmic decrement at f1.
--
-- What happens   The wall of ten blocks starts with the velocities of its exact first mode and decays with xi = a / (2 w1). The ratio of
--                two swings one period apart is exp(-2 pi xi / sqrt(1 - xi^2)). The damping scheme is centred, so the step does not change
--                the decay to first order.
-- Source         formula of V21; the mode from lib_block_beam.lua.
-- How to run     erbs run scenes/verify/v46_damped_wall.lua [-D xi=0.1] [-D n=20]
-- What to look at  decrement_over_formula, period_over_formula.
label("quick")
include "lib_block_beam.lua"
local xi, n = param("xi", 0.05, "damping ratio of the first mode"), param("n", 10, "blocks")
local length, height, width, density = 3, 0.3, 1, 2000
local b = beam { n = n, length = length, height = height, width = width, E = 5e9, nu = 0.2, density = density }
local w = b.frequency(1)
local shape = b.shape(w)
gravity(0)
material { name = "masonry", density = density }
box { name = "foot", group = "foot", size = { height, width, 0.2 }, at = { 0, 0, -0.2 }, fixed = true }
for k = 1, n do
  box { name = "b" .. k, group = "wall", size = { height, width, b.d }, at = { 0, 0, (k - 1) * b.d },
    initial = { velocity = { 1e-4 * shape[k].u, 0, 0 }, spin = { 0, 1e-4 * shape[k].turn, 0 } } }
end
for factor, between in pairs { { "wall", "wall" }, { "foot", "wall" } } do
  joint { law = mortar { kn = factor * b.kn, ks = factor * b.ks, ft = 1e9, c = 1e9, mu = 0.6 }, between = between }
end
damping { mass = 2 * xi * w }
recorder { name = "tip", quantity = "displacement", block = "b" .. n, axis = "x" }
local damped = w * math.sqrt(1 - xi ^ 2)
local period, swings = 2 * pi / damped, 6
analysis { duration = (swings + 0.5) * period, start = "rest", output_dt = period / 500, frame_dt = period }
metric("decrement_over_formula", "", function(run)
  local first, last = run.at("tip_ux_rel_m", period / 4), run.at("tip_ux_rel_m", (swings + 0.25) * period)
  return math.log(first / last) / swings / (2 * pi * xi / math.sqrt(1 - xi ^ 2))
end)
metric("period_over_formula", "", function(run) return run.period("tip_ux_rel_m") / period end)
-- 0.5 %: a mode of small rotations, straight lines between rows, (w dt)^2.
expect("metrics.decrement_over_formula", 1, { rel = 5e-3, source = "2 pi xi / sqrt(1 - xi^2)" })
expect("metrics.period_over_formula", 1, { rel = 1e-4, source = "2 pi / (w1 sqrt(1 - xi^2))" })
