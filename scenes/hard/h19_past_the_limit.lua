-- H19, the other side: the same chain of cubes with strong dashpots, 1 % beyond its explicit limit, diverges and is stopped.
--
-- What happens   See h19_stiffness_damping_limit.lua for the formula and the source. The run must end as "diverged", not with a result.
-- How to run     erbs run scenes/hard/h19_past_the_limit.lua [-D xi=2] [-D fraction=1.05]
-- What to look at  status.
past_the_limit = true
include "h19_stiffness_damping_limit.lua"
