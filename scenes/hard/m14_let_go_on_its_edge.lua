-- Hard case: a block is let go tilted on its edge, on a dry bed that bears nothing yet
--
-- What happens   The block starts at rest. Its edge sinks into the bed, and the strip that bears grows with the load. The block swings on this
--                strip, whose stiffness changes within each swing, until dashpots have taken the swing; then it rocks.
-- Source         Energy identity. The first fall of the weight on a strip of no width is an event that no speed foretells.
-- How to run     erbs run scenes/hard/m14_let_go_on_its_edge.lua [-D tilt=0.5] [-D kn=1e10] [-D width=0.6 -D height=3]
-- What to look at  energy.residual_relative: 3.7e-3 with the step of the bed, 1.5e-2 on a soft one.
label("quick")
local width, depth, height = param("width", 0.25, "[m]"), param("depth", 0.75, "[m]"), param("height", 1, "[m]")
local tilt = param("tilt", 0.1, "at the start, of atan(width / height)")
local kn = param("kn", 1e9, "[Pa/m]")
family({ width = { 0.06, 0.5 }, height = { 0.5, 4 }, tilt = { 0.02, 0.5, 0.8 }, kn = { 1e8, 1e10, 1e12 } }, { combinations = 12 })
material { name = "stone", density = 2300 }
ground { size = 40 }
box { name = "block", size = { width, depth, height }, center = { 0, 0, height / 2 },
  initial = { rotation = { 0, tilt * math.atan(width / height), 0 }, about = { width / 2, 0, 0 } } }
joint { law = dry { kn = kn, mu = 1 } }
analysis { duration = 1.5 * math.sqrt(height / g), start = "rest", frame_dt = 1 }
expect("energy.residual_relative", 1e-3, { below = true, source = "nothing is made" })
