-- H19, the other side: the same chain of cubes with strong dashpots, one part in a hundred past its explicit limit, diverges and is caught.
--
-- What happens   h19_stiffness_damping_limit.lua has the formula and the source. The run must end as "diverged", not as a result.
-- How to run     erbs run scenes/hard/h19_past_the_limit.lua [-D xi=2] [-D fraction=1.05]
-- What to look at  status.
past_the_limit = true
include "h19_stiffness_damping_limit.lua"
