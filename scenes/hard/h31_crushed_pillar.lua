-- H31: pillars whose beds lose their strength as they are crushed, loaded until they go.
--
-- What happens   Four pillars bear their weight and a growing load: centred or eccentric, on beds that soften with a compressive fracture
--                energy or stay on a plateau. At .95 of the load that crushes first they stand. Then it grows beyond: a centred pillar that
--                softens is crushed through in a moment and collapses, its peer on a plateau is pressed in. Eccentric toes lose their edge.
-- Source         N = fc A (centred); N (1 / A + 6 e / (b h^2)) = fc at first crushing (eccentric).
-- How to run     erbs run scenes/hard/h31_crushed_pillar.lua [-D kn=...] [-D ductility=1.6*mm] [-D ramp=1]
-- What to look at  before_*: damage at .95 of the strength; sunk_*, lost_*; the residual of the ledger while strength is lost.
label("quick")
local kn, stones = param("kn", 2e9, "[Pa/m]"), param("stones", 4, "of a pillar")
local ductility, ramp = param("ductility", 1.6 * mm, "Gc / fc [m]"), param("ramp", 1, "time to the strength [s]")
local wide, tall, density = 1, 1.5, 2400
local area, weight = wide ^ 2, stones * wide ^ 2 * tall * density * g
local fc = param("fc", 1.3 * weight / area, "of the weak beds: the weight is most of the load, so that what falls falls as it would [Pa]")
material { name = "stone", density = density, friction = 0.6, kn = kn, ks = 0.4 * kn }
box { name = "floor", group = "floor", size = { 24, 12, 1 }, at = { -4, -6, -1 }, fixed = true }
local cases = { { e = 0, soft = true }, { e = 0.03, soft = true }, { e = 0 }, { e = 0.03 } }
for i, case in ipairs(cases) do
  local name, x = "pillar" .. i, 4 * (i - 1)
  for k = 1, stones do
    box { name = name .. "_" .. k, group = name, size = { wide, wide, tall }, at = { x, 0, (k - 1) * tall } }
  end
  local law = mortar {
    kn = kn, ks = 0.4 * kn, ft = 0.1 * fc, c = 0.3 * fc, mu = 0.6, damping = 0.05, fc = fc, Gc = case.soft and fc * ductility or 0,
  }
  joint { law = law, between = { name, name } }
  joint { law = law, between = { "floor", name } }
  -- The load stands at e; the weight is centred.
  local load = (fc * area - weight) / (1 + 6 * case.e)
  force {
    block = name .. "_" .. stones, direction = "z", point = { x + wide / 2 + case.e * wide, wide / 2, stones * tall },
    wave = table_wave { times = { 0, 0.95 * ramp, 1.2 * ramp }, values = { 0, -0.95 * load, -1.3 * load }, hold = true },
  }
  recorder { name = name, quantity = "damage", blocks = name .. "_1", others = "floor" }
  recorder { name = name, quantity = "crushing", blocks = name .. "_1", others = "floor" }
  recorder { name = name, quantity = "normal_stress", blocks = name .. "_1", others = "floor" }
  recorder { name = name .. "_top", quantity = "displacement", block = name .. "_" .. stones, axis = "xz" }
  metric("before_" .. name, "", function(run)
    for k, time in ipairs(run.time) do if time >= 0.9 * ramp then return run.history(name .. "_damage")[k] end end
  end)
  expect("metrics.before_" .. name, 0, { abs = 0, source = "below the strength nothing is crushed" })
  metric("greatest_" .. name, "", function(run)
    local least = 0
    for _, stress in ipairs(run.history(name .. "_normal_stress_min_Pa")) do least = math.min(least, stress) end
    return -least / fc
  end)
  expect("metrics.greatest_" .. name, 1, { abs = 0.02, source = "fc is the greatest pressure; it is reached between two rows" })
  metric("sunk_" .. name, "m", function(run) return -run.last(name .. "_top_uz_rel_m") end)
  metric("lost_" .. name, "", function(run) return run.last(name .. "_crushing") end)
end
expect("metrics.lost_pillar1", 1, { abs = 1e-9, source = "the lowest bed bears most: it is spent" })
expect("metrics.sunk_pillar1", 0.5 * wide, { above = true, source = "a spent bed bears nothing" })
expect("metrics.lost_pillar3", 0, { abs = 0, source = "a plateau keeps its strength" })
expect("collapse.collapsed", true, { source = "the centred pillar that softens" })
analysis { duration = 2 * ramp, output_dt = 0.005, stop_after_collapse = 0.02, frame_stress = true, frame_dt = 0.02 }
camera { name = "front", eye = { 6.5, -19, 4 }, target = { 6.5, 0, 2.6 } }
expect("energy.residual_relative", 1e-3, { below = true, source = "ledger: crushing is booked place by place" })
