-- Overturning map of one block: which half-sine pulses of the ground overturn it
--
-- What happens   Each run gives the block of overturning_block.lua one pulse of another frequency and amplitude. The map shows which ones
--                it survives, beside the threshold of the exact equation of a rocking block and Housner's estimate.
-- Source         Housner 1963; Zhang and Makris 2001, Fig. 6: omega_p / p against a_p / (g tan alpha).
-- How to run     erbs sweep scenes/studies/overturning_map.lua -D n=40        40 x 40 pulses take three minutes on two cores
-- What to look at  results.svg, results.csv. Red cells are pulses that overturn it.
local n = param("n", 8, "pulses along each side of the map")
local highest_omega, highest_amplitude = param("highest_omega", 6, "of omega_p / p"), param("highest_amplitude", 6, "of a_p over g tan(alpha)")

local function spread(lo, hi)  -- the middles of n equal parts
  local values = {}
  for i = 1, n do values[i] = lo + (hi - lo) * (i - 0.5) / n end
  return values
end

local omega, exact, housner = {}, {}, {}
local width, height = 0.4, 1.2
local alpha, p = math.atan(width / height), math.sqrt(3 * g / (2 * math.sqrt(width ^ 2 + height ^ 2)))
for i = 0, 40 do
  omega[#omega + 1] = 0.2 + (highest_omega - 0.2) * i / 40
  local pulse = half_sine { amplitude = g * math.tan(alpha), frequency = omega[#omega] * p / (2 * pi) }
  exact[#omega] = rocking_overturning { width = width, height = height, from = 0.9, to = 30, points = 60, wave = pulse }.lowest
  housner[#omega] = math.sqrt(1 + omega[#omega] ^ 2)
end

study {
  title = "Half-sine pulses that overturn a block of 0.4 x 1.2 m",
  scene = "overturning_block.lua",
  vary = { grid { omega = spread(0.2, highest_omega) }, grid { amplitude = spread(0.8, highest_amplitude) } },
  collect = { "metrics.overturned" },
  keep = "none",
  curves = { { label = "exact equation", x = omega, y = exact }, { label = "Housner 1963: sqrt(1 + omega^2)", x = omega, y = housner } },
}
