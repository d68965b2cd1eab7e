-- Hard case: a loose brick lies on the ground, or a hair above it, beside a pier on soft beds
--
-- What happens   The step of the soft pier is many times longer than the contact of the brick bears. The brick has no speed at the start, so
--                nothing foretells its contact, and one step too long throws it into the air or ends the run.
-- Source         A brick that is laid down stays where it is: it sinks by its weight over the stiffness of its face
-- How to run     erbs run scenes/hard/h36_first_step.lua [-D gap=1e-6] [-D kn=1e7] [-D size=3]
-- What to look at  metrics.thrown, metrics.settlement_over_paper
label("quick")
local kn, contact = param("kn", 1e9, "[Pa/m] of the beds"), param("contact", 2e10, "[Pa/m]")
local gap, size, tilt = param("gap", 0, "[m] below the brick"), param("size", 1, "times .3 x .2 x .1 m"), param("tilt", 0, "[rad] of the brick")
family({ kn = { 1e7, 1e8, 1e12 }, contact = { 1e9, 1e12 }, gap = { 1e-7, 1e-6, 1e-5 }, size = { 0.2, 3 }, tilt = { 1e-3, 0.05 } },
  { combinations = 16 })
gravity(g)
local length, width, height, density = 0.3 * size, 0.2 * size, 0.1 * size, 1800
material { name = "brick", density = density, friction = 0.6, restitution = 0.3, kn = contact, ks = 0.4 * contact }
box { name = "ground", size = { 10 * size, 4 * size, 0.2 }, center = { 0, 0, -0.1 }, fixed = true }
for i = 1, 3 do box { name = "pier" .. i, group = "pier", size = { length, width, height }, center = { 0, 0, (i - 0.5) * height } } end
joint { law = mortar { kn = kn, ks = 0.4 * kn, ft = 10 * MPa, c = 10 * MPa, mu = 0.6 } }
joint { none = true, between = { "loose", "" } }
local rise = gap + length / 2 * math.sin(tilt) + height / 2 * (math.cos(tilt) - 1)  -- of the centroid above its place on the ground
box { name = "loose", group = "loose", size = { length, width, height }, center = { size, 0, height / 2 + rise }, rotation = { 0, tilt, 0 },
  free = true }
recorder { name = "loose", quantity = "displacement", block = "loose", axis = "z" }
analysis { duration = 1.5 }
local weight_over_bed = density * height * g / contact  -- m
metric("thrown", "", function(run) return math.max(0, run.max "loose_uz_rel_m") / height end)
metric("settlement_over_paper", "", function(run) return (-run.last "loose_uz_rel_m" - rise) / weight_over_bed end)
expect("metrics.thrown", 1e-3, { below = true, source = "nothing lifts it" })
expect("metrics.settlement_over_paper", 1, { abs = 0.02, source = "weight over stiffness" })
expect("energy.residual_relative", 1e-3, { below = true, source = "gate" })
