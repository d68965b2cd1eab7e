-- V24: energy of an undamped bonded wall of a thousand bricks, excited by noise at the start, over a hundred thousand steps.
--
-- What happens   Every brick starts with a random velocity and spin. Nothing cracks and nothing is damped. Leapfrog conserves a shadow
--                energy (T = v- m v+ / 2 with the elastic energy at the same instant) to round-off, without trend. The energy with the mean
--                of both velocities oscillates about it by dt^2 sum m a^2 / 8, of second order.
-- Source         Hairer, Lubich and Wanner 2003, Acta Numerica 12, section 5 (the modified Hamiltonian of leapfrog).
-- How to run     erbs run scenes/verify/v24_energy_of_a_wall.lua [-D steps=1e6] [-D courses=20] [-D share=0.5]
-- What to look at  drift: change of the energy over the initial energy; energy.residual_relative; converge_order_slope.
label("fixed_dt")
local across, courses = param("across", 25, "bricks along the wall"), param("courses", 40, "")
local steps = param("steps", 1e5, "of the long run")
local share = param("share", 0.9, "dt over the limit")
local order = param("order", 0, "dt over the limit in the short runs of converge{}; 0: the long run")
local seed = param("seed", 1, "of the noise")

local l, w, h, t, density = 0.3, 0.125, 0.1, 10 * mm, 1800
gravity(0)
material { name = "brick", density = density }
local number = (seed * 7919 + 17) % 2147483647
local function draw()  -- Park and Miller 1988
  number = 16807 * number % 2147483647
  return number / 2147483647 - 0.5
end
for _ = 1, 10 do draw() end
local mass = density * l * w * h
local inertia = { mass * (w ^ 2 + h ^ 2) / 12, mass * (l ^ 2 + h ^ 2) / 12, mass * (l ^ 2 + w ^ 2) / 12 }
local start, names = 0, {}
box { name = "foot", size = { (across + 1) * (l + t), w, h }, at = { 0, 0, -h - t }, fixed = true }
for course = 0, courses - 1 do
  for i = 0, across - 1 do
    local v, spin = { 1e-3 * draw(), 1e-3 * draw(), 1e-3 * draw() }, { 1e-2 * draw(), 1e-2 * draw(), 1e-2 * draw() }
    local name = course .. "_" .. i
    box { name = name, group = "wall", size = { l, w, h }, at = { i * (l + t) + course % 2 * (l + t) / 2, 0, course * (h + t) },
      initial = { velocity = v, spin = spin } }
    for k = 1, 3 do start = start + mass * v[k] ^ 2 / 2 + inertia[k] * spin[k] ^ 2 / 2 end
    names[#names + 1] = name
    if order > 0 then
      recorder { name = name, quantity = "velocity", block = name }
      recorder { name = name, quantity = "spin", block = name }
    end
  end
end
joint { law = mortar { E = 1e9, nu = 0.2, thickness = t, ft = 1e9, c = 1e9, mu = 0.6 }, tolerance = 0.1 * mm }
-- The shortest period of these joints sets the limit, about 3.8e-5 s.
local limit = 3.8e-5
local duration = order > 0 and 100 * limit or steps * share * limit
analysis { duration = duration, dt_fraction = order > 0 and order or share, start = "rest", output_dt = duration / 10, frame_dt = duration, energy_gate = 1e-4 }

metric("energy_at_start", "J", start)
metric("drift", "", function(run) return math.abs(run.energy.kinetic_J + run.energy.elastic_J - start) / start end)
metric("steps_done", "", function(run) return run.steps end)
-- Energy with the mean velocities at the last row, relative to the energy at the start.
converge { param = "order", values = { 0.8, 0.4, 0.2, 0.1 }, slope = 1.9, error = function(run)
  local kinetic = 0
  for _, name in ipairs(names) do
    for k, axis in ipairs { "x", "y", "z" } do
      kinetic = kinetic + mass * run.last(name .. "_v" .. axis .. "_rel_m_s") ^ 2 / 2 + inertia[k] * run.last(name .. "_w" .. axis .. "_rad_s") ^ 2 / 2
    end
  end
  return (kinetic + run.energy.elastic_J) / start - 1
end }
-- Round-off, and the rotation of joint frames to second order: no error that grows.
expect("metrics.drift", 1e-4, { below = true, source = "the leapfrog's shadow energy" })
expect("energy.residual_relative", 1e-4, { below = true, source = "the worst of all settlings: bounded, no trend" })
expect("metrics.steps_done", 0.8 * steps, { above = true, source = "a hundred thousand steps" })
