-- P3: free rocking of a wall on its base, up to the first impact.
--
-- What happens   A wall 0.6 m thick and 3 m high is tilted by 0.05 rad about its toe and released. The first impact ends a quarter period.
-- Source         Housner 1963, the exact equation integrated: 0.36643904 s. The bed is elastic, so the toe sinks in. That shortens the arm
--                of the weight and slows the start; no time step removes this error.
-- How to run     erbs accuracy scenes/accuracy/p3_free_rocking.lua [-D kn=1e12]
-- What to look at  The stiffness of the bed is the knob. The step soon ceases to matter.
label("coarse_study")
local kn = param("kn", 1e12, "of the bed [Pa/m]")
accuracy { param = "kn", name = "bed stiffness", values = { 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15 } }
material { name = "stone", density = 2000, kn = kn, ks = 0.4 * kn }
box { name = "base", size = { 2, 1, 0.2 }, at = { -1, -0.5, -0.2 }, fixed = true }
box { name = "wall", size = { 0.6, 1, 3 }, at = { -0.3, -0.5, 0 }, initial = { rotation = { 0, 0.05, 0 }, about = { 0.3, 0, 0 } } }
joint { law = dry { kn = kn, ks = 0.4 * kn, mu = 2 } }
recorder { name = "wall", quantity = "rotation", block = "wall", axis = "y" }
metric("quarter", "s", function(run) return run.crossings("wall_ry_rad", 0, false)[1] end)
expect("metrics.quarter", 0.36643904, { rel = 0.03, source = "Housner's exact equation" })
analysis { duration = 0.42, start = "rest", output_dt = 1e-4, frame_dt = 0.1 }
