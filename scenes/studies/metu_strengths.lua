-- Strengths of the METU house: which of them meet what was observed
--
-- What happens   Each run tilts the house of metu_house.lua until it falls, with another strength and friction of its mortar: both are lost
--                in the source.
-- Source         Tilting test of a full-scale house at METU. Observed: the walls across the tilt (east, west) overturn, those along it
--                (south, north) crack diagonally.
-- How to run     erbs sweep scenes/studies/metu_strengths.lua        15 runs, five minutes on two cores
-- What to look at  results.svg: tangent of the tilt over the strength; results.csv: what each wall does.
local first = param("first", 8, "tilt towards -x before the return; 0: towards +x only [deg]")

local strengths = {}
for _, ft in ipairs { 0.02 * MPa, 0.05 * MPa, 0.08 * MPa, 0.15 * MPa, 0.3 * MPa } do strengths[#strengths + 1] = { ft = ft, c = 1.5 * ft } end
study {
  title = "METU house: tangent of the tilt at which it falls",
  scene = "../metu_house.lua",
  vary = { grid { first = { first } }, grid { mu = { 0.5, 0.65, 0.8 } }, list(strengths) },
  collect = { "capacity.multiplier", "capacity.angle_deg", "capacity.mechanism", "capacity.walls.wall_east", "capacity.walls.wall_west",
    "capacity.walls.wall_south", "capacity.walls.wall_north", "capacity.joints_opened", "capacity.joints_slid" },
  keep = "metrics",
  max_wall = "30m",
}
