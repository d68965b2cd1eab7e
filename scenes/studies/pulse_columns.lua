-- Columns of one, two and four blocks or round drums under five pulses: the least amplitude that brings each down
--
-- What happens   For each number of drums and each pulse the amplitude of pulse_column.lua is bisected.
-- Source         Makris and Roussos 2000; Psycharis 1990; Mavroeidis and Papageorgiou 2003. Columns of drums are no map with one edge:
--                a bisection finds one threshold between its ends, and there may be others.
-- How to run     erbs sweep scenes/studies/pulse_columns.lua [-D sides=16]        (round drums)
-- What to look at  results.csv, results.svg: amplitude over g tan(alpha) by pulse and number of drums
local sides = param("sides", 0, "of round drums; 0: square blocks")
study {
  title = "Least overturning amplitude of a column 0.4 x 1.2 m",
  scene = "pulse_column.lua",
  vary = { grid { sides = { sides } }, grid { pulse = { "half_sine", "full_sine", "full_cosine", "ricker", "mp_pulse" } }, grid { n = { 1, 2, 4 } },
    grid { omega = { 1, 2, 3 } } },
  bisect = { param = "amplitude", lo = 0.5, hi = 16, rel = 0.02, points = 1, key = "metrics.overturned" },
  keep = "none",
}
