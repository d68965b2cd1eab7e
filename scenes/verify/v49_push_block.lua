-- V49: a block on a bed, pushed until it topples or slides: by acceleration, by tilting, by displacement, with every way of relaxation.
--
-- What happens   The multiplier grows through states of equilibrium. The bed carries no tension and is pressed in at the toe of the block, so
--                that the block topples below b / h.
-- Source         Balance of a block of half width b and half height h on a bed of stiffness kn, width d, at the rotation r: the toe bears
--                c = sqrt(2 N / (kn d r)), its force acts at c / 3, and lambda = (b - c / 3) / h - r. Its greatest value, over r, is
--                lambda = b / h - 3 (k / (6 h))^(2/3),   k = sqrt(2 N / (kn d)),   or mu if that is less.
--                A tilted block weighs cos(angle) times as much on its bed.
-- How to run     erbs run scenes/verify/v49_push_block.lua [-D case=7]
-- What to look at  push_block_least, push_block_most: capacity over that of the formula, least and most of all cases.
local density, d = 2000, 1
local cases = {}
local function case(keys) cases[#cases + 1] = keys end
for _, b in ipairs { 0.1, 0.3, 0.6 } do case { b = b, h = 1, kn = 1e12, mu = 0.7 } end
for _, kn in ipairs { 1e9, 1e10, 1e11 } do case { b = 0.2, h = 1, kn = kn, mu = 0.7 } end
for _, mu in ipairs { 0.05, 0.15, 0.19 } do case { b = 0.2, h = 1, kn = 1e12, mu = mu } end
case { b = 0.02, h = 0.1, kn = 1e12, mu = 0.7 }
case { b = 2, h = 10, kn = 1e11, mu = 0.7 }
case { b = 0.2, h = 1, kn = 1e11, mu = 0.7, direction = { 0.6, 0.8, 0 } }
case { b = 0.2, h = 1, kn = 1e11, mu = 0.7, direction = "-x" }
case { b = 0.2, h = 1, kn = 1e11, mu = 0.7, relaxation = "local" }
case { b = 0.2, h = 1, kn = 1e11, mu = 0.7, relaxation = "adaptive" }
case { b = 0.2, h = 1, kn = 1e11, mu = 0.7, inertia = "true" }
case { b = 0.2, h = 1, kn = 1e11, mu = 0.7, kind = "tilt" }
case { b = 0.2, h = 1, kn = 1e12, mu = 0.15, kind = "tilt" }
case { b = 0.2, h = 1, kn = 1e11, mu = 0.7, kind = "force" }
case { b = 0.2, h = 1, kn = 1e10, mu = 0.7, kind = "displacement" }

local number = param("case", 1, "the case")
local c = cases[number] or error("case is 1 to " .. #cases)
local size = { 2 * c.b, d, 2 * c.h }
local direction = c.direction or "x"
material { name = "stone", density = density, kn = c.kn, ks = 0.4 * c.kn, friction = c.mu }
box { name = "floor", size = { 8 * c.h, 8 * c.h, c.h }, at = { -4 * c.h, -4 * c.h, -c.h }, fixed = true }
if type(direction) == "table" then  -- the block is turned square to the push
  transform { rotation = { 0, 0, math.atan(0.8, 0.6) }, function() box { name = "block", size = size, at = { -c.b, -d / 2, 0 } } end }
else
  box { name = "block", size = size, at = { -c.b, -d / 2, 0 } }
end
joint { law = dry { kn = c.kn, ks = 0.4 * c.kn, mu = c.mu } }
local weight = density * size[1] * size[2] * size[3] * g
local push = { kind = c.kind == "tilt" and "tilt" or "pushover", relaxation = c.relaxation, inertia = c.inertia, direction = direction }
if c.kind == "force" then push.pattern = { { block = "block", force = { weight, 0, 0 } } } end
if c.kind == "displacement" then push.control, push.displacement = "displacement", 0.05 end
analysis(push)

local function toppling(N) return c.b / c.h - 3 * (math.sqrt(2 * N / (c.kn * d)) / (6 * c.h)) ^ (2 / 3) end
local on_paper = math.min(c.mu, toppling(weight))
if c.kind == "tilt" then
  for _ = 1, 20 do on_paper = math.min(c.mu, toppling(weight * math.cos(math.atan(on_paper)))) end
end
metric("on_paper", "", on_paper)
converge { param = "case", name = "push_block", values = (function() local all = {} for i = 1, #cases do all[i] = i end return all end)(),
  value = function(run) return run.capacity.multiplier / on_paper end }
-- The bracket of .2 %, and for control by displacement an eighth of a step.
expect("metrics.push_block_least", 1, { between = { 0.996, 1.001 }, source = "toe of an elastic bed" })
expect("metrics.push_block_most", 1, { between = { 0.999, 1.002 }, source = "toe of an elastic bed" })
expect("capacity.unbalanced_relative", 1e-5, { below = true, source = "criterion of equilibrium" })
