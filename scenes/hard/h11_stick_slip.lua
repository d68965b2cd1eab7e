-- H11: hundreds of changes between stick and slip; slip never returns energy, in any step.
--
-- What happens   A block is pressed on its joint and moved to and fro by a prescribed slow motion. A fast tremble on top takes it through
--                the transition between stick and slip again and again. The slip is the motion less its elastic part, and T . d(slip) >= 0
--                in every step.
-- Source         Coulomb friction: the traction of a sliding point is along its slip.
-- How to run     erbs run scenes/hard/h11_stick_slip.lua [-D tremble=50] [-D steps=...]
-- What to look at  least_slip_work_*: least work of a step, over the elastic energy at the limit; changes_*: from stick to slip;
--                friction_over_slip: friction work of the ledger over the sum of T . d(slip).
local kn, mu = param("kn", 1e9, "[Pa/m]"), param("mu", 0.8, "friction")
local tremble = param("tremble", 40, "swings of the fast motion in one of the slow")
local steps = param("steps", 40000, "of the run")
local depth = param("depth", 2e-6, "[m]")
label("fixed_dt")
gravity(0)
material { name = "brick", density = 1800 }
joint { law = dry { kn = kn, ks = 0.4 * kn, mu = mu } }
local dt = 1e-5
local l, w, time = 0.3, 0.125, steps * dt
local area = l * w
local ks, limit = 0.4 * kn * area, mu * kn * depth * area
local reach = limit / ks  -- m, largest elastic slip
local work = {}
for i, share in ipairs { 0.2, 0.6, 1.5 } do  -- amplitude of the tremble over the largest elastic slip
  local name, base = "block" .. i, "base" .. i
  box { name = base, group = base, size = { l, w, 0.1 }, at = { 2 * i, 0, -0.1 }, fixed = true }
  box { name = name, group = name, size = { l, w, 0.1 }, at = { 2 * i, 0, 0 } }
  motion { block = name, direction = { 0, 0, -1 }, wave = table_wave { times = { 0, 100 * dt }, values = { 0, depth }, hold = true } }
  motion { block = name, direction = "x", wave = sine { amplitude = 6 * reach, frequency = 2 / time, start = 100 * dt } }
  motion { block = name, direction = "x", wave = sine { amplitude = share * reach, frequency = 2 * tremble / time, start = 100 * dt } }
  recorder { name = name, quantity = "reaction", blocks = { base }, axis = "x" }
  recorder { name = name, quantity = "displacement", block = name, axis = "x" }
  local function slips(run)
    local T, u, slip = run.history(name .. "_fx_N"), run.history(name .. "_ux_rel_m"), {}
    for k = 1, #T do slip[k] = u[k] - T[k] / ks end
    return T, slip
  end
  metric("least_slip_work_" .. i, "", function(run)
    local T, slip = slips(run)
    local least = 0
    for k = 2, #T do least = math.min(least, (T[k] + T[k - 1]) / 2 * (slip[k] - slip[k - 1])) end
    return least / (limit * reach / 2)
  end)
  metric("slip_work_" .. i, "J", function(run)
    local T, slip = slips(run)
    local sum = 0
    for k = 2, #T do sum = sum + (T[k] + T[k - 1]) / 2 * (slip[k] - slip[k - 1]) end
    work[i] = sum
    return sum
  end)
  metric("changes_" .. i, "", function(run)
    local T, slip = slips(run)
    local count, was = 0, false
    for k = 2, #T do
      local now = math.abs(slip[k] - slip[k - 1]) > 1e-9 * reach
      if now and not was then count = count + 1 end
      was = now
    end
    return count
  end)
  -- Histories are written with 17 digits: only round-off of u - T / ks remains.
  expect("metrics.least_slip_work_" .. i, -1e-12, { above = true, source = "friction takes energy in every step" })
end
metric("friction_over_slip", "", function(run)
  return run.energy.friction_J / (work[1] + work[2] + work[3])
end)
analysis { duration = time, dt = dt, output_dt = dt, start = "rest" }
expect("metrics.changes_3", 4 * tremble / 2, { above = true, source = "the tremble takes it there again and again" })
-- The same sums; the ledger takes them point by point.
expect("metrics.friction_over_slip", 1, { rel = 1e-9, source = "the ledger books T . d(slip)" })
expect("status", "completed")
