-- Hard case: a light block carries a block a hundred thousand times heavier, which carries another light block.
--
-- What happens   A pebble-sized block under a block of 1e5 times its mass sets the time step. The pair vibrates with its own slow period,
--                which must come out right after many thousand steps. A light block on the heavy one must follow it without drift.
-- Source         Period of two springs in series under the heavy mass: T = 2 pi sqrt(M (1/k1 + 1/k2)); the light mass between them changes
--                it by the share m / M.
-- How to run     erbs run scenes/hard/h01_extreme_mass_ratio.lua [-D ratio=1e7] [-D kn=...]
-- What to look at  period_ratio, steps, rider_error.
label("quick")
local ratio = param("ratio", 1e5, "heavy over light mass")
local kn = param("kn", 1e9, "[Pa/m]")
local cycles = param("cycles", 20, "")
local light = param("light", 100, "density of the light blocks [kg/m3]")
local edge, thin = 0.1, 0.02

gravity(0)
material { name = "light", density = light }
local heavy_height = 2.0
local heavy_density = 20000
local side = math.sqrt(ratio * light * edge * edge * thin / (heavy_height * heavy_density))
material { name = "heavy", density = heavy_density }
local area, M, m_light = edge * edge, heavy_density * side ^ 2 * heavy_height, light * edge * edge * thin
joint { law = mortar { kn = kn, ks = kn, ft = 1e9, c = 1e9, mu = 0.6 }, between = { "chain", "chain" } }
box { name = "foot", group = "chain", material = "light", size = { edge, edge, 0.1 }, at = { -edge / 2, -edge / 2, -0.1 }, fixed = true }
box { name = "pad", group = "chain", material = "light", size = { edge, edge, thin }, at = { -edge / 2, -edge / 2, 0 }, initial = { position = { 0, 0, 5e-7 } } }
box { name = "heavy", group = "chain", material = "heavy", size = { side, side, heavy_height }, at = { -side / 2, -side / 2, thin },
  initial = { position = { 0, 0, 1e-6 } } }
box { name = "rider", group = "chain", material = "light", size = { edge, edge, thin }, at = { -edge / 2, -edge / 2, thin + heavy_height },
  initial = { position = { 0, 0, 1e-6 } } }
local k = kn * area
-- Exact: three masses pad, heavy, rider on three springs; the slow mode by inverse iteration on the 3 x 3 chain.
local function slow_mode()
  local x, w2 = { 0.5, 1, 1 }, 0
  for _ = 1, 50 do
    local f = { m_light * x[1], M * x[2], m_light * x[3] }
    -- K^-1 f of the chain: each displacement adds the sum of the forces above it over k.
    local a = (f[1] + f[2] + f[3]) / k
    local b = a + (f[2] + f[3]) / k
    local c = b + f[3] / k
    w2 = x[2] / b
    x = { a / b, 1, c / b }
  end
  return math.sqrt(w2)
end
local w = slow_mode()
recorder { name = "heavy", quantity = "displacement", block = "heavy", axis = "z" }
recorder { name = "rider", quantity = "displacement", block = "rider", axis = "z" }
analysis { duration = (cycles + 0.5) * 2 * pi / w, start = "rest", output_dt = 2 * pi / w / 200, frame_dt = 2 * pi / w }
metric("period_ratio", "", function(run) return run.period("heavy_uz_rel_m") * w / (2 * pi) end)
metric("rider_error", "", function(run)
  local a, b, worst = run.history("heavy_uz_rel_m"), run.history("rider_uz_rel_m"), 0
  for i = 1, #a do worst = math.max(worst, math.abs(a[i] - b[i])) end
  return worst / 1e-6
end)
-- Rows are read by straight lines, 200 per cycle, over `cycles` cycles; the step is at most a thousandth of the period.
expect("metrics.period_ratio", 1, { abs = 1e-5, source = "slow mode of the three masses" })
-- The rider lags by m w^2 / k of the motion and starts from exactly the same place: twice that. Noise in the start displaces the rider by
-- up to twice the noise of one block. It then vibrates on its own spring by as much for ever.
expect("metrics.rider_error", 4 * m_light * w ^ 2 / k + 1e-9 + 2 * start_noise / 1e-6, { below = true, source = "m w^2 / k" })
expect("energy.residual_relative", 1e-6, { below = true, source = "elastic gate" })
