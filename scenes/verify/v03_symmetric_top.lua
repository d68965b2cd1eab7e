-- V03: torque-free spin of symmetric blocks, slender and flat.
--
-- What happens   The spin of a symmetric body precesses about the body's own axis at (I3 - I1) w3 / I1 (body axes). The axis precesses
--                about the angular momentum at L / I1 (world axes).
-- Source         Euler's equations, e.g. Goldstein, Classical Mechanics, section 5.6.
-- How to run     erbs run scenes/verify/v03_symmetric_top.lua [-D dt=...] [-D slender=5] [-D spin=20]
-- What to look at  body_rate_error_* and axis_rate_error_* over `turns` turns.
label("quick")
local spin = param("spin", 10, "about the body's axis [rad/s]")
local across = param("across", 3, "across the axis [rad/s]")
local slender = param("slender", 3, "length over width of the slender block; the flat one has its inverse")
local width = param("width", 0.1, "width [m]")
local turns = param("turns", 10, "turns of the slow block's body precession")
local dt = param("dt", 1e-4, "time step: the phase errs by (w dt)^2 / 12 [s]")

gravity(0)
material { name = "stone", density = 2500 }
local tops = { slender = { length = width * slender, at = 0 }, flat = { length = width / slender, at = 2 } }
local slowest = math.huge
for name, top in pairs(tops) do
  local mass = 2500 * width ^ 2 * top.length
  top.i3, top.i1 = mass * width ^ 2 / 6, mass * (width ^ 2 + top.length ^ 2) / 12
  top.rate = (top.i3 - top.i1) / top.i1 * spin
  top.axis_rate = math.sqrt((top.i3 * spin) ^ 2 + (top.i1 * across) ^ 2) / top.i1
  top.cone = math.atan(top.i1 * across, top.i3 * spin)  -- half angle between axis and L
  slowest = math.min(slowest, math.abs(top.rate))
  box { name = name, size = { width, width, top.length }, center = { top.at, 0, 0 }, free = true, initial = { spin = { across, 0, spin } } }
  recorder { name = name, quantity = "spin", block = name }
  recorder { name = name, quantity = "rotation", block = name }
end
-- Rows close enough that no phase advances by more than a right angle between them.
local fastest = math.max(tops.slender.axis_rate, tops.flat.axis_rate, spin)
local duration = turns * 2 * pi / slowest
analysis { duration = duration, dt = dt, start = "rest", output_dt = math.max(dt, 0.2 / fastest) }

-- Rotation of v by the rotation vector r (Rodrigues).
local function turn(r, v)
  local angle = math.sqrt(r[1] ^ 2 + r[2] ^ 2 + r[3] ^ 2)
  if angle == 0 then return v end
  local k = { r[1] / angle, r[2] / angle, r[3] / angle }
  local c, si = math.cos(angle), math.sin(angle)
  local dot = (k[1] * v[1] + k[2] * v[2] + k[3] * v[3]) * (1 - c)
  local cross = { k[2] * v[3] - k[3] * v[2], k[3] * v[1] - k[1] * v[3], k[1] * v[2] - k[2] * v[1] }
  return { v[1] * c + cross[1] * si + k[1] * dot, v[2] * c + cross[2] * si + k[2] * dot, v[3] * c + cross[3] * si + k[3] * dot }
end
local function rows(run, name)
  local spin_of, turn_of = {}, {}
  for k, axis in ipairs { "x", "y", "z" } do
    spin_of[k] = run.history(name .. "_w" .. axis .. "_rad_s")
    turn_of[k] = run.history(name .. "_r" .. axis .. "_rad")
  end
  return function(i) return { spin_of[1][i], spin_of[2][i], spin_of[3][i] }, { turn_of[1][i], turn_of[2][i], turn_of[3][i] } end
end
-- Mean rate of an angle given modulo 2 pi, unwrapped from row to row with the expected rate as a guide.
local function mean_rate(run, angle, guess)
  local first, last, total = angle(1), angle(1), 0
  for i = 2, #run.time do
    local step = angle(i) - last
    local likely = guess * (run.time[i] - run.time[i - 1])
    step = step - 2 * pi * math.floor((step - likely) / (2 * pi) + 0.5)
    total, last = total + step, angle(i)
  end
  return total / (run.time[#run.time] - run.time[1])
end
for name, top in pairs(tops) do
  metric("body_rate_error_" .. name, "", function(run)
    local row = rows(run, name)
    return mean_rate(run, function(i)
      local w, r = row(i)
      local body = turn({ -r[1], -r[2], -r[3] }, w)
      return math.atan(body[2], body[1])
    end, top.rate) / top.rate - 1
  end)
  metric("axis_rate_error_" .. name, "", function(run)  -- L lies in the x-z plane: x axis of the cone = y cross L
    local row, ex, ez = rows(run, name), math.cos(top.cone), math.sin(top.cone)
    local sign = 1
    return mean_rate(run, function(i)
      local _, r = row(i)
      local axis = turn(r, { 0, 0, 1 })
      return math.atan(axis[2], axis[1] * ex - axis[3] * ez) * sign
    end, top.axis_rate) / top.axis_rate - 1
  end)
  -- (w dt)^2 / 12 of the implicit midpoint rule, 1.5e-7 at w dt = 1.5e-3, and the round-off of the rows.
  expect("metrics.body_rate_error_" .. name, 0, { abs = 1e-6, source = "(I3 - I1) w3 / I1" })
  expect("metrics.axis_rate_error_" .. name, 0, { abs = 1e-6, source = "L / I1" })
end
converge { param = "dt", values = { 16e-4, 8e-4, 4e-4 }, slope = 1.95, name = "order", error = function(run)
  local row = rows(run, "slender")
  return mean_rate(run, function(i)
    local w, r = row(i)
    local body = turn({ -r[1], -r[2], -r[3] }, w)
    return math.atan(body[2], body[1])
  end, tops.slender.rate) / tops.slender.rate - 1
end }
expect("energy.residual_relative", 1e-10, { below = true, source = "the implicit midpoint keeps the energy; round-off of the steps" })
