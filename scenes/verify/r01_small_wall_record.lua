-- R01, a regression: a small wall of bricks on mortar under the first two seconds of El Centro, out of its plane.
--
-- What happens   Five courses in running bond, free at the top, are shaken across their plane hard enough to crack some joints and not hard
--                enough to fall. Nothing here has a closed form: the expected numbers come from a run of this scene and hold the
--                program to itself. The part before any crack is compared with kernel = "reference" by running it so.
-- How to run     erbs run scenes/verify/r01_small_wall_record.lua [-D reference=1] [-D pga=1.2*g]
-- What to look at  drift_peak, base_shear_peak_of_weight, joints_broken; the same with -D reference=1.
local pga = param("pga", 0.8 * g, "peak of the record [m/s2]")
local reference = param("reference", 0, "1: the plain kernel")
local duration = param("duration", 2, "[s]")
local E, t = param("E", 1e8, "of the mortar, soft for a long step [Pa]"), 5 * mm
local ft, c = param("ft", 15 * kPa, "weak [Pa]"), param("c", 22 * kPa, "[Pa]")

material { name = "brick", density = 1800, friction = 0.6 }
ground { size = 6 }
local l, w, h, courses, bricks = 300 * mm, 125 * mm, 100 * mm, 10, 4
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
joint { law = mortar { E = E, nu = 0.2, thickness = t, ft = ft, c = c, mu = 0.6 }, thickness = t, tolerance = 0.1 * mm }
ground_motion { wave = record { file = "records/elcentro_1940_ns.csv", peak = pga }, direction = "y" }
damping { mass = 2 }
analysis { duration = duration, kernel = reference == 1 and "reference" or "fast", output_dt = 2 * ms }
recorder { name = "top", quantity = "displacement", block = blocks[count - 2], axis = "y" }
recorder { name = "base", quantity = "reaction", axis = "yz" }
recorder { name = "wall", quantity = "damage" }
camera { name = "side", eye = { 2.5, -3, 1.4 }, target = { 0, 0, 0.5 } }
metric("bricks", "", count)
metric("drift_peak", "", function(run) return run.peak("top_uy_rel_m") / (courses * (h + t)) end)
metric("base_shear_peak_of_weight", "", function(run) return run.peak("base_fy_N") / -run.first("base_fz_N") end)
metric("damage_end", "", function(run) return run.last("wall_damage") end)
metric("first_crack_s", "s", function(run) return run.first_crack and run.first_crack.time end)
