-- Hard case: the capacity of random structures, by push, by tilting and by control of the displacement
--
-- What happens   A seed draws a stack on a slope, a pier, an arch, a corbel, a wall, a portal, a barrel, a wall with a buttress or a room of
--                up to 75 blocks, dry or in mortar, and a direction in the plane of the ground. The structure is pushed to its capacity by
--                steps of the acceleration, tilted to it, and pushed by steps of the displacement; limit analysis of rigid blocks stands beside.
-- Source         Statics: a structure bears no more than the upper bound of limit analysis with dilatancy (Drucker 1954; Gilbert, Casapulla
--                and Ahmed 2006), and tilting by an angle is pushing by its tangent. A hinge on a bed of kn and width w carries the weight N
--                on a strip x: kn w theta x^2 / 2 = N. Its lever loses x / 3 by that, and h theta by the height h of the weight; least is
--                lost at x^3 = 12 h N / (kn w), where it is x / 2. kn is drawn so that x is some per cent of the side. A multiplier m of the
--                push loads the beds sqrt(1 + m^2) times as much as tilting does, and x grows with the cube root of that.
-- How to run     erbs run scenes/hard/random_statics.lua -D seed=17 [-D kind=3] [-D way=2]
--                erbs test scenes/hard/random_statics.lua --seeds 60
-- What to look at  over (capacity over the upper bound, less 1), short (1 less capacity over the non-associated multiplier, less what four
--                such hinges lose; limit analysis may press head joints that nothing presses), apart (greatest difference of the three ways, less
--                what hinges lose less of in tilting).
local seed = param("seed", 34, "of the draw")
local kind = param("kind", 0, "1 stack, 2 pier, 3 arch, 4 corbel, 5 wall, 6 portal, 7 barrel, 8 buttress, 9 room; 0: drawn")
local way = param("way", 1, "1 push, 2 tilting, 3 control of the displacement")
local softness = param("softness", 0, "x over the side, see above; 0: drawn")

local draw = include "parts/draw.lua" (seed)
local drawn = draw.whole(1, 9)
if kind == 0 then kind = drawn end
local mu, density = draw.uniform(0.3, 1), draw.uniform(1600, 2600)
local heading = draw.chance(0.5) and draw.whole(0, 3) * pi / 2 or draw.uniform(0, 2 * pi)
local soft = draw.log_uniform(0.01, 0.05)
if softness > 0 then soft = softness end
material { name = "brick", density = density, friction = mu }
local built = include "parts/structures.lua" (draw, kind, mu)
local side, weight = math.sqrt(built.volume / built.height), density * g * built.volume
local kn = 12 * built.height / 2 * weight / (side * (soft * side) ^ 3)
local bonded = draw.chance(0.3)  -- then tilting, which lightens the weight, is another load
local ft = density * g * built.height * draw.log_uniform(0.1, 3)
joint { law = bonded and mortar { kn = kn, ks = 0.4 * kn, ft = ft, c = ft * draw.uniform(1, 2), mu = mu } or dry { kn = kn, mu = mu } }

analysis { kind = way == 2 and "tilt" or "pushover", direction = { math.cos(heading), math.sin(heading), 0 }, fall = 0,
  up_to = way == 2 and 80 * deg or 5, monitor = { block = built.monitor or built.blocks[#built.blocks] },
  control = way == 3 and "displacement" or nil, displacement = way == 3 and 0.2 * side or nil, limit = way == 1 and "always" or "never" }

local function capacity(run) return run.capacity.multiplier end
metric("capacity", "", capacity)
local function beside(run) return bonded and run.capacity.limit.bonded or run.capacity.limit.dry end
metric("over", "", function(run) return way == 1 and run.capacity.multiplier / beside(run).associated_upper - 1 or 0 end)
metric("short", "", function(run) return way == 1 and 1 - run.capacity.multiplier / run.capacity.limit.dry.lower - 4 * soft or 0 end)
metric("kind", "", kind)
metric("mortar", "", bonded and 1 or 0)
metric("softness", "", soft)
metric("kn", "Pa/m", kn)
metric("blocks", "", #built.blocks)
converge { param = "way", name = "ways", values = bonded and { 1, 3 } or { 1, 2, 3 }, value = capacity }
metric("apart", "", function(run)
  local all = run.metrics.metrics
  if not all.ways_most then return 0 end
  local lost = bonded and 0 or math.max(0, 1 - run.capacity.multiplier / run.capacity.limit.dry.lower)
  return all.ways_most / all.ways_least - 1 - lost * (1 - (1 + run.capacity.multiplier ^ 2) ^ (-1 / 6))
end)
expect("status", "completed")
expect("metrics.over", 2e-3, { below = true, source = "upper bound theorem" })
-- No theorem bounds the capacity from below where joints slide without dilatancy. Walls that bear on each other show it: analysis presses
-- their head joints, so that friction binds them; at rest nothing does (.29 g instead of .43 for seed 4 with a buttress, in a slow ramp too).
local redundant = kind > 7 or (kind == 3 or kind == 7) and math.abs(math.cos(heading)) < 0.9  -- or an arch pushed over sideways
if not redundant then expect("metrics.short", 0.1, { below = true, source = "hinges pressed in; head joints without pressure" }) end
-- With mortar a crack sets its energy free at once and may break more; and walls and vaults that bear on each other stand in many ways where
-- they slide without dilatancy, so that the way there counts (seed 7: .7215 to .733 g by tilting in steps of other lengths).
local one_way = kind < 7 and not bonded
expect("metrics.apart", one_way and 1e-2 or 3e-2, { below = true, source = "all ways lead to one capacity" })
expect("metrics.ways_failed", 0, { abs = 0, source = "all ways lead to a capacity" })
