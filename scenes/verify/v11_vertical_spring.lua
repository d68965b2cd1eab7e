-- V11: blocks vibrate vertically on one bed joint.
--
-- What happens   T = 2 pi sqrt(m / (kn A)). Leapfrog has a shorter period: sin(w' dt / 2) = w dt / 2, to first order by the share (w dt)^2
--                / 24. Blocks of different height share the step, so each has its own w dt.
-- Source         Hairer, Lubich and Wanner 2003, Acta Numerica 12, section 5 (leapfrog applied to the oscillator).
-- How to run     erbs run scenes/verify/v11_vertical_spring.lua [-D kn=...] [-D density=...] [-D share=0.9]
-- What to look at  coefficient_*: (T'/T - 1) / (w dt)^2, which is -1/24 = -0.041667 by the series.
label("quick")
local kn = param("kn", 1e9, "normal stiffness of the bed [Pa/m]")
local density = param("density", 1800, "[kg/m3]")
local height = param("height", 0.1, "of the lightest block [m]")
local share = param("share", 0.2, "dt over 2/omega of the lightest block")
local cycles = param("cycles", 60, "of the lightest block")

gravity(0)
material { name = "brick", density = density }
local w1 = math.sqrt(kn / (density * height))
local dt = share * 2 / w1
for i = 1, 3 do
  local h, name = height * i ^ 2, "block" .. i
  box { name = "base" .. i, group = "base", size = { 0.3, 0.125, 0.1 }, at = { i, 0, -0.1 }, fixed = true }
  box { name = name, group = "block", size = { 0.3, 0.125, h }, at = { i, 0, 0 }, initial = { position = { 0, 0, 1e-5 } } }
  recorder { name = name, quantity = "displacement", block = name, axis = "z" }
  local w = w1 / i
  local own = function(run) return run.period(name .. "_uz_rel_m") * w / (2 * pi) end  -- T' / T
  metric("period_ratio_" .. i, "", own)
  metric("coefficient_" .. i, "", function(run) return (own(run) - 1) / (w * dt) ^ 2 end)
  -- Crossings are read by straight lines between steps: a phase of (w dt)^3 / 30 at the two ends, over 2 pi cycles.
  local reading = (w * dt) ^ 3 / 30 / (2 * pi * math.floor(cycles / i)) + 1e-9
  expect("metrics.period_ratio_" .. i, w * dt / 2 / math.asin(w * dt / 2), { abs = 2 * reading, source = "sin(w' dt / 2) = w dt / 2" })
  -- The next term of the series is 3/640 (w dt)^4 beside 1/24 (w dt)^2: a share of 0.11 (w dt)^2.
  expect("metrics.coefficient_" .. i, -1 / 24, { rel = 0.2 * (w * dt) ^ 2 + 60 * reading / (w * dt) ^ 2, source = "-(w dt)^2 / 24" })
end
joint { law = mortar { kn = kn, ks = 0.4 * kn, ft = 1e9, c = 1e9, mu = 0.6 } }
analysis { duration = cycles * 2 * pi / w1, dt = dt, start = "rest", output_dt = dt }
converge { param = "share", values = { 0.4, 0.2, 0.1 }, slope = 1.95, name = "order", error = function(run) return run.period("block1_uz_rel_m") * w1 / (2 * pi) - 1 end }
expect("energy.residual_relative", 1e-10, { below = true, source = "exact for a linear spring (discrete identity of the ledger)" })
