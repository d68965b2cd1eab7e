-- Hard case: an edge passes over a nearly parallel edge
--
-- What happens   Bars stand on their edges. Upper bars move across lower ones, edge over edge, at angles of 0 to 0.1 rad between the edges.
--                A normal from the cross product of nearly parallel edges would spin. Here the normal turns from one flank to the other at
--                the rate at which the edges pass.
-- Source         hard case 5: the direction of the force turns by less than 1 degree per step
-- How to run     erbs run scenes/hard/h05_parallel_edges.lua
-- What to look at  turn_* (largest change of direction in one step, degrees)
-- Tolerance      At a penetration d the edges pass within 2 d, and the direction turns by 90 degrees: 0.09 degrees per step at this speed.
label("quick", "fixed_dt")
local d = param("depth", 0.5 * mm, "of edge below edge [m]")
local dt, down, steps = 1e-5, 500, 4000  -- s, steps to come down beside the edge, and steps to pass over it
gravity(0)
material { name = "stone", density = 2000, kn = 1e9, ks = 0, friction = 0, restitution = 1 }
material { name = "anvil", density = 1e5, kn = 1e9, ks = 0, friction = 0, restitution = 1 }  -- so heavy that it does not move
local r = 0.05
local function bar(length)
  local out = {}
  for _, x in ipairs { -length / 2, length / 2 } do
    for k = 0, 3 do out[#out + 1] = { x, r * math.cos(k * pi / 2), r * math.sin(k * pi / 2) } end
  end
  return out
end
for i, angle in ipairs { 0, 1e-12, 1e-9, 1e-6, 1e-3, 0.1 } do
  local name, at = "angle" .. i, { 0, i, 0 }
  block { name = name .. "_below", material = "anvil", vertices = bar(0.4), at = at, free = true }
  block { name = name, material = "stone", vertices = bar(0.3), at = { 0, i, 2 * r + d }, rotation = { 0, 0, angle }, free = true }
  motion { block = name, wave = function(t) return 4 * d * (2 * math.max(0, t / dt - down) / steps - 1) end, direction = "y" }
  motion { block = name, wave = function(t) return -2 * d * math.min(1, t / dt / down) end, direction = "z" }
  recorder { name = name, quantity = "reaction", block = name .. "_below" }
  metric("turn_" .. name, "deg", function(run)
    local y, z, worst, last = run.history(name .. "_fy_N"), run.history(name .. "_fz_N"), 0, nil
    for k = 2, #y do
      if z[k] ^ 2 + y[k] ^ 2 > 1e-8 then
        local now = math.atan(y[k], -z[k]) / deg
        if last then worst = math.max(worst, math.abs(now - last)) end
        last = now
      end
    end
    return worst
  end)
  expect("metrics.turn_" .. name, 1, { below = true, source = "hard case 5" })
end
-- A wide energy tolerance: the usual one is meant for runs with more energy than the first touch of two edges.
analysis { duration = (down + steps) * dt, dt = dt, start = "rest", output_dt = dt, frame_dt = 1, energy_gate = 0.5 }
