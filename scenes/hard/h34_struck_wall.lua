-- Hard case: a block falls on a wall of weak, stiff mortar, whose cracked beds then tremble at the limit of the step
--
-- What happens   The blow cracks the beds. What is left of them opens and closes again and again at .9 of the step that they bear. Each time
--                makes a little energy, far less than one event may, and always of the same sign.
-- Source         Energy identity. Events may err by less, the more the whole run has erred (engine/joints/event_bound.h).
-- How to run     erbs run scenes/hard/h34_struck_wall.lua [-D bed=5e12] [-D strength=1e5] [-D fall=0.2] [-D duration=0.5]
-- What to look at  energy.residual_relative: 2.4e-3 and growing as long as the beds tremble, where only the last steps counted; 4e-6 with --dt-fraction 0.3.
local bed = param("bed", 5.5e12, "normal stiffness of the beds [Pa/m]")
local strength = param("strength", 0.095 * MPa, "tensile [Pa]")
local kn = param("kn", 6.6e9, "normal stiffness of contacts [Pa/m]")
local fall, duration = param("fall", 0.2, "[m]"), param("duration", 0.5, "[s]")
local size = { 0.3, 0.125, 0.1 }
family({ bed = { 3e12, 1e13 }, strength = { 0.05 * MPa, 0.2 * MPa }, kn = { 3e9, 3e10 }, fall = { 0.1, 0.5 } }, { combinations = 4 })
material { name = "brick", density = 2100, kn = kn, ks = 0.4 * kn, friction = 0.6, restitution = 0.85 }
ground { size = 60, material = "brick" }
for course = 0, 5 do
  for i = -1, 1 do box { group = "wall", size = size, center = { 0, i * size[2], (course + 0.5) * size[3] } } end
end
for _, other in ipairs { "wall", "ground" } do
  joint { law = mortar { kn = bed, ks = 0.4 * bed, ft = strength, c = 1.5 * strength, mu = 0.6, Gf1 = 37, Gf2 = 49 }, between = { "wall", other } }
end
box { size = { 0.09, 0.15, 0.06 }, center = { 0.09, -0.07, 0.65 + fall }, rotation = { 0.002, 0.07, -0.54 }, free = true }
gravity(g)
analysis { duration = duration, frame_dt = 1 }
expect("energy.residual_relative", 5e-4, { below = true, source = "what all events of a run may leave" })
expect("momentum_residual", 1e-8, { below = true, source = "joints and contacts conserve momentum" })
