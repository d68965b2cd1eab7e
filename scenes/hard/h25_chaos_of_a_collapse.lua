-- Hard case 25: a collapse is chaotic, and still reproducible to the bit.
--
-- What happens   A pillar of dry blocks is shaken down. A start that differs by 1e-9 of a block's size ends elsewhere. Two things hold: the
--                statistics of many such starts, and the bits of one start, which are the same in every run.
-- Source         chaos; fixed order of all sums.
-- How to run     erbs run scenes/hard/h25_chaos_of_a_collapse.lua [-D noise=1e-6] [-D amplitude=1]
-- What to look at  time_mean, time_deviation: time of the collapse over the ensemble; place_deviation: final position of the top block;
--                same_deviation: a fingerprint of all bits over identical runs, 0.
local seed = param("seed", 0, "of the noise; 0: none")
local again = param("again", 0, "changes nothing: runs that must end alike")
local noise = param("noise", 1e-9, "of the start, of a block's size")
local amplitude = param("amplitude", 0.8, "of the ground, of g")
local courses = param("courses", 6, "")
local kn = param("kn", 2e9, "[Pa/m]")

local size = { 0.3, 0.3, 0.2 }
material { name = "stone", density = 2200, friction = 0.6, kn = kn, ks = 0.4 * kn, restitution = 0.2 }
box { name = "floor", group = "floor", size = { 8, 8, 0.2 }, at = { -4, -4, -0.2 }, fixed = true }
local number = (seed % 100003) * 7919 + 17
local function draw()
  number = 16807 * number % 2147483647
  return (number / 2147483647 - 0.5) * (seed > 0 and noise * size[3] or 0)
end
for i = 1, courses do
  box { name = "b" .. i, group = "pillar", size = size, at = { -0.15, -0.15, (i - 1) * size[3] },
    initial = { velocity = { 10 * draw(), 10 * draw(), 0 } } }
end
joint { law = dry { kn = kn, mu = 0.6 } }
ground_motion { wave = sine { amplitude = amplitude * g, frequency = 1.5 }, direction = { 1, 0.2, 0 } }
local top = "b" .. courses
recorder { name = "top", quantity = "displacement", block = top }
analysis { duration = 2.5, output_dt = 0.01, frame_dt = 0.1 }
-- The last 12 hexadecimal digits of the hash, which a number holds exactly.
local function fingerprint(run) return tonumber("0x" .. run.state_hash:gsub("[^%x]", ""):sub(-12)) end
metric("collapse_time", "s", function(run) return run.collapse.time_s end)
ensemble { n = 8, seed = 1, name = "time", value = function(run) return run.collapse.time_s end }
ensemble { n = 8, seed = 1, name = "place", value = function(run) return run.last("top_ux_rel_m") end }
ensemble { n = 3, seed = 1, name = "same", param = "again", value = fingerprint }
expect("collapse.collapsed", true)
expect("metrics.time_failed", 0, { abs = 0, source = "every run ends" })
-- The onset precedes chaos: its scatter is less than a tenth of it, while final positions differ by centimetres.
expect("metrics.time_deviation", 0.1, { below = true, source = "statistics hold" })
expect("metrics.same_deviation", 0, { abs = 0, source = "fixed summation order, no fast mathematics" })
expect("metrics.place_deviation", 0, { above = true, source = "chaos: places differ" })
expect("energy.residual_relative", 1e-2, { below = true, source = "gate of a collapse" })
