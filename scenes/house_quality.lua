-- The first quarter of a second of the shaking-table house under El Centro: error and cost of the three qualities.
--
-- What happens   The house of scenes/shake_table_house.lua sways with the ground; all joints stay intact.
-- Source         No number on paper: the reference is the limit of finer steps and more points.
-- How to run     erbs accuracy scenes/house_quality.lua
-- What to look at  The rows of quality: error and cost of draft, standard and reference.
label("coarse_study", "quality_only")
-- The mean square is taken up to a fixed instant. A run ends with a whole step, so a mean up to its end would cover times that differ by
-- half a step. That is 1e-6 of the time, more than the error of the steps.
local span = param("span", 0.249, "of the record [s]")
metric("sway_rms", "m", function(run)
  local t, u, sum = run.time, run.history "floor3_ux_rel_m", 0
  for i = 2, #t do
    local a, b, length = u[i - 1], u[i], t[i] - t[i - 1]
    if t[i] > span then a, b, length = a, a + (span - t[i - 1]) / length * (b - a), span - t[i - 1] end
    sum = sum + length * (a * a + a * b + b * b) / 3  -- integral of the square of a straight line from a to b
    if t[i] > span then break end
  end
  return math.sqrt(sum / span)
end)
include "shake_table_house.lua"
analysis { duration = span + 1e-3, output_dt = 1e-4, frame_dt = 1 }
