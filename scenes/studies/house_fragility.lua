-- The house of shake_table_house.lua: at which peak it falls, when and where to
--
-- What happens   El Centro shakes twins of the house at eight peaks. Twins differ by 1e-9 m in the place of each brick: what they disagree on is
--                what no run alone can tell. A run ends once its house has fallen and the direction is known.
-- Source         Gu and Miao judge a simulation by time and direction of collapse; the house is theirs. Baker 2015 for the likelihood.
-- How to run     erbs sweep scenes/studies/house_fragility.lua        160 runs; -D twins=4: 32 runs
-- What to look at  fragility.svg, falls.svg; fragility.csv, stripes.csv, falls.csv
-- What is found  None of 20 twins falls at 1.0 g, 9 at 1.2 g, 18 at 1.4 g, all from 1.6 g on: median 1.23 g [1.18, 1.28], dispersion .09,
--                all of it chaos. Near the median they fall after 3.7 to 5.2 s (16 to 84 %) to either side, from 2.2 g on after 2.1 s to -x.
local twins = param("twins", 20, "of each peak")
local size = param("size", 1e-9, "of the perturbation [m and rad]")
local kn_cracked = param("kn_cracked", 0, "normal stiffness of beds without bond; 0: as with bond [Pa/m]")
-- The peak of the record comes at 1.5 s and its strong part ends at 4 s, in scaled time; a second burst follows until 9 s.
local duration = param("duration", 9 * s, "of a run; 22 s: the whole record [s]")
study {
  title = "House of Gu and Miao under El Centro",
  scene = "../shake_table_house.lua",
  vary = {
    grid { kn_cracked = { kn_cracked } },
    grid { after_collapse = { 0.3 } },
    grid { duration = { duration } },
    perturbations { n = twins, size = size },
    grid { pga = { 1.0 * g, 1.2 * g, 1.4 * g, 1.6 * g, 1.8 * g, 2.0 * g, 2.2 * g, 2.5 * g } },
  },
  collect = { "collapse.collapsed", "metrics.drift_storey1", "metrics.first_crack_s" },
  fragility = { im = "pga", collapse = "collapse.collapsed", damage = { "metrics.drift_storey1" }, falls = true },
  keep = "metrics",
  max_wall = "30m",
}
