-- Hard case: pulse amplitude that overturns a block, with all settings at their defaults
--
-- What happens   A block of 0.3 x 1 x 1 m stands on the ground on a dry joint of 5 GPa/m; half a sine of 1 Hz shakes it. Bisection finds
--                the amplitude that overturns it. The scene sets neither step nor tolerance nor damping, and every run must give an answer.
-- Source         Housner's equation with the toe of a bed without tension. The weight W spreads over a = sqrt(2 W / (kn w theta)) of the
--                base (w: its width across) and acts a / 3 from the edge. The toe costs 6 % of rigid_amplitude here, 1 % at 5e11 Pa/m.
-- How to run     erbs run scenes/hard/h28_overturning_by_default.lua [-D kn=5e11]
-- What to look at  amplitude over theory; amplitude_failed: number of runs without an answer
local B, H, kn, amp = 0.3, 1, param("kn", 5 * GPa), param("amp", 0.5, "[g]")
local rho, frequency = 2400, 1 * Hz
material { name = "stone", density = rho }
ground {}
joint { law = dry { kn = kn, mu = 0.6 } }
box { name = "block", size = { B, 1, H }, material = "stone" }
ground_motion { wave = half_sine { amplitude = amp * g, frequency = frequency }, direction = "x" }

local R, alpha = math.sqrt(B ^ 2 + H ^ 2) / 2, math.atan(B / H)
local whole = 2 * rho * H * g / (kn * B)  -- rad, rotation below which the whole base is in compression
local function falls(a)
  local theta, rate, t, dt = 0, 0, 0, 2e-4
  while t < 4 do
    local shake = t < 0.5 / frequency and a * math.sin(2 * math.pi * frequency * t) or 0
    local arm = theta < whole and B / 6 * theta / whole or R * math.sin(alpha - theta) - B / 3 * math.sqrt(whole / theta)
    rate = rate + dt * 3 * g / (4 * R * R) * (shake * R * math.cos(alpha - theta) - arm)
    theta, t = theta + dt * rate, t + dt
    if theta > 1.5 * alpha then return true end
    if t > 0.5 / frequency and theta <= 0 then return false end
  end
  return false
end
local lo, hi = 0.2, 1
while hi - lo > 1e-4 do
  local middle = (lo + hi) / 2
  if falls(middle) then hi = middle else lo = middle end
end
metric("theory", "g", hi)
metric("rigid_amplitude", "g", rocking_overturning { width = B, height = H, from = 0.2, to = 4, points = 200,
  wave = half_sine { amplitude = g, frequency = frequency } }.lowest)
bisect { param = "amp", lo = 0.1, hi = 1.5, rel = 0.02, name = "amplitude" }
analysis { duration = 3, stop_after_collapse = 0 }
expect("metrics.amplitude", hi, { rel = 0.015, source = "Housner's equation with a toe; half the last bracket is 0.6 %" })
expect("status", "completed")
