-- The blocks of Pena et al. as ensembles: the share that overturns, and the spread of the peaks
--
-- What happens   Each of three blocks rocks freely, under a harmonic and under random motions of several levels. Each motion is run eight times
--                with a start perturbed by 1e-6, since peaks after many impacts are a matter of statistics.
-- Source         Pena, Prieto, Lourenco, Campos Costa and Lemos 2007 (EESD 36, 2383)
-- How to run     erbs sweep scenes/studies/pena_blocks.lua -D motion='"random"'      (or "free", "harmonic")
-- What to look at  fragility.svg: probability of overturning over the level for each block; results.csv: peak and time to rest
local motion = param("motion", "random")
local seeds = motion == "random" and { 1, 2, 3, 4, 5, 6, 7, 8 } or { 1 }
study {
  title = "Blocks of Pena et al. under " .. motion .. " motion",
  scene = "pena_block.lua",
  vary = { grid { motion = { motion } }, grid { specimen = { 1, 2, 3 } }, grid { seed = seeds },
    perturbations { n = motion == "random" and 1 or 8, size = 1e-6 },
    grid { level = motion == "free" and { 1 } or { 1.5, 2.5, 3.5, 5, 7, 10 } } },
  collect = { "metrics.overturned", "metrics.peak", "metrics.rest" },
  fragility = { im = "level", collapse = "metrics.overturned", damage = { "metrics.peak" }, by = { "specimen" } },
  keep = "none",
}
