-- V70: a block at rest on what moves at once
--
-- What happens   A block rests on a plate. The plate starts upwards at once, or a pulse far shorter than the contact's own period kicks it or
--                the ground under it. Nothing approaches: the blow comes within a step that was sized for a block at rest. It threw the block
--                at up to 18 times its speed; now the step shortens for what the load is known to do (engine/solve/jolts.h).
-- Source         Newton's rule: the block leaves a plate of speed V with (1 + e) V; after a pulse of the impulse m V it rebounds with e V.
-- How to run     erbs run scenes/verify/v70_jolt.lua [-D restitution=0] [-D way=1] [-D pulse=3e-5]
-- What to look at  metrics.over_paper: the speed over that on paper, in terms of V.
label("quick")
local e, kn, speed = param("restitution", 0.3), param("kn", 5e10, "[Pa/m]"), param("speed", 0.5, "V [m/s]")
local side, start = param("side", 0.3, "[m]"), param("start", 0.1, "of the jolt [s]")
local way = param("way", 0, "0: the plate starts, 1: a pulse of the ground, 2: a pulse of force, 3: the plate tilts at once")
local pulse_time = param("pulse", 0.02, "of the pulse, over the contact's own period")
local turn = param("turn", 0, "[degrees] of the scene about the vertical")
family({ restitution = { 0, 0.1, 0.8 }, kn = { 1e9, 1e12 }, speed = { 0.1, 3 }, side = { 0.05, 1 }, start = { 0, 1e-4, 0.1001, 0.10013 },
  way = { 1, 2, 3 }, pulse = { 0.001, 0.1 }, turn = { 30 } }, { combinations = 24 })

gravity(g)
material { name = "stone", density = 2000, kn = kn, ks = 0.4 * kn, friction = 0.5, restitution = e }
local mass, period = 2000 * side ^ 3, 2 * math.pi * math.sqrt(2000 * side / kn)
local short = pulse_time * period
local arm, driven = 10 * side, way == 0 or way == 3
transform { rotation = { 0, 0, turn * deg }, function()
  box { name = "plate", size = { 3 * side, 3 * side, side }, at = { -1.5 * side, -1.5 * side, -side }, fixed = not driven }
  box { name = "block", size = { side, side, side }, at = { -side / 2, -side / 2, 0 }, free = true }
end }
local function ramp(value)
  if start == 0 then return table_wave { times = { 0, 1 }, values = { 0, value }, hold = true } end
  return table_wave { times = { 0, start, start + 1 }, values = { 0, 0, value }, hold = true }
end
if way == 0 then motion { block = "plate", direction = "z", wave = ramp(speed) }
elseif way == 3 then turning { block = "plate", axis = "x", wave = ramp(speed / arm), about = { 0, -arm, 0 } }
elseif way == 1 then ground_motion { direction = "z", wave = pulse { amplitude = speed / short, start = start, duration = short } }
else force { block = "block", direction = "z", wave = pulse { amplitude = -mass * speed / short, start = start, duration = short } } end
recorder { name = "block", quantity = "velocity", block = "block", axis = "z" }
local after = math.min(0.2 * speed / g + 4 * period, 0.05)
analysis { duration = start + after, output_dt = after / 200, frame_dt = 1 }
local paper = driven and 1 + e or e
metric("over_paper", "", function(run) return run.max "block_vz_rel_m_s" / speed - paper end)
expect("metrics.over_paper", 0, { between = { -0.2, 0.04 }, source = "Newton, with a restitution of .02 at least; a pulse that is not short against the period rebounds less" })
expect("energy.residual_relative", 1e-4, { below = true, source = "goal" })
