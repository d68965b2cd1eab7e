-- V18: the ultimate moment of a dry joint is N H/2 for every quadrature rule: the toe lies at the true edge.
--
-- What happens   Held blocks are rotated further and further at constant compression N. M / (N H/2) = 1 - 2a/(3H), and the contact length a
--                = sqrt(2 N / (kn B theta)) shrinks to nothing. Two midpoints without this closed form would stop at 1 - 1/2.
-- Source         bed of springs without tension; rigid-plastic limit N H/2 of rocking.
-- How to run     erbs run scenes/verify/v18_ultimate_moment.lua [-D side=...] [-D kn=...] [-D load=...]
-- What to look at  moment_*: M over N H/2, towards 1; the last of each rule is the rocking limit.
label("quick")
local H, B = param("side", 0.3, "side along the bending [m]"), param("width", 0.125, "the other side [m]")
local kn, load = param("kn", 1e11, "[Pa/m]"), param("load", 50 * N, "compression N [N]")

gravity(0)
material { name = "brick", density = 1800 }
local number = 0
for _, rule in ipairs { { "simpson", 3 }, { "midpoint", 1 }, { "midpoint", 2 }, { "midpoint", 4 }, { "trapezoid", 2 }, { "gauss", 2 } } do
  for i, share in ipairs { 0.3, 0.1, 0.03, 0.01 } do
    number = number + 1
    local name, a = string.format("%s%d_%d", rule[1], rule[2], i), share * H
    local base, theta = "base_" .. name, 2 * load / (kn * B * a ^ 2)
    local lift = theta * (H / 2 - a) + 0.05 * (1 - math.cos(theta))  -- the centroid is 5 cm above the joint
    box { name = base, group = base, size = { H, B, 0.1 }, at = { 2 * H * number, 0, -0.1 }, fixed = true }
    box { name = name, group = name, size = { H, B, 0.1 }, at = { 2 * H * number, 0, 0 }, initial = { rotation = { 0, theta, 0 }, position = { 0, 0, lift } } }
    local n = { rule[2], math.max(2, rule[2]) }
    joint { law = dry { kn = kn, mu = 0 }, between = { base, name }, rule = rule[1], points = H >= B and n or { n[2], n[1] } }
    motion { block = name, wave = lift, direction = "z" }
    recorder { name = name, quantity = "joint_moment", blocks = { base }, others = { name }, axis = "y" }
    recorder { name = name, quantity = "normal_force", blocks = { base }, others = { name } }
    metric("moment_" .. name, "", function(run)
      return math.abs(run.last(name .. "_my_N_m") / run.last(name .. "_normal_N")) / (H / 2)
    end)
    -- Arms rotate by theta: theta^2, and theta times the lever of half the block's height over H/2; the depth of the toe over a is theta.
    expect("metrics.moment_" .. name, 1 - 2 * share / 3, { abs = 1e-9 + 2 * theta, source = "1 - 2 a / (3 H)" })
  end
end
analysis { duration = 1e-5, dt = 1e-6, start = "rest", output_dt = 1e-6 }
