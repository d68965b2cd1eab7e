-- Hard case: loose plates that fall onto each other on a slope come to rest as one stack
--
-- What happens   Plates hang above each other on a slope below the angle of friction, and fall. While they hang, each is alone; once they lie
--                on each other they hop together, and slowly. A scale of interlock that stays that of the start lets the stack creep for
--                seconds (engine/model/columns.h).
-- Source         Coulomb: below the angle of friction a stack comes to rest
-- How to run     erbs run scenes/hard/h35_poured_stack.lua [-D plates=40] [-D gap=.1] [-D share=.9]
-- What to look at  drift (of the length, per second, in the last half second), gone (m, way down the slope)
label("quick")
local plates, thickness, length = param("plates", 20, ""), param("thickness", 0.05, "[m]"), param("length", 1.6, "[m]")
local gap = param("gap", 0.05, "between two plates, of their thickness")
local share, mu, kn = param("share", 0.7, "of the angle of friction"), param("mu", 0.6, ""), param("kn", 1e10, "[Pa/m]")
local restitution, duration = param("restitution", 0.3), param("duration", 5, "[s]")
family({ plates = { 2, 10, 16 }, gap = { 0.009, 0.011, 0.02 }, share = { 0.3, 0.8, 0.9 }, mu = { 0.3, 1 }, kn = { 1e9, 1e11 }, restitution = { 0.05 }, thickness = { 0.02, 0.1 } },
  { combinations = 12 })
local slope = share * math.atan(mu)
if math.tan(slope) * plates * thickness > 0.5 * length then error("the weight of the stack passes beside its foot; make it longer or lower share", 0) end
gravity { g * math.sin(slope), 0, -g * math.cos(slope) }
material { name = "stone", density = 2000, friction = mu, restitution = restitution, kn = kn, ks = 0.4 * kn }
box { name = "base", size = { 20, 20, 0.2 }, center = { 0, 0, -0.1 }, fixed = true }
for i = 1, plates do
  box { name = "plate" .. i, size = { length, 0.8, thickness }, center = { 0, 0, (i - 0.5) * thickness * (1 + gap) + 0.5 * gap * thickness }, free = true }
end
local drift = include "parts/walk.lua"
local watched = { "plate1", "plate" .. math.ceil(plates / 2), "plate" .. plates }
for i, name in ipairs(watched) do
  if name ~= watched[i - 1] then recorder { name = name, quantity = "displacement", block = name } end
end
analysis { duration = duration, start = "rest", output_dt = 5e-3, frame_dt = 1 }
metric("drift", "1/s", function(run) return drift(run, watched, 0.5) / length end)
metric("gone", "m", function(run) return run.last("plate" .. plates .. "_ux_rel_m") end)
expect("metrics.drift", 1e-6, { below = true, source = "Coulomb" })
expect("energy.residual_relative", 1e-3, { below = true, source = "gate" })
