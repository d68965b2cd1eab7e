-- V16: a prestressed bonded joint is bent until its first point cracks, for rules with and without points at the edge.
--
-- What happens   The moment grows slowly. A rule with exact bending and points at the edge cracks at (ft + s0) B H^2 / 6. N midpoints take
--                the stress at H/(2N) inside the edge and carry 1 + 1/N of it; trapezoids 1 + 2/(N - 1)^2; two Gauss points sqrt(3).
-- Source         M = sigma I_rule / s_outermost.
-- How to run     erbs run scenes/verify/v16_bending_to_cracking.lua [-D ft=...] [-D prestress=...] [-D kn=...] [-D side=0.5]
-- What to look at  moment_*: bending moment at the first damage over (ft + s0) B H^2 / 6.
label("quick")
local ft, prestress = param("ft", 0.2 * MPa, "tensile strength [Pa]"), param("prestress", 0.3 * MPa, "compression s0 [Pa]")
local kn = param("kn", 2e11, "[Pa/m]")
local H, B = param("side", 0.3, "side of the face along the bending [m]"), param("width", 0.125, "the other side [m]")
local density = param("density", 1800, "[kg/m3]")

gravity(0)
material { name = "brick", density = density }
local law = mortar { kn = kn, ks = 0.4 * kn, ft = ft, c = 20 * ft, mu = 0.6 }
local ramp = 4000 / math.sqrt(kn / (density * 0.1))  -- s: the blocks follow with a lag of 1 / (omega ramp) = 2.5e-4
local number = 0
local function case(name, rule, n, ratio, s0)
  number = number + 1
  local base, area, cracking = "base_" .. name, H * B, ratio * (ft + s0) * B * H ^ 2 / 6
  box { name = base, group = base, size = { H, B, 0.1 }, at = { 3 * H * number, 0, -0.1 }, fixed = true }
  box { name = name, group = name, size = { H, B, 0.1 }, at = { 3 * H * number, 0, 0 } }
  joint { law = law, between = { base, name }, rule = rule, points = H >= B and { n, math.min(n, 3) } or { math.min(n, 3), n } }
  force { block = name, wave = s0 * area, direction = { 0, 0, -1 } }
  -- The load ends soon after the expected crack, before the block rotates far.
  moment { block = name, direction = "y", wave = table_wave { times = { 0, ramp, 1.0001 * ramp }, values = { 0, 1.02 * cracking, 0 } } }
  recorder { name = name, quantity = "damage", blocks = { base }, others = { name } }
  metric("moment_" .. name, "", function(run)
    for i, damage in ipairs(run.history(name .. "_damage")) do
      if damage > 0 then return 1.02 * cracking * run.time[i] / ramp / ((ft + s0) * B * H ^ 2 / 6) end
    end
  end)
  -- Lag of the ramp and one row (5e-4 of it).
  expect("metrics.moment_" .. name, ratio, { rel = 5e-3, source = "M_cr = sigma I / s of the rule" })
end
for _, s0 in ipairs(prestress > 0 and { 0, prestress } or { 0 }) do
  local tag = s0 == 0 and "_bare" or "_pressed"
  case("simpson3" .. tag, "simpson", 3, 1, s0)
  case("simpson5" .. tag, "simpson", 5, 1, s0)
  for _, n in ipairs { 2, 3, 4, 8 } do case("midpoint" .. n .. tag, "midpoint", n, 1 + 1 / n, s0) end
  for _, n in ipairs { 2, 3, 5 } do case("trapezoid" .. n .. tag, "trapezoid", n, 1 + 2 / (n - 1) ^ 2, s0) end
  case("gauss2" .. tag, "gauss", 2, math.sqrt(3), s0)
end
analysis { duration = ramp, start = "equilibrium", output_dt = ramp / 2000, dt_fraction = 0.25 }
