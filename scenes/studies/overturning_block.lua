-- One block under one half-sine pulse of the ground, for the study overturning_map.lua
--
-- What happens   A block on two narrow feet stands on ground that moves by one lobe of a sine, from the phase of uplift on. It falls, or
--                rocks back to rest.
-- Source         Housner 1963; Makris and Zhang 2001. `margin` is the amplitude over that of Housner's exact equation of this pulse.
-- How to run     erbs run scenes/studies/overturning_block.lua -D omega=2 -D amplitude=2.2
-- What to look at  metrics.overturned, metrics.margin
local width, height = param("width", 0.4, "[m]"), param("height", 1.2, "[m]")
local w, a = param("omega", 2, "circular frequency of the pulse over p"), param("amplitude", 2, "of the pulse over g tan(alpha)")
local block = (include "verify/parts/rocking_block.lua") { name = "block", width = width, height = height, duration = 1 }
local p, threshold = block.theory.p, g * math.tan(block.theory.alpha)
local frequency = w * p / (2 * pi)
ground_motion { wave = half_sine { amplitude = a * threshold, frequency = frequency }, direction = "x" }
-- Near the threshold the block hesitates at theta = alpha: 1 % off takes ln(100) / p.
analysis { duration = 0.5 / frequency + 8 / p, start = "rest", output_dt = 5e-3, frame_dt = 10, stop_after_collapse = 0.1 }
metric("overturned", "", function(run) return run.collapse.collapsed and 1 or 0 end)
metric("theory", "", function()
  local exact = rocking_overturning { width = width, height = height, criterion = "overturning", from = 0.9, to = 30, points = 60,
    wave = half_sine { amplitude = threshold, frequency = frequency } }
  return exact.lowest
end)
