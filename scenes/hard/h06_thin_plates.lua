-- Hard case: thin plates hit corners and edges, with deep overlap
--
-- What happens   Plates of 0.3 x 0.2 x 0.01 m fly with edge, corner or face at the edges and corners of fixed blocks and at each other,
--                without friction or damping. Some contact laws take the direction of least overlap for the normal. Where this direction
--                switches, they return stored energy along a new line and create energy. Here the inner distance is a potential, so no
--                energy is created.
-- Source         conservation of energy
-- How to run     erbs run scenes/hard/h06_thin_plates.lua [-D seed=...] [-D fraction=0.9]
-- What to look at  energy.residual_relative, max_penetration_relative
-- Tolerance      second order in the step: 1e-2 at 0.9 of its bound
label("quick")
local seed = param("seed", 1, "")
local fraction = param("fraction", 0.2, "of the step's bound")
local speed = param("speed", 2, "[m/s]")
local kn = param("kn", 2e11, "[Pa/m]")
gravity(0)
material { name = "stone", density = 2000, kn = kn, ks = 0, friction = 0, restitution = 1 }
local state = seed * 7919 + 12345
local function random()
  state = (state * 1103515245 + 12345) % 2147483648
  return 2 * state / 2147483648 - 1
end
local function plate(name, at, velocity)
  box { name = name, size = { 0.3, 0.2, 0.01 }, center = at, free = true,
    initial = { velocity = velocity, rotation = { 3 * random(), 3 * random(), 3 * random() }, spin = { 5 * random(), 5 * random(), 5 * random() } } }
end
for i = 1, 12 do
  local z = 3 * i
  box { name = "block" .. i, size = { 0.2, 0.2, 0.2 }, center = { 0, 0, z }, fixed = true }
  plate("thrown" .. i, { 0.35, 0.1 * random(), z + 0.1 * random() }, { -speed, 0, 0 })
  plate("one" .. i, { 1.8, 0, z }, { speed, 0, 0 })
  plate("other" .. i, { 2.2, 0.1 * random(), z + 0.1 * random() }, { -speed, 0, 0 })
end
analysis { duration = 0.2, dt_fraction = fraction, start = "rest", output_dt = 0.002, frame_dt = 0.2 }
expect("energy.residual_relative", 1e-2, { below = true, source = "gate" })
expect("max_penetration_relative", 0.25, { below = true, source = "the inner distance turns over at half the thickness" })
