-- V34: a block on a block rocks in four patterns.
--
-- What happens   A half sine of inertia forces pushes two stacked blocks, free to separate, to +x, and a second such stack to -x. The
--                blocks rotate the same way, in opposite ways, or one alone. The transitions have no closed form: the stacks must be mirror
--                images, and the ledger must close. The scene reports the sequence of patterns.
-- Source         Psycharis 1990 (EESD 19, 555): patterns 1 both the same way, 2 opposite, 3 the upper alone, 4 both as one about the edge
--                of the lower.
-- How to run     erbs run scenes/verify/v34_two_blocks.lua [-D amplitude=0.5] [-D frequency=1.2]
-- What to look at  mirror; pattern_1..4: share of the time in each; changes: number of changes of pattern.
label("quick")
local amplitude, frequency = param("amplitude", 0.42, "[g]"), param("frequency", 1.0, "[Hz]")
local kn = param("kn", 2e10, "[Pa/m]")
local width, depth, density, heights = 0.5, 0.5, 2400, { 1.0, 1.2 }

material { name = "stone", density = density, kn = kn, ks = 0.4 * kn, friction = 0.8, restitution = 0.2 }
box { name = "floor", size = { 20, 4, 0.5 }, at = { -10, -2, -0.5 }, fixed = true, material = "stone" }
joint { law = dry { kn = kn, ks = 0.4 * kn, mu = 0.8 } }
for i, way in ipairs { 1, -1 } do
  local z = 0
  for level, height in ipairs(heights) do
    local name = string.format("s%d_%d", i, level)
    box { name = name, size = { width, depth, height }, at = { 4 * (i - 1.5) - width / 2, -depth / 2, z }, material = "stone" }
    force { block = name, direction = "x", wave = half_sine { amplitude = way * amplitude * g * density * width * depth * height, frequency = frequency } }
    recorder { name = name, quantity = "rotation", block = name, axis = "y" }
    z = z + height
  end
end
local function pattern(lower, upper)
  local still = 1e-4  -- rad
  local a, relative = lower, upper - lower
  if math.abs(a) < still and math.abs(relative) < still then return 0 end
  if math.abs(relative) < still then return 4 end
  if math.abs(a) < still then return 3 end
  return a * relative > 0 and 1 or 2
end
local function patterns(run)
  local lower, upper, share, changes, last = run.history("s1_1_ry_rad"), run.history("s1_2_ry_rad"), {}, 0, nil
  for i = 1, #lower do
    local now = pattern(lower[i], upper[i])
    share[now] = (share[now] or 0) + 1 / #lower
    if last and now ~= last then changes = changes + 1 end
    last = now
  end
  return share, changes
end
for k = 1, 4 do metric("pattern_" .. k, "", function(run) return patterns(run)[k] or 0 end) end
metric("changes", "", function(run)
  local _, changes = patterns(run)
  return changes
end)
metric("mirror", "rad", function(run)
  local worst = 0
  for level = 1, 2 do
    local a, b = run.history(string.format("s1_%d_ry_rad", level)), run.history(string.format("s2_%d_ry_rad", level))
    for i = 1, #a do worst = math.max(worst, math.abs(a[i] + b[i])) end
  end
  return worst
end)
metric("largest", "rad", function(run) return math.max(run.peak("s1_1_ry_rad"), run.peak("s1_2_ry_rad")) end)
-- Impacts magnify round-off; 1e-3 of a rocking of about 0.1 rad.
expect("metrics.mirror", 1e-4, { below = true, source = "mirror symmetry" })
expect("metrics.largest", 1e-2, { above = true, source = "the blocks do rock" })
expect("energy.residual_relative", 1e-3, { below = true, source = "ledger" })
analysis { duration = param("duration", 3, "[s]"), output_dt = 2e-3, frame_dt = 0.04, dt_fraction = 0.5 }
