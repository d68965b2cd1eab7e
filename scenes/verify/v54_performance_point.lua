-- V54: the performance point of blocks that slide on soft beds, which is known on paper.
--
-- What happens   A flat block on a bed of shear stiffness ks is pushed by displacement: it moves by V / (ks A), and slides at mu N. So its
--                curve is elastic and perfectly plastic. With a second block on another bed above, the structure has a shape.
-- Source         EN 1998-1:2004, 3.2.2.2, tables 3.2 and 3.3, and annex B; TBSC 2018, 2.3.4. One block: Gamma = 1, m* = M, both variants agree.
--                Two blocks of mass m on the stiffnesses k1, k2: u1 = 2 F / k1, u2 = u1 + F / k2, Gamma = u2 (u1 + u2) / (u1^2 + u2^2);
--                the effective mass is m (u1 + u2)^2 / (u1^2 + u2^2).
-- How to run     erbs run scenes/verify/v54_performance_point.lua [-D case=7]
-- What to look at  performance.svg; performance_point_least, performance_point_most: displacement of the top over that on paper.
local side, height, density, kn = 2, 0.1, 2000, 1e9
local m, mu = density * side * side * height, 0.3
local cases = {}
local function case(keys) cases[#cases + 1] = keys end
-- T: period of the block on its bed (s); q: elastic demand over its strength
for _, T in ipairs { 0.25, 0.4, 0.7 } do
  for _, q in ipairs { 0.7, 1.6, 2.4 } do case { T = T, q = q, spectrum = { kind = "EN 1998-1 type 1", ground = "B" } } end
end
case { T = 0.4, q = 2, spectrum = { kind = "EN 1998-1 type 2", ground = "D" } }
case { T = 0.4, q = 2, spectrum = { kind = "EN 1998-1 type 1", ground = "C", damping = 0.1 } }
case { T = 0.4, q = 2, spectrum = { kind = "TBSC 2018" } }
case { T = 0.25, q = 2, spectrum = { kind = "table" } }
case { T = 0.25, q = 2, spectrum = { kind = "EN 1998-1 type 1", ground = "A", iterate = true } }
case { T = 0.7, q = 1.6, second = 1, variant = "n2", spectrum = { kind = "EN 1998-1 type 1", ground = "B", shape = "elastic" } }
case { T = 0.7, q = 1.6, second = 1, variant = "mpp", spectrum = { kind = "EN 1998-1 type 1", ground = "B", shape = "elastic", nodes = 2 } }
case { T = 0.4, q = 1.4, second = 2, variant = "n2", spectrum = { kind = "EN 1998-1 type 1", ground = "D", shape = "elastic" } }

local number = param("case", 1, "the case")
local c = cases[number] or error("case is 1 to " .. #cases)
local variant = c.variant or "n2"

-- The structure: k1 and k2 carry the shear of two and of one block.
local count = c.second and 2 or 1
local ratio = c.second or 1  -- k2 / k1
local u1, u2 = 2, 2 + 1 / ratio  -- for F = k1 = 1
local gamma = count == 1 and 1 or u2 * (u1 + u2) / (u1 ^ 2 + u2 ^ 2)
local share = (count == 1 or variant == "mpp") and 1 or (u1 + u2) ^ 2 / (u1 ^ 2 + u2 ^ 2) / 2  -- of the mass in A = V / (share M)
local M, yield = count * m, mu * g / share  -- the foot slides at mu N
local at_yield = yield * (c.T / (2 * math.pi)) ^ 2  -- of the oscillator
local k1 = count == 1 and m * mu * g / at_yield or mu * M * g * (1 + 1 / (2 * ratio)) / (gamma * at_yield)

-- The spectra on paper, of the acceleration `a` at the period c.T, and the end of their plateau.
local function en(S, TC, TD, eta, type)
  return { TC = TC, at = function(a) return { ag = a / (S * 2.5 * eta * math.min(1, TC / c.T)) } end }
end
local on_paper = ({
  ["EN 1998-1 type 1A"] = en(1, 0.4, 2, 1), ["EN 1998-1 type 1B"] = en(1.2, 0.5, 2, 1), ["EN 1998-1 type 1D"] = en(1.35, 0.8, 2, 1),
  ["EN 1998-1 type 1C"] = en(1.15, 0.6, 2, math.sqrt(10 / 15)), ["EN 1998-1 type 2D"] = en(1.8, 0.3, 1.2, 1),
  ["TBSC 2018"] = { TC = 0.25, at = function(a) return { SDS = 4 * c.T * a / g, SD1 = c.T * a / g } end },
  table = { TC = 0.45, at = function(a) return { TC = 0.45, table = { { T = 0, Sa = 0.5 * a }, { T = 0.1, Sa = a }, { T = 2, Sa = a } } } end },
})[c.spectrum.kind .. (c.spectrum.ground or "")]
for key, value in pairs(on_paper.at(c.q * yield)) do c.spectrum[key] = value end
if c.spectrum.kind == "table" then c.spectrum.kind = nil end
spectrum(c.spectrum)

local elastic = c.q * at_yield
local target = elastic
if c.T < on_paper.TC and c.q > 1 then target = math.min(3, (1 + (c.q - 1) * on_paper.TC / c.T) / c.q) * elastic end
local top = gamma * target

material { name = "stone", density = density, kn = kn, ks = kn, friction = 1 }
box { name = "floor", size = { 3 * side, 3 * side, 0.5 }, at = { -1.5 * side, -1.5 * side, -0.5 }, fixed = true }
for i = 1, count do
  box { name = "block" .. i, group = "blocks" .. i, size = { side, side, height }, at = { -side / 2, -side / 2, (i - 1) * height } }
end
joint { law = dry { kn = kn, ks = k1 / side ^ 2, mu = mu } }
if count == 2 then joint { between = { "blocks1", "blocks2" }, law = dry { kn = kn, ks = ratio * k1 / side ^ 2, mu = 2 } } end
analysis { kind = "pushover", control = "displacement", displacement = 1.1 * math.max(top, gamma * at_yield) }

metric("on_paper_top_m", "m", top)
metric("gamma_on_paper", "", gamma)
converge { param = "case", name = "performance_point",
  values = (function() local all = {} for i = 1, #cases do all[i] = i end return all end)(),
  value = function(run) return run.capacity.performance[variant].top_displacement_m / top end }
-- The corner of the curve lies between two states, an eighth of a step apart.
expect("metrics.performance_point_least", 1, { between = { 0.995, 1.001 }, source = "annex B of an elastic and perfectly plastic oscillator" })
expect("metrics.performance_point_most", 1, { between = { 0.999, 1.005 }, source = "annex B of an elastic and perfectly plastic oscillator" })
expect("capacity.performance.n2.verdict", "within the curve")
expect("capacity.performance.gamma", 1, { rel = 1e-4, source = "one block has one shape" })
