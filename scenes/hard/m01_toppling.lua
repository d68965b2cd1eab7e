-- Hard case: a block topples and lands on its side
--
-- What happens   One lobe of a sine in the ground, or a table that tilts and returns, turns a block on a joint over its edge. The block
--                falls, its side hits the ground within a step or two, and it comes to rest there.
-- Source         A rigid block that rotates about its edge lifts its centroid by half its diagonal less half its height at most. Nothing
--                may throw it higher, and impacts may only take energy.
-- How to run     erbs run scenes/hard/m01_toppling.lua [-D width=0.5] [-D height=2] [-D by=2] [-D kn=...]
-- What to look at  rise (over half the diagonal less half the height), final speed (m/s), reset (share of the energy that passed),
--                energy.residual_relative.
local width, depth, height = param("width", 0.3, "[m]"), param("depth", 0.5, "[m]"), param("height", 1, "[m]")
local kn, mu = param("kn", 5e9, "[Pa/m]"), param("mu", 0.6, "")
local by = param("by", 1, "1: a half sine of the ground, 2: a tilting table")
local amplitude = param("amplitude", 1.7, "of g tan alpha, or of alpha: 1.37 and 1 are the least that can do it")
family({ width = { 0.1, 0.2, 0.35 }, depth = { 0.1, 2 }, height = { 1.5, 2, 6 }, kn = { 1e9, 1e10, 1e11, 1e12 }, mu = { 0.55, 1 },
  by = { 1, 2 }, amplitude = { 1.5, 1.9 } }, { combinations = 8 })
if amplitude * width / height > mu then error("a block as stocky as this slides before it falls; lower width or amplitude, or raise mu", 0) end

local alpha, radius = math.atan(width / height), math.sqrt(width ^ 2 + height ^ 2) / 2
local p = math.sqrt(3 * g / (4 * radius))
material { name = "stone", density = 2200, friction = mu }
ground { size = 8 * height }
box { name = "block", size = { width, depth, height }, center = { 0, 0, height / 2 }, material = "stone" }
joint { law = dry { kn = kn, mu = mu } }
local duration = 9 / p
if by == 1 then ground_motion { wave = half_sine { amplitude = amplitude * width / height * g, frequency = p / (2 * pi) }, direction = "x" }
else tilt { wave = half_sine { amplitude = amplitude * alpha, frequency = p / (4 * pi) }, axis = "y" } duration = 14 / p end

recorder { name = "centre", quantity = "displacement", block = "block" }
recorder { name = "v", quantity = "velocity", block = "block" }
recorder { name = "w", quantity = "spin", block = "block" }
metric("rise", "", function(run) return run.max "centre_uz_rel_m" / (radius - height / 2) end)
metric("speed", "m/s", function(run)
  local square = 0
  for _, axis in ipairs { "x", "y", "z" } do
    square = square + run.last("v_v" .. axis .. "_rel_m_s") ^ 2 + (radius * run.last("w_w" .. axis .. "_rad_s")) ^ 2
  end
  return math.sqrt(square)
end)
metric("lies", "", function(run) return (run.last "centre_uz_rel_m" + height / 2) / (width / 2) end)
metric("reset", "", function(run)
  local e = run.energy
  return math.abs(e.reset_J) / (math.abs(e.base_work_J) + math.abs(e.tilt_work_J) + math.abs(e.gravity_J))
end)
analysis { duration = duration, output_dt = 2e-3, frame_dt = 1 }
expect("collapse.collapsed", true)
expect("metrics.rise", 1.005, { below = true, source = "half the diagonal less half the height" })
expect("metrics.lies", 1, { abs = 0.005, source = "on its side" })
expect("metrics.speed", 1e-3, { below = true, source = "it lies still" })
expect("metrics.reset", 2e-3, { below = true, source = "what contacts lose when they are made anew" })
expect("energy.residual_relative", 1e-3, { below = true, source = "nothing is made" })
