-- V22 beside others: a blow of little energy rebounds as asked
--
-- What happens   A small cube falls on a block of 2 m that rests on the ground, another on the ground itself. Two bricks meet head on while
--                they fly together. A heavy block flies past, so that each blow is a small share of all energy.
-- Source         As v22_central_collision: the restitution that was given, whatever else moves (Galilean invariance).
-- How to run     erbs run scenes/verify/v22_restitution_beside_others.lua [-D common=20] [-D side=0.05] [-D restitution=0.2]
-- What to look at  on_block, on_ground, in_flight: restitutions
local kn = param("kn", 1e10, "[Pa/m]")
local common = param("common", 20, "speed of the bricks that fly together, and of the heavy block [m/s]")
local height = param("height", 0.3, "of the falls [m]")
local side = param("side", 0.05, "of the cubes [m]")
local e = param("restitution", 0.05, "")
family({ kn = { 1e9, 1e11, 1e12 }, common = { 0, 5 }, height = { 0.05, 2 }, side = { 0.1, 0.3 }, restitution = { 0.2, 0.5, 0.9 } }, { combinations = 12 })
material { name = "m", density = 2000, kn = kn, ks = 0.4 * kn, restitution = e, friction = 0 }
ground { size = 300, material = "m" }
local hit = math.sqrt(2 * height / g)
box { name = "block", size = { 2, 2, 2 }, at = { 0, 0, 0 }, free = true }
box { name = "flies", size = { 2, 2, 2 }, at = { 5, 0, 40 }, free = true, initial = { velocity = { common, 0, 0 } } }
local function rebound(name, speed)
  metric(name, "", function(run)
    local v = run.history(speed)
    local least, most, fell = 0, 0, false
    for _, now in ipairs(v) do
      least = math.min(least, now)
      fell = fell or least < -0.5 * g * hit
      if fell then most = math.max(most, now) end
    end
    return most / -least
  end)
  expect("metrics." .. name, e, { abs = 0.03, source = "as asked for; the weight acts during a soft blow" })
end
for name, at in pairs { on_block = { 1, 1, 2 + height }, on_ground = { -6, 0, height } } do
  box { name = name, size = { side, side, side }, at = at, free = true }
  recorder { name = name, quantity = "velocity", block = name, axis = "z" }
  rebound(name, name .. "_vz_rel_m_s")
end
for i, sign in ipairs { 1, -1 } do
  box { name = "brick" .. i, size = { 0.3, 0.2, 0.1 }, center = { 0, 9 + sign * (0.1 + 0.15 * hit), 40 }, free = true, initial = { velocity = { common, -0.25 * sign, 0 } } }
  recorder { name = "brick" .. i, quantity = "velocity", block = "brick" .. i, axis = "y" }
end
metric("in_flight", "", function(run) return 2 * (run.last "brick1_vy_rel_m_s" - run.last "brick2_vy_rel_m_s") end)
expect("metrics.in_flight", e, { abs = 0.01, source = "as asked for" })
analysis { duration = 1.2 * hit + 5e-3, output_dt = hit / 2000, frame_dt = 1 }
expect("energy.residual_relative", 1e-3, { below = true, source = "the blows' own errors" })
