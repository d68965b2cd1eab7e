-- The beginning of the shaking-table house under El Centro, for the errors and costs of quality.
--
-- What happens   The first quarter of a second of scenes/shake_table_house.lua: all joints sound, the house sways with the ground.
-- Source         no number on paper: against the limit of finer steps and more points.
-- How to run     erbs accuracy scenes/house_quality.lua
-- What to look at  the rows of quality: what draft, standard and reference err by and cost.
label("coarse_study", "quality_only")
-- Up to an instant that is the same for all: a run ends with a whole step, and the mean square up to there would be over a time that differs by
-- half a step, 1e-6 of it, which is more than the steps err by.
local span = param("span", 0.249, "of the record [s]")
metric("sway_rms", "m", function(run)
  local t, u, sum = run.time, run.history "floor3_ux_rel_m", 0
  for i = 2, #t do
    local a, b, length = u[i - 1], u[i], t[i] - t[i - 1]
    if t[i] > span then a, b, length = a, a + (span - t[i - 1]) / length * (b - a), span - t[i - 1] end
    sum = sum + length * (a * a + a * b + b * b) / 3  -- of a line from a to b
    if t[i] > span then break end
  end
  return math.sqrt(sum / span)
end)
include "shake_table_house.lua"
analysis { duration = span + 1e-3, output_dt = 1e-4, frame_dt = 1 }
