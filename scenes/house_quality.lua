-- The beginning of the shaking-table house under El Centro, for the errors and costs of quality.
--
-- What happens   The first quarter of a second of scenes/shake_table_house.lua: all joints sound, the house sways with the ground.
-- Source         no number on paper: against the limit of finer steps and more points.
-- How to run     erbs accuracy scenes/house_quality.lua
-- What to look at  the rows of quality: what draft, standard and reference err by and cost.
label("coarse_study", "quality_only")
metric("sway_rms", "m", function(run) return run.rms "floor3_ux_rel_m" end)
include "shake_table_house.lua"
analysis { duration = 0.25, output_dt = 1e-4, frame_dt = 1 }
