-- P5: horizontal load that turns an arch into a mechanism.
--
-- What happens   Seven voussoirs on dry joints of high friction form an arch. The ground acceleration grows slowly compared with the
--                periods of the arch. The result is the acceleration, as a share of gravity, at which a voussoir has moved by R / 100.
-- Source         Limit analysis: 0.37361 (Oppenheim 1992: 0.37) for t/R = 0.15 and an embrace of 157.5 degrees. The hinges are pressed
--                in, which lowers the result; the mechanism needs time to move, which raises it.
-- How to run     erbs accuracy scenes/accuracy/p5_arch.lua [-D rate=0.01]
-- What to look at  Neither step nor points matter: the knobs are the rate of loading and the stiffness of the joints.
label("coarse_study")
local R, n, embrace = param("R", 10, "of the centre line [m]"), 7, 157.5 * deg
local t, kn = 0.15 * R, param("kn", 1e11, "[Pa/m]")
local rate = param("rate", 0.02, "growth of the load [g/s]")
accuracy { param = "kn", name = "joint stiffness", values = { 1e10, 1e11, 1e12, 1e13 } }
accuracy { param = "rate", name = "rate of loading", values = { 0.08, 0.02, 0.005, 0.00125 } }
local from = 0.30
material { name = "stone", density = 2000, kn = kn, ks = 0.4 * kn, friction = 3 }
local function at(angle, radius, y) return { radius * math.sin(angle), y, radius * math.cos(angle) } end
local function voussoir(name, a, b, fixed)
  local points = {}
  for _, y in ipairs { -0.5, 0.5 } do
    for _, angle in ipairs { a, b } do
      points[#points + 1] = at(angle, R - t / 2, y)
      points[#points + 1] = at(angle, R + t / 2, y)
    end
  end
  block { name = name, vertices = points, material = "stone", fixed = fixed }
end
local step = embrace / n
voussoir("left", -embrace / 2 - step, -embrace / 2, true)
voussoir("right", embrace / 2, embrace / 2 + step, true)
for i = 1, n do voussoir("v" .. i, -embrace / 2 + (i - 1) * step, -embrace / 2 + i * step) end
joint { law = dry { kn = kn, ks = 0.4 * kn, mu = 3 }, tolerance = 1e-3 }
local grow = 2  -- s, smooth growth of the load to its first value
local function load(time)
  if time < grow then return from * 0.5 * (1 - math.cos(pi * time / grow)) end
  return from + rate * (time - grow)
end
ground_motion { wave = function(time) return g * load(time) end, direction = "x" }
damping { mass = 1 }
recorder { name = "crown", quantity = "displacement", block = "v4", axis = "x" }
metric("multiplier", "g", function(run)
  local at = run.crossings("crown_ux_rel_m", -0.01 * R, false)[1]
  return at and load(at)
end)
-- It moves R / 100 in about the time sqrt(2 * 0.1 m / (0.03 g)) = 0.8 s, in which the load grows by 0.016 g.
expect("metrics.multiplier", 0.37361, { rel = 0.06, source = "limit analysis" })
analysis { duration = grow + (0.42 - from) / rate, output_dt = 2e-3, frame_dt = 1, energy_gate = 1, stop_when_moved = 0.05 * R }
