-- V01: free fall of blocks of different mass, size and height; one of them is thrown upwards and sideways.
--
-- What happens   Only gravity acts. Leapfrog starts with half a kick, so z(t) = h0 + v0 t - g t^2 / 2 holds at every step for any dt.
--                Symplectic Euler would be off by g t dt / 2 (4.9 mm after 1 s at dt = 1 ms).
-- Source         Hairer, Lubich and Wanner 2003, Acta Numerica 12, section 1: kick-drift-kick is exact for a constant force.
-- How to run     erbs run scenes/verify/v01_free_fall.lua [-D dt=1e-4] [-D h0=50] [-D size=2]
-- What to look at  worst_relative_error (over all blocks and all rows), and the energy residual.
label("quick")
local dt = param("dt", 1e-3, "time step [s]")
local fine = param("fine", 0, "above 0: a tenth of the step")
if fine > 0 then dt = dt / 10 end
local h0 = param("h0", 10, "height of the lowest block [m]")
local size = param("size", 0.3, "longest edge of the smallest block [m]")
local fall_time = param("fall_time", 1, "length of the fall [s]")
local acceleration = param("gravity", g, "downwards [m/s2]")

gravity(acceleration)
material { name = "brick", density = 1800 }
material { name = "lead", density = 11340 }
local cases = {
  { material = "brick", scale = 1, v = { 0, 0, 0 } },
  { material = "lead", scale = 1, v = { 0, 0, 0 } },
  { material = "brick", scale = 7, v = { 0, 0, 0 } },
  { material = "brick", scale = 1, v = { 3, -2, 4 } },
}
for i, case in ipairs(cases) do
  local edge = size * case.scale
  case.name = "block" .. i
  case.h = h0 * i
  box { name = case.name, material = case.material, size = { edge, edge / 2.4, edge / 3 }, center = { 20 * i, 0, case.h }, free = true,
    initial = { velocity = case.v } }
  recorder { name = case.name, quantity = "displacement", block = case.name }
end
analysis { duration = fall_time, dt = dt, start = "rest", output_dt = fall_time / 50 }

-- Error over the largest distance of the block from the ground, so that no row divides by zero.
local function worst_error(run)
  local worst = 0
  for _, case in ipairs(cases) do
    for k, axis in ipairs { "x", "y", "z" } do
      for i, u in ipairs(run.history(case.name .. "_u" .. axis .. "_rel_m")) do
        local time = run.time[i]
        local exact = case.v[k] * time - (k == 3 and acceleration * time ^ 2 / 2 or 0)
        worst = math.max(worst, math.abs(u - exact) / case.h)
      end
    end
  end
  return worst
end
metric("worst_relative_error", "", worst_error)
ensemble { n = 1, seed = 1, param = "fine", name = "fine", value = worst_error }
metric("fallen_m", "m", function(run) return -run.last("block1_uz_rel_m") end)
metric("end_time_s", "s", function(run) return run.time[#run.time] end)

-- Only round-off: n sums of eps each, n = fall_time / dt steps.
expect("metrics.worst_relative_error", 1e-12, { below = true, source = "h0 + v0 t - g t^2 / 2" })
expect("metrics.fine_most", 1e-11, { below = true, source = "the same at a tenth of the step: ten times the round-off" })
-- The run ends at a whole step; here dt must divide the time of the fall.
expect("metrics.fallen_m", acceleration * fall_time ^ 2 / 2, { rel = 1e-12 * math.max(1, 1e-3 / dt), source = "g t^2 / 2" })
expect("energy.residual_relative", 1e-12, { below = true, source = "a constant force: the ledger's identity is exact" })
