-- V10: a block on rough ground under an oscillating force that just exceeds friction: stick, slip, and a slow walk.
--
-- What happens   8 cos(t) N act on 1 kg, which friction holds by at most mu m g = 7.848 N. In each half cycle the block slips a few
--                millimetres. lib_sliding.lua integrates the rigid answer for any force, mass and friction from event to event.
-- Source         Potra, Anitescu, Gavrea and Trinkle 2006, Int. J. Numer. Meth. Eng. 66, 1079 (also a validation case of Solfec): x(10 s) =
--                -0.008697 m, largest speed 0.039545 m/s for 0.3 x 0.3 x 0.1 m, mu 0.8.
-- How to run     erbs run scenes/verify/v10_stick_slip.lua [-D F=9] [-D mass=5] [-D spring=300*Hz]
-- Step           -0.0087 m at any step up to 0.9 of the limit, with and without the dashpots of the joint. While a contact slips the step
--                stays below 1/omega of its patch. Friction couples sway and rocking of a block whose pressure lies near an edge
--                (v10_flutter.lua); without this bound the motion would grow.
-- Limit          mu H / 2 < L / 6. Beyond it the trailing edge of the bed opens and the pressure at the other edge follows friction. The
--                block then flutters as it slides and walks faster than a rigid one. The scene refuses such a block.
-- What to look at  x_end, v_largest beside rigid_x_end, rigid_v_largest.
include "lib_sliding.lua"
local F, mu = param("F", 8, "amplitude of the force [N]"), param("mu", 0.8, "")
local mass = param("mass", 1, "[kg]")
local omega = param("omega", 1, "of the force [rad/s]")
local duration = param("duration", 10, "[s]")
local spring = param("spring", 300, "frequency of the block on its shear spring [Hz]")
local size = { 0.3, 0.3, 0.1 }
local area = size[1] * size[2]
if mu * size[3] / 2 > size[1] / 6 then error("mu = " .. mu .. " opens the bed under the trailing edge; keep it below " .. size[1] / 3 / size[3], 0) end
local ks = mass * (2 * pi * spring) ^ 2 / area
local kn = 2.5 * ks

material { name = "stone", density = mass / (area * size[3]), friction = mu, kn = kn, ks = ks }
local rigid = sliding { drive = function(t) return -F / mass * math.cos(omega * t) end, limit = mu * g, ends = duration }
local reach = 0.5 + rigid.largest
box { name = "plate", group = "plate", size = { 2 * reach, 1, 0.1 }, at = { -reach, -0.5, -0.1 }, fixed = true }
box { name = "block", group = "block", size = size, at = { -0.15, -0.15, 0 } }
joint { law = dry { kn = kn, ks = ks, mu = mu, interlock = 0 }, between = { "plate", "block" } }
force { block = "block", wave = sine { amplitude = F, frequency = omega / (2 * pi), phase = 90 * deg, start = 1e-9 }, direction = "x" }
-- The ramp waits for sliding blocks. So the force at the start is slightly below sliding, and the spring is already stretched when the wave
-- begins.
force { block = "block", wave = table_wave { times = { 0, 1e-9, 2e-9 }, values = { math.min(F, 0.999 * mu * mass * g), 0, 0 } }, direction = "x" }
recorder { name = "block", quantity = "displacement", block = "block", axis = "x" }
recorder { name = "block", quantity = "velocity", block = "block", axis = "x" }
-- start = "ramp" applies the force slowly. With "rest" gravity and the force would act at once, and the bed would vibrate by W / k, 3e-6 m.
analysis { duration = duration, start = "ramp", output_dt = duration / 2000, frame_dt = duration / 50 }
metric("x_end", "m", function(run) return run.last("block_ux_rel_m") - run.first("block_ux_rel_m") end)
metric("v_largest", "m/s", function(run) return run.peak("block_vx_rel_m_s") end)
metric("rigid_x_end", "m", rigid.at_end)
metric("rigid_v_largest", "m/s", rigid.speed)
-- Plus the deformation of the spring, which is all there is while F stays below mu m g; for speeds also its vibration from the start.
local give = F / (mass * (2 * pi * spring) ^ 2)
expect("metrics.x_end", rigid.at_end, { abs = 0.01 * rigid.largest + 2.5 * give, source = "rigid sliding, 1 % of the peak" })
expect("metrics.v_largest", rigid.speed, { abs = 0.01 * rigid.speed + 2.5 * give * omega, source = "rigid sliding" })
if F == 8 and mu == 0.8 and mass == 1 and omega == 1 and duration == 10 then
  expect("metrics.rigid_x_end", -0.008697, { abs = 2e-6, source = "Potra et al. 2006" })
  expect("metrics.rigid_v_largest", 0.039545, { abs = 2e-6, source = "Potra et al. 2006" })
end
