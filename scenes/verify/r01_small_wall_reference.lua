-- R01 by the reference kernel: the same wall and the same expectations.
--
-- How to run     erbs run scenes/verify/r01_small_wall_reference.lua
-- What to look at  The numbers beside those of r01_small_wall_record.lua, which explains the tolerances.
label("quick")
plain_kernel = 1
include "r01_small_wall_record.lua"
expect("status", "completed")
