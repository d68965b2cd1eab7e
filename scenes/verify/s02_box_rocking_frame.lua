-- S02: what holds the ring of the box? Without friction on the walls along the motion, and without their mitres, a rocking frame remains.
--
-- What happens   Bisection finds the least amplitude at which a wall has turned by alpha when the acceleration first vanishes, as in S01: of the
--                whole box; with a ring that does not rub on the walls along the motion (smooth); and without their mitres as well (frame), so
--                that two walls and the ring rock alone. The frame follows theory. It explains why the mass of the ring hardly matters, not why
--                the ring helps at low frequencies: that comes from the walls along the motion, most of it through their mitres, which wedge the
--                wall at the back.
-- Source         Makris and Vassiliou 2013 (EESD 42, 371): columns under a beam rock like one block of p_hat = p sqrt((1 + 2 gamma) / (1 + 3 gamma)),
--                gamma the mass of the beam over that of the columns; exact equation by rocking_overturning.
-- How to run     erbs run scenes/verify/s02_box_rocking_frame.lua
-- What to look at  frame_over_theory_*; smooth_over_whole_*, smooth_over_frame_*
local build, beds = include "parts/box_of_walls.lua", include "parts/calibrated_beds.lua"
local unchanged, cases, chosen = -1, {}, nil
local function case(name, keys, lo, hi)
  keys.amplitude, keys.beds = param(name, unchanged, "a / (g alpha)"), beds
  cases[#cases + 1] = { name = name, keys = keys, lo = lo, hi = hi }
  if keys.amplitude ~= unchanged then chosen = keys end
end
for _, w in ipairs { 0.5, 1, 2 } do
  local tag = string.format("%g", 10 * w)
  local most = ({ [0.5] = 1.3, [1] = 1.7, [2] = 3.2 })[w]
  case("frame_" .. tag, { case = 2, omega = w, side_friction = 0, mitre_kn = 1e3 }, 0.75 * most, most)
  case("heavy_" .. tag, { case = 4, omega = w, side_friction = 0, mitre_kn = 1e3 }, 0.75 * most, most)
  case("smooth_" .. tag, { case = 2, omega = w, side_friction = 0 }, most, 1.5 * most)
  case("whole_" .. tag, { case = 2, omega = w }, most, 1.5 * most)
end
local box = build(chosen or { case = 2, omega = 1, side_friction = 0, amplitude = 2.3, beds = beds })
for _, one in ipairs(cases) do
  bisect { param = one.name, name = "least_" .. one.name, lo = one.lo, hi = one.hi, rel = 0.005, points = 1, collapsed_when = box.collapsed }
end
local wall, ring = 1800 * 0.6 * 3 * 3.4, { frame = 2551.02 * 0.6 * 0.7 * 13.6, heavy = 5123.48 * 0.6 * 0.7 * 13.6 }  -- kg
for _, w in ipairs { 0.5, 1, 2 } do
  local tag = string.format("%g", 10 * w)
  local function least(run, name) return run.metrics.metrics["least_" .. name .. "_" .. tag] end
  for name, mass in pairs(ring) do
    local gamma = mass / (2 * wall)
    local theory = rocking_overturning { alpha = box.alpha, p = box.p * math.sqrt((1 + 2 * gamma) / (1 + 3 * gamma)), criterion = "alpha_at_end", from = 0.9,
      to = 5, points = 50, wave = half_sine { amplitude = 9.8 * box.alpha, frequency = w * box.p / (2 * pi) } }.lowest
    metric(name .. "_over_theory_" .. tag, "", function(run) return least(run, name) / theory end)
    -- 10 %, as for walls alone (S01): the centroid of a mitred wall lies nearer to the outer edge, and toes sink in at the base and under the ring.
    expect("metrics." .. name .. "_over_theory_" .. tag, 1, { rel = 0.1, source = "Makris and Vassiliou 2013" })
  end
  metric("smooth_over_whole_" .. tag, "", function(run) return least(run, "smooth") / least(run, "whole") end)
  metric("smooth_over_frame_" .. tag, "", function(run) return least(run, "smooth") / least(run, "frame") end)
  expect("metrics.smooth_over_whole_" .. tag, 1, { below = true, source = "friction on the walls along the motion holds the ring" })
  expect("metrics.smooth_over_frame_" .. tag, 1.1, { above = true, source = "so does the wedged wall at the back" })
end
