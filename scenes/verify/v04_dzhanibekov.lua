-- V04: a brick that spins about its middle axis flips again and again.
--
-- What happens   Spin about the middle axis is unstable: its sign flips every half period 2 K(k) / lambda. Without the gyroscopic term (the
--                scalar Euler equation of Gu and Miao, eq. (1)) it never flips: v04_without_gyroscopic.lua.
-- Source         Jacobi's solution of Euler's equations, Landau and Lifshitz, Mechanics, section 37; K and F from Carlson's R_F (Carlson
--                1979, Numer. Math. 33, 1).
-- How to run     erbs run scenes/verify/v04_dzhanibekov.lua [-D flips=200] [-D spin=5] [-D dt=...]
-- What to look at  first_flip_s and half_period_s beside the formula, number of flips, energy residual.
label("quick")
local length, width, height = param("length", 0.30, "[m]"), param("width", 0.125, "[m]"), param("height", 0.10, "[m]")
local density = param("density", 1900, "[kg/m3]")
local spin = param("spin", 10, "about the middle axis [rad/s]")
local nudge = param("nudge", 0.05, "about the other two [rad/s]")
local flips = param("flips", 50, "how many are watched")
local dt = param("dt", 5e-4, "time step [s]")

gravity(0)
material { name = "brick", density = density }
box { name = "brick", size = { length, width, height }, center = { 0, 0, 0 }, free = true, initial = { spin = { nudge, spin, nudge } } }

local function rf(x, y, z)  -- Carlson's R_F by duplication
  for _ = 1, 40 do
    local lambda = math.sqrt(x * y) + math.sqrt(y * z) + math.sqrt(z * x)
    x, y, z = (x + lambda) / 4, (y + lambda) / 4, (z + lambda) / 4
  end
  return 1 / math.sqrt((x + y + z) / 3)
end
-- Axes 1 (long, smallest inertia), 2, 3. w1 = dn or cn, w2 = sn, w3 = cn or dn, depending on the side of the separatrix.
local mass = density * length * width * height
if not (length > width and width > height) then error("a brick tumbles about its middle axis only where length > width > height", 0) end
local i1, i2, i3 = mass * (width ^ 2 + height ^ 2) / 12, mass * (length ^ 2 + height ^ 2) / 12, mass * (length ^ 2 + width ^ 2) / 12
local e2, l2 = i1 * nudge ^ 2 + i2 * spin ^ 2 + i3 * nudge ^ 2, (i1 * nudge) ^ 2 + (i2 * spin) ^ 2 + (i3 * nudge) ^ 2
local a, c = i1, i3  -- L^2 > 2 E I2: axes as written; otherwise axes 1 and 3 change places
if l2 < e2 * i2 then a, c = i3, i1 end
local lambda = math.sqrt(math.abs((c - i2) * (l2 - e2 * a) / (a * i2 * c)))
local k2 = (i2 - a) * (e2 * c - l2) / ((c - i2) * (l2 - e2 * a))
local amplitude = math.sqrt((e2 * c - l2) / (i2 * (c - i2)))
local half_period = 2 * rf(0, 1 - k2, 1) / lambda
local s = spin / amplitude  -- sn at the start
local before = s * rf(1 - s ^ 2, 1 - k2 * s ^ 2, 1) / lambda  -- time since sn passed zero upwards
-- The signs of the nudges tell whether sn rises or falls at the start: w2' = (I3 - I1) / I2 w3 w1 > 0 with both positive.
local first_flip = half_period - before

analysis { duration = first_flip + (flips - 0.5) * half_period, dt = dt, start = "rest", output_dt = half_period / 400, energy_gate = 1e-6 }
recorder { name = "brick", quantity = "spin", block = "brick" }
recorder { name = "brick", quantity = "rotation", block = "brick" }

-- A second brick, spun about the same axis in the other direction and thrown, gives the sum of L about the origin (world axes) all its
-- parts.
box { name = "other", size = { width, length, height }, center = { 3, -2, 1 }, free = true,
  initial = { spin = { spin / 2, -nudge, 3 * nudge }, velocity = { 3e-3, 2e-3, -1e-3 } } }
