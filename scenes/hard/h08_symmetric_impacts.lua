-- Hard case: many contacts at the same instant
--
-- What happens   A brick, a cube and a plate drop flat and must not start to spin. A cube runs into a row of touching cubes. A heap and its
--                mirror image fall apart side by side. A scheme that treats contacts one after another depends on their order; here there
--                is no order.
-- Source         symmetry
-- How to run     erbs run scenes/hard/h08_symmetric_impacts.lua [-D fraction=0.9]
-- What to look at  spin_* (over sqrt(g / l)), cradle_across (m/s, across the row), mirror_error (m)
-- Tolerance      1e-9 of the angular speed sqrt(g / l); across the row only round-off. The heap is chaotic: the mirror image is followed
--                until round-off, 1e-16, has grown by a factor of 1e4 at most. Noise in the start breaks the symmetry. A face that lands
--                askew by the noise is thrown back by its springs, w = sqrt(kn / (density height)). During the flight, w times the flight
--                time, a hundred and more, multiplies the noise before the next touch. So dropped bodies are watched only until they fly
--                back, when they may spin with the noise times w.
label("quick")
local drop = math.sqrt(2 * 0.1 / g)  -- s
local fraction = param("fraction", 0.5, "of the step's bound")
local e = param("restitution", 0.5, "")
local kn = param("kn", 2e9, "[Pa/m]")
gravity(g)
material { name = "stone", density = 2000, kn = kn, ks = 0.4 * kn, friction = 0.4, restitution = e }
ground { size = 60, material = "stone" }
for i, size in ipairs { { 0.3, 0.125, 0.1 }, { 0.1, 0.1, 0.1 }, { 0.4, 0.3, 0.03 } } do
  local name = ({ "brick", "cube", "plate" })[i]
  box { name = name, size = size, at = { 2 * i, -size[2] / 2, 0.1 }, free = true }
  recorder { name = name, quantity = "spin", block = name }
  metric("spin_" .. name, "", function(run)
    local worst, noisy = 0, start_noise > 0
    for _, axis in ipairs { "x", "y", "z" } do
      for k, spin in ipairs(run.history(name .. "_w" .. axis .. "_rad_s")) do
        if not noisy or run.time[k] < drop * (1 + e) then worst = math.max(worst, math.abs(spin)) end
      end
    end
    return worst / math.sqrt(g / size[1])
  end)
  -- Rotations about two axes, and as much again from the sideways displacement that friction feels.
  expect("metrics.spin_" .. name, 1e-9 + 2 * math.sqrt(2) * start_noise * math.sqrt(kn / (2000 * size[3])) / math.sqrt(g / size[1]), { below = true, source = "hard case 8" })
end
local row = {}
for i = 0, 5 do
  local name = "row" .. i
  box { name = name, size = { 0.1, 0.1, 0.1 }, at = { (i == 0 and -0.12 or 0.1 * i), 5, 0 }, free = true, initial = { velocity = { i == 0 and 1 or 0, 0, 0 } } }
  recorder { name = name, quantity = "velocity", block = name }
  row[#row + 1] = name
end
metric("cradle_across", "", function(run)
  local worst = 0
  for _, name in ipairs(row) do worst = math.max(worst, run.peak(name .. "_vy_rel_m_s")) end
  return worst
end)
-- Faces displaced by noise push with kn A times the noise, which gives a speed of w times it.
expect("metrics.cradle_across", 1e-9 + start_noise * math.sqrt(kn / (2000 * 0.1)), { below = true, source = "symmetry about the plane of the row" })
-- The heap and its mirror image in the plane x = 0: positions and rotations are mirrored block by block.
local heap = {}
for i = 1, 6 do
  local name = "heap" .. i
  local at, turn = { 0.12 * (i % 2), 0.05 * (i % 3), 0.3 * i }, { 0.3 * i, 0.2 * (i % 4), 0.5 * i }
  for _, side in ipairs { 1, -1 } do
    box { name = name .. (side > 0 and "r" or "l"), size = { 0.3, 0.125, 0.1 }, center = { side * (10 + at[1]), 10 + at[2], at[3] }, free = true,
      initial = { rotation = { turn[1], side * turn[2], side * turn[3] } } }
    recorder { name = name .. (side > 0 and "r" or "l"), quantity = "displacement", block = name .. (side > 0 and "r" or "l") }
  end
  heap[#heap + 1] = name
end
metric("mirror_error", "m", function(run)
  local worst = 0
  for _, name in ipairs(heap) do
    for axis, sign in pairs { x = -1, y = 1, z = 1 } do
      worst = math.max(worst, math.abs(run.at(name .. "r_u" .. axis .. "_rel_m", 0.3) - sign * run.at(name .. "l_u" .. axis .. "_rel_m", 0.3)))
    end
  end
  return worst
end)
expect("metrics.mirror_error", 1e-12 + 2e4 * start_noise, { below = true, source = "mirrored scene, mirrored result" })
analysis { duration = 0.6, dt_fraction = fraction, start = "rest", output_dt = 0.005, frame_dt = 0.6 }
expect("energy.residual_relative", 1e-2, { below = true, source = "gate" })
