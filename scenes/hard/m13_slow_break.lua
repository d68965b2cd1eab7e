-- Hard case: brittle mortar that breaks under a load that grows slowly
--
-- What happens   A beam on two beds bears the settlement of one support until the mortar breaks, all at once. The beam, nearly still until
--                then, swings with the energy that the bed has stored: the whole energy of the scene.
-- Source         Energy identity. The step is short before a bond breaks, while that costs nothing (`Solver::event_rate_of_breaks`).
-- How to run     erbs run scenes/hard/m13_slow_break.lua [-D side=0.3] [-D kn=1e9] [-D ft=1e5] [-D bricks=3]
-- What to look at  energy.residual_relative: up to 1.2e-2, and 18 of 41 runs beyond 1e-3, where the step shortened after the break only.
local side = param("side", 1, "of the supports; the beam is three times as long [m]")
local kn, ft = param("kn", 1e10, "of the beds [Pa/m]"), param("ft", 1e6, "of the mortar [Pa]")
local time = param("time", 2, "of the settlement [s]")
local bricks = param("bricks", 1, "of which the beam consists, in two courses if more than one")
family({ side = { 0.3, 3, 5 }, kn = { 1e9, 1e11, 1e12 }, ft = { 1e5, 3e5 }, time = { 1, 4 }, bricks = { 3, 8 } }, { combinations = 24 })
material { name = "stone", density = 2000, friction = 0.6 }
box { name = "left", group = "left", size = { side, side, side }, at = { 0, 0, -side }, fixed = true }
box { name = "right", group = "right", size = { side, side, side }, at = { 3 * side, 0, -side }, fixed = true }
local courses = bricks > 1 and 2 or 1
for course = 0, courses - 1 do
  for i = 0, bricks - 1 do
    box { size = { 3 * side / bricks, side, 0.4 * side / courses }, at = { 0.5 * side + 3 * side / bricks * i, 0, 0.4 * side / courses * course } }
  end
end
joint { law = mortar { kn = kn, ft = ft, c = ft, mu = 0.6 } }
settle { supports = "right", by = 0.02 * side, duration = time }
analysis { duration = 1.5 * time, frame_dt = 1 }
expect("energy.residual_relative", 1e-3, { below = true, source = "nothing is made, nothing lost unbooked" })
expect("momentum_residual", 1e-8, { below = true, source = "joints and contacts conserve momentum" })
