-- P2: lowest frequency and decay of a cantilever wall of blocks.
--
-- What happens   A wall 3 m high and 0.3 m thick, cut into blocks with elastic joints, starts in its first mode. Its damping is 2 % of
--                critical. Blocks have d = 0.3 m by default, `unit` times that otherwise. Their joints have the stiffness E / d; the
--                lowest joint has twice that, because only half a block hangs on it.
-- Source         Timoshenko's beam, kappa 5/6: 8.45079 Hz; with 2 % of damping sqrt(1 - 0.02^2) of it, and its decay rate a / 2 for mass
--                damping a. With n points a side, midpoint joints are too
--                soft in bending by 1/n^2 and trapezoid joints too stiff by 2/(n - 1)^2: the error of f falls with n^-2. Blocks: d^2.
-- How to run     erbs accuracy scenes/accuracy/p2_cantilever.lua
-- What to look at  Order 2 of the step, of midpoints and of the block size, which is the knob; Simpson and Gauss are exact.
label("fine_points")
local unit = param("unit", 1, "size of the blocks over 0.3 m")
accuracy { param = "unit", name = "block size", values = { 2, 1, 0.5, 0.25, 0.125 } }
local L, t, B, E, nu, rho = 3.0, 0.3, 1.0, 5e9, 0.2, 2000
local d = 0.3 * unit
local n, f1 = math.floor(L / d + 0.5), 8.4507890
local kn, ks = E / d, 5 / 6 * E / (2 * (1 + nu)) / d
gravity(0)
material { name = "wall", density = rho }
box { name = "base", group = "base", size = { t, B, d }, at = { 0, 0, -d }, fixed = true }
-- The lowest mode of the blocks themselves, by inverse iteration (displacement and rotation of each block in turn). A start in Euler's mode
-- would also excite higher modes, and their zero crossings would hide the error of the step, which is 3e-6 at most.
local mass, inertia, shear, bending = rho * t * B * d, rho * t * B * d * (t * t + d * d) / 12, ks * t * B, kn * B * t ^ 3 / 12
local K = {}
for i = 1, 2 * n do
  K[i] = {}
  for j = 1, 2 * n do K[i][j] = 0 end
end
-- adds a spring of energy k (g . y)^2 / 2
local function spring(k, g)
  for i, a in pairs(g) do for j, b in pairs(g) do K[i][j] = K[i][j] + k * a * b end end
end
for i = 1, n do
  local x, r, stiff = 2 * i - 1, 2 * i, i == 1 and 2 or 1
  spring(stiff * shear, i == 1 and { [x] = 1, [r] = -d / 2 } or { [x] = 1, [r] = -d / 2, [x - 2] = -1, [r - 2] = -d / 2 })
  spring(stiff * bending, i == 1 and { [r] = 1 } or { [r] = 1, [r - 2] = -1 })
end
local function solve(b)  -- Gauss elimination, K positive definite
  local a, y = {}, {}
  for i = 1, 2 * n do a[i], y[i] = table.pack(table.unpack(K[i])), b[i] end
  for c = 1, 2 * n do
    for i = c + 1, math.min(2 * n, c + 4) do  -- bandwidth 4
      local f = a[i][c] / a[c][c]
      if f ~= 0 then
        for j = c, math.min(2 * n, c + 4) do a[i][j] = a[i][j] - f * a[c][j] end
        y[i] = y[i] - f * y[c]
      end
    end
  end
  for i = 2 * n, 1, -1 do
    for j = i + 1, math.min(2 * n, i + 4) do y[i] = y[i] - a[i][j] * y[j] end
    y[i] = y[i] / a[i][i]
  end
  return y
end
local shape = {}
for i = 1, n do shape[2 * i - 1], shape[2 * i] = (i / n) ^ 2, 2 * i / n / L end
for _ = 1, 25 do
  for i = 1, n do shape[2 * i - 1], shape[2 * i] = mass * shape[2 * i - 1], inertia * shape[2 * i] end
  shape = solve(shape)
  for i, y in ipairs(shape) do if i < 2 * n - 1 then shape[i] = y / shape[2 * n - 1] end end
  shape[2 * n], shape[2 * n - 1] = shape[2 * n] / shape[2 * n - 1], 1
end
for i = 1, n do
  local x, r = shape[2 * i - 1], shape[2 * i]
  box { name = "b" .. i, group = "wall", size = { t, B, d }, at = { 0, 0, (i - 1) * d }, initial = { velocity = { 1e-4 * x, 0, 0 }, spin = { 0, 1e-4 * r, 0 } } }
end
joint { law = mortar { kn = kn, ks = ks, ft = 1e9, c = 1e9, mu = 0.6 } }
joint { law = mortar { kn = 2 * kn, ks = 2 * ks, ft = 1e9, c = 1e9, mu = 0.6 }, between = { "base", "wall" } }
local a = 2 * 0.02 * 2 * pi * f1
damping { mass = a }
recorder { name = "top", quantity = "displacement", block = "b" .. n, axis = "x" }
local column = "top_ux_rel_m"
metric("frequency", "Hz", function(run) return 1 / run.period(column) end)
metric("decay", "1/s", function(run)
  local u, t_first, first, t_last, last = run.history(column), nil, nil, nil, nil
  for i = 2, #u - 1 do
    if u[i] > 0 and u[i] > u[i - 1] and u[i] >= u[i + 1] and u[i] > 1e-9 then
      if not first then first, t_first = u[i], run.time[i] end
      last, t_last = u[i], run.time[i]
    end
  end
  return math.log(first / last) / (t_last - t_first)
end)
-- With N = 10 blocks f is 0.45 % too low; Simpson's joints are exact.
expect("metrics.frequency", f1 * math.sqrt(1 - 0.02 ^ 2), { rel = 0.01, source = "Timoshenko, damped" })
expect("metrics.decay", a / 2, { rel = 0.02, source = "mass damping" })
analysis { duration = 10.3 / f1, start = "rest", output_dt = 1e-9, frame_dt = 1 }
