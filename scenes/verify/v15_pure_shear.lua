-- V15: joints are sheared under five compressions and, for each coupling, under two tensions, until they slide.
--
-- What happens   A prescribed motion compresses (or opens) each joint and then shears it. Under compression s the peak is (c + mu s) A and
--                the residual mu_residual s A. Under tension s the peak is c - mu s (coulomb), c (1 - s / ft) (linear) or c sqrt(1 - (s /
--                ft)^2) (ellipse), then nothing.
-- Source         Coulomb with a tension cut-off; the couplings as documented in the mortar law.
-- How to run     erbs run scenes/verify/v15_pure_shear.lua [-D c=...] [-D ft=...] [-D mu=...] [-D mu_residual=...] [-D kn=...]
-- What to look at  peak_* and rest_*: shear force over the formula.
label("quick")
local c, ft = param("c", 0.3 * MPa, "cohesion [Pa]"), param("ft", 0.2 * MPa, "tensile strength, at most c / mu [Pa]")
local mu, mu_residual = param("mu", 0.6, "before failure"), param("mu_residual", 0.5, "after failure")
local kn, ks = param("kn", 2e11, "[Pa/m]"), param("ks", 0.8e11, "[Pa/m]")
local largest = param("largest", 2 * MPa, "greatest compression [Pa]")
local steps = param("steps", 4000, "steps of the shearing")

gravity(0)
material { name = "brick", density = 1800 }
local area, dt, count = 0.3 * 0.125, 1e-6, 0
local function case(name, coupling, s, peak, rest, direction)  -- s: Pa, tension positive
  count = count + 1
  peak = math.max(peak, rest)  -- if friction carries more than the bond did
  local base, to = "base_" .. name, 1.2 * peak / ks  -- m, slip at the end
  box { name = base, group = base, size = { 0.3, 0.125, 0.1 }, at = { count, 0, -0.1 }, fixed = true }
  box { name = name, group = name, size = { 0.3, 0.125, 0.1 }, at = { count, 0, 0 } }
  joint { law = mortar { kn = kn, ks = ks, ft = ft, c = c, mu = mu, mu_residual = mu_residual, coupling = coupling }, between = { base, name } }
  motion { block = name, direction = "z", wave = table_wave { times = { 0, 100 * dt }, values = { 0, s / kn }, hold = true } }
  motion { block = name, direction = direction, wave = table_wave { times = { 200 * dt, (200 + steps) * dt }, values = { 0, to }, hold = true } }
  recorder { name = name, quantity = "shear_force", blocks = { base }, others = { name } }
  metric("peak_" .. name, "", function(run) return run.max(name .. "_shear_N") / (peak * area) end)
  -- One step of the shearing: 1.2 parts in `steps`.
  expect("metrics.peak_" .. name, 1, { abs = 1.3 / steps, source = "V15: " .. coupling })
  if s < 0 then
    metric("rest_" .. name, "", function(run) return run.last(name .. "_shear_N") / (rest * area) end)
    expect("metrics.rest_" .. name, 1, { abs = 1e-9, source = "mu_residual s A, at once" })
  else
    metric("rest_" .. name, "N", function(run) return run.last(name .. "_shear_N") end)
    -- Round-off of the forces before.
    expect("metrics.rest_" .. name, 0, { abs = 1e-14 * peak * area, source = "nothing is left in tension" })
  end
end
local directions = { "x", "y", { 1, 1, 0 }, { -1, 2, 0 }, { 3, -1, 0 } }
for i = 1, 5 do
  local s = largest * i / 5
  case("compression" .. i, "coulomb", -s, c + mu * s, mu_residual * s, directions[i])
end
case("none", "coulomb", 0, c, 0, "x")
for _, part in ipairs { 0.4, 0.8 } do
  local s, tag = part * ft, string.format("_tension%d", part * 10)
  if c - mu * s > 0 then case("coulomb" .. tag, "coulomb", s, c - mu * s, 0, "x") end
  case("linear" .. tag, "linear", s, c * (1 - part), 0, "x")
  case("ellipse" .. tag, "ellipse", s, c * math.sqrt(1 - part ^ 2), 0, "x")
end
analysis { duration = (200 + steps) * dt, dt = dt, output_dt = dt, start = "rest" }
