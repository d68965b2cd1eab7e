-- The parameter study of Gu and Miao on a small wall: damping, iterations and order of blocks in their sequential scheme.
--
-- What happens   A wall of bricks on mortar is shaken by El Centro. The scheme moves one block at a time while all others are held. It
--                diverges without damping at any dt, and with mass damping below about dt w_b^2 / 2. Above, the wall stands, but it
--                is held back by a viscosity that has nothing to do with masonry. Explicit damping diverges again towards c dt = 2.
--                More sweeps per step need less damping. Leapfrog needs none. verify/v20_*.lua show these laws one by one on a chain.
-- Source         Gu and Miao, "Parameter study on computer simulation of collapse responses for masonry structures", Fig. 6.
-- How to run     erbs run scenes/sequential_study.lua [-D c=0.5] [-D iterations=4] [-D explicit_c=1] [-D centred=1] [-D leapfrog=1]
--                [-D E=1e9]
-- What to look at  collapse_c: neutral damping over dt w_b^2 / 2; drift_over_leapfrog; orders_mean and orders_deviation: peak drift in 8
--                random orders, over that of leapfrog; collapse_explicit_c: c dt at which explicit damping becomes too large.
local c = param("c", 1.2, "mass damping over dt w_b^2 / 2")
local explicit_c = param("explicit_c", 0, "above 0: explicit mass damping, as c dt")
local iterations, centred = param("iterations", 1, "sweeps per step"), param("centred", 0, "1: the centred sweep")
local leapfrog = param("leapfrog", 0, "above 0: all at once, without damping")
local seed = param("seed", 1, "of the random order")
local share = param("share", 0.3, "dt over the limit of the leapfrog; Gu and Miao's T / 10 is .22")
local E, t = param("E", 1e8, "of the mortar, soft for a long step [Pa]"), 10 * mm
local pga, duration = param("pga", 0.1 * g, "[m/s2]"), param("duration", 0.6, "[s]")

local l, w, h, across, courses, density, nu = 0.3, 0.125, 0.1, 3, 6, 1800, 0.2
material { name = "brick", density = density }
box { name = "foot", group = "foot", size = { (across + 1) * (l + t), w, h }, at = { 0, 0, -h - t }, fixed = true }
for course = 0, courses - 1 do
  for i = 0, across - 1 do
    box { name = course .. "_" .. i, group = "wall", size = { l, w, h }, at = { i * (l + t), 0, course * (h + t) } }
  end
end
joint { law = mortar { E = E, nu = nu, thickness = t, ft = 1 * MPa, c = 1 * MPa, mu = 0.6 }, tolerance = 0.1 * mm }
-- A brick between held neighbours: two bed joints and two head joints, in the stiffer of the two directions in the plane.
local kn, mass = E / t, density * l * w * h
local ks = kn / (2 * (1 + nu))
local block_w2 = math.max(2 * kn * l * w + 2 * ks * w * h, 2 * ks * l * w + 2 * kn * w * h) / mass
local limit = param("limit", 1.62e-4 * math.sqrt(1e8 / E), "2 / omega_max of this wall, from erbs check [s]")
local dt = share * limit
if leapfrog == 0 then
  damping { mass = explicit_c > 0 and explicit_c / dt or c * dt / iterations * block_w2 / 2, form = explicit_c > 0 and "explicit" or "centred" }
end
ground_motion { wave = record { file = "records/elcentro_1940_ns.csv", peak = pga, time_factor = 0.707 }, direction = { 0, 1, 0 } }
recorder { name = "top", quantity = "displacement", block = (courses - 1) .. "_1", axis = "xy" }
analysis { duration = duration, dt = dt, unstable = true, output_dt = duration / 300, frame_dt = duration / 25,
  solver = leapfrog > 0 and "leapfrog" or "sequential", variant = centred == 1 and "centred" or "literal", iterations = iterations, seed = seed }
camera { name = "front", eye = { 0.6, -2.5, 0.9 }, target = { 0.6, 0, 0.35 } }

local function drift(run) return run.peak("top_uy_rel_m") end
-- A run diverges if its status says so, or if its last fifth swings far more than its first half.
local function grows(run)
  if run.status == "diverged" then return true end
  local u, early, late = run.history("top_uy_rel_m"), 0, 0
  for i, value in ipairs(u) do
    if value ~= value or math.abs(value) > 1 then return true end
    if i < 0.5 * #u then early = math.max(early, math.abs(value)) elseif i > 0.8 * #u then late = math.max(late, math.abs(value)) end
  end
  return late > 20 * early
end
metric("drift", "m", drift)
metric("diverges", "", grows)
bisect { param = "c", lo = 1.5, hi = 0.1, rel = 0.05, collapsed_when = grows }
bisect { param = "explicit_c", lo = 0.5, hi = 2.5, rel = 0.02, collapsed_when = grows }
ensemble { n = 1, seed = 1, param = "leapfrog", name = "leapfrog", value = drift }
ensemble { n = 8, seed = 1, name = "orders", value = drift }
metric("drift_over_leapfrog", "", function(run) return drift(run) / run.metrics.metrics.leapfrog_mean end)
metric("orders_scatter", "", function(run) return run.metrics.metrics.orders_deviation / run.metrics.metrics.orders_mean end)
