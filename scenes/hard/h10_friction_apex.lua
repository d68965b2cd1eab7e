-- H10: friction at the apex of its cone: pressure on a sliding joint falls to zero and returns.
--
-- What happens   Prescribed motions move blocks up and down through zero pressure (one block just touches it, one separates). At another
--                frequency they slide along the joint; reversals occur before, at and after the instants without pressure. There the cone
--                is a point: no limit, no direction, nothing to divide by. Forces must stay finite and inside the cone. In one step they
--                may change only by the increments of the springs.
-- Source         Coulomb: |T| <= mu N, T = 0 where N = 0; |dT| <= ks A |du| + mu kn A |dw|.
-- How to run     erbs run scenes/hard/h10_friction_apex.lua [-D kn=...] [-D mu=...] [-D steps=...]
-- What to look at  beyond_cone_*: over the greatest mu N; jump_*: largest change of the shear force over its bound.
local kn, mu = param("kn", 1e9, "[Pa/m]"), param("mu", 0.6, "friction")
local steps = param("steps", 20000, "of the run")
local depth = param("depth", 2e-6, "of the deepest pressure [m]")
label("fixed_dt")
gravity(0)
material { name = "brick", density = 1800 }
joint { law = dry { kn = kn, ks = 0.4 * kn, mu = mu } }
local dt = 1e-5
local l, w, time = 0.3, 0.125, steps * dt
local area, slow, fast = l * w, 5 / time, 13 / time  -- Hz
local slide = 4 * mu * depth / 0.4                   -- m, well beyond the elastic slip of the springs
for i, case in ipairs { { lift = 1, phase = 0 }, { lift = 1, phase = 0.4 }, { lift = 1.5, phase = -0.4 }, { lift = 1.5, phase = 1.2 } } do
  local name, base = "block" .. i, "base" .. i
  box { name = base, group = base, size = { l, w, 0.1 }, at = { 2 * i, 0, -0.1 }, fixed = true }
  box { name = name, group = name, size = { l, w, 0.1 }, at = { 2 * i, 0, 0 } }
  -- height -depth + lift depth (1 - cos) / 2: from -depth to (lift - 1) depth
  motion { block = name, direction = "z", wave = (case.lift / 2 - 1) * depth }
  motion { block = name, direction = "z", wave = sine { amplitude = -case.lift / 2 * depth, frequency = slow, phase = 90 * deg } }
  motion { block = name, direction = { 2, 1, 0 }, wave = sine { amplitude = slide, frequency = fast, phase = case.phase } }
  recorder { name = name, quantity = "normal_force", blocks = { base }, others = { name } }
  recorder { name = name, quantity = "shear_force", blocks = { base }, others = { name } }
  local most = kn * area * depth
  metric("beyond_cone_" .. i, "", function(run)
    local N, T, worst = run.history(name .. "_normal_N"), run.history(name .. "_shear_N"), 0
    for k = 1, #N do
      local beyond = T[k] - mu * math.max(0, -N[k])
      if not (beyond < 1e300) then return 1 / 0 end
      worst = math.max(worst, beyond)
    end
    return worst / (mu * most)
  end)
  metric("jump_" .. i, "", function(run)
    local T, worst = run.history(name .. "_shear_N"), 0
    for k = 3, #T do worst = math.max(worst, math.abs(T[k] - T[k - 1])) end
    return worst / (2 * math.pi * dt * area * (0.4 * kn * slide * fast + mu * kn * case.lift / 2 * depth * slow))
  end)
  -- Radial return is exact: only round-off of the forces remains.
  expect("metrics.beyond_cone_" .. i, 1e-9, { below = true, source = "|T| <= mu N" })
  expect("metrics.jump_" .. i, 1.0001, { below = true, source = "|dT| <= ks A |du| + mu kn A |dw|" })
end
analysis { duration = time, dt = dt, output_dt = dt, start = "rest" }
expect("status", "completed")
