-- V62: a wall of undamped mortar slides down a slope as a block does
--
-- What happens   A wall of strong mortar stands on a bed without bond, steeper than its friction angle. It slides off, and waves run through
--                it, since nothing damps them: the pressure of the bed trembles by more than its own size. Its mean acceleration is that
--                of a rigid block. On a slope below the friction angle it stands, although it trembles as well. Friction is less than mu
--                only where bricks swing faster than the wall slides (mortar_kn = 1e10: .54 instead of .6), since it then turns with them.
-- Source         Coulomb: acceleration g (sin(slope) - mu cos(slope)), from which the coefficient of friction follows
-- How to run     erbs run scenes/verify/v62_wall_on_a_slope.lua [-D slope=33 -D kn=1e11 -D rows=8]
-- What to look at  metrics.friction_over_mu between half of the run and its end, or metrics.drift (m) where it stands
local cols = param("cols", 20, "bricks in a course")
local rows = param("rows", 4, "courses")
local kn = param("kn", 1e12, "[Pa/m] of the lowest bed")
local mortar_kn = param("mortar_kn", 1e12, "[Pa/m] of the others")
local mu = param("mu", 0.6)
local slope = param("slope", 40, "[degrees]")
local damping = param("damping", 0, "of critical, of the cracked bed")
local angle = param("angle", 0, "[degrees] of the slope from the wall")
family({ cols = { 5, 60 }, rows = { 1, 2, 8 }, kn = { 1e9, 1e10, 1e11 }, mortar_kn = { 1e11, 1e13 }, mu = { 0.3, 0.5 }, slope = { 20, 29, 36, 50 },
  damping = { 0.02, 0.3 }, angle = { 180 } }, { combinations = 12 })
local steep = slope * deg
local across, size, duration = g * math.sin(steep), { 0.3, 0.2, 0.1 }, 0.3
gravity { -across * math.cos(angle * deg), -across * math.sin(angle * deg), -g * math.cos(steep) }
material { name = "brick", density = 1800, friction = mu, restitution = 0.2, kn = 5e10, ks = 2e10 }
box { name = "base", group = "base", material = "brick", size = { 2 * cols * size[1] + 2, 1, 0.2 }, center = { 0, 0, -0.1 }, fixed = true }
for i = 1, cols do
  for k = 0, rows - 1 do
    box { group = "wall", material = "brick", size = size, center = { (i - (cols + 1) / 2) * size[1], 0, (k + 0.5) * size[3] } }
  end
end
joint { law = mortar { kn = mortar_kn, ks = 0.4 * mortar_kn, mu = mu, ft = 20 * MPa, c = 30 * MPa } }
joint { between = { "base", "wall" }, law = mortar { kn = kn, ks = 0.4 * kn, mu = mu, ft = 0, c = 0, damping = damping } }
recorder { name = "wall", quantity = "displacement", group = "wall" }
recorder { name = "speed", quantity = "velocity", group = "wall" }
analysis { duration = duration, start = "rest" }

local function down(run, name, unit, t)
  return -(run.at(name .. "x" .. unit, t) * math.cos(angle * deg) + run.at(name .. "y" .. unit, t) * math.sin(angle * deg))
end
local function speed(run, t) return down(run, "speed_v", "_rel_m_s", t) end
if math.tan(steep) > mu then
  metric("friction_over_mu", "", function(run)
    local acceleration = (speed(run, duration) - speed(run, duration / 2)) / (duration / 2)
    return (math.tan(steep) - acceleration / (g * math.cos(steep))) / mu
  end)
  expect("metrics.friction_over_mu", 1, { abs = 0.05, source = "Coulomb" })
else
  metric("drift", "m", function(run) return down(run, "wall_u", "_rel_m", duration) - down(run, "wall_u", "_rel_m", duration / 2) end)
  expect("metrics.drift", 0, { abs = 1e-5, source = "Coulomb: it stands, and the springs of its beds swing" })
end
expect("energy.residual_relative", 1e-3, { below = true, source = "gate" })
