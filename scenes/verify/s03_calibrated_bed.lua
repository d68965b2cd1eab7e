-- S03: a wall on the calibrated contacts of the box rocks like Housner's block.
--
-- What happens   Two walls are tilted by .05 rad and released: one whose whole face stands on the contact of method 1, stiffness and friction without
--                damping, and one on feet with the contact of method 2, stiffness and damping. Impacts and peaks stand beside Housner's.
-- Source         Housner 1963, exact equation; methods: P. J. S. Gomes (IST Lisbon), 2.2 and 2.3. A damping ratio of .362 has been fitted; formula (15)
--                of Pena et al. as he prints it gives .390.
-- How to run     erbs run scenes/verify/s03_calibrated_bed.lua
-- What to look at  rms_1, rms_2: of the distances of six times over the last of them, and of six peaks over the first of them
label("quick")
local beds = include "parts/calibrated_beds.lua"
local width, height, depth, density, theta, impacts = 0.6, 3, 4, 1800, 0.05, 6
local theory = rocking { width = width, height = height, theta = theta, duration = 6 }
for method, bed in ipairs(beds) do
  local name, y = "wall_" .. method, 8 * method
  material { name = name, density = density, kn = bed.kn, ks = bed.ks, friction = bed.mu, restitution = bed.restitution }
  box { name = "base_" .. method, material = name, fixed = true, size = { 4 * height, 1.5 * depth, 0.4 }, center = { 0, y, -0.2 } }
  local initial = { rotation = { 0, theta, 0 }, about = { width / 2, y, 0 } }
  if method == 2 then footed_block { name = name, material = name, free = true, size = { width, depth, height }, at = { 0, y, 0 }, initial = initial }
  else box { name = name, material = name, free = true, size = { width, depth, height }, at = { -width / 2, y - depth / 2, 0 }, initial = initial } end
  recorder { name = name, quantity = "rotation", block = name, axis = "y" }
  metric("rms_" .. method, "", function(run)
    local turn, t, sum, n, peak = run.history(name .. "_ry_rad"), run.time, 0, 0, 0
    for i = 2, #turn do
      if turn[i - 1] * turn[i] < 0 and n <= impacts then
        if n > 0 then sum = sum + ((peak / theory.alpha - theory.amplitudes[n + 1]) / theory.amplitudes[2]) ^ 2 end
        n, peak = n + 1, 0
        local at = t[i - 1] + (t[i] - t[i - 1]) * turn[i - 1] / (turn[i - 1] - turn[i])
        if n <= impacts then sum = sum + ((at - theory.impacts[n]) / theory.impacts[impacts]) ^ 2 end
      end
      peak = math.max(peak, math.abs(turn[i]))
    end
    return n > impacts and math.sqrt(sum / (2 * impacts)) or nil
  end)
end
analysis { duration = theory.impacts[impacts + 1] + 0.1, start = "rest", output_dt = 1e-3, frame_dt = 0.1 }
-- 3 %: undamped impacts of a whole face tremble, and another step gives other ones; 1 %: feet of .8 % of the width.
expect("metrics.rms_1", 0.03, { below = true, source = "Housner 1963" })
expect("metrics.rms_2", 0.01, { below = true, source = "Housner 1963" })
