-- Hard case: blocks of many sizes fall flat on a slope and rebound with the given restitution
--
-- What happens   Blocks without joints, parallel to a smooth slope, fall on it from a small height, at the default time step. Normal to the
--                slope they rebound with 0.3 of their speed; along it they keep all of it.
-- Source         Newton's restitution; v22_restitution_at_the_step has level ground.
-- How to run     erbs run scenes/hard/m07_slope_restitution.lua [-D slope=40*deg] [-D kn=...] [-D restitution=0.5] [-D drop=1]
-- What to look at  normal_I: speed after over speed before the impact, of the block of size I; along_I.
label("quick")
local slope, drop = param("slope", 25 * deg, "[rad]"), param("drop", 0.1, "way of the fall across the slope [m]")
local kn, restitution = param("kn", 5e10, "[Pa/m]"), param("restitution", 0.3, "")
family({ slope = { 5 * deg, 45 * deg }, drop = { 0.01, 1 }, kn = { 1e9, 1e10, 1e12 }, restitution = { 0.1, 0.5, 0.8 } }, { combinations = 6 })
local sizes = { { 0.1, 0.1, 0.05 }, { 0.3, 0.15, 0.08 }, { 0.6, 0.3, 0.3 }, { 0.4, 0.2, 0.02 }, { 0.2, 0.2, 0.6 } }
material { name = "stone", density = 2000, kn = kn, ks = 0.4 * kn, friction = 0, restitution = restitution }
-- Gravity is rotated instead of the slope, so that z is the normal of the slope.
gravity { g * math.sin(slope), 0, -g * math.cos(slope) }
local fall = g * math.cos(slope)
local hit = math.sqrt(2 * drop / fall)
local after = 1.15 * hit
for i, size in ipairs(sizes) do
  box { name = "base" .. i, size = { 8 * size[1] + 4 * drop, 2 * size[2], 0.2 }, center = { 2 * drop, 2 * i, -0.1 }, fixed = true, material = "stone" }
  box { name = "block" .. i, size = size, center = { 0, 2 * i, drop + size[3] / 2 }, material = "stone", free = true }
  recorder { name = "block" .. i, quantity = "velocity", block = "block" .. i }
  metric("normal_" .. i, "", function(run) return (run.at("block" .. i .. "_vz_rel_m_s", after) + fall * (after - hit)) / (fall * hit) end)
  metric("along_" .. i, "", function(run) return run.at("block" .. i .. "_vx_rel_m_s", after) / (g * math.sin(slope) * after) end)
  -- the weight acts during the impact
  local weight = fall / (fall * hit * math.sqrt(kn / (2000 * size[3])))
  expect("metrics.normal_" .. i, restitution, { abs = 0.03 * restitution + 5 * weight, source = "Newton's restitution" })
  expect("metrics.along_" .. i, 1, { rel = 1e-6, source = "a smooth slope" })
end
analysis { duration = 1.2 * hit, start = "rest", output_dt = hit / 500, frame_dt = 1 }
expect("energy.residual_relative", 1e-2, { below = true, source = "gate" })
