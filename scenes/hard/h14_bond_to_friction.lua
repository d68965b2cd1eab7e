-- H14: from bond to friction to contact: no jump of force when faces separate and close, or when a block slides off its joint.
--
-- What happens   lifted: a bonded block is pulled up until its bond fails. It rises beyond the range of the small-displacement joint, so
--                contact takes over, and comes down again. The force returns at zero gap, on the line kn A u, as if nothing had happened.
--                slid: blocks that slide under their weight are released to contact on the way; one is dry, one has a bond that has sheared
--                off.
-- Source         continuity; invariant of the hard case: jump below 1e-3 m g.
-- How to run     erbs run scenes/hard/h14_bond_to_friction.lua [-D kn=...] [-D speed=...]
-- What to look at  off_line_lifted: largest distance of the force from kn A u after the crack, over m g; jump_*: largest change of force in
--                one step around the release to contact, over m g.
local kn, mu = param("kn", 1e9, "[Pa/m]"), param("mu", 0.6, "friction")
local speed = param("speed", 0.3, "of the blocks that slide [m/s]")
local beta = param("ratio", 0.3, "dashpots of joints, of each one's own critical value")
local density = 1800
local l, w, h = 0.3, 0.125, 0.04
local area, weight = l * w, density * l * w * h * g
material { name = "brick", density = density, friction = mu, restitution = 1, kn = kn, ks = 0.4 * kn }
damping { joint_ratio = beta }  -- the start of sliding rocks the blocks; they must be calm at the release to contact
local function bed(name, x) box { name = name, group = name, size = { 3 * l, 3 * w, 0.1 }, at = { x - l, -w, -0.1 }, fixed = true } end

local duration = 0.6
local ft = 20 * kPa
local up = 0.02 * math.sqrt(l * l + w * w)  -- m, beyond the range of the small-displacement joint
-- The motion of the lifted block is prescribed; the block below moves freely on a strong bed.
bed("base_anvil", 0)
box { name = "anvil", group = "anvil", size = { l, w, h }, at = { 0, 0, 0 } }
box { name = "lifted", group = "lifted", size = { l, w, h }, at = { 0, 0, h } }
joint { law = mortar { kn = 10 * kn, ks = 4 * kn, ft = 1 * GPa, c = 1 * GPa, mu = mu }, between = { "base_anvil", "anvil" } }
joint { law = mortar { kn = kn, ks = 0.4 * kn, ft = ft, c = 40 * kPa, mu = mu }, between = { "anvil", "lifted" } }
motion { block = "lifted", direction = "z", wave = table_wave {
  times = { 0, 0.2 * duration, 0.4 * duration, 0.6 * duration, 0.95 * duration, duration },
  values = { 0, 2 * ft / kn, up, weight / (kn * area), -weight / (kn * area), -weight / (kn * area) }, hold = true } }
recorder { name = "lifted", quantity = "reaction", blocks = { "lifted" }, axis = "z" }
recorder { name = "lifted", quantity = "displacement", block = "lifted", axis = "z" }
recorder { name = "anvil", quantity = "displacement", block = "anvil", axis = "z" }
metric("off_line_lifted", "", function(run)
  local F, u, most = run.history("lifted_fz_N"), run.history("lifted_uz_rel_m"), 0
  local below = run.history("anvil_uz_rel_m")
  for k = 1, #F do
    if run.time[k] > 0.5 * duration then most = math.max(most, math.abs(F[k] - kn * area * math.max(0, below[k] - u[k]))) end
  end
  return most / weight
end)
-- Contact acts between faces that are enlarged by half the joint; it follows the line within depth over thickness, 1e-5 here. While the gap
-- closes, the speed adds up to half a step of motion; at rest this is gone.
expect("metrics.off_line_lifted", 1e-3, { below = true, source = "zero force at zero gap, stiffness of the joint" })

for i, law in ipairs { dry { kn = kn, ks = 0.4 * kn, mu = mu }, mortar { kn = kn, ks = 0.4 * kn, ft = 0, c = 0.1 * weight / area, mu = mu } } do
  local name, base, x = "slid" .. i, "base_slid" .. i, 3 * i
  bed(base, x)
  box { name = name, group = name, size = { l, w, h }, at = { x, 0, 0 }, initial = { velocity = { speed, 0, 0 } } }
  joint { law = law, between = { base, name } }
  recorder { name = name, quantity = "reaction", blocks = { base }, axis = "xz" }
  -- Second differences show a jump, but not a vibration of many steps.
  metric("jump_" .. name, "", function(run)
    local T, N, most = run.history(name .. "_fx_N"), run.history(name .. "_fz_N"), 0
    for k = 3, #T do
      if run.time[k] > 0.002 and run.time[k] < 0.9 * speed / (mu * g) then
        most = math.max(most, math.abs(T[k] - 2 * T[k - 1] + T[k - 2]), math.abs(N[k] - 2 * N[k - 1] + N[k - 2]))
      end
    end
    return most / weight
  end)
  expect("metrics.jump_" .. name, 1e-3, { below = true, source = "hand-over keeps the force" })
  recorder { name = name, quantity = "displacement", block = name, axis = "x" }
  metric("travel_" .. name, "m", function(run) return run.last(name .. "_ux_rel_m") end)
  expect("metrics.travel_" .. name, speed ^ 2 / (2 * mu * g), { rel = 0.01, source = "v^2 / (2 mu g)" })
end
analysis { duration = duration, output_dt = 1e-7 }
expect("energy.residual_relative", 1e-3, { below = true, source = "ledger with friction and a hand-over" })
expect("status", "completed")
