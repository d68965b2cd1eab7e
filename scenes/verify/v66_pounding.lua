-- V66: two blocks on springs strike each other
--
-- What happens   Two towers of one block each stand on soft beds, side by side. One starts with a speed towards the other and strikes it.
--                Nothing is loose; an intact structure begins to touch itself.
-- Source         Free vibration until the gap is closed, then Newton's restitution for equal masses: the struck block leaves with (1 + e) / 2
--                of the speed, and swings out by that over its frequency (Goldsmith 1960, Impact)
-- How to run     erbs run scenes/verify/v66_pounding.lua [-D gap=1e-4] [-D kn=1e8] [-D size=1]
-- What to look at  metrics.swing_over_paper: 0 where the contact of intact blocks is overlooked
label("quick")
local size, kn, e = param("size", 0.3, "[m]"), param("kn", 1e8, "[Pa/m] of the beds"), param("restitution", 0.3)
local gap, swing = param("gap", 0.3, "of the swing without contact"), param("swing", 0.02, "of the first block, over its size")
local stiffer, turn = param("stiffer", 1e4, "contact over bed"), param("turn", 0, "[degrees] of all from x")
family({ size = { 0.05, 2 }, kn = { 1e7, 1e9, 1e10 }, restitution = { 0.1, 0.8 }, gap = { 0.01, 0.9 }, swing = { 5e-3, 0.05 }, stiffer = { 3e3, 1e5 },
  turn = { 30, 90 } }, { combinations = 16 })
gravity(0)
local density, along, thin = 2000, { math.cos(turn * deg), math.sin(turn * deg), 0 }, size / 4
material { name = "stone", density = density, friction = 0, restitution = e, kn = stiffer * kn, ks = 0.4 * stiffer * kn }
local function place(name, x, thickness, keys)
  keys.name, keys.group, keys.size = name, keys.fixed and "walls" or "towers", { thickness, size, size }
  keys.center = { x * along[1], x * along[2], 0 }
  keys.rotation = { 0, 0, turn * deg }
  box(keys)
end
local w = math.sqrt(kn / (density * size))  -- rad/s
local reach = swing * size                  -- m, of the first block without the second
local between = gap * reach
place("left", -thin / 2, thin, { fixed = true })
place("first", size / 2, size, { initial = { velocity = { w * reach * along[1], w * reach * along[2], 0 } } })
place("second", 1.5 * size + between, size, {})
place("right", 2 * size + between + thin / 2, thin, { fixed = true })
joint { law = mortar { kn = kn, ks = 0.4 * kn, ft = 1e9, c = 1e9, mu = 0.7 } }
joint { none = true, between = { "towers", "towers" } }
recorder { name = "second", quantity = "displacement", block = "second" }
local period = 2 * math.pi / w
analysis { duration = 0.7 * period, output_dt = period / 2000, start = "rest" }
metric("swing_over_paper", "", function(run)
  local x, y = run.history "second_ux_rel_m", run.history "second_uy_rel_m"
  local most = 0
  for i = 1, #x do most = math.max(most, x[i] * along[1] + y[i] * along[2]) end
  return most / ((1 + e) / 2 * math.sqrt(1 - gap ^ 2) * reach)
end)
expect("metrics.swing_over_paper", 1, { abs = 0.05, source = "Newton; the blow lasts up to a tenth of the period" })
expect("energy.residual_relative", 1e-3, { below = true, source = "gate" })
