-- Hard case: stacks of many courses at rest on dry joints, straight and leaning, without any damping.
--
-- What happens   Round-off must not accumulate: no block drifts, no kinetic energy grows. In the leaning stack every course is shifted by
--                the same amount, so that the lowest joints are close to opening; the eccentricity of the weight stays inside the core.
-- How to run     erbs run scenes/hard/h09_long_resting_stack.lua [-D courses=100] [-D duration=60]
-- What to look at  drift_* (over the height of a block), kinetic_per_mass (m2/s2) at the end.
label("quick")
local courses = param("courses", 50, "")
local duration = param("duration", 20, "[s]")
local kn = param("kn", 1e10, "[Pa/m]")
local lean = param("lean", 0.25, "greatest eccentricity of the weight above, over the core's H/6")
local size = { 0.3, 0.125, 0.1 }

material { name = "brick", density = 1800 }
joint { law = dry { kn = kn, mu = 0.6 }, between = { "straight", "straight" } }
joint { law = dry { kn = kn, mu = 0.6 }, between = { "leaning", "leaning" } }
local shift = { straight = 0, leaning = 2 * lean * size[1] / 6 / courses }  -- the centroid of the blocks above moves by half of it
for name, by in pairs(shift) do
  local y = name == "straight" and 0 or 2
  box { name = name .. "_foot", group = name, size = { 1, 1, 0.1 }, at = { -0.5, y - 0.5, -0.1 }, fixed = true }
  for i = 1, courses do
    box { name = name .. i, group = name, size = size, at = { by * (i - 1), y, (i - 1) * size[3] } }
  end
  recorder { name = name, quantity = "displacement", block = name .. courses }
  local blocks = {}
  for i = 1, courses do blocks[i] = name .. i end
  recorder { name = name .. "_joints", quantity = "slip", blocks = blocks }
  metric("drift_" .. name, "", function(run)
    local largest = 0
    for _, axis in ipairs { "x", "y", "z" } do
      local column = name .. "_u" .. axis .. "_rel_m"
      largest = math.max(largest, run.max(column) - run.min(column))
    end
    return largest / size[3]
  end)
  expect("metrics.drift_" .. name, 1e-6 * duration, { below = true, source = "1e-6 of the smallest edge per second" })
end
recorder { name = "base", quantity = "reaction", axis = "z" }
local weight = 2 * courses * 1800 * size[1] * size[2] * size[3] * g
metric("reaction_error", "", function(run) return -run.last("base_fz_N") / weight - 1 end)
metric("kinetic_per_mass", "m2/s2", function(run) return run.energy.kinetic_J / (weight / g) end)
analysis { duration = duration, start = "equilibrium", output_dt = duration / 50, frame_dt = duration }
-- Noise in the start displaces every bed by sqrt(2/3) of it in each direction (root mean square of a difference). It stores noise^2 / 3 (kn
-- + 2 ks) A per bed; no more can ever become motion. A factor of two covers the scatter of the draw. Two beds carry the reaction, whose
-- rows show at most four times their swing.
local ks, bed = 0.4 * kn, size[1] * size[2]
local stored = 2 * start_noise ^ 2 / 3 * (kn + 2 * ks) * bed / (1800 * bed * size[3])
expect("metrics.reaction_error", 0, { abs = 1e-6 + 4 * math.sqrt(2 * 2 / 3) * start_noise * kn * bed / weight, source = "weight" })
expect("metrics.kinetic_per_mass", 1e-12 + stored, { below = true, source = "hard case 9: nothing gathers" })
