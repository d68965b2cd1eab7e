-- V02: projectiles with mass damping, thrown in different directions.
--
-- What happens   v' = g - a v, so v = v0 e^(-at) + (g/a)(1 - e^(-at)) in each direction. Centred damping is the Cayley approximation of
--                e^(-a dt): its rate is a (1 + (a dt)^2 / 12), of second order.
-- How to run     erbs run scenes/verify/v02_projectile_with_damping.lua [-D dt=...] [-D a=...]; half the dt, a quarter of the error
-- What to look at  error_over_adt2_*: the error of displacement and velocity in units of (a dt)^2, the same number at any dt.
label("quick")
local dt = param("dt", 2e-3, "time step [s]")
local a = param("a", 5, "mass damping [1/s]")
local fall_time = param("fall_time", 1, "length of the flight [s]")

gravity(g)
damping { mass = a, scope = "all" }
material { name = "brick", density = 1800 }
local throws = { { 0, 0, 0 }, { 6, 0, 8 }, { -3, 7, -2 } }
for i, v in ipairs(throws) do
  box { name = "block" .. i, size = { 0.3, 0.125, 0.1 }, center = { 10 * i, 0, 30 }, free = true, initial = { velocity = v } }
  recorder { name = "block" .. i, quantity = "displacement", block = "block" .. i }
  recorder { name = "block" .. i, quantity = "velocity", block = "block" .. i }
end
analysis { duration = fall_time, dt = dt, start = "rest", output_dt = fall_time / 20 }

local function worst(run, column, exact)
  local largest, scale = 0, 0
  for i, v in ipairs(throws) do
    for k, axis in ipairs { "x", "y", "z" } do
      for row, got in ipairs(run.history("block" .. i .. "_" .. column:format(axis))) do
        local wanted = exact(v[k], k == 3 and -g or 0, run.time[row])
        largest, scale = math.max(largest, math.abs(got - wanted)), math.max(scale, math.abs(wanted))
      end
    end
  end
  return largest / scale / (a * dt) ^ 2
end
metric("error_over_adt2_velocity", "", function(run)
  return worst(run, "v%s_rel_m_s", function(v0, f, time) return v0 * math.exp(-a * time) + f / a * (1 - math.exp(-a * time)) end)
end)
metric("error_over_adt2_path", "", function(run)
  return worst(run, "u%s_rel_m", function(v0, f, time)
    return f / a * time + (v0 - f / a) * (1 - math.exp(-a * time)) / a
  end)
end)
-- The rate errs by the share (a dt)^2 / 12, and a t e^(-a t) <= 1/e. The mean of two half steps adds (a dt)^2 / 8 to a velocity. Together
-- below 1/4.
expect("metrics.error_over_adt2_velocity", 0.25, { below = true, source = "Cayley: (a dt)^2 (1/12 a t e^(-at) + 1/8)" })
expect("metrics.error_over_adt2_path", 0.25, { below = true, source = "the same, integrated" })
-- The order itself: the error of the velocities when the step is halved again and again.
converge { param = "dt", values = { 0.08 / a, 0.04 / a, 0.02 / a, 0.01 / a }, slope = 1.9, name = "order",
  error = function(run) return worst(run, "v%s_rel_m_s", function(v0, f, time) return v0 * math.exp(-a * time) + f / a * (1 - math.exp(-a * time)) end) * dt ^ 2 end }
expect("energy.residual_relative", 1e-12, { below = true, source = "centred damping is booked with the mean velocity it acts on" })
