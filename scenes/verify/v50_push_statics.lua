-- V50: capacities of columns, arches and walls by acceleration, by tilting and by displacement.
--
-- What happens   Each structure is pushed through states of equilibrium until there is none.
-- Source         V37, V40, V42, V43, V44 of this book, by limit analysis: columns b / h; arches by four hinges (parts/arch_hinges.lua); the wall
--                of Ferris and Tin-Loi 2001: 0.640, and sliding at mu; walls in running bond between .57546 and .57950; a wall on edge t / h.
-- How to run     erbs run scenes/verify/v50_push_statics.lua [-D case=4]
-- What to look at  push_statics_least, push_statics_most: capacity over the one on paper. Stiff blocks press their hinges in: up to 3 % below.
local hinges = include "parts/arch_hinges.lua"
local stiff, walls_stiff = 1e12, 2e11
local cases = {}
local function case(value, keys, build) cases[#cases + 1] = { value = value, push = keys, build = build } end

local function blocks(mu, kn) material { name = "stone", density = 2000, kn = kn or stiff, ks = 0.4 * (kn or stiff), friction = mu } end
local function floor() box { name = "floor", size = { 10, 10, 0.5 }, at = { -5, -5, -0.5 }, fixed = true } end
local function dry_joints(mu, kn) joint { law = dry { kn = kn or stiff, ks = 0.4 * (kn or stiff), mu = mu } } end

local function column_of(n)
  return function()
    blocks(0.7); floor(); column { blocks = n, size = { 1, 1, 0.5 } }; dry_joints(0.7)
  end
end
local function arch_of(n, t, embrace)
  return function()
    blocks(3); arch { radius = 10, thickness = 10 * t, width = 1, voussoirs = n, embrace = embrace * deg }; dry_joints(3)
  end
end
local function wall_of(brick, wide, courses, shift, mu)
  return function()
    blocks(mu, walls_stiff); floor()
    wall { brick = { length = brick[1], width = 0.2, height = brick[2] }, length = wide * brick[1], courses = courses, joint = 0, shift = shift,
      closer = brick[1] / 4, at = { -wide * brick[1] / 2, -0.1, 0 }, material = "stone", quiet = true }
    dry_joints(mu, walls_stiff)
  end
end
case(0.2, {}, column_of(10))
case(0.2, { kind = "tilt" }, column_of(10))
case(0.2, { control = "displacement", displacement = 0.1 }, column_of(10))
local oppenheim = hinges.multiplier(7, 0.15, 157.5 * deg)
case(oppenheim, {}, arch_of(7, 0.15, 157.5))
case(oppenheim, { kind = "tilt" }, arch_of(7, 0.15, 157.5))
case(oppenheim, { direction = "-x" }, arch_of(7, 0.15, 157.5))
case(oppenheim, { control = "displacement", displacement = 0.1, monitor = { block = "arch.v04" } }, arch_of(7, 0.15, 157.5))
case(hinges.multiplier(11, 0.2, 140 * deg), {}, arch_of(11, 0.2, 140))
case(0.64, { step = 0.04 }, wall_of({ 0.4, 0.175 }, 5, 6, 0, 0.65))
case(0.65, { step = 0.04 }, wall_of({ 0.4, 0.175 }, 5, 6, 1, 0.65))
case(0.2 / (6 * 0.175), { direction = "y" }, wall_of({ 0.4, 0.175 }, 5, 6, 0, 0.65))
case(0.2 / (6 * 0.175), { direction = "y", kind = "tilt" }, wall_of({ 0.4, 0.175 }, 5, 6, 1, 0.65))

local number = param("case", 1, "the case")
local c = cases[number] or error("case is 1 to " .. #cases)
c.push.kind = c.push.kind or "pushover"
c.build()
analysis(c.push)
metric("on_paper", "", c.value)
converge { param = "case", name = "push_statics", values = (function() local all = {} for i = 1, #cases do all[i] = i end return all end)(),
  value = function(run) return run.capacity.multiplier / c.value end }
expect("metrics.push_statics_least", 1, { between = { 0.97, 1.002 }, source = "limit analysis; pressed hinges" })
expect("metrics.push_statics_most", 1, { between = { 0.98, 1.002 }, source = "limit analysis; the bracket" })
