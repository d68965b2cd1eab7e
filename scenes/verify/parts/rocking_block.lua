-- A block that rocks on two narrow feet, like test blocks with a slightly hollow base, with the solution of Housner's equations.
--
-- A flat full base on springs does not give Housner's impact, because the impact is spread over the face (measured: phi_1 0.454 to 0.488
-- for the Pena block with any dashpot, Housner 0.386). Feet of a hundredth of the width bring the impact to the edges. Stiffness:
-- `settlement` is that of the full base under the weight of the block over half the width, d0 / b, so kn = density g height / d0. While the
-- block rocks, its toe is pressed in over a length of sqrt(2 N / (kn depth theta)); its centre of pressure lies inside the edge
-- accordingly.
local rocking_blocks = 0

return function(keys)
  rocking_blocks = rocking_blocks + 1
  local name, width, height = keys.name, keys.width, keys.height
  local b, depth, density = width / 2, keys.depth or width, keys.density or 2500
  local kn = density * g * height / ((keys.settlement or 1.7e-6) * b)
  local at = keys.at or { 0, rocking_blocks * 2 * depth }
  local theory = rocking { width = width, height = height, theta = keys.theta or 0, duration = keys.duration, wave = keys.wave }
  local stone = "stone_" .. name
  material { name = stone, density = density, kn = kn, ks = 0.4 * kn, friction = 2, restitution = keys.restitution or 0.24 }
  box { name = "base_" .. name, material = stone, fixed = true, size = { 6 * height, 1.5 * depth, height / 2 }, at = { at[1] - 3 * height, at[2] - 0.75 * depth, -height / 2 } }
  local turned = keys.theta and { rotation = { 0, keys.theta, 0 }, about = { at[1] + b, at[2], 0 } }
  footed_block { name = name, material = stone, free = true, initial = turned, size = { width, depth, height }, at = { at[1], at[2], 0 }, foot = keys.foot or 0.008 }
  recorder { name = name, quantity = "rotation", block = name, axis = "y" }
  local column = name .. "_ry_rad"

  -- Times of impacts, and the greatest |theta| / alpha before the first, between the first and the second, ...
  local function impacts(run)
    local theta, t, times, peaks, peak = run.history(column), run.time, {}, {}, 0
    for i = 1, #theta do
      if i > 1 and theta[i - 1] * theta[i] < 0 then
        times[#times + 1] = t[i - 1] + (t[i] - t[i - 1]) * theta[i - 1] / (theta[i - 1] - theta[i])
        peaks[#peaks + 1], peak = peak / theory.alpha, 0
      end
      peak = math.max(peak, math.abs(theta[i]))
    end
    peaks[#peaks + 1] = peak / theory.alpha
    return times, peaks
  end
  return { name = name, theory = theory, column = column, impacts = impacts, kn = kn }
end
