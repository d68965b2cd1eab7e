-- P6: Newmark's sliding block on ground that swings once.
--
-- What happens   A flat block slides on ground that moves through one full sine of 0.6 g at 2 Hz; friction 0.3.
-- Source         Newmark 1965, integrated exactly: greatest slip 0.047179 m. The joint's spring gives by mu g / w^2 and delays the slip by
--                about 1 / w: .047199 m for a spring of 200 Hz. The acceleration is continuous where slip starts, so leapfrog is of second order.
-- How to run     erbs accuracy scenes/accuracy/p6_newmark_slip.lua [-D kn=1e11]
-- What to look at  the slope of the step against its own limit, the spring's error apart.
label("fine_study")
local kn = param("kn", 5.7e7, "of the bed: 200 Hz in shear, so that its swing is resolved by the steps [Pa/m]")
local mu, A, f = 0.3, 0.6, 2
material { name = "stone", density = 1800 }
box { name = "plate", size = { 4, 1, 0.2 }, at = { -2, -0.5, -0.2 }, fixed = true }
box { name = "block", size = { 0.6, 0.6, 0.02 }, at = { -0.3, -0.3, 0 } }
joint { law = dry { kn = kn, ks = kn, mu = mu } }
ground_motion { wave = sine { amplitude = A * g, frequency = f, duration = 1 / f }, direction = "x" }
recorder { name = "slip", quantity = "displacement", block = "block", axis = "x" }
metric("slip", "m", function(run) return run.peak "slip_ux_rel_m" end)
expect("metrics.slip", 0.047179, { rel = 0.005, source = "Newmark" })
analysis { duration = 0.65, start = "equilibrium", output_dt = 1e-5, frame_dt = 0.1 }
