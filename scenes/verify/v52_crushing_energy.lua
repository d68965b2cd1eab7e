-- V52: a compressive strength that softens: crushing takes Gc per area, whatever the stiffness, the points and the step.
--
-- What happens   Held blocks are pressed between plates until their beds are spent, through an unloading and a reloading on the way. Others
--                are rotated about their far edge until the near one is spent.
-- Source         p = fc (1 - w / (2 Gc / fc)), w = closing - p / kn: linear softening, area Gc below the curve (a compressive fracture energy
--                as in Lourenco 1996; usual Gc / fc = 1.6 mm). Rotated by theta about the far edge until its near edge is spent, a bed of
--                width B has N = B Gc / theta, and about that edge M = B fc (e^2 / 3 + (d - e)(d + 2 e) / 6) / theta^2, e = fc / kn, d = 2 Gc / fc.
--                Where the corners bear, those of the near edge have half the area: N = A p / 2, M = N H at half of that rotation.
-- How to run     erbs run scenes/verify/v52_crushing_energy.lua [-D kn=...] [-D fc=...] [-D ductility=1.6*mm] [-D steps=...]
-- What to look at  peak_*, half_*, unloading_*, spent_*: of the pressed blocks; turned_*; crushing_over_paper.
label("quick")
local fc, ductility = param("fc", 10 * MPa, "[Pa]"), param("ductility", 1.6 * mm, "Gc / fc [m]")
local kn = param("kn", 1e10, "of the softest beds; others have 3 and 20 times this [Pa/m]")
local H, B = param("side", 0.5, "[m]"), param("width", 0.3, "[m]")
local steps = param("steps", 4000, "of the whole run")
family({ kn = { 1e10, 1e11, 1e12 }, fc = { 2e6, 1e7 }, ductility = { 0.6e-3, 1.6e-3, 5e-3 }, steps = { 1000, 10000 } }, { combinations = 6 })
gravity(0)
material { name = "stone", density = 2000 }
local dt = 1e-5
local duration, depth = steps * dt, 2 * ductility  -- depth: crushed depth without strength
local crushing, place = 0, 0

local function pair(name, x)
  local base = "base_" .. name
  box { name = base, group = base, size = { H, B, 0.1 }, at = { x, 0, -0.1 }, fixed = true }
  box { name = name, group = name, size = { H, B, 0.1 }, at = { x, 0, 0 } }
  return base
end
local function bed(base, name, stiffness, rule, n, bond, pressure)
  joint {
    law = mortar { kn = stiffness, ks = 0.4 * stiffness, ft = bond or 0, c = 2 * (bond or 0), mu = 0.6, fc = fc, Gc = fc * ductility },
    between = { base, name }, rule = rule, points = { n, n }, pressure = pressure or "face",
  }
