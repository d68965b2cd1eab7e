-- V09: order of leapfrog through slip, stick and slip back, on a softer joint, and the error of the shear spring itself.
--
-- What happens   The block of v09_newmark_sine.lua (mu 0.3, A 0.6, 2 Hz) on a spring of 200 Hz. The acceleration is continuous where slip
--                starts, so halving the step divides the error by four. The reference is the finest step of the same scene, because the
--                spring itself changes the slip from 0.047179 to about 0.0472 m. The factor depends on the position of the slip event
--                within a step: with other springs this position wanders as the step is halved, and the observed slopes lie between 0.3 and
--                2.3.
-- How to run     erbs run scenes/verify/v09_order.lua
-- What to look at  converge_share_slope; slip: the largest slip with the spring.
label("fixed_dt")
local f, A, mu, size, density = 2, 0.6, 0.3, 0.3, 1800
local spring = param("spring", 200, "frequency of the block on its shear spring [Hz]")
local share = param("share", 1 / 64, "dt over the limit")
local height = size / 20
local ks = density * height * (2 * pi * spring) ^ 2
material { name = "stone", density = density, friction = mu, kn = 2.5 * ks, ks = ks }
box { name = "plate", group = "plate", size = { 1, 1, 0.1 }, at = { -0.5, -0.5, -0.1 }, fixed = true }
box { name = "block", group = "block", size = { size, size / 2, height }, at = { -size / 2, -size / 4, 0 } }
joint { law = dry { kn = 2.5 * ks, ks = ks, mu = mu }, between = { "plate", "block" } }
recorder { name = "block", quantity = "displacement", block = "block", axis = "x" }
ground_motion { wave = full_sine { amplitude = A * g, frequency = f }, direction = "x" }
-- Just beyond the end of the first slip: later vibrations of the spring do not affect the largest slip.
analysis { duration = 0.46, start = "equilibrium", dt_fraction = share, output_dt = 0.46, frame_dt = 1 }
metric("slip", "m", function(run) return -run.last("block_ux_rel_m") end)
converge { param = "share", values = { 1 / 8, 1 / 16, 1 / 32, 1 / 64, 1 / 512 }, slope = 1.7, value = function(run) return run.last("block_ux_rel_m") end }
