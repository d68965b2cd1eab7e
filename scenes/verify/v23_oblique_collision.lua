-- V23: bodies meet obliquely and off centre in free space
--
-- What happens   Pairs of bodies of several shapes tumble into each other: face, edge and corner, with friction, impact damping and spin.
--                Each gains the linear and angular momentum that the other loses, to round-off, and the ledger books all the energy.
-- Source         conservation of momentum of an isolated system
-- How to run     erbs run scenes/verify/v23_oblique_collision.lua [-D seed=...] [-D restitution=...] [-D friction=...]
-- What to look at  momentum_error, spin_error (over the sums of the magnitudes), met (share of the pairs that have met)
label("quick")
local seed = param("seed", 1, "of poses and velocities")
local e = param("restitution", 0.4, "")
local mu = param("friction", 0.5, "")
local kn = param("kn", 5e9, "[Pa/m]")
local fraction = param("fraction", 0.5, "of the step's bound")
gravity(0)
material { name = "stone", density = 2000, kn = kn, ks = 0.4 * kn, restitution = e, friction = mu }
local state = seed * 7919 + 12345
local function random()
  state = (state * 1103515245 + 12345) % 2147483648
  return 2 * state / 2147483648 - 1
end
local function vector(a) return { a * random(), a * random(), a * random() } end
local function ring(n, r, z)
  local out = {}
  for i = 1, n do out[i] = { r * math.cos(2 * pi * i / n), r * math.sin(2 * pi * i / n), z } end
  return out
end
local function make(shape, name, at, velocity)
  local initial = { velocity = velocity, spin = vector(8), rotation = vector(2) }
  if shape == "brick" then box { name = name, size = { 0.3, 0.125, 0.1 }, center = at, free = true, initial = initial } end
  if shape == "cube" then box { name = name, size = { 0.1, 0.1, 0.1 }, center = at, free = true, initial = initial } end
  if shape == "plate" then box { name = name, size = { 0.4, 0.3, 0.03 }, center = at, free = true, initial = initial } end
  if shape == "wedge" or shape == "drum" then
    local points = shape == "wedge" and { { -0.15, -0.06, -0.05 }, { 0.15, -0.06, -0.05 }, { 0.15, 0.06, -0.05 }, { -0.15, 0.06, -0.05 },
      { 0.1, -0.06, 0.08 }, { 0.1, 0.06, 0.08 } } or ring(9, 0.1, -0.1)
    if shape == "drum" then for _, p in ipairs(ring(9, 0.08, 0.1)) do points[#points + 1] = p end end
    for _, p in ipairs(points) do for i = 1, 3 do p[i] = p[i] + at[i] end end
    block { name = name, vertices = points, free = true, initial = initial }
  end
end
local shapes, names = { "brick", "cube", "plate", "wedge", "drum" }, {}
for i, a in ipairs(shapes) do
  for k = i, #shapes do
    local name, middle = a .. "_" .. shapes[k], { 0, 0, 3 * #names }
    names[#names + 1] = name
    local way = vector(0.3)
    make(a, name .. "_a", { middle[1] - 0.3, middle[2], middle[3] }, { 3, way[2], way[3] })
    make(shapes[k], name .. "_b", { middle[1] + 0.3, middle[2] + 0.03, middle[3] - 0.02 }, { -3, -way[2], way[3] })
    for _, quantity in ipairs { "momentum", "angular_momentum" } do
      for _, which in ipairs { "_a", "_b" } do
        recorder { name = name .. which, quantity = quantity, block = name .. which, point = middle }
      end
    end
  end
end
local function error_of(column)
  return function(run)
    local worst = 0
    for _, name in ipairs(names) do
      local change, size = 0, 0
      for _, axis in ipairs { "x", "y", "z" } do
        local a, b = column:format(name .. "_a", axis), column:format(name .. "_b", axis)
        change = change + (run.last(a) + run.last(b) - run.first(a) - run.first(b)) ^ 2
        size = size + run.first(a) ^ 2 + run.first(b) ^ 2
      end
      worst = math.max(worst, math.sqrt(change / size))
    end
    return worst
  end
end
metric("momentum_error", "", error_of("%s_p%s_kg_m_s"))
metric("spin_error", "", error_of("%s_L%s_kg_m2_s"))
metric("met", "", function(run)
  local n = 0
  for _, name in ipairs(names) do
    local p = name .. "_a_px_kg_m_s"
    if math.abs(run.last(p) - run.first(p)) > 0.05 * math.abs(run.first(p)) then n = n + 1 end
  end
  return n / #names
end)
-- The run ends soon after all have met: free flight adds x = x + dt v, whose rounding error repeats and grows with the number of steps.
analysis { duration = 0.13, dt_fraction = fraction, start = "rest", output_dt = 0.01, frame_dt = 0.13 }
expect("metrics.momentum_error", 1e-12, { below = true, source = "action and reaction" })
expect("metrics.spin_error", 1e-12, { below = true, source = "action and reaction, along one line" })
expect("metrics.met", 0.8, { above = true, source = "the pairs are aimed at each other" })
expect("energy.residual_relative", 1e-2, { below = true, source = "gate of collapses" })
