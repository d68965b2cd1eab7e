-- Hard case: stacks of plates just below the friction limit, each on its own slope
--
-- What happens   28 stacks of five plates stand on slopes at 0.985 of the friction limit. The slopes face all directions, and the joints
--                are soft to stiff. Along and across the plates Newton's method finds the equilibrium. In oblique directions friction
--                leaves no equilibrium that one step from zero can reach: a damped ramp brings these stacks to rest, while the others keep
--                their state. Then nothing may move.
-- Source         Coulomb: a stack below the limit stays
-- How to run     erbs run scenes/hard/h27_stacks_on_slopes.lua [-D share=1.02] [-D past=9: that one alone slides]
-- What to look at  drift, of the top plates over their size, 1/s, once what the start had disturbed has come to rest (0.2 s); moved, over their size, in all.
local mu, share, past = param("mu", 0.6), param("share", 0.985, "of the friction limit"), param("past", 0, "number of a stack at 1.02 of it")
local stacks, length = 28, 0.4
material { name = "brick", density = 1800 }
for i = 1, stacks do
  local id, way = "s" .. i, 2 * math.pi * (i - 1) / stacks
  local slope = math.atan(mu * (i == past and 1.02 or share))
  transform { rotation = { math.sin(way) * slope, math.cos(way) * slope, 0 }, at = { 2 * (i % 7), 2 * (i // 7), 0 }, function()
    box { name = id .. "_base", group = id, size = { 0.6, 0.4, 0.1 }, at = { -0.1, -0.1, -0.1 }, fixed = true, material = "brick" }
    for c = 1, 5 do box { name = id .. "_" .. c, group = id, size = { length, 0.2, 0.05 }, at = { 0, 0, (c - 1) * 0.05 }, material = "brick" } end
  end }
  joint { between = { id, id }, law = dry { kn = 10 ^ (10 + (i - 1) / (stacks - 1)), mu = mu } }
  recorder { name = "top" .. i, quantity = "displacement", block = id .. "_5" }
end
-- The farthest way of a top plate since a time, over its size.
local function way(run, since)
  local most, row, times = 0, 1, run.time
  while times[row] < since do row = row + 1 end
  for i = 1, stacks do
    for _, axis in ipairs { "x", "y", "z" } do
      local u = run.history("top" .. i .. "_u" .. axis .. "_rel_m")
      if i ~= past then most = math.max(most, math.abs(u[#u] - u[row])) end
    end
  end
  return most / length
end
metric("moved", "", function(run) return way(run, 0) end)
metric("drift", "1/s", function(run) return way(run, 0.2) / (run.time_s - 0.2) end)
analysis { duration = 2, frame_dt = 0.2 }
expect("metrics.moved", 1e-5, { below = true, source = "Coulomb" })
expect("metrics.drift", 1e-6, { below = true, source = "Coulomb" })
expect("collapse.under_gravity", false)
expect("collapse.fallen_fraction", past > 0 and 1 / stacks or 0, { abs = 1e-9, source = "the one that is past its limit" })
expect("momentum_residual", 1e-9, { below = true, source = "Newton's third law" })
expect("status", "completed")