recorder { name = "spin", quantity = "angular_momentum", block = "brick" }
recorder { name = "all", quantity = "angular_momentum" }
recorder { name = "all", quantity = "momentum" }
local function drift(stem, unit)  -- largest change of a vector over its initial length
  return function(run)
    local columns, square, worst = {}, 0, 0
    for k, axis in ipairs { "x", "y", "z" } do
      columns[k] = run.history(stem .. axis .. unit)
      square = square + columns[k][1] ^ 2
    end
    for i = 1, #run.time do
      local change = 0
      for k = 1, 3 do change = change + (columns[k][i] - columns[k][1]) ^ 2 end
      worst = math.max(worst, change)
    end
    return math.sqrt(worst / square)
  end
end
metric("spin_momentum_drift", "", drift("spin_L", "_kg_m2_s"))
metric("angular_momentum_drift", "", drift("all_L", "_kg_m2_s"))
metric("momentum_drift", "", drift("all_p", "_kg_m_s"))

-- Times at which the spin about the body's own middle axis changes sign.
local function flip_times(run)
  local w, r, times, last, last_time = {}, {}, {}, nil, 0
  for k, axis in ipairs { "x", "y", "z" } do
    w[k], r[k] = run.history("brick_w" .. axis .. "_rad_s"), run.history("brick_r" .. axis .. "_rad")
  end
  for i, time in ipairs(run.time) do
    local v, q = { w[1][i], w[2][i], w[3][i] }, { r[1][i], r[2][i], r[3][i] }
    local angle = math.sqrt(q[1] ^ 2 + q[2] ^ 2 + q[3] ^ 2)
    local middle = v[2]
    if angle > 0 then  -- second component of R^T w
      local n = { q[1] / angle, q[2] / angle, q[3] / angle }
      local dot = (n[1] * v[1] + n[2] * v[2] + n[3] * v[3]) * (1 - math.cos(angle))
      middle = v[2] * math.cos(angle) - (n[3] * v[1] - n[1] * v[3]) * math.sin(angle) + n[2] * dot
    end
    if last and last * middle < 0 then times[#times + 1] = last_time + (time - last_time) * last / (last - middle) end
    last, last_time = middle, time
  end
  return times
end
metric("flips", "", function(run) return #flip_times(run) end)
metric("first_flip_s", "s", function(run) return flip_times(run)[1] end)
metric("half_period_s", "s", function(run)
  local times = flip_times(run)
  return (times[#times] - times[1]) / (#times - 1)
end)
metric("expected_first_flip_s", "s", first_flip)
metric("expected_half_period_s", "s", half_period)

converge { param = "dt", values = { 0.064 / spin, 0.032 / spin, 0.016 / spin }, slope = 1.9, name = "order", error = function(run) return flip_times(run)[1] / first_flip - 1 end }
expect("metrics.flips", flips, { abs = 0, source = "2 K(k) / lambda" })
-- The implicit midpoint rule rotates too slowly by the share (w dt)^2 / 12 (2e-6 at w dt = 5e-3). Near the separatrix this costs about
-- ln(16 / k'^2) / 2 = 6 times as much. The linear reading of the crossing between rows adds (half_period / 400)^2 of curvature.
expect("metrics.first_flip_s", first_flip, { rel = 1e-4, source = "(2 K - F(phi0, k)) / lambda" })
expect("metrics.half_period_s", half_period, { rel = 1e-4, source = "2 K(k) / lambda" })
-- The implicit midpoint rule keeps energy and |L| to round-off: the error is bounded, not secular.
expect("energy.residual_relative", 1e-10, { below = true, source = "quadratic invariants are kept exactly" })
-- The state carries L itself in world axes: without a moment L stays untouched, and positions drift along the velocity.
expect("metrics.spin_momentum_drift", 1e-12, { below = true, source = "no moment acts" })
expect("metrics.angular_momentum_drift", 1e-12, { below = true, source = "round-off of x cross p" })
expect("metrics.momentum_drift", 1e-12, { below = true, source = "no force acts" })
