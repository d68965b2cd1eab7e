-- R01 by the plain kernel: the same wall, the same expectations, by engine/solve/reference.
--
-- How to run     erbs run scenes/verify/r01_small_wall_reference.lua
-- What to look at  the numbers beside those of r01_small_wall_record.lua; tolerances and their causes are there.
label("quick")
plain_kernel = 1
include "r01_small_wall_record.lua"
expect("status", "completed")
