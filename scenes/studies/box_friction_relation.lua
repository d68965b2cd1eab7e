-- What holds the ring of the box: the collapse relation with and without its friction on the walls along the motion, and without their mitres
--
-- What happens   As box_collapse_relation.lua, for one ring and one calibration. Without friction on the walls along the motion the ring
--                still leans on the wall at the back, which the mitres wedge. Without the mitres as well two walls and the ring rock alone:
--                a frame, which theory describes as one block of another p.
-- Source         P. J. S. Gomes (IST Lisbon), Figs. 9 and 10; Makris and Vassiliou 2013 (EESD 42, 371): columns of mass m under a beam rock
--                like one block of p sqrt((1 + 2 gamma) / (1 + 3 gamma)), gamma = mass of the beam / mass of the columns
-- How to run     erbs sweep scenes/studies/box_friction_relation.lua [-D case=4]        two minutes on two cores
-- What to look at  results.svg: the frame (side_friction 0, mitre_kn 1000) follows its curve, everything else lies above it
local case = param("case", 2, "of box_lintel.lua, with a ring: 2 to 4")
local density = ({ [2] = 2551.02, [3] = 3408.51, [4] = 5123.48 })[case] or error("case must be 2, 3 or 4: case 1 has no ring", 0)
local alpha, p = math.atan(0.6 / 3), rocking { width = 0.6, height = 3, duration = 1e-3, gravity = 9.8 }.p
local gamma = density * 0.6 * 0.7 * 13.6 / (2 * 1800 * 0.6 * 3 * 3.4)
local p_frame = p * math.sqrt((1 + 2 * gamma) / (1 + 3 * gamma))

local omega, alone, frame = {}, {}, {}
local function lowest(rate, frequency)
  return rocking_overturning { alpha = alpha, p = rate, gravity = 9.8, criterion = "alpha_at_end", from = 0.9, to = 5, points = 50,
    wave = half_sine { amplitude = 9.8 * alpha, frequency = frequency } }.lowest
end
for i = 0, 39 do
  omega[i + 1] = 0.05 + 1.95 * i / 39
  alone[i + 1], frame[i + 1] = lowest(p, omega[i + 1] * p / (2 * pi)), lowest(p_frame, omega[i + 1] * p / (2 * pi))
end

study {
  title = "Ring on four mitred walls: friction on the walls along the motion, and mitres",
  scene = "../box_lintel.lua",
  vary = { grid { case = { case } }, grid { side_friction = { 1, 0 } }, grid { mitre_kn = { 50e6, 1e3 } },
    grid { omega = { 0.1, 0.25, 0.5, 0.75, 1, 1.25, 1.5, 1.75, 2 } } },
  bisect = { param = "amplitude", lo = 0.7, hi = 5, rel = 0.005, key = "metrics.collapse" },
  collect = { "metrics.turn_front", "metrics.turn_back", "metrics.turn_side" },
  keep = "none",
  x = "omega / p [-]", y = "least a / (g alpha) [-]",
  max_wall = "5m",
  curves = { { label = "one wall alone, exact equation", x = omega, y = alone }, { label = "rocking frame, exact equation", x = omega, y = frame } },
}
