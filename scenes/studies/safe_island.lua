-- Overturning spectrum of a block under one-cycle sines: a safe island above the first region of overturning
--
-- What happens   Each run gives the block of pulse_column.lua a full sine of another frequency and amplitude. Small pulses overturn it after one
--                impact, larger ones leave it standing again, still larger ones overturn it without an impact.
-- Source         Zhang and Makris 2001, Fig. 6: omega_p / p against a_p / (g alpha); the island of the exact equation is drawn beside.
-- How to run     erbs sweep scenes/studies/safe_island.lua          576 pulses take two minutes on two cores
-- What to look at  results.svg: the blue cells between the two red regions, for omega / p from 3 to 6
local n = param("n", 24, "pulses along each side of the map")
local function spread(lo, hi)
  local values = {}
  for i = 1, n do values[i] = lo + (hi - lo) * (i - 0.5) / n end
  return values
end
-- Edges for a block of .4 x 1.2 m with Housner's restitution, from a scan of the exact equation (scenes/verify/v32_full_sine_overturning.lua).
-- They are given over g alpha, the amplitudes of the map over g tan(alpha).
local omega, alpha = { 1, 2, 3, 4, 5 }, math.atan(0.4 / 1.2)
local function scaled(values)
  local out = {}
  for i, value in ipairs(values) do out[i] = value * alpha / math.tan(alpha) end
  return out
end
study {
  title = "One-cycle sines that overturn a block of 0.4 x 1.2 m",
  scene = "pulse_column.lua",
  vary = { grid { omega = spread(0.5, 6.5) }, grid { amplitude = spread(0.5, 10.5) } },
  collect = { "metrics.overturned", "metrics.theory" },
  keep = "none",
  curves = { { label = "least amplitude, one impact", x = omega, y = scaled { 1.1739, 1.2752, 1.4823, 2.0317, 3.7107 } },
    { label = "foot of the safe island", x = omega, y = scaled { 1.4650, 2.3933, 3.5947, 4.9776, 6.4042 } },
    { label = "its top: no impact above", x = { 1, 2, 3, 4, 5, 6 }, y = scaled { 1.4679, 2.4476, 3.8184, 5.5707, 7.7134, 10.2587 } } },
}
