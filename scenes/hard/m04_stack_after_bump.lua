-- Hard case: a stack on a slope comes to rest after a bump
--
-- What happens   Plates lie on a slope below the angle of friction. One half sine makes them hop; then each bed opens a little in every
--                cycle of the stack's vibration. A law that slides a little in every such hop lets the stack creep down for ever.
-- Source         Below the angle of friction a stack comes to rest after a shake; v06_creep has the stack that was never shaken.
-- How to run     erbs run scenes/hard/m04_stack_after_bump.lua [-D plates=40] [-D share=0.9] [-D up=0] [-D start=3]
-- What to look at  drift (of the length, per second, in the last half second; 0: all have come to rest, or swing to rest about a place that stays), gone (m, way down the slope), energy.residual_relative.
label("quick")
local plates, length, width, thickness = param("plates", 8, ""), param("length", 1.6, "[m]"), param("width", 0.2, "[m]"),
  param("thickness", 0.05, "[m]")
local share, mu = param("share", 0.6, "of the angle of friction"), param("mu", 0.6, "")
local kn = param("kn", 1e10, "[Pa/m]")
local up = param("up", 1, "1: bump across the slope's horizon, downwards; 0: sideways, down the slope; 2: across the slope")
local amplitude = param("amplitude", 1.2 * g, "[m/s2]")
local start = param("start", 1, "1 equilibrium, 2 ramp, 3 rest")
local rest = param("rest", 3, "after the bump [s]; looked at from 2 s on")
family({ plates = { 1, 3, 20, 40 }, length = { 0.4, 0.8 }, thickness = { 0.02, 0.1 }, share = { 0.1, 0.3, 0.9 }, mu = { 0.3, 1 }, kn = { 1e9, 1e11, 1e12 },
  up = { 0, 2 }, start = { 2, 3 } }, { combinations = 12 })
local slope = share * math.atan(mu)
if math.tan(slope) * plates * thickness > 0.5 * length then error("the weight of the stack passes beside its foot; make it longer or lower share", 0) end
if up ~= 1 and plates * thickness > 8 * (up == 0 and length or width) then error("a stack as slender as this is overturned sideways; take fewer plates", 0) end
material { name = "stone", density = 2000, friction = mu }
transform { rotation = { 0, slope, 0 }, function()
  box { name = "base", size = { 4 * length, 3 * width, 0.2 }, center = { 0, 0, -0.1 }, fixed = true }
  for i = 1, plates do box { name = "plate" .. i, size = { length, width, thickness }, center = { 0, 0, (i - 0.5) * thickness } } end
end }
joint { law = dry { kn = kn, mu = mu } }
ground_motion { wave = half_sine { amplitude = up == 1 and -amplitude or 0.5 * amplitude, frequency = 10, start = 0.1 }, direction = ({ [0] = "x", "z", "y" })[up] }
local drift = include "parts/walk.lua"
local watched = { "plate1", "plate" .. math.ceil(plates / 2), "plate" .. plates }
for i, name in ipairs(watched) do
  if name ~= watched[i - 1] then recorder { name = name, quantity = "displacement", block = name } end
end
metric("drift", "1/s", function(run) return drift(run, watched, 0.5) / length end)
metric("gone", "m", function(run) return math.sqrt(run.last(watched[#watched] .. "_ux_rel_m") ^ 2 + run.last(watched[#watched] .. "_uy_rel_m") ^ 2) end)
analysis { duration = 0.15 + rest, start = ({ "equilibrium", "ramp", "rest" })[start], output_dt = 5e-3, frame_dt = 1 }
expect("metrics.drift", 1e-6, { below = true, source = "below the angle of friction it sticks" })
expect("energy.residual_relative", 1e-3, { below = true, source = "nothing is made" })
