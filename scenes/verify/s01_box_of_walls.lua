-- S01: four mitred walls without a ring fall like Housner's block; under a ring they withstand more, whatever roof it carries.
--
-- What happens   Bisection finds the least amplitude of a sine at which a wall of box_lintel.lua has turned by alpha when the acceleration first
--                vanishes (its own run: case 2 just above it): without the ring at four frequencies beside the exact equation of the rocking block; under the ring, under the ring
--                with a roof and with three roofs; in both directions; with both contacts of wall and base.
-- Source         P. J. S. Gomes (IST Lisbon), Figs. 9 and 10 and findings (i) to (vi): case 1 close to Housner, cases 2 to 4 above it everywhere,
--                cases 3 and 4 close to 2, both methods and both directions alike, the wall across the motion falls first. Curve: rocking_overturning.
-- How to run     erbs run scenes/verify/s01_box_of_walls.lua
-- What to look at  figures/relation.svg; alone_w and ring_w: a / (g alpha) at omega / p = w
label("quick")
local build, beds = include "parts/box_of_walls.lua", include "parts/calibrated_beds.lua"

-- Each study changes the param of its own name; its runs see from it which box to build.
local frequencies, unchanged, cases, chosen = { 0.5, 1, 1.5, 2 }, -1, {}, nil
local function case(name, keys, lo, hi)
  local at = param(name, unchanged, "a / (g alpha)")
  local one = { name = name, keys = keys, lo = lo, hi = hi }
  one.keys.amplitude, one.keys.beds = at, beds
  cases[#cases + 1] = one
  if at ~= unchanged then chosen = one end
end
local function tag(w) return string.format("%g", 10 * w) end
for i, w in ipairs(frequencies) do
  local least, most = ({ 0.95, 1.2, 1.6, 2.1 })[i], ({ 1.25, 1.6, 2.1, 2.8 })[i]
  case("alone_" .. tag(w), { case = 1, omega = w }, least, most)
  case("ring_" .. tag(w), { case = 2, omega = w }, 1.3 * least, 1.75 * most)
  if w == 1 or w == 2 then
    case("roof_" .. tag(w), { case = 3, omega = w }, 1.3 * least, 1.75 * most)
    case("roofs_" .. tag(w), { case = 4, omega = w }, 1.3 * least, 1.75 * most)
  end
end
case("alone_y", { case = 1, omega = 1, direction = "y" }, 1.2, 1.6)
case("ring_y", { case = 2, omega = 1, direction = "y" }, 1.56, 2.8)
case("alone_damped", { case = 1, omega = 1, method = 2 }, 1.2, 1.6)
case("ring_damped", { case = 2, omega = 1, method = 2 }, 1.56, 2.8)
local box = build(chosen and chosen.keys or { case = 2, omega = 1, amplitude = 2.3, beds = beds })  -- the scene's own run: just above the least amplitude
for _, one in ipairs(cases) do
  bisect { param = one.name, name = "least_" .. one.name, lo = one.lo, hi = one.hi, rel = 0.005, points = 1, collapsed_when = box.collapsed }
end

local function least(run, name) return run.metrics.metrics["least_" .. name] end
local theory, alone, ring = {}, {}, {}
for i, w in ipairs(frequencies) do
  theory[i] = rocking_overturning { width = 0.6, height = 3, criterion = "alpha_at_end", from = 0.9, to = 5, points = 50,
    wave = half_sine { amplitude = 9.8 * box.alpha, frequency = w * box.p / (2 * pi) } }.lowest
  alone[i], ring[i] = "least_alone_" .. tag(w), "least_ring_" .. tag(w)
  metric("alone_over_theory_" .. tag(w), "", function(run) return least(run, "alone_" .. tag(w)) / theory[i] end)
  metric("ring_over_alone_" .. tag(w), "", function(run) return least(run, "ring_" .. tag(w)) / least(run, "alone_" .. tag(w)) end)
  -- 10 %: the centroid of a mitred wall lies 6 % of half its width nearer to the outer edge, and the toe sinks into the bed.
  expect("metrics.alone_over_theory_" .. tag(w), 1, { rel = 0.1, source = "exact equation, theta = alpha at the end of the half sine" })
  expect("metrics.ring_over_alone_" .. tag(w), 1.2, { above = true, source = "Gomes, Figs. 9 and 10: above case 1 everywhere" })
end
for _, of in ipairs { { "roof", 0.05 }, { "roofs", 0.05 } } do
  for _, w in ipairs { 1, 2 } do
    local name = of[1] .. "_over_ring_" .. tag(w)
    metric(name, "", function(run) return least(run, of[1] .. "_" .. tag(w)) / least(run, "ring_" .. tag(w)) end)
    expect("metrics." .. name, 1, { rel = of[2], source = "Gomes: cases 3 and 4 do not differ much from 2" })
  end
end
for _, of in ipairs { "alone", "ring" } do
  metric(of .. "_y_over_x", "", function(run) return least(run, of .. "_y") / least(run, of .. "_10") end)
  expect("metrics." .. of .. "_y_over_x", 1, { rel = 0.01, source = "the plan is symmetric; 0.5 % is the width of a bracket" })
  metric(of .. "_damped", "", function(run) return least(run, of .. "_damped") / least(run, of .. "_10") end)
  expect("metrics." .. of .. "_damped", 1, { rel = 0.03, source = "Gomes: both methods of calibration give similar curves" })
end
for _, which in ipairs { "front", "back", "side" } do metric("turn_" .. which, "", function(run) return box.turn(run, which) end) end
expect("metrics.turn_front", 1, { above = true, source = "the wall across the motion falls first" })
expect("metrics.turn_back", 1, { below = true, source = "the wall opposite turns less" })
expect("metrics.turn_side", 1, { below = true, source = "the walls along the motion stand" })
figure { name = "relation", title = "Four mitred walls under a sine: alone and under a ring", x = "omega / p", y = "a / (g alpha)",
  curves = { { label = "theta = alpha at the end, exact equation", x = frequencies, y = theory }, { label = "walls alone", x = frequencies, metrics = alone },
    { label = "under a ring", x = frequencies, metrics = ring } } }
