-- V22: two blocks meet head on, face to face, in free space
--
-- What happens   Pairs of blocks fly into each other along their common axis, each pair with its own restitution, mass ratio and shape.
--                They separate with the speed of Hunt and Crossley's law, turn back after a quarter of a period of the contact spring, and
--                conserve momentum.
-- Source         Contact spring k = kn A on the reduced mass m: without loss they are in contact for pi / omega, omega = sqrt(k / m). With
--                p = kn depth (1 + chi v), v the closing speed (Hunt and Crossley 1975, J. Appl. Mech. 42, eq. 10), the restitution e
--                follows from X - ln(1 + X) = -e X - ln(1 - e X), X = chi v0, for any kn and m. chi is chosen so that e is the given one.
-- How to run     erbs run scenes/verify/v22_central_collision.lua [-D speed=...] [-D kn=...] [-D fraction=0.9]
-- What to look at  restitution_* (against the given one), duration_* (of contact over pi / omega), momentum_error.
label("quick", "fixed_dt")  -- at coarser steps the dashpot of a strongly damped impact is capped for stability: see v22_restitution_at_the_step
local speed = param("speed", 1, "of each towards the other [m/s]")
local kn = param("kn", 1e10, "[Pa/m]")
local fraction = param("fraction", 0.1, "of the step's bound")
local gap = param("gap", 1 * mm, "between the faces at the start [m]")
gravity(0)
local slowest = 0
local function pair(name, e, size_a, size_b, density_b)
  local place = 10 * #name * (string.byte(name) - 96)
  material { name = name .. "_a", density = 2000, kn = kn, ks = 0.4 * kn, restitution = e, friction = 0 }
  material { name = name .. "_b", density = density_b, kn = kn, ks = 0.4 * kn, restitution = e, friction = 0 }
  local function half(which, size, sign)
    box { name = name .. which, size = size, center = { sign * (size[1] + gap) / 2, place, 0 }, material = name .. "_" .. which, free = true,
      initial = { velocity = { -sign * speed, 0, 0 } } }
    recorder { name = name .. which, quantity = "velocity", block = name .. which, axis = "x" }
  end
  half("a", size_a, -1)
  half("b", size_b, 1)
  local m_a, m_b = 2000 * size_a[1] * size_a[2] * size_a[3], density_b * size_b[1] * size_b[2] * size_b[3]
  local reduced, area = m_a * m_b / (m_a + m_b), math.min(size_a[2], size_b[2]) * math.min(size_a[3], size_b[3])
  local omega = math.sqrt(kn * area / reduced)
  -- A rim as wide as the depth of the contact lies nearer to the sides than to the face and carries less.
  local rim = 2 * speed / omega / math.sqrt(area)
  slowest = math.max(slowest, pi / omega)
  local a, b = name .. "a_vx_rel_m_s", name .. "b_vx_rel_m_s"
  metric("restitution_" .. name, "", function(run) return (run.last(b) - run.last(a)) / (2 * speed) end)
  metric("momentum_error_" .. name, "", function(run)
    return math.abs(m_a * (run.last(a) - speed) + m_b * (run.last(b) + speed)) / ((m_a + m_b) * speed)
  end)
  expect("metrics.restitution_" .. name, e, { abs = 0.005 + rim * e, source = "restitution asked for; steps of the run, and the rim" })
  expect("metrics.momentum_error_" .. name, 1e-13, { below = true, source = "action and reaction" })
  if e < 1 then return end
  metric("duration_" .. name, "", function(run)  -- twice the time from touch to the change of sign of the relative velocity
    local va, vb, t = run.history(a), run.history(b), run.time
    for i = 2, #t do
      local u, v = vb[i - 1] - va[i - 1], vb[i] - va[i]
      if u < 0 and v >= 0 then return 2 * (t[i - 1] + (t[i] - t[i - 1]) * u / (u - v) - gap / (2 * speed)) / (pi / omega) end
    end
  end)
  expect("metrics.duration_" .. name, 1, { abs = 0.01 + rim, source = "pi / omega; the first touch falls inside a step" })
end
local cube, brick, slab = { 0.1, 0.1, 0.1 }, { 0.3, 0.125, 0.1 }, { 0.05, 0.6, 0.4 }
pair("a", 1, cube, cube, 2000)
pair("b", 1, brick, slab, 2400)
pair("c", 0.9, cube, cube, 2000)
pair("d", 0.5, cube, cube, 2000)
pair("e", 0.2, brick, brick, 1800)
pair("f", 0.5, cube, cube, 200)
pair("g", 0.5, cube, slab, 8000)
pair("h", 0.05, cube, brick, 1000)
local duration = gap / (2 * speed) + 3 * slowest
analysis { duration = duration, dt_fraction = fraction, start = "rest", output_dt = duration / 400, frame_dt = duration }
expect("energy.residual_relative", 1e-2, { below = true, source = "gate; the first touch falls inside a step" })
