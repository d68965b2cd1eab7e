-- P4: smallest half-sine pulse that overturns a block, by bisection.
--
-- What happens   A block of 0.4 x 1.2 m stands on ground that moves by one lobe of a sine at twice the frequency parameter of the block.
--                Runs side by side find the least amplitude that overturns it.
-- Source         Shao and Tung 1999; Zhang and Makris 2001; the exact equation: 1.8667386 g alpha. The bed is elastic: see P3.
-- How to run     erbs accuracy scenes/accuracy/p4_half_sine.lua [-D kn=1e12]
-- What to look at  The knobs are the bracket and the bed; smaller steps cost time and gain nothing.
label("coarse_study", "quality_only")
local kn = param("kn", 2e11, "of the bed [Pa/m]")
local bracket = param("bracket", 0.002, "width of the last bracket over its upper end")
accuracy { param = "kn", name = "bed stiffness", values = { 2e8, 2e9, 2e10, 2e11, 2e12, 2e13 } }
accuracy { param = "bracket", values = { 0.1, 0.03, 0.01, 0.002, 0.0005 } }
local b, h = 0.2, 0.6
local alpha, p = math.atan(b / h), math.sqrt(3 * g / (4 * math.sqrt(b ^ 2 + h ^ 2)))
local amplitude = param("amplitude", 1.5, "of the pulse [g alpha]")
material { name = "stone", density = 2000, kn = kn }
box { name = "base", size = { 6, 2, 0.2 }, at = { -3, -1, -0.2 }, fixed = true }
box { name = "block", size = { 2 * b, 0.5, 2 * h }, at = { -b, -0.25, 0 } }
joint { law = dry { kn = kn, ks = 0.4 * kn, mu = 3 } }
local f = 2 * p / (2 * pi)
ground_motion { wave = half_sine { amplitude = amplitude * g * alpha, frequency = f }, direction = "x" }
bisect { param = "amplitude", name = "least", lo = 1.4, hi = 2.2, rel = bracket }
-- The load presses the toe in: 1.9 (4/9 d0 h / b^2)^(1/3).
expect("metrics.least", 1.8667386, { rel = 0.04, source = "exact equation of the rigid block" })
-- Near the threshold the block lingers on its edge: the time to fall grows by 1 / p with each e-th part of the distance.
analysis { duration = 0.5 / f + 10 / p, start = "rest", output_dt = 5e-3, frame_dt = 0.5, stop_after_collapse = 0.01, energy_gate = 1 }
