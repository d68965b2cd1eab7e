-- Hard case: a slender column falls over and lands flat
--
-- What happens   A half sine of the ground overturns a column on a dry joint. Its whole side hits the ground at once; this contact is
--                hundreds of times stiffer than the edge about which the column turned, and its far end is much faster.
-- Source         as m01_toppling, with a harder impact: the column ends flat and at rest, and no energy is created.
-- How to run     erbs run scenes/hard/m03_falls_flat.lua [-D width=1 -D height=4] [-D width=0.05 -D height=0.3] [-D kn=...]
-- What to look at  lies (height of the centroid over half the width), final speed, reset, energy.residual_relative.
local width, depth, height = param("width", 0.3, "[m]"), param("depth", 1, "[m]"), param("height", 3, "[m]")
local kn = param("kn", 5e9, "[Pa/m]")
local amplitude = param("amplitude", 3, "of g tan alpha")
family({ width = { 0.05, 0.1, 1 }, depth = { 0.1, 4 }, height = { 1, 4, 6 }, kn = { 1e9, 1e10, 1e11, 1e12 },
  amplitude = { 2 } }, { combinations = 8 })
if amplitude * width / height > 1 then error("a column as stocky as this slides before it falls; lower width or amplitude", 0) end
local radius = math.sqrt(width ^ 2 + height ^ 2) / 2
local p = math.sqrt(3 * g / (4 * radius))
material { name = "stone", density = 2200, friction = 0.6 }
ground { size = 8 * height }
box { name = "column", size = { width, depth, height }, center = { 0, 0, height / 2 }, material = "stone" }
joint { law = dry { kn = kn, mu = 1 } }
ground_motion { wave = half_sine { amplitude = amplitude * width / height * g, frequency = p / (2 * pi) }, direction = "x" }
recorder { name = "centre", quantity = "displacement", block = "column" }
recorder { name = "v", quantity = "velocity", block = "column" }
recorder { name = "w", quantity = "spin", block = "column" }
metric("speed", "m/s", function(run)
  local square = 0
  for _, axis in ipairs { "x", "y", "z" } do
    square = square + run.last("v_v" .. axis .. "_rel_m_s") ^ 2 + (radius * run.last("w_w" .. axis .. "_rad_s")) ^ 2
  end
  return math.sqrt(square)
end)
metric("rise", "", function(run) return run.max "centre_uz_rel_m" / (radius - height / 2) end)
metric("lies", "", function(run) return (run.last "centre_uz_rel_m" + height / 2) / (width / 2) end)
metric("reset", "", function(run) return math.abs(run.energy.reset_J) / (math.abs(run.energy.base_work_J) + math.abs(run.energy.gravity_J)) end)
analysis { duration = 10 / p, output_dt = 2e-3, frame_dt = 1 }
expect("collapse.collapsed", true)
expect("metrics.rise", 1.05, { below = true, source = "half the diagonal; thrown hard it may leave its edge for a moment" })
expect("metrics.lies", 1, { abs = 0.005, source = "flat on its side" })
expect("metrics.speed", 1e-3, { below = true, source = "it lies still" })
expect("metrics.reset", 2e-3, { below = true, source = "what contacts lose when they are made anew" })
expect("energy.residual_relative", 1e-3, { below = true, source = "nothing is made" })
