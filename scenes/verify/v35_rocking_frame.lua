-- V35: two columns under a beam rock like one block with a smaller p.
--
-- What happens   The columns stand tilted by theta and carry the beam on their upper corners. Released, they reach their first impact after
--                a quarter of the period of a block of their alpha. This block has p_hat = p sqrt((1 + 2 gamma) / (1 + 3 gamma)), gamma the
--                mass of the beam over that of the columns. A heavier beam is slower, but never below 0.816 p.
-- Source         Makris and Vassiliou 2013 (EESD 42, 371); exact equation by rocking{ p = p_hat }.
-- How to run     erbs run scenes/verify/v35_rocking_frame.lua [-D phi=0.3] [-D columns=4]
-- What to look at  quarter_*: time of the first impact over the formula, for several masses of the beam.
label("quick")
local width, height, phi = param("width", 0.5, "of a column [m]"), param("height", 3, "[m]"), param("phi", 0.5, "tilt over alpha")
local columns = param("columns", 2, "their number")
local kn = param("kn", 5e10, "[Pa/m]")
local depth, density, pitch, thickness = 0.5, 2000, 2, 0.5
local alpha, theta = math.atan(width / height), phi * math.atan(width / height)
local length = (columns - 1) * pitch + width

joint { law = dry { kn = kn, mu = 1 }, none = true }
material { name = "stone", density = density, kn = kn, ks = 0.4 * kn, friction = 1, restitution = 0.2 }
box { name = "floor", size = { 3 * length, 40, 1 }, at = { -length, -5, -1 }, fixed = true, material = "stone" }
local p = rocking { width = width, height = height, duration = 1 }.p
local longest = 0
for i, gamma in ipairs { 0.25, 1, 4 } do
  local y, beam = 2 * i, "beam" .. i
  material { name = "beam_" .. i, density = gamma * columns * density * width * height / (length * thickness), kn = kn, ks = 0.4 * kn, friction = 1, restitution = 0.2 }
  for c = 1, columns do
    local x = (c - 1) * pitch
    box { name = string.format("column%d_%d", i, c), size = { width, depth, height }, at = { x, y, 0 }, free = true, material = "stone",
      initial = { rotation = { 0, theta, 0 }, about = { x + width, y, 0 } } }
  end
  -- The upper left corner, which carries the beam, rotates about the lower right corner.
  local dx = -width * math.cos(theta) + height * math.sin(theta) + width
  local dz = width * math.sin(theta) + height * math.cos(theta) - height
  box { name = beam, size = { length, depth, thickness }, at = { 0, y, height }, free = true, material = "beam_" .. i, initial = { position = { dx, 0, dz } } }
  recorder { name = beam, quantity = "rotation", block = string.format("column%d_1", i), axis = "y" }
  local theory = rocking { alpha = alpha, p = p * math.sqrt((1 + 2 * gamma) / (1 + 3 * gamma)), theta = theta, duration = 5 }
  longest = math.max(longest, theory.impacts[1])
  metric("quarter_" .. i, "", function(run) return run.crossings(beam .. "_ry_rad", 0)[1] / theory.impacts[1] end)
  -- 3 %: toes sink in at both ends of every column.
  expect("metrics.quarter_" .. i, 1, { rel = 0.03, source = "Makris and Vassiliou 2013" })
end
analysis { duration = 1.1 * longest, start = "rest", dt = param("dt", 4e-5), output_dt = 2e-3, frame_dt = 0.05 }
