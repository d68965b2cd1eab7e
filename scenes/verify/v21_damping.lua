-- V21: blocks on one bed joint vibrate vertically and decay: mass damping, stiffness damping, and both.
--
-- What happens   The damping ratio is xi = a / (2 w) + b w / 2: slow blocks feel the mass part, fast ones the dashpots in the joints. From
--                peak to peak the vibration shrinks by the logarithmic decrement 2 pi xi / sqrt(1 - xi^2).
-- Source         Rayleigh, Theory of Sound, sections 45 and 103.
-- How to run     erbs run scenes/verify/v21_damping.lua [-D a=...] [-D b=...] [-D kn=...] [-D share=0.05]
-- What to look at  decrement_*: over the formula.
local kn = param("kn", 1e9, "normal stiffness of the bed [Pa/m]")
local density = param("density", 1800, "[kg/m3]")
local height = param("height", 0.1, "of the lightest block [m]")
local share = param("share", 0.2, "dt over 2/omega of the lightest block")
local w1 = math.sqrt(kn / (density * height))
local a = param("a", 0.02 * w1, "mass damping [1/s]")
local b = param("b", 0.1 / w1, "stiffness damping [s]")
local cycles = param("cycles", 6, "between the peaks that are compared")

label("fixed_dt")
gravity(0)
material { name = "brick", density = density }
damping { mass = a, stiffness = b }
local dt = share * 2 / w1
for i = 1, 4 do
  local h, name = height * i ^ 2, "block" .. i
  box { name = "base" .. i, group = "base", size = { 0.3, 0.125, 0.1 }, at = { i, 0, -0.1 }, fixed = true }
  box { name = name, group = "block", size = { 0.3, 0.125, h }, at = { i, 0, 0 }, initial = { position = { 0, 0, 1e-5 } } }
  recorder { name = name, quantity = "displacement", block = name, axis = "z" }
  local w = w1 / i
  local xi = a / (2 * w) + b * w / 2
  metric("decrement_" .. i, "", function(run)
    local u, peaks = run.history(name .. "_uz_rel_m"), {}
    for k = 2, #u - 1 do
      if u[k] > 0 and u[k] >= u[k - 1] and u[k] > u[k + 1] then  -- the top of the parabola through three rows
        local slope, bend = (u[k + 1] - u[k - 1]) / 2, u[k + 1] - 2 * u[k] + u[k - 1]
        peaks[#peaks + 1] = u[k] - slope ^ 2 / (2 * bend)
      end
    end
    return math.log(peaks[1] / peaks[1 + cycles]) / cycles / (2 * math.pi * xi / math.sqrt(1 - xi ^ 2))
  end)
  -- Dashpots see the velocity of half a step before, and leapfrog vibrates too fast: shares b w^2 dt / 4 and -(w dt)^2 / 24 of the
  -- decrement, 1 % and -0.7 % for the lightest block. v21_decay_at_any_step has the exact law for every step up to the limit.
  expect("metrics.decrement_" .. i, 1, { abs = 0.005, source = "2 pi xi / sqrt(1 - xi^2)" })
end
joint { law = mortar { kn = kn, ks = 0.4 * kn, ft = 1e9, c = 1e9, mu = 0.6 } }
analysis { duration = (cycles + 1.3) * 4 * 2 * math.pi / w1, dt = dt, start = "rest", output_dt = dt }
metric("limit_over_formula", "", function(run)
  local xi = b * w1 / 2
  return run.dt_critical_s / (2 / w1 * (math.sqrt(1 + xi ^ 2) - xi))
end)
-- The rocking of the lowest block is faster than its vertical vibration by at most sqrt 3: its own limit is shorter, never longer.
expect("metrics.limit_over_formula", 1, { below = true, source = "explicit dashpots: (2 / w) (sqrt(1 + xi^2) - xi)" })
-- Each dashpot books its own work; the ledger compares it with the motion of the blocks.
expect("energy.residual_relative", 1e-6, { below = true, source = "ledger" })
