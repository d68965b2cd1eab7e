-- The blocks of Pena et al. as ensembles: the share that overturns, and the spread of the peaks
--
-- What happens   Each of four blocks rocks freely, under harmonic motions of three frequencies, or under random motions, at several levels. Random
--                motions have eight seeds, the others eight (harmonic: four) starts perturbed by 1e-6: peaks after many impacts are a matter of statistics.
-- Source         Pena, Prieto, Lourenco, Campos Costa and Lemos 2007 (EESD 36, 2383); assumptions in the head of pena_block.lua
-- How to run     erbs sweep scenes/studies/pena_blocks.lua -D motion=harmonic      (or free, random)
-- What to look at  fragility.svg: probability of overturning over the level for each block; results.csv: peak and time to rest, beside Housner's
local motion = param("motion", "random")
local random, free = motion == "random", motion == "free"
study {
  title = "Blocks of Pena et al. under " .. motion .. " motion",
  scene = "pena_block.lua",
  vary = { grid { motion = { motion } }, grid { specimen = { 1, 2, 3, 4 } }, grid { frequency = motion == "harmonic" and { 2, 3, 4 } or { 3 } },
    grid { seed = random and { 1, 2, 3, 4, 5, 6, 7, 8 } or { 1 } }, perturbations { n = random and 1 or free and 8 or 4, size = 1e-6 },
    grid { level = free and { 1 } or random and { 1.5, 2.5, 3.5, 5, 7, 10 } or { 1.5, 2.5, 3.5, 5 } } },
  collect = { "metrics.overturned", "metrics.peak", "metrics.rest", "metrics.theory_overturned", "metrics.theory_peak" },
  fragility = { im = "level", collapse = "metrics.overturned", damage = { "metrics.peak" }, by = { "specimen" } },
  keep = "none",
}
