-- H14, third part: a block that slides far from its joint ends on soft debris contact, without a jump of force.
--
-- What happens   Blocks slide under their weight. Contact takes over from the joint with the stiffness of the former joint (stiff). When
--                they have moved on by 2 % of the side, the stiffness of debris (soft) takes over bit by bit. Force and friction continue
--                without a jump; in the end the softer contact gives way more.
-- Source         continuity; v^2 / (2 mu g); weight / (kn A) of the debris
-- How to run     erbs run scenes/hard/h14_bed_to_debris.lua [-D kn=...] [-D soft=...] [-D speed=...]
-- What to look at  jump_*: largest second difference of the force in steps, over m g; travel_*; sunk_*: final penetration over weight / (kn
--                A).
label("quick")
local kn, mu = param("kn", 1e11, "of the joint [Pa/m]"), param("mu", 0.6, "friction")
local soft = param("soft", 2e9, "kn of debris [Pa/m]")
local speed = param("speed", 0.6, "[m/s]")
local density = 1800
local l, w, h = 0.3, 0.125, 0.04
local area, weight = l * w, density * l * w * h * g
local duration = 0.25
material { name = "brick", density = density, friction = mu, restitution = 0.1, kn = soft, ks = 0.4 * soft }
damping { joint_ratio = 0.3 }  -- the start of sliding rocks the blocks; they must be calm when the former joint goes
for i, law in ipairs { dry { kn = kn, ks = 0.4 * kn, mu = mu }, mortar { kn = kn, ks = 0.4 * kn, ft = 0, c = 0.1 * weight / area, mu = mu } } do
  local name, base, x = "slid" .. i, "base" .. i, 3 * i
  box { name = base, group = base, size = { 3 * l, 3 * w, 0.1 }, at = { x - l, -w, -0.1 }, fixed = true }
  box { name = name, group = name, size = { l, w, h }, at = { x, 0, 0 }, initial = { velocity = { speed, 0, 0 } } }
  joint { law = law, between = { base, name } }
  recorder { name = name, quantity = "reaction", blocks = { base }, axis = "xz" }
  recorder { name = name, quantity = "displacement", block = name, axis = "xz" }
  metric("jump_" .. name, "", function(run)
    local T, N, most = run.history(name .. "_fx_N"), run.history(name .. "_fz_N"), 0
    for k = 3, #T do
      if run.time[k] > 0.002 and run.time[k] < 0.9 * speed / (mu * g) then
        most = math.max(most, math.abs(T[k] - 2 * T[k - 1] + T[k - 2]), math.abs(N[k] - 2 * N[k - 1] + N[k - 2]))
      end
    end
    return most / weight
  end)
  -- The stiffness, and with it the force, falls by 0.8 % at a time.
  expect("metrics.jump_" .. name, 0.02, { below = true, source = "beds go over with the force they bear" })
  metric("travel_" .. name, "m", function(run) return run.last(name .. "_ux_rel_m") end)
  expect("metrics.travel_" .. name, speed ^ 2 / (2 * mu * g), { rel = 0.01, source = "v^2 / (2 mu g)" })
  metric("sunk_" .. name, "", function(run) return -run.last(name .. "_uz_rel_m") / (weight / (math.min(soft, kn) * area)) end)
  expect("metrics.sunk_" .. name, 1, { rel = 0.01, source = "weight / (kn A) of the softer of the two" })
end
analysis { duration = duration, output_dt = 1e-7 }
expect("energy.residual_relative", 1e-3, { below = true, source = "ledger with friction and a hand-over" })
expect("status", "completed")
