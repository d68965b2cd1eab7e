-- P9: soft contacts that act once in several steps, beside a stiff wall.
--
-- What happens   A plate slides over the ground and stops by friction, and another falls flat and bounces. Beside them stands
--                a pier whose stiff beds set the step. Contacts with the soft ground act once in several steps, as their own stiffness
--                allows.
-- Source         Coulomb: v0^2 / (2 mu g). Newton's restitution: the plate returns e times the speed with which it strikes.
-- How to run     erbs accuracy scenes/accuracy/p9_levels.lua [-D levels=1] [-D ratio=1e6]
-- What to look at  metrics.slide, and metrics.rebound, over the ratio of the stiffnesses and over the number of levels (scenes/accuracy)
local ratio = param("ratio", 1e4, "stiffness of the beds over that of the ground")
local levels = param("levels", 6, "time levels of contacts")
accuracy { param = "levels", name = "levels of contacts", values = { 6, 5, 4, 3, 2, 1 } }
local soft = param("soft", 1e8, "normal stiffness of contacts [Pa/m]")
local mu, e, v0, fall = 0.5, 0.5, 1, 0.05
material { name = "stone", density = 1800, friction = mu, restitution = e, kn = soft, ks = 0.4 * soft }
ground { size = 10, material = "stone" }
local weight = 1800 * g * 0.05
for i = 0, 1 do
  box { name = "pier" .. i, size = { 0.3, 0.3, 0.1 }, center = { -1, 0, 0.05 + 0.1 * i }, group = "pier" }
end
joint { law = mortar { kn = ratio * soft, ks = 0.4 * ratio * soft, ft = 1 * MPa, c = 1 * MPa, mu = mu }, between = { "pier", "pier" } }
joint { law = dry { kn = ratio * soft, mu = mu }, between = { "pier", "ground" } }
box { name = "slider", size = { 0.3, 0.3, 0.05 }, center = { 0, 0, 0.025 - weight / soft }, free = true, initial = { velocity = { v0, 0, 0 } } }
box { name = "faller", size = { 0.3, 0.3, 0.05 }, center = { 0, 2, 0.025 + fall }, free = true }
recorder { name = "slider", quantity = "displacement", block = "slider", axis = "x" }
recorder { name = "faller", quantity = "displacement", block = "faller", axis = "z" }
gravity(g)
analysis { duration = 0.35, start = "rest", levels = levels, output_dt = 1e-3, frame_dt = 0.1 }
metric("slide", "m", function(run) local x = run.history "slider_ux_rel_m" return x[#x] end)
metric("rebound", "m", function(run)  -- height of the first bounce
  local z, low, high = run.history("faller_uz_rel_m"), math.huge, 0
  for i = 1, #z do
    if high == 0 and z[i] < low then low = z[i] end
    if low < -0.99 * fall then high = math.max(high, z[i] + fall) end
  end
  return high
end)
expect("metrics.slide", v0 ^ 2 / (2 * mu * g), { rel = 5e-3, source = "Coulomb: v0^2 / (2 mu g)" })
expect("metrics.rebound", e ^ 2 * fall, { rel = 0.1, source = "Newton's restitution e = .5: e^2 times the height" })
expect("energy.residual_relative", 1e-3, { below = true, source = "ledger" })
