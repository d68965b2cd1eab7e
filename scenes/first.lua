-- Twelve dry bricks on shaking ground
-- A dry pier stands on the ground. The ground begins to shake; the pier rocks and falls within a second.
--   run:  erbs run scenes/first.lua --video          stronger:  erbs run scenes/first.lua -D shake=0.6*g -o runs/stronger
--   see:  runs/first/*.mp4, histories.svg, metrics.json (collapse.time_s); with -D shake=0.1*g it stands
local shake = param("shake", 0.35*g, "peak acceleration of the ground [m/s2]")

material{ name = "brick", density = 1800, friction = 0.6 }
ground{ size = 8 }
for course = 0, 11 do
  box{ name = "brick" .. course, group = "pier", size = { 30*cm, 12.5*cm, 10*cm }, at = { -15*cm, -6.25*cm, course * 10*cm } }
end
joint{ law = dry{ kn = 5*GPa, mu = 0.6 } }

ground_motion{ wave = sine{ amplitude = shake, frequency = 1.5*Hz, duration = 3 }, direction = "y" }
analysis{ duration = 4 }
recorder{ name = "top", quantity = "displacement", block = "brick11" }
camera{ name = "side", eye = { 2.8, -1.9, 1.1 }, target = { 0, -0.35, 0.45 } }