end
-- Linear in time between its nodes; the nodes are rows.
local function value_at(run, column, share)
  local values = run.history(column)
  return values[math.floor(share * (#values - 1) + 0.5) + 1]
end
local function one(name, value, tolerance, source)
  metric(name, "", value)
  expect("metrics." .. name, 1, { abs = tolerance, source = source })
end

for i, stiffer in ipairs { 1, 3, 20 } do
  for k, rule in ipairs { { "simpson", 3 }, { "gauss", 2 }, { "midpoint", 1 }, { "trapezoid", 2, "points" } } do
    place = place + 1
    local stiffness, name = kn * stiffer, string.format("pressed%d%s", i, rule[1])
    local e = fc / stiffness
    local base = pair(name, 2 * H * place)
    bed(base, name, stiffness, rule[1], rule[2], (k == 1 or k == 4) and 0.1 * MPa or 0, rule[3])
    -- Closings of the nodes: the peak, half of the strength (w = d / 2), back by half of the elastic part, again, spent and past it.
    local half = 0.5 * depth + 0.5 * e
    local times, closings = { 0, 0.2, 0.4, 0.5, 0.6, 0.9, 1 }, { 0, e, half, half - 0.25 * e, half, depth, 1.1 * depth }
    for n = 1, #times do times[n], closings[n] = times[n] * duration, -closings[n] end
    motion { block = name, direction = "z", wave = table_wave { times = times, values = closings, hold = true } }
    recorder { name = name, quantity = "normal_stress", blocks = { base }, others = { name } }
    recorder { name = name, quantity = "crushing", blocks = { base }, others = { name } }
    recorder { name = name, quantity = "damage", blocks = { base }, others = { name } }
    local column = name .. "_normal_stress_mean_Pa"
    one("peak_" .. name, function(run) return -value_at(run, column, 0.2) / fc end, 1e-9, "fc")
    one("half_" .. name, function(run) return -value_at(run, column, 0.4) / (0.5 * fc) end, 1e-9, "fc (1 - w / d), w = d / 2")
    one("unloading_" .. name, function(run) return -value_at(run, column, 0.5) / (0.25 * fc) end, 1e-9, "fc / 2 - kn e / 4")
    one("again_" .. name, function(run) return -value_at(run, column, 0.6) / (0.5 * fc) end, 1e-9, "the same curve")
    one("lost_half_" .. name, function(run) return value_at(run, name .. "_crushing", 0.4) / 0.5 end, 1e-9, "w / d")
    one("lost_" .. name, function(run) return run.last(name .. "_crushing") end, 1e-9, "w = d")
    one("damage_" .. name, function(run) return run.last(name .. "_damage") end, 1e-9, "crushed all over")
    metric("spent_" .. name, "Pa", function(run) return run.last(column) end)
    expect("metrics.spent_" .. name, 0, { abs = 1e-6, source = "no strength is left" })
    crushing = crushing + fc * ductility * H * B
  end
end

for i, stiffer in ipairs { 1, 20, 1, 20 } do
  place = place + 1
  local stiffness, name, corners = kn * stiffer, "turned" .. i, i > 2
  local e, theta, x = fc / stiffness, depth / H, 2 * H * place
  local base = pair(name, x)
  if corners then bed(base, name, stiffness, "trapezoid", 2, 0, "points") else bed(base, name, stiffness, "simpson", 3) end
  turning { block = name, axis = "y", wave = table_wave { times = { 0, 0.9 * duration }, values = { 0, theta }, hold = true }, about = { x, B / 2, 0 } }
  recorder { name = name, quantity = "normal_force", blocks = { base }, others = { name } }
  recorder { name = name, quantity = "joint_moment", blocks = { base }, others = { name }, axis = "y" }
  -- The far edge is the hinge; M of the recorder is about the middle.
  if corners then
    local u = 0.5 * depth
    local N = 0.5 * B * H * (u < e and stiffness * u or fc * (1 - (u - e) / (depth - e)))
    one("turned_force_" .. i, function(run) return -value_at(run, name .. "_normal_N", 0.45) / N end, 1e-4, "A p / 2; arms turn")
    one("turned_moment_" .. i, function(run) return value_at(run, name .. "_my_N_m", 0.45) / (N * H / 2) end, 1e-4, "N H / 2")
    crushing = crushing + 0.5 * fc * ductility * H * B
    goto next
  end
  local N = B * fc * ductility / theta
  local M = B * fc * (e ^ 2 / 3 + (depth - e) * (depth + 2 * e) / 6) / theta ^ 2
  one("turned_force_" .. i, function(run) return -run.last(name .. "_normal_N") / N end, 1e-3, "B Gc / theta; steps cut the corners of the curve")
  one("turned_moment_" .. i, function(run) return (N * H / 2 + run.last(name .. "_my_N_m")) / M end, 2e-3, "B Int p u du / theta^2")
  -- A place at u has dissipated the area below the curve less its elastic energy: the mean over u in 0..d.
  local spent = 0
  local n = 20000
  for k = 1, n do
    local u = (k - 0.5) / n * depth
    if u > e then
      local w = (u - e) / (1 - e / depth)
      spent = spent + fc * w * (1 - w / (2 * depth)) / n
    end
  end
  crushing = crushing + spent * H * B
  ::next::
end
-- A step that begins or ends crushing cuts a corner of the curve: half a step of closing times the change of pressure.
local closing = depth / (0.3 * steps)
one("crushing_over_paper", function(run) return run.metrics.energy.crushing_J / crushing end, 20 * kn * closing ^ 2 / (fc * ductility) + 1e-6, "Gc A")

analysis { duration = duration, dt = dt, start = "rest", output_dt = duration / 100 }
expect("energy.residual_relative", 1e-3, { below = true, source = "ledger: crushing is booked place by place" })
