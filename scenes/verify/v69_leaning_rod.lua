-- V69: a smooth rod with sharp ends slides down a wall and leaves it
--
-- What happens   A rod leans on a wall and stands on the ground, both without friction. Its upper end slides down the wall until it leaves it;
--                then the rod keeps its speed along the ground. Its ends are knife edges: of the two faces at such an edge one presses forward
--                and one back, and the dashpot of the first exceeded the net pressure, so that the wall held the rod by up to 31 % of its weight.
-- Source         Energy, and the wall's reaction m x'' = 0: sin(theta) = 2/3 sin(theta0), whatever the inertia. With I = k m L2 the speed is
--                L/3 sin(theta0) sqrt(g sin(theta0) / (3 L (1/4 + k))); a rhombus of thickness 2 d has k = (1 + (2 d / L)^2) / 24.
-- How to run     erbs run scenes/verify/v69_leaning_rod.lua [-D thickness=.004] [-D angle=50]
-- What to look at  metrics.speed, and metrics.pull: what the wall pulls, over the weight.
label("quick")
local length, share = param("length", 1, "[m]"), param("share", 0.05, "half its thickness over its length")
local angle, kn = param("angle", 60, "[degrees] from the ground"), param("kn", 1e10, "[Pa/m]")
local e = param("restitution", 0.3)
family({ length = { 0.2, 4 }, share = { 0.002, 0.02, 0.1 }, angle = { 45, 70 }, kn = { 1e11, 1e12 }, restitution = { 0, 0.8 } }, { combinations = 12 })

local d, wide = share * length, 0.5 * length
local s, c = math.sin(angle * deg), math.cos(angle * deg)
gravity(g)
material { name = "stone", density = 2000, kn = kn, ks = 0.4 * kn, friction = 0, restitution = e }
ground { size = 40 * length, material = "stone" }
box { name = "wall", size = { length, 4 * length, 4 * length }, at = { -length, -2 * length, 0 }, fixed = true }
local middle = { length * s / 2, length * c / 2 }  -- z, x
prism { name = "rod", axis = "y", height = wide, at = { 0, -wide / 2, 0 }, free = true,
  polygon = { { 0, length * c }, { middle[1] + d * c, middle[2] + d * s }, { length * s, 0 }, { middle[1] - d * c, middle[2] - d * s } } }
recorder { name = "rod", quantity = "velocity", block = "rod", axis = "x" }
recorder { name = "wall", quantity = "reaction", block = "wall" }

local k = (1 + (2 * share) ^ 2) / 24
local speed = length / 3 * s * math.sqrt(g * s / (3 * length * (1 / 4 + k)))
local weight = 2000 * length * d * wide * g
local slow = math.sqrt(length / g)
analysis { duration = 1.2 * slow, output_dt = slow / 500, frame_dt = slow, start = "rest" }
metric("speed", "", function(run) return run.max "rod_vx_rel_m_s" / speed end)
metric("pull", "", function(run) return math.max(0, run.max "wall_fx_N") / weight end)
expect("metrics.speed", 1, { abs = 0.02, source = "a rigid rod" })
expect("metrics.pull", 1e-9, { below = true, source = "contact does not pull" })
expect("energy.residual_relative", 1e-3, { below = true, source = "gate" })
