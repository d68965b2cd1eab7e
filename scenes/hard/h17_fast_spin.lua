-- Hard case 17: bricks and a wedge with skew principal axes tumble at 50 rad/s for a minute.
--
-- What happens   An explicit w x I w pumps energy into fast tumbling. Here the rotation uses the implicit midpoint rule in the body frame
--                with exact transport of L. Energy and angular momentum hold to round-off at any step, even where no face is square to a
--                principal axis.
-- Source         Simo and Wong 1991, Int. J. Numer. Meth. Eng. 31, 19.
-- How to run     erbs run scenes/hard/h17_fast_spin.lua [-D spin=200] [-D dt=1e-3] [-D duration=600]
-- What to look at  energy.residual_relative, momentum_drift: largest change of L over its length.
label("quick", "fixed_dt")
local spin, dt = param("spin", 50, "[rad/s]"), param("dt", 2e-4, "a hundredth of a turn per radian: w dt = .01 [s]")
local duration = param("duration", 60, "[s]")
gravity(0)
material { name = "stone", density = 2200 }
local shapes = {
  brick = function(o) o.size = { 0.3, 0.125, 0.1 } return box(o) end,
  plate = function(o) o.size = { 0.4, 0.4, 0.03 } return box(o) end,
}
local axes = { { 1, 0.02, 0.01 }, { 0.02, 1, 0.03 }, { 0.3, -0.5, 0.8 } }
local names, number = {}, 0
local function body(kind, axis)
  number = number + 1
  local name = kind .. number
  local length = math.sqrt(axis[1] ^ 2 + axis[2] ^ 2 + axis[3] ^ 2)
  local initial = { spin = { spin * axis[1] / length, spin * axis[2] / length, spin * axis[3] / length } }
  if kind == "wedge" then  -- a skew wedge: products of inertia in every plane
    prism { name = name, polygon = { { 0, 0 }, { 0.3, 0.02 }, { 0.05, 0.15 } }, height = 0.1, at = { 2 * number, 0, 0 }, free = true, initial = initial,
      rotation = { 0.3, 0.2, 0.1 } }
  else
    shapes[kind] { name = name, center = { 2 * number, 0, 0 }, free = true, initial = initial }
  end
  recorder { name = name, quantity = "angular_momentum", block = name }
  names[#names + 1] = name
end
for _, axis in ipairs(axes) do
  body("brick", axis)
  body("plate", axis)
  body("wedge", axis)
end
analysis { duration = duration, dt = dt, start = "rest", output_dt = duration / 600, frame_dt = duration / 60, energy_gate = 1e-6 }
metric("momentum_drift", "", function(run)
  local worst = 0
  for _, name in ipairs(names) do
    local L, square = {}, 0
    for k, axis in ipairs { "x", "y", "z" } do
      L[k] = run.history(name .. "_L" .. axis .. "_kg_m2_s")
      square = square + L[k][1] ^ 2
    end
    for i = 1, #run.time do
      local change = 0
      for k = 1, 3 do change = change + (L[k][i] - L[k][1]) ^ 2 end
      worst = math.max(worst, math.sqrt(change / square))
    end
  end
  return worst
end)
-- The state carries L itself, and energy is a quadratic invariant of the midpoint rule: only round-off of 3e5 steps remains.
expect("metrics.momentum_drift", 1e-10, { below = true, source = "no moment acts" })
expect("energy.residual_relative", 1e-9, { below = true, source = "no power acts" })
