-- V48: beds become softer once their bond is gone (`kn_cracked`, `ks_cracked`).
--
-- What happens   Held blocks are pressed onto their beds by a fixed depth and sheared until the bond is gone. At constant depth their force
--                falls with the stiffness, and what they no longer store is booked as crushing. Free blocks are sheared off by a slow
--                horizontal force. Each sinks until its softer bed bears its weight.
-- Source         Own. N = kn_cracked A depth at the end; crushing A depth^2 (kn - kn_cracked) / 2, and the same of the elastic slip
--                mu N / (ks A), if both stiffnesses fall alike. A free block sinks by W / A (1 / kn_cracked - 1 / kn). While that is slow, half
--                of the work of its weight is crushing, half is stored.
-- How to run     erbs run scenes/verify/v48_faded_bed.lua [-D kn=...] [-D side=...] [-D share=0.2]
-- What to look at  force_*, shear_*: at the end, over the paper; crushing_over_paper; sinks_*.
label("quick")
local kn = param("kn", 1e11, "[Pa/m]")
local side = param("side", 0.3, "[m]")
local share = param("share", 0.2, "of the stiffness once the bond is gone, besides 1, .5 and .05")
local depth = param("depth", 2e-6, "of the held blocks [m]")
local mu, bond = 0.6, 0.02  -- cohesion over the frictional strength
gravity(g)
material { name = "stone", density = 2400 }
local area, heavy = side ^ 2, 0.5 * side  -- of the free blocks
local weight = 2400 * 9.80665 * area * heavy
local ks, shear, crushing = 0.4 * kn, 4 * depth, 0
-- The dashpots of a bed soften with it, so that its viscous ratio falls with the root of the stiffness: e^-8 of the swing is left.
local rate = 0.05 * share * math.sqrt(kn / (2400 * 0.5 * side))  -- 1/s, decay of the free block
local t1 = 0.02  -- the bond is gone
local t2 = math.max(0.15, 3 * t1 + 8 / rate)
local quick = 1e-4  -- s; a bed that slides while it fades rubs with the pressure that it bore before (interlock)
local dt = 0.1 * 2 / math.sqrt(kn / (2400 * 0.1))

for i, r in ipairs { 1, 0.5, share, 0.05 } do
  for k, rule in ipairs { "gauss", "simpson" } do
    local name, y = string.format("held%d%s", i, rule), 2 * k * side
    local strength = bond * mu * kn * depth
    box { name = "base_" .. name, group = "base_" .. name, size = { side, side, 0.1 }, at = { 3 * side * i, y, -0.1 }, fixed = true }
    box { name = name, group = name, size = { side, side, 0.1 }, at = { 3 * side * i, y, 0 } }
    motion { block = name, direction = "z", wave = table_wave { times = { 0, t1 / 4 }, values = { 0, -depth }, hold = true } }
    motion { block = name, direction = "x", wave = table_wave { times = { 0, t1 / 2, t1 / 2 + quick }, values = { 0, 0, shear }, hold = true } }
    joint {
      law = mortar { kn = kn, ks = ks, ft = strength / mu, c = strength, mu = mu, kn_cracked = r < 1 and r * kn or 0 },
      between = { "base_" .. name, name }, rule = rule, points = { 3, 3 },
    }
    recorder { name = name, quantity = "normal_force", blocks = { "base_" .. name }, others = { name } }
    recorder { name = name .. "_x", quantity = "shear_force", blocks = { "base_" .. name }, others = { name }, axis = "x" }
    metric("force_" .. name, "", function(run) return math.abs(run.last(name .. "_normal_N")) / (r * kn * area * depth) end)
    expect("metrics.force_" .. name, 1, { abs = 1e-6, source = "kn_cracked A depth" })
    metric("shear_" .. name, "", function(run) return math.abs(run.last(name .. "_x_shear_N")) / (mu * r * kn * area * depth) end)
    expect("metrics.shear_" .. name, 1, { abs = 1e-6, source = "mu N, falls with the stiffness" })
    local slip = mu * kn * depth / ks
    crushing = crushing + (1 - r) * area * (kn * depth ^ 2 + ks * slip ^ 2) / 2
  end
end

for i, r in ipairs { 1, share } do
  local name, y = "free" .. i, -2 * side
  box { name = "base_" .. name, group = "base_" .. name, size = { side, side, 0.1 }, at = { 3 * side * i, y, -0.1 }, fixed = true }
  box { name = name, group = name, size = { side, side, heavy }, at = { 3 * side * i, y, 0 } }
  local pull = (1 + 10 * bond) * mu * weight
  force { block = name, direction = "x", wave = table_wave { times = { 0, t1, 1.2 * t1, 3 * t1 }, values = { 0, pull, 0.5 * pull, 0 }, hold = true } }
  joint {
    law = mortar { kn = kn, ks = ks, ft = bond * weight / area, c = bond * mu * weight / area, mu = mu, kn_cracked = r < 1 and r * kn or 0, ks_cracked = r < 1 and ks or 0, damping = 0.05 },
    between = { "base_" .. name, name },
  }
  recorder { name = name, quantity = "displacement", block = name, axis = "z" }
  -- Beyond its settlement on the intact bed.
  metric("sinks_" .. name, "", function(run) return -run.last(name .. "_uz_rel_m") / (weight / area / kn) - 1 end)
  expect("metrics.sinks_" .. name, 1 / r - 1, { abs = 0.02 + 0.02 * (1 / r - 1), source = "W / A (1 / kn_cracked - 1 / kn)" })
  crushing = crushing + weight ^ 2 / area * (1 / r - 1) / kn / 2
end
metric("crushing_over_paper", "", function(run) return run.metrics.energy.crushing_J / crushing end)
expect("metrics.crushing_over_paper", 1, { abs = 5e-3, source = "A depth^2 (kn - kn_cracked) / 2; W (sinking) / 2" })
analysis { duration = t2, dt = dt, output_dt = 20 * dt }
expect("energy.residual_relative", 1e-5, { below = true, source = "ledger: the loss of stiffness is booked as crushing" })
