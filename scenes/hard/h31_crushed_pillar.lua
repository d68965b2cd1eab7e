-- H31: a pillar of stones whose beds lose their strength as they are crushed, loaded until it goes.
--
-- What happens   Four pillars carry a slowly growing load: centred or at the edge of the core, on a plateau or with a compressive fracture
--                energy. At .95 of the strength they stand. The loads rise on, beyond fc of the beds. Pillars that soften are crushed
--                through in a moment and collapse; those on a plateau are pressed in as long as the load pushes.
-- Source         N = fc A (centred); N (1 / A + 6 e / (b h^2)) = fc at first crushing (eccentric). Crushing takes at most Gc A of a bed.
-- How to run     erbs run scenes/hard/h31_crushed_pillar.lua [-D kn=...] [-D ductility=1.6*mm] [-D ramp=0.5]
-- What to look at  before_*: damage at .95 of the strength; collapse; crushing_share; the residual of the ledger while strength is lost.
local kn, fc = param("kn", 1e10, "[Pa/m]"), param("fc", 10 * MPa, "[Pa]")
local ductility, ramp = param("ductility", 1.6 * mm, "Gc / fc [m]"), param("ramp", 0.4, "time to the strength [s]")
local side, stones = 0.5, 3
material { name = "stone", density = 2400, friction = 0.6, kn = kn, ks = 0.4 * kn }
box { name = "floor", group = "floor", size = { 12, 6, 1 }, at = { -1, -3, -1 }, fixed = true }
local area, most = side ^ 2, 0
for i, case in ipairs { { e = 0, soft = true }, { e = 1 / 8, soft = true }, { e = 0, soft = false }, { e = 1 / 8, soft = false } } do
  local name = "pillar" .. i
  for k = 1, stones do
    box { name = name .. "_" .. k, group = name, size = { side, side, side }, at = { 3 * (i - 1), 0, (k - 1) * side } }
  end
  local law = mortar {
    kn = kn, ks = 0.4 * kn, ft = 0.1 * MPa, c = 0.3 * MPa, mu = 0.6, damping = 0.05, fc = fc, Gc = case.soft and fc * ductility or 0,
  }
  joint { law = law, between = { name, name } }
  joint { law = law, between = { "floor", name } }
  local strength = fc * area / (1 + 6 * case.e)
  force {
    block = name .. "_" .. stones, direction = "z", point = { 3 * (i - 1) + side / 2 + case.e * side, side / 2, stones * side },
    wave = table_wave { times = { 0, 0.95 * ramp, 1.2 * ramp }, values = { 0, -0.95 * strength, case.soft and -1.2 * strength or -0.99 * strength }, hold = true },
  }
  recorder { name = name, quantity = "damage", blocks = name .. "_1" }
  recorder { name = name, quantity = "crushing", blocks = name .. "_1" }
  recorder { name = name .. "_top", quantity = "displacement", block = name .. "_" .. stones, axis = "z" }
  local function at(run, column, time)
    local values = run.history(column)
    for k, t in ipairs(run.time) do if t >= time - 1e-9 then return values[k] end end
  end
  metric("before_" .. name, "", function(run) return at(run, name .. "_damage", 0.9 * ramp) end)
  expect("metrics.before_" .. name, 0, { abs = 0, source = "below the strength nothing is crushed" })
  if case.soft then
    metric("sunk_" .. name, "m", function(run) return -run.last(name .. "_top_uz_rel_m") end)
    expect("metrics.sunk_" .. name, side / 2, { above = true, source = "a bed that is spent bears nothing" })
    most = most + stones * area * fc * ductility
  else
    metric("sunk_" .. name, "m", function(run) return -run.last(name .. "_top_uz_rel_m") end)
    expect("metrics.sunk_" .. name, 5 * stones * fc / kn, { below = true, source = "elastic below fc: stones fc / kn, and its bending" })
  end
end
metric("crushing_share", "", function(run) return run.metrics.energy.crushing_J / most end)
expect("metrics.crushing_share", { between = { 0.3, 1.001 }, source = "at most Gc A of each bed that is spent" })
expect("collapse.collapsed", true, { source = "two of four pillars" })
analysis { duration = 1.5 * ramp, output_dt = 0.005, stop_after_collapse = 0.02, frame_stress = true, frame_dt = 0.02 }
camera { name = "front", eye = { 4.5, -12, 3 }, target = { 4.5, 0, 0.7 } }
expect("energy.residual_relative", 1e-3, { below = true, source = "ledger: crushing is booked place by place" })
