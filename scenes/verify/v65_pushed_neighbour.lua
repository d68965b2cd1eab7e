-- V65: a plate is pushed against a block that only mortar holds
--
-- What happens   A block stands on a bed of strong mortar. A plate comes down on it, closes a gap, and presses the block on its bed. Neither is
--                loose: contact begins between blocks of an intact structure.
-- Source         Two beds in series: F = (way - gap) A / (1 / kn of the bed + 1 / kn of contact), the gap with the settlement of the block
-- How to run     erbs run scenes/verify/v65_pushed_neighbour.lua [-D gap=0] [-D size=2] [-D kn=1e8]
-- What to look at  metrics.force_over_paper: 0 where the contact of intact blocks is overlooked
label("quick")
local size, kn = param("size", 0.2, "[m]"), param("kn", 1e10, "[Pa/m] of the bed")
local contact, gap = param("contact", 2e10, "[Pa/m]"), param("gap", 0.01, "[m]")
local closing = param("closing", 1e-3, "way of the plate after the gap, over the size")
local others = param("others", 0, "loose bricks that lie elsewhere")
family({ size = { 0.05, 2 }, kn = { 1e8, 1e9, 1e12 }, contact = { 1e9, 1e11 }, gap = { 0, 1e-4, 0.2 }, closing = { 1e-4, 3e-3 }, others = { 1 } },
  { combinations = 16 })
gravity(g)
local density, area = 2000, size ^ 2
material { name = "stone", density = density, friction = 0.6, kn = contact, ks = 0.4 * contact }
box { name = "ground", group = "ground", size = { 6 * size, 6 * size, size / 4 }, center = { 0, 0, -size / 8 }, fixed = true }
box { name = "block", group = "block", size = { size, size, size }, center = { 0, 0, size / 2 } }
box { name = "plate", size = { size, size, size / 4 }, center = { 0, 0, size + gap + size / 8 } }
joint { law = mortar { kn = kn, ks = 0.4 * kn, ft = 1e9, c = 1e9, mu = 0.7 }, between = { "ground", "block" } }
for i = 1, others do
  box { name = "brick" .. i, size = { size, size / 2, size / 3 }, center = { 2 * i * size, 0, size / 6 }, free = true }
end
local settles = density * size * g / kn
local way, stiffness = gap + settles + closing * size, area / (1 / kn + 1 / contact)
local period = 2 * math.pi * math.sqrt(density * size / kn)
local ramp = math.max(40 * period, 20 * way)  -- s; slow against the block, at most 0.1 m/s
motion { block = "plate", direction = { 0, 0, -1 }, wave = function(t)
  local x = math.min(1, t / ramp)
  return way * x ^ 3 * (10 - 15 * x + 6 * x ^ 2)
end, sample = ramp / 500 }
recorder { name = "plate", quantity = "reaction", block = "plate", axis = "z" }
analysis { duration = 1.1 * ramp }
metric("force_over_paper", "", function(run) return run.last "plate_fz_N" / (stiffness * closing * size) end)
expect("metrics.force_over_paper", 1, { abs = 0.01, source = "beds in series" })
expect("energy.residual_relative", 1e-3, { below = true, source = "gate" })
