-- V36: a tilted drum rocks and rolls on its rim and comes to rest.
--
-- What happens   Two drums of a column (prisms of many sides) are released tilted, one towards +x, the other towards -x; a third is tilted
--                and spun. There is no closed form: the first two must be mirror images and stay in their plane, and no energy may appear.
-- Source         Symmetry; the ledger.
-- How to run     erbs run scenes/verify/v36_drum.lua [-D sides=24] [-D tilt=0.2]
-- What to look at  mirror: largest |x_1 + x_2| over the radius; aside: out of plane; losses; energy.residual_relative.
label("quick")
local sides, tilted = param("sides", 32, "of a drum"), param("tilt", 0.15, "[rad]")
local radius, height, kn = 0.5, 1.5, param("kn", 2e9, "[Pa/m]")
material { name = "stone", density = 2500, kn = kn, ks = 0.4 * kn, friction = 0.8, restitution = 0.2 }
box { name = "floor", size = { 20, 20, 1 }, at = { -10, -10, -1 }, fixed = true, material = "stone" }
joint { law = dry { kn = kn, mu = 0.8 }, none = true }
local polygon = {}
for i = 1, sides do  -- a side faces -x and one +x: the drum rocks on them
  local a = 2 * pi * (i - 0.5) / sides
  polygon[i] = { radius * math.cos(a), radius * math.sin(a) }
end
local apothem = radius * math.cos(pi / sides)
for i, way in ipairs { 1, -1, 1 } do
  local x = 4 * (i - 2)
  local spin = i == 3 and { 0, 0, 1.5 } or { 0, 0, 0 }
  prism { name = "drum" .. i, polygon = polygon, height = height, at = { x, 0, 0 }, free = true, material = "stone",
    initial = { rotation = { 0, way * tilted, 0 }, about = { x + way * apothem, 0, 0 }, spin = spin } }
  recorder { name = "drum" .. i, quantity = "displacement", block = "drum" .. i }
end
metric("mirror", "radius", function(run)
  local a, b, worst = run.history("drum1_ux_rel_m"), run.history("drum2_ux_rel_m"), 0
  for i = 1, #a do worst = math.max(worst, math.abs(a[i] + b[i])) end
  return worst / radius
end)
metric("aside", "radius", function(run) return math.max(run.peak("drum1_uy_rel_m"), run.peak("drum2_uy_rel_m")) / radius end)
metric("losses", "J", function(run) return run.energy.contact_damping_J + run.energy.friction_J end)
-- Round-off of the positions (1e-17 m after 10 ms) grows about tenfold at each impact on a side: 1e-9 to 1e-8 after ten. Impacts follow
-- each other faster as the swing decays. A hundred times that is allowed.
expect("metrics.mirror", 1e-6, { below = true, source = "mirror symmetry" })
expect("metrics.aside", 1e-9, { below = true, source = "mirror symmetry" })
expect("metrics.losses", 0, { above = true, source = "no energy appears" })
expect("energy.residual_relative", 1e-3, { below = true, source = "ledger" })
analysis { duration = param("duration", 2.5, "[s]"), start = "rest", dt = 1e-4, output_dt = 5e-3, frame_dt = 0.04 }
