-- One block under one half-sine pulse of the ground, for the study overturning_map.lua
--
-- What happens   A block on two narrow feet stands on ground that moves by one lobe of a sine. It falls, or rocks back to rest.
-- Source         Housner 1963; Zhang and Makris 2001. Feet and stiffness as in scenes/verify/parts/rocking_block.lua, which says why.
-- How to run     erbs run scenes/studies/overturning_block.lua -D omega=2 -D amplitude=2
-- What to look at  metrics.overturned (1: it fell), metrics.theory: least amplitude by the exact equation of the rocking block
local width, height = param("width", 0.4, "[m]"), param("height", 1.2, "[m]")
local omega = param("omega", 2, "circular frequency of the pulse over p [-]")
local settlement = param("settlement", 1e-5, "of the full base under the weight, over half the width [-]")
local amplitude = param("amplitude", 2, "of the pulse over g tan(alpha) [-]")

local b, density = width / 2, 2500
local kn = density * g * height / (settlement * b)
material { name = "stone", density = density, kn = kn, ks = 0.4 * kn, friction = 2, restitution = 0.24 }
box { name = "base", material = "stone", fixed = true, size = { 6 * height, 1.5 * width, height / 2 }, at = { -3 * height, -0.75 * width, -height / 2 } }
footed_block { name = "block", material = "stone", free = true, size = { width, width, height } }

local alpha = math.atan(width / height)
local p = math.sqrt(3 * g / (4 * math.sqrt(width ^ 2 + height ^ 2) / 2))
local frequency = omega * p / (2 * pi)
ground_motion { wave = half_sine { amplitude = amplitude * g * math.tan(alpha), frequency = frequency }, direction = "x" }
-- Near the threshold the block hesitates at theta = alpha: 1 % off takes ln(100) / p.
analysis { duration = 0.5 / frequency + 6 / p, start = "rest", output_dt = 5e-3, frame_dt = 10, stop_after_collapse = 0.01 }
metric("overturned", "", function(run) return run.collapse.collapsed and 1 or 0 end)
metric("theory", "", function()
  return rocking_overturning { width = width, height = height, from = 0.9, to = 30, points = 60,
    wave = half_sine { amplitude = g * math.tan(alpha), frequency = frequency } }.lowest
end)
