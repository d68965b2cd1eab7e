-- Hard case: faces that are parallel to within round-off
--
-- What happens   Bricks lie on slabs, flush with their edges or not, rotated by 0, 1e-12 and 1e-9 about each axis, on contact only. With
--                contact points, their number would flicker and the force would jump. The force of an overlap area changes as little as the
--                pose.
-- Source         weight
-- How to run     erbs run scenes/hard/h04_parallel_faces.lua
-- What to look at  jump (largest change of the force on a slab in one step, over the weight), force_error (of all bricks at the end), moved
-- Tolerance      The bricks start in equilibrium to round-off. Only the rotation remains: kn times 1e-9 x 0.15 m at most.
label("quick", "fixed_dt")
local kn = param("kn", 1e9, "[Pa/m]")
local size = { 0.3, 0.125, 0.1 }
local weight = 1800 * size[1] * size[2] * size[3] * g
gravity(g)
material { name = "stone", density = 1800, kn = kn, ks = 0.4 * kn, friction = 0.6, restitution = 0.2 }
local sunk, names = weight / (kn * size[1] * size[2]), {}
for o, offset in ipairs { { 0, 0 }, { 1, 0 }, { 0, 1 }, { 1, 1 }, { 0.37, 0.21 } } do  -- 1: flush with the edge of the slab
  for e, angle in ipairs { 0, 1e-12, 1e-9 } do
    for axis = 1, 3 do
      local name, at, turn = ("b%d_%d_%d"):format(o, e, axis), { 2 * o, 2 * e, 2 * axis }, { 0, 0, 0 }
      turn[axis] = angle
      box { name = name .. "_slab", size = { 0.6, 0.5, 0.1 }, center = { at[1], at[2], at[3] - 0.05 }, fixed = true }
      box { name = name, size = size, free = true,
        center = { at[1] + offset[1] * (0.6 - size[1]) / 2, at[2] + offset[2] * (0.5 - size[2]) / 2, at[3] + size[3] / 2 },
        initial = { position = { 0, 0, -sunk }, rotation = turn } }
      names[#names + 1] = name
      recorder { name = name, quantity = "reaction", block = name, axis = "z" }
      recorder { name = name .. "_at", quantity = "displacement", block = name }
    end
  end
end
metric("jump", "", function(run)
  local worst = 0
  for _, name in ipairs(names) do
    local f = run.history(name .. "_fz_N")
    for i = 2, #f - 1 do worst = math.max(worst, math.abs(f[i] - f[i - 1])) end
  end
  return worst / weight
end)
metric("force_error", "", function(run)
  local worst = 0
  for _, name in ipairs(names) do worst = math.max(worst, math.abs(run.last(name .. "_fz_N") / weight - 1)) end
  return worst
end)
metric("moved", "", function(run)  -- sideways, over the smallest edge
  local worst = 0
  for _, name in ipairs(names) do
    worst = math.max(worst, math.abs(run.last(name .. "_at_ux_rel_m")), math.abs(run.last(name .. "_at_uy_rel_m")))
  end
  return worst / size[3]
end)
analysis { duration = 0.01, dt = 2e-5, start = "rest", output_dt = 2e-5, frame_dt = 0.02 }
expect("metrics.jump", 0.05, { below = true, source = "hard case 4" })
expect("metrics.force_error", 0.05, { below = true, source = "weight, and the turns" })
expect("metrics.moved", 1e-6, { below = true, source = "nothing pushes across" })
