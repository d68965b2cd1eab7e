-- Hard case 20: a slender slab lies on two rows of many small brick pillars.
--
-- What happens   About thirty joints hold one rigid body. Its stiffness is their sum, its own rocking may set the step, and it must spread
--                its weight evenly. Then the ground shakes below cracking: the ledger, the reaction and the loads of equal pillars show
--                errors.
-- Source         equilibrium and symmetry.
-- How to run     erbs run scenes/hard/h20_slab_over_many_bricks.lua [-D pillars=40] [-D thick=0.05]
-- What to look at  reaction_error, uneven: largest difference of the pillars' mean loads over their mean; energy.residual_relative;
--                dt_critical_s.
label("quick")
local pillars = param("pillars", 15, "in each row")
local thick, slab = param("thick", 0.1, "of the slab [m]"), param("slab", 2400, "its density [kg/m3]")
local shake, frequency = param("shake", 0.1, "of the ground, of g"), param("frequency", 5, "[Hz]")
local E, t = param("E", 5e8, "of the mortar [Pa]"), 10 * mm
local courses, l, w, h, pitch, span = 3, 0.2, 0.2, 0.1, 0.4, 3

material { name = "brick", density = 1800 }
material { name = "concrete", density = slab }
local weight, tops = 0, {}
for row = 0, 1 do
  for i = 1, pillars do
    local x, y = (i - 0.5) * pitch - l / 2, row * span
    box { name = "foot" .. row .. "_" .. i, group = "foot", material = "brick", size = { l, w, h }, at = { x, y, -h - t }, fixed = true }
    for c = 1, courses do
      box { name = row .. "_" .. i .. "_" .. c, group = "pillar", material = "brick", size = { l, w, h }, at = { x, y, (c - 1) * (h + t) } }
      weight = weight + 1800 * l * w * h * g
    end
    local top = row .. "_" .. i .. "_" .. courses
    recorder { name = top, quantity = "normal_force", blocks = { top }, others = { "slab" } }
    tops[#tops + 1] = top
  end
end
local length, depth = pillars * pitch, span + w
box { name = "slab", group = "slab", material = "concrete", size = { length, depth, thick }, at = { 0, 0, courses * (h + t) } }
weight = weight + slab * length * depth * thick * g
joint { law = mortar { E = E, nu = 0.2, thickness = t, ft = 0.3 * MPa, c = 0.5 * MPa, mu = 0.7 }, tolerance = 0.1 * mm }
ground_motion { wave = sine { amplitude = shake * g, frequency = frequency, start = 0.02 }, direction = { 1, 0.5, 0 } }
recorder { name = "base", quantity = "reaction" }
recorder { name = "slab", quantity = "displacement", block = "slab" }
analysis { duration = 1.0, output_dt = 0.005, frame_dt = 0.1 }
metric("reaction_error", "", function(run) return -run.mean("base_fz_N") / weight - 1 end)
metric("uneven", "", function(run)
  local least, most, sum = math.huge, -math.huge, 0
  for _, name in ipairs(tops) do
    local f = -run.mean(name .. "_normal_N")
    least, most, sum = math.min(least, f), math.max(most, f), sum + f
  end
  return (most - least) / (sum / #tops)  -- sum F dt = m (v - v0) + m int a dt of the supports: its relative error, as the run reports it
end)
metric("momentum_error", "", function(run)  -- impulse of the supports, relative: sum F dt = m (v - v0) + m Int a dt is left to the ledger
  return run.momentum_residual
end)
-- Means over a second of shaking: five cycles, and the vibration from noise of 1e-8 m in the start.
expect("metrics.reaction_error", 0, { abs = 1e-3, source = "weight" })
-- A centred rigid slab on equal springs: equal loads.
expect("metrics.uneven", 0, { abs = 0.01, source = "symmetry" })
expect("metrics.momentum_error", 1e-10, { below = true, source = "action is reaction" })
expect("energy.residual_relative", 1e-3, { below = true, source = "bonded gate" })
expect("joints_broken", 0, { abs = 0, source = "nothing cracks" })
