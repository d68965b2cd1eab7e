-- P6: Newmark's sliding block on ground that moves by one sine.
--
-- What happens   A flat block slides on ground that moves by one full sine of 0.6 g at 2 Hz; the friction is 0.3.
-- Source         Newmark 1965, integrated exactly: greatest slip 0.0471794007 m. The spring of the joint gives way by mu g / w^2 and delays
--                the slip by about 1 / w. The acceleration is continuous where slip starts, so leapfrog is of second order; its constant
--                changes with the position of this event within a step.
-- How to run     erbs accuracy scenes/accuracy/p6_newmark_slip.lua [-D ks=1e11]
-- What to look at  Against theory the spring of the bed is the knob. Against the scene's own limit, at one spring, the order of the step.
label("fine_study")
local ks = param("ks", 5.7e7, "of the bed: 200 Hz in shear, so that its swing is resolved by the steps [Pa/m]")
accuracy { param = "ks", name = "bed stiffness", values = { 5.7e5, 5.7e6, 5.7e7, 5.7e8, 5.7e9 } }
-- Not equal to ks: sway, rocking and bouncing of so flat a block would all have 200 Hz and would beat.
local kn = param("kn", 2.5 * ks, "of the bed [Pa/m]")
local mu, A, f = 0.3, 0.6, 2
material { name = "stone", density = 1800 }
box { name = "plate", size = { 4, 1, 0.2 }, at = { -2, -0.5, -0.2 }, fixed = true }
-- The block starts with the velocity at which the growing ground acceleration deforms the bed. From rest it would swing about this motion
-- as fast as the ground's push grows; it would slip, catch and slip again before it slides for good.
local side, h = 0.6, 0.02
local growth, turned = 1800 * h * A * g * 2 * pi * f, h / 2 * 12 / side ^ 2  -- Pa/s; moment of it by the arm h / 2 over side^2 / 12
box { name = "block", size = { side, side, h }, at = { -side / 2, -side / 2, 0 },
  initial = { velocity = { -growth * (1 / ks + h / 2 * turned / kn), 0, 0 }, spin = { 0, -growth * turned / kn, 0 } } }
joint { law = dry { kn = kn, ks = ks, mu = mu } }
ground_motion { wave = sine { amplitude = A * g, frequency = f, duration = 1 / f }, direction = "x" }
recorder { name = "slip", quantity = "displacement", block = "block", axis = "x" }
metric("slip", "m", function(run) return run.peak "slip_ux_rel_m" end)
expect("metrics.slip", 0.0471794007, { rel = 0.005, source = "Newmark, integrated exactly" })
analysis { duration = 0.65, dt_fraction = 1 / 32, start = "equilibrium", output_dt = 1e-5, frame_dt = 0.1 }
