-- Collapse relation of four mitred walls: least amplitude of a sine over its frequency, for four loads on top and two calibrations of the bed
--
-- What happens   Bisection finds, for each case, method and frequency, the least amplitude at which a wall of box_lintel.lua has turned by alpha when
--                the acceleration first vanishes. Theory beside it: the rocking block as thick as the walls, by the exact equation, and Housner.
-- Source         P. J. S. Gomes (IST Lisbon), Figs. 9 and 10; Housner 1963: a / (g alpha) = sqrt(1 + (omega / p)^2)
-- How to run     erbs sweep scenes/studies/box_collapse_relation.lua        three minutes on two cores
--                Without friction of the ring on the walls along the motion: -D side_friction=0; as a rocking frame: also -D mitre_kn=1e3
-- What to look at  results_method_1.svg, results_method_2.svg: cases 2 to 4 lie above 1, and close together. results.csv
local theory, housner, omega = {}, {}, {}
local alpha, p = math.atan(0.6 / 3), rocking { width = 0.6, height = 3, duration = 1e-3, gravity = 9.8 }.p
for i = 0, 39 do
  omega[i + 1] = 0.05 + 1.95 * i / 39
  theory[i + 1] = rocking_overturning { width = 0.6, height = 3, gravity = 9.8, criterion = "alpha_at_end", from = 0.9, to = 5, points = 50,
    wave = half_sine { amplitude = 9.8 * alpha, frequency = omega[i + 1] * p / (2 * pi) } }.lowest
  housner[i + 1] = math.sqrt(1 + omega[i + 1] ^ 2)
end

study {
  title = "Four mitred walls under a sine: least amplitude that turns a wall by alpha",
  scene = "../box_lintel.lua",
  vary = { grid { method = { 1, 2 } }, grid { case = { 1, 2, 3, 4 } }, grid { omega = { 0.1, 0.25, 0.5, 0.75, 1, 1.25, 1.5, 1.75, 2 } } },
  bisect = { param = "amplitude", lo = 0.7, hi = 5, rel = 0.005, key = "metrics.collapse" },
  collect = { "metrics.turn_front", "metrics.turn_back", "metrics.turn_side" },
  keep = "none",
  x = "omega / p [-]", y = "least a / (g alpha) [-]", split = "method",
  max_wall = "5m",
  curves = { { label = "theta = alpha, exact equation", x = omega, y = theory }, { label = "Housner 1963", x = omega, y = housner } },
}
