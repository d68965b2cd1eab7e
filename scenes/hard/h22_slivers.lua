-- Hard case: slivers, tiny fragments and frictionless mitres
--
-- What happens   Wedges cut at 45 degrees meet without friction or bond and slide off each other, once as drawn and once mirrored. Slivers
--                of 0.2 mm, needles and pyramids fall on a brick; one fragment has a millionth of its mass.
-- Source         mirrored scene, mirrored result; W / (2 sin 45 deg) on each side of a wedge in a groove (V45)
-- How to run     erbs run scenes/hard/h22_slivers.lua
-- What to look at  mirror_error, groove (force on a flank over the weight), energy.residual_relative, status
label("quick")
local kn = param("kn", 1e8, "[Pa/m]")
gravity(g)
material { name = "stone", density = 2000, kn = kn, ks = 0.4 * kn, friction = 0, restitution = 0.3 }
material { name = "rough", density = 2000, kn = kn, ks = 0.4 * kn, friction = 0.6, restitution = 0.3 }
ground { size = 40, material = "rough" }
local function wedge(x, side, z)  -- a triangle with its mitre at 45 degrees; `side`: direction of its foot
  return { { x, 0, z }, { x + side * 0.2, 0, z }, { x, 0, z + 0.2 }, { x, 0.1, z }, { x + side * 0.2, 0.1, z }, { x, 0.1, z + 0.2 } }
end
-- The mitred pair: a fixed lower wedge and an upper one that slides down its flank; and the mirror image.
for _, side in ipairs { 1, -1 } do
  local name, x = side > 0 and "right" or "left", side * 5
  block { name = name .. "_low", material = "stone", vertices = wedge(x, side, 0.3), fixed = true }
  block { name = name, material = "stone", free = true, vertices = { { x + side * 0.2, 0, 0.3 }, { x + side * 0.2, 0, 0.5 }, { x, 0, 0.5 },
    { x + side * 0.2, 0.1, 0.3 }, { x + side * 0.2, 0.1, 0.5 }, { x, 0.1, 0.5 } } }
  recorder { name = name, quantity = "displacement", block = name }
end
metric("mirror_error", "m", function(run)
  local worst = 0
  for axis, sign in pairs { x = -1, y = 1, z = 1 } do
    local r, l = run.history("right_u" .. axis .. "_rel_m"), run.history("left_u" .. axis .. "_rel_m")
    for i = 1, #r do worst = math.max(worst, math.abs(r[i] - sign * l[i])) end
  end
  return worst
end)
metric("slid", "m", function(run) return math.sqrt(run.at("right_ux_rel_m", 0.15) ^ 2 + run.at("right_uz_rel_m", 0.15) ^ 2) end)
-- Noise in the start differs on the two sides by up to twice itself; its rotations move the centre by a fraction of that as faces meet.
expect("metrics.mirror_error", 1e-12 + 4 * start_noise, { below = true, source = "symmetry" })
expect("metrics.slid", 0.5 * g * math.sin(45 * deg) * 0.15 ^ 2, { rel = 0.01, source = "g sin 45 t^2 / 2, from a face that bounces" })
-- A wedge of 90 degrees in its groove.
for _, side in ipairs { 1, -1 } do
  block { name = "groove" .. side, material = "stone", fixed = true, vertices = { { 0, 0, 0.1 }, { side * 0.3, 0, 0.4 }, { side * 0.3, 0, 0.1 },
    { 0, 0.1, 0.1 }, { side * 0.3, 0.1, 0.4 }, { side * 0.3, 0.1, 0.1 } } }
  recorder { name = "flank" .. side, quantity = "reaction", block = "groove" .. side }
end
block { name = "keel", material = "stone", free = true, vertices = { { 0, 0, 0.1 }, { 0.2, 0, 0.3 }, { -0.2, 0, 0.3 }, { 0, 0.1, 0.1 }, { 0.2, 0.1, 0.3 }, { -0.2, 0.1, 0.3 } } }
metric("groove", "", function(run)
  local weight = 2000 * 0.2 * 0.2 * 0.1 * g
  return math.sqrt(run.mean("flank1_fx_N") ^ 2 + run.mean("flank1_fz_N") ^ 2) / weight
end)
expect("metrics.groove", 1 / (2 * math.sin(45 * deg)), { rel = 0.02, source = "V45: W / (2 sin 45 deg); mean of a settling" })
-- Slivers, needles, a fragment and a pyramid on a brick.
box { name = "bed", material = "rough", size = { 0.4, 0.4, 0.1 }, at = { 10, 0, 0 }, fixed = true }
box { name = "sliver", material = "rough", size = { 0.2, 0.1, 0.0002 }, center = { 10.2, 0.2, 0.16 }, free = true, initial = { rotation = { 0.2, 0.1, 0 } } }
box { name = "needle", material = "rough", size = { 0.2, 0.001, 0.001 }, center = { 10.2, 0.1, 0.14 }, free = true, initial = { rotation = { 0.3, 0.2, 0 } } }
box { name = "fragment", material = "rough", size = { 0.003, 0.003, 0.003 }, center = { 10.1, 0.3, 0.12 }, free = true, initial = { rotation = { 1, 2, 0 } } }
block { name = "pyramid", material = "rough", vertices = { { 0, 0, 0 }, { 0.1, 0, 0 }, { 0, 0.1, 0 }, { 0.03, 0.03, 0.004 } }, at = { 10.25, 0.25, 0.13 }, free = true }
analysis { duration = 0.25, start = "rest", output_dt = 0.001, frame_dt = 0.25 }
expect("status", "completed")
expect("energy.residual_relative", 1e-2, { below = true, source = "gate" })
