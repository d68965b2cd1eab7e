-- Hard case: walls creep if friction loses its history
--
-- What happens   Loose bricks lie on a slope at 0.9 of the angle of friction: alone, crossed in a stack, and flush side by side. Only
--                contact holds them, and their pairs are searched again and again. No brick may creep.
-- Source         Coulomb: nothing slides below atan(mu)
-- How to run     erbs run scenes/hard/h07_creep_of_contacts.lua [-D duration=60]
-- What to look at  drift (in the second half, over the smallest edge)
local duration = param("duration", 10, "[s]")
local kn = param("kn", 2e9, "[Pa/m]")
local mu = param("mu", 0.6, "")
local noise = param("noise", 1e-8, "turn of each brick at the start [rad]")
local slope = 0.9 * math.atan(mu)
gravity { g * math.sin(slope), 0, -g * math.cos(slope) }
material { name = "stone", density = 1800, kn = kn, ks = 0.4 * kn, friction = mu, restitution = 0.2 }
ground { size = 20, material = "stone" }
local names, long, wide, high = {}, 0.3, 0.125, 0.1
local function brick(x, y, layer, turned)
  local name = "b" .. #names + 1
  local sign = #names % 2 == 0 and 1 or -1
  box { name = name, size = turned and { wide, long, high } or { long, wide, high }, center = { x, y, (layer + 0.5) * high }, free = true,
    initial = { rotation = { noise * sign, noise, -noise * sign } } }
  names[#names + 1] = name
  recorder { name = name, quantity = "displacement", block = name }
end
brick(0, 0, 0)
for layer = 0, 1 do brick(1, 0, layer, layer % 2 == 1) end  -- a third brick would open the second's bed: the weight would leave the core
for i = 0, 3 do brick(2 + long * i, 0, 0) end
for i = 0, 2 do brick(4, wide * i, 0) end
metric("drift", "", function(run)
  local worst = 0
  for _, name in ipairs(names) do
    for _, axis in ipairs { "x", "y", "z" } do
      local column = name .. "_u" .. axis .. "_rel_m"
      worst = math.max(worst, math.abs(run.last(column) - run.at(column, duration / 2)))
    end
  end
  return worst / high
end)
analysis { duration = duration, start = "rest", output_dt = duration / 100, frame_dt = duration }
expect("metrics.drift", 1e-6, { below = true, source = "hard case 7: 1e-6 of the smallest edge" })
expect("energy.residual_relative", 1e-2, { below = true, source = "gate" })
