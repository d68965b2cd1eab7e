-- V09: order of leapfrog through stick and slip, on a softer joint.
--
-- What happens   The block of v09_newmark_sine.lua (mu 0.3, A 0.6, 2 Hz) on an undamped spring of 200 Hz, shortly before its largest slip.
--                The acceleration is continuous where slip starts, so halving the step divides the error by four. The reference is the
--                finest step of the same scene, because the spring itself changes the slip. The factor depends on the position of the
--                slip event within a step: with springs of 150 to 400 Hz the observed slopes lie between 0.8 and 3.7, and the errors are
--                below 1e-6 m at 1/8 of the limit and 2e-8 m at 1/64. A dashpot knows the velocity of half a step before, which is an
--                error of first order: 3e-5 m of what remains of the slip at 1/8 of the limit, where the block slides back.
-- How to run     erbs run scenes/verify/v09_order.lua
-- What to look at  converge_share_slope; slip: the slip after 0.29 s.
label("fixed_dt")
local f, A, mu, size, density = 2, 0.6, 0.3, 0.3, 1800
local spring = param("spring", 200, "frequency of the block on its shear spring [Hz]")
local share = param("share", 1 / 64, "dt over the limit")
local height = size / 20
local ks = density * height * (2 * pi * spring) ^ 2
material { name = "stone", density = density, friction = mu, kn = 2.5 * ks, ks = ks }
box { name = "plate", group = "plate", size = { 1, 1, 0.1 }, at = { -0.5, -0.5, -0.1 }, fixed = true }
box { name = "block", group = "block", size = { size, size / 2, height }, at = { -size / 2, -size / 4, 0 } }
joint { law = dry { kn = 2.5 * ks, ks = ks, mu = mu, damping = 0 }, between = { "plate", "block" } }
recorder { name = "block", quantity = "displacement", block = "block", axis = "x" }
ground_motion { wave = full_sine { amplitude = A * g, frequency = f }, direction = "x" }
-- A row in every step: a straight line between two of them errs by a dt^2 / 8 at most, 6e-9 m.
analysis { duration = 0.3, start = "equilibrium", dt_fraction = share, output_dt = 1e-5, frame_dt = 1 }
local function slip(run) return -run.at("block_ux_rel_m", 0.29) end
metric("slip", "m", slip)
converge { param = "share", values = { 1 / 8, 1 / 16, 1 / 32, 1 / 64, 1 / 512 }, slope = 1.7, value = slip }
expect("metrics.converge_share_error", 0, { abs = 1e-8, source = "second order, at 1/64 of the limit" })
