-- A chain of n cubes joined by springs, without gravity, for the cases of the sequential scheme (V20, V20b). Included by other scenes.
--
-- spring_chain{ n, share, free, first_mode, drift, speed } makes the blocks b1..bn along x, between two fixed cubes unless `free`. Returns
-- mass, k, tau = sqrt(m / k), dt = share * 2 / omega_max, block_w2 = K_ii / m of an inner block and energy(run, row). Only the springs
-- along x carry load: the shear stiffness is a tenth, so that no other mode sets the step.
function spring_chain(o)
  local a, density, kn = o.side or 0.1, o.density or 2000, o.kn or 1e9
  local chain = { n = o.n, mass = density * a ^ 3, k = kn * a * a }
  chain.tau = math.sqrt(chain.mass / chain.k)
  -- omega_max = 2 / tau sin of n / (n + 1) pi/2 (ends held) or (n - 1) / n pi/2 (free)
  local last = o.free and (o.n - 1) / o.n or o.n / (o.n + 1)
  chain.dt_critical = chain.tau / math.sin(pi / 2 * last)
  chain.dt = o.share * chain.dt_critical
  chain.block_w2 = 2 * chain.k / chain.mass
  gravity(0)
  material { name = "stone", density = density }
  joint { law = mortar { kn = kn, ks = 0.1 * kn, ft = 1e9, c = 1e9, mu = 0.6 } }
  if not o.free then
    box { name = "left", size = { a, a, a }, center = { 0, 0, 0 }, fixed = true }
    box { name = "right", size = { a, a, a }, center = { a * (o.n + 1), 0, 0 }, fixed = true }
  end
  local number = 12345  -- noise for all modes (Park and Miller 1988)
  for i = 1, o.n do
    for _ = 1, 3 do number = 16807 * number % 2147483647 end
    local noise = 0.1 * (number / 2147483647 - 0.5)
    local v = o.drift or (o.speed or 1e-9) * (noise + (o.first_mode or 1) * math.sin(pi * i / (o.n + 1)))
    box { name = "b" .. i, size = { a, a, a }, center = { a * i, 0, 0 }, initial = { velocity = { v, 0, 0 } } }
    recorder { name = "b" .. i, quantity = "velocity", block = "b" .. i, axis = "x" }
    recorder { name = "b" .. i, quantity = "displacement", block = "b" .. i, axis = "x" }
  end
  -- Kinetic energy and elastic energy at a row of histories.csv.
  function chain.energy(run, row)
    local sum, before = 0, o.free and run.history("b1_ux_rel_m")[row] or 0
    for i = 1, o.n do
      local v, u = run.history("b" .. i .. "_vx_rel_m_s")[row], run.history("b" .. i .. "_ux_rel_m")[row]
      sum = sum + chain.mass * v * v / 2 + chain.k * (u - before) ^ 2 / 2
      before = u
    end
    return sum + (o.free and 0 or chain.k * before ^ 2 / 2)
  end
  -- Growth rate of the amplitude over the second half of the rows, times tau.
  function chain.growth(run)
    local last_row = #run.time
    local middle = (last_row + 1) // 2
    return chain.tau * math.log(chain.energy(run, last_row) / chain.energy(run, middle)) / 2 / (run.time[last_row] - run.time[middle])
  end
  -- Exact growth rate (times tau) of the literal sweep in a fixed order, ends held. Let z be the factor of a step, s^2 = z, h = dt / tau,
  -- and a = c dt of centred damping. The tridiagonal sweep has the eigenvalue equation (1 + a/2) z - 2 + (1 - a/2) / z + 2 h^2 (1 - s cos(j
  -- pi / (n + 1))) = 0, a quartic in s (compare Young's equation of successive over-relaxation, 1954, Trans. AMS 76, 92).
  function chain.exact_growth(c, dt)
    dt = dt or chain.dt
    local h, damped, largest = dt / chain.tau, (c or 0) * dt, 0
    for j = 1, o.n do
      local p = { 1 + damped / 2, -2 * h * h * math.cos(j * pi / (o.n + 1)), 2 * h * h - 2, 0, 1 - damped / 2 }
      local zr, zi = { 1, 0.4, -0.65, -0.62 }, { 0, 0.9, 0.72, -0.3 }  -- iteration of Durand and Kerner, complex by hand
      for _ = 1, 200 do
        for i = 1, 4 do
          local vr, vi, dr, di = 0, 0, p[1], 0
          for _, coefficient in ipairs(p) do vr, vi = vr * zr[i] - vi * zi[i] + coefficient, vr * zi[i] + vi * zr[i] end
          for other = 1, 4 do
            if other ~= i then
              local xr, xi = zr[i] - zr[other], zi[i] - zi[other]
              dr, di = dr * xr - di * xi, dr * xi + di * xr
            end
          end
          local size = dr * dr + di * di
          zr[i], zi[i] = zr[i] - (vr * dr + vi * di) / size, zi[i] - (vi * dr - vr * di) / size
        end
      end
      for i = 1, 4 do largest = math.max(largest, zr[i] ^ 2 + zi[i] ^ 2) end  -- |z| = |s|^2
    end
    return math.log(largest) / h
  end
  return chain
end
