-- Incremental dynamic analysis of a pier over twelve records: fractiles of its drift, and its fragility
--
-- What happens   Each run shakes the pier of ida_pier.lua by one record, scaled to one peak acceleration. The capacity of a record lies between
--                its last standing and its first collapsed run; some records never bring the pier down below the highest level.
-- Source         Vamvatsikos and Cornell 2002; Baker 2015 for the likelihoods.
-- How to run     erbs sweep scenes/studies/ida_records.lua --allow ../shared/data/records/peer      (PEER records in a folder of yours)
--                -D im=metrics.sa_t1 takes the spectral acceleration of a rocking pier instead of the peak
-- What to look at  fragility.svg, ida.svg; fragility.csv, stripes.csv, fractiles.csv
local im = param("im", "pga")
study {
  title = "Mortared pier of 0.3 x 1.6 m, twelve records",
  scene = "ida_pier.lua",
  vary = {
    records {
      param = "motion", scale = "pga", scales = { 0.15 * g, 0.3 * g, 0.45 * g, 0.6 * g, 0.8 * g, 1.0 * g, 1.25 * g, 1.5 * g },
      files = { "RSN6_IMPVALL.I_I-ELC180-hor1.AT2", "RSN6_IMPVALL.I_I-ELC270-hor2.AT2", "RSN6_IMPVALL.I_I-ELC-UP.AT2",
        "RSN77_SFERN_PUL164-hor1.AT2", "RSN77_SFERN_PUL254-hor2.AT2", "RSN77_SFERN_PULDWN-up.AT2", "RSN753_LOMAP_CLS000-hor1.AT2",
        "RSN753_LOMAP_CLS090-hor2.AT2", "RSN753_LOMAP_CLS-UP.AT2", "RSN1690_NORTH151_SYL090-hor1.AT2",
        "RSN1690_NORTH151_SYL360-hor2.AT2", "RSN1690_NORTH151_SYL-UP.AT2" },
    },
  },
  collect = { "collapse.collapsed", "metrics.drift" },
  fragility = { im = im, collapse = "collapse.collapsed", damage = { "metrics.drift" }, along = "pga" },
  keep = "none",
  max_wall = "5m",
}
