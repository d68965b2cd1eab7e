-- V14: joints, brittle and softening, are pulled apart evenly until they fail.
--
-- What happens   A prescribed motion opens each joint. The force rises along kn A u to ft A. A brittle joint drops to zero there and
--                releases A ft^2 / (2 kn). A softening joint falls linearly and takes A Gf in all.
-- Source         Hillerborg, Modeer and Petersson 1976, Cement Concrete Res. 6, 773 (linear softening, Gf = ft w / 2).
-- How to run     erbs run scenes/verify/v14_pure_tension.lua [-D ft=...] [-D kn=...] [-D Gf=...] [-D steps=...]
-- What to look at  peak_* and work_*: force at failure and work of the pull over their formulas; fracture energy of the whole run.
label("quick")
local ft, kn = param("ft", 0.2 * MPa, "tensile strength [Pa]"), param("kn", 2e11, "[Pa/m]")
local Gf = param("Gf", 10, "fracture energy of the softening joints [J/m2]")
local steps = param("steps", 4000, "steps from rest to the peak of the brittle joints")
local sizes = { { 0.3, 0.125 }, { 0.15, 0.125 }, { 1.0, 0.4 } }

gravity(0)
material { name = "brick", density = 1800 }
local open = ft / kn  -- m, at the peak
local dt = 1e-6
local laws = {
  brittle = { law = mortar { kn = kn, ks = 0.4 * kn, ft = ft, c = 2 * ft, mu = 0.6 }, energy = ft ^ 2 / (2 * kn), reach = 1.5 * open },
  softening = { law = mortar { kn = kn, ks = 0.4 * kn, ft = ft, c = 2 * ft, mu = 0.6, Gf1 = Gf }, energy = Gf, reach = 1.1 * 2 * Gf / ft },
  -- An ultimate opening instead of a fracture energy: Gf = ft w / 2.
  ultimate = { law = mortar { kn = kn, ks = 0.4 * kn, ft = ft, c = 2 * ft, mu = 0.6, un_ultimate = 20 * open }, energy = 10 * ft * open, reach = 22 * open },
}
local total, count = 0, 0
for kind, case in pairs(laws) do
  for i, size in ipairs(sizes) do
    local name, area = kind .. i, size[1] * size[2]
    count = count + 1
    box { name = "base_" .. name, group = "base", size = { size[1], size[2], 0.1 }, at = { 2 * i, 2 * count, -0.1 }, fixed = true }
    box { name = name, group = kind, size = { size[1], size[2], 0.1 }, at = { 2 * i, 2 * count, 0 } }
    -- Slow up to 1.2 times the peak, so that the peak is resolved to one step; then on to the end.
    local slow = 1.2 * steps * dt
    motion { block = name, direction = "z", wave = table_wave { times = { 0, slow, 2 * slow }, values = { 0, 1.2 * open, case.reach }, hold = true } }
    recorder { name = name, quantity = "normal_force", blocks = { "base_" .. name }, others = { name } }
    recorder { name = name, quantity = "displacement", block = name, axis = "z" }
    metric("peak_" .. name, "", function(run) return run.max(name .. "_normal_N") / (ft * area) end)
    metric("work_" .. name, "", function(run)  -- trapezoids of force over opening
      local f, u, work = run.history(name .. "_normal_N"), run.history(name .. "_uz_rel_m"), 0
      for row = 2, #f do work = work + (f[row] + f[row - 1]) / 2 * (u[row] - u[row - 1]) end
      return work / (case.energy * area)
    end)
    metric("left_" .. name, "N", function(run) return run.last(name .. "_normal_N") end)
    -- The last step below the peak: one part in `steps`.
    expect("metrics.peak_" .. name, 1, { abs = 1.1 / steps, source = "ft A" })
    -- Trapezoids across the drop and the corner: one step's share of the work at the peak.
    expect("metrics.work_" .. name, 1, { abs = kind == "brittle" and 2.5 / steps or 1e-3, source = kind == "brittle" and "A ft^2 / (2 kn)" or "A Gf" })
    expect("metrics.left_" .. name, 0, { abs = 0, source = "irreversible" })
    total = total + case.energy * area
  end
  joint { law = case.law, between = { "base", kind } }
end
analysis { duration = 2.4 * steps * dt, dt = dt, output_dt = dt, start = "rest" }
metric("fracture_over_formula", "", function(run) return run.energy.fracture_J / total end)
-- The ledger's own term, which the law books, not these forces.
expect("metrics.fracture_over_formula", 1, { abs = 1e-3, source = "sum of A ft^2 / (2 kn) and A Gf" })
