-- P7: acceleration at which a bonded wall first cracks.
--
-- What happens   The ground under a wall of 105 bricks on mortar accelerates along the wall, more and more and without jumps. The first
--                joint point reaches its strength at the heel. The stress at the edge decides; points inside a joint see less of it.
-- Source         No number on paper: the reference is the limit of finer steps and more points.
-- How to run     erbs accuracy scenes/accuracy/p7_first_crack.lua
-- What to look at  Midpoints crack late, by the share 1/n of the stress at the edge; the step hardly matters.
local E, t = param("E", 1e9, "of the mortar [Pa]"), 5 * mm
local rate = param("rate", 1.0, "growth of the acceleration [g/s]")
material { name = "brick", density = 1800, friction = 0.6 }
ground { size = 6 }
local l, w, h, courses, bricks = 300 * mm, 125 * mm, 100 * mm, 14, 7
local count, blocks = 0, {}
for course = 0, courses - 1 do
  local x, z = -bricks * (l + t) / 2, t + course * (h + t)
  local half = course % 2 == 1
  for i = 0, half and bricks or bricks - 1 do
    local length = half and (i == 0 or i == bricks) and (l - t) / 2 or l
    count = count + 1
    blocks[count] = "brick" .. count
    box { name = blocks[count], group = "wall", size = { length, w, h }, at = { x, -w / 2, z } }
    x = x + length + t
  end
end
joint { law = mortar { E = E, nu = 0.2, thickness = t, ft = 40 * kPa, c = 500 * kPa, mu = 0.6 }, thickness = t, tolerance = 0.1 * mm }
ground_motion { wave = function(time) return rate * g * time end, direction = "x" }
damping { mass = 20 }
analysis { duration = 1.1, output_dt = 5e-4, frame_dt = 1 }
recorder { name = "top", quantity = "displacement", block = blocks[count], axis = "x" }
metric("cracks_at", "g", function(run) return run.first_crack and rate * run.first_crack.time end)
metric("drift_at_half", "m", function(run) return run.at("top_ux_rel_m", 0.4) end)
