-- H13: fracture energies too small for the stiffness (snap-back): the joint drops to zero at its peak.
--
-- What happens   At its peak a joint in tension stores ft^2 / (2 kn) per area, a joint in shear c^2 / (2 ks). With a smaller fracture
--                energy the softening line would lead back to smaller openings (snap-back). The program warns when it reads the scene. The
--                joint then fails at the peak and takes all its stored energy instead of the given one. With a larger fracture energy the
--                joint follows the line and takes the given energy.
-- Source         Bazant and Cedolin, Stability of Structures, 1991, chapter 13; Gf < ft^2 t / (2 E) with kn = E / t.
-- How to run     erbs check scenes/hard/h13_snap_back.lua (to read the warnings); erbs run scenes/hard/h13_snap_back.lua
-- What to look at  work_*: work of the pull or push, over A times the larger of the given energy and the energy at the peak.
local ft, c, kn = 0.2 * MPa, 0.3 * MPa, param("kn", 2e9, "[Pa/m]")
local ks = 0.4 * kn
local steps, dt = 4000, 1e-6
gravity(0)
material { name = "brick", density = 1800 }
local total = 0
local function case(name, share, shear)
  local peak_energy = shear and c ^ 2 / (2 * ks) or ft ^ 2 / (2 * kn)
  local given, area, peak = share * peak_energy, 0.3 * 0.125, shear and c / ks or ft / kn
  -- In shear the given energy is that of the plastic slip, without the elastic slip that is recovered.
  local energy = shear and (share > 1 and given or peak_energy) or math.max(given, peak_energy)
  local base, at = "base_" .. name, 2 * share + (shear and 20 or 0)
  box { name = base, group = base, size = { 0.3, 0.125, 0.1 }, at = { at, 0, -0.1 }, fixed = true }
  box { name = name, group = name, size = { 0.3, 0.125, 0.1 }, at = { at, 0, 0 } }
  joint { law = mortar { kn = kn, ks = ks, ft = ft, c = c, mu = 0.6, Gf1 = shear and 0 or given, Gf2 = shear and given or 0 }, between = { base, name } }
  motion { block = name, direction = shear and "x" or "z",
           wave = table_wave { times = { 0, steps * dt }, values = { 0, 1.3 * peak * math.max(1, share + (shear and 1 or 0)) }, hold = true } }
  recorder { name = name, quantity = shear and "shear_force" or "normal_force", blocks = { base }, others = { name } }
  recorder { name = name, quantity = "displacement", block = name, axis = shear and "x" or "z" }
  metric("work_" .. name, "", function(run)
    local f, u, work = run.history(name .. (shear and "_shear_N" or "_normal_N")), run.history(name .. (shear and "_ux_rel_m" or "_uz_rel_m")), 0
    for row = 2, #f do work = work + (f[row] + f[row - 1]) / 2 * (u[row] - u[row - 1]) end
    return work / (energy * area)
  end)
  -- Trapezoidal rule across a drop: one step's share of the work at the peak.
  expect("metrics.work_" .. name, 1, { abs = 4 * math.max(1, share) / steps, source = share > 1 and "A Gf" or "A times the energy at the peak" })
end
for _, shear in ipairs { false, true } do
  local kind = shear and "shear" or "tension"
  case(kind .. "_half", 0.5, shear)
  case(kind .. "_twice", 2, shear)
  case(kind .. "_five_times", 5, shear)
end
analysis { duration = steps * dt, dt = dt, output_dt = dt, start = "rest" }
label("fixed_dt")
expect("status", "completed")
