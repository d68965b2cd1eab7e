-- V68: what lies on a structure without a joint weighs upon it from the start, no more and no less
--
-- What happens   Slabs lie on mortared piers, one upon the other, and no joint ties them. Nothing else acts. The feet of the piers bear all
--                that weighs, from the first instant to the last.
-- Source         Statics. A weight that came at once would press up to twice as hard (Rankine: a load applied suddenly).
-- How to run     erbs run scenes/verify/v68_slab_at_rest_on_piers.lua [-D piers=1] [-D slabs=5] [-D slope=.5] [-D start=rest]
-- What to look at  metrics.least_over_weight and metrics.most_over_weight, near 0 and 2 with start = "rest"; metrics.sways: tall piers under
--                slabs off their centre swing slowly where the weights come too fast
label("quick")
local size, piers, slabs = param("size", 0.3, "side of a pier [m]"), param("piers", 2), param("slabs", 1)
local kn, contact = param("kn", 1e9, "[Pa/m] of the beds"), param("contact", 5e10, "[Pa/m] of loose blocks")
local thickness = param("thickness", 0.5, "of a slab, over the side of a pier")
local slope = param("slope", 0, "of all, over the slope at which slabs slide or topple")
local across, start = param("across", 1, "parts of a slab on one pier"), param("start", "equilibrium")
local courses, off = param("courses", 3, "of a pier"), param("off", 0, "centre of the slabs from that of the pier, over its side")
family({ size = { 0.05, 2 }, piers = { 1 }, slabs = { 3 }, kn = { 1e10, 1e12 }, contact = { 1e9, 1e11 }, thickness = { 0.05, 1 },
  slope = { 0.3, 0.6 }, across = { 2 }, courses = { 20 }, off = { 0.05 } }, { combinations = 16 })

local density = 2000
material { name = "stone", density = density, friction = 0.6, kn = contact, ks = 0.4 * contact }
joint { law = mortar { kn = kn, ks = 0.4 * kn, ft = 100 * MPa, c = 100 * MPa, mu = 0.7 } }
joint { between = { "loose", "" }, none = true }
joint { between = { "loose", "loose" }, none = true }
local volume, turn = 0, slope * math.atan(math.min(0.6, 1 / (across * slabs * thickness)))
transform { rotation = { 0, turn, 0 }, function()
  for p = 1, piers do
    local y = (p - 1) * 3 * size
    box { name = "foot" .. p, size = { size, size, size / 2 }, at = { 0, y, -size / 2 }, fixed = true }
    for c = 1, courses do
      box { name = "pier" .. p .. "_" .. c, size = { size, size, size / 2 }, at = { 0, y, (c - 1) * size / 2 } }
      volume = volume + size ^ 3 / 2
    end
  end
  local long, high = (3 * piers - 2) * size, thickness * size
  for s = 1, slabs do
    for a = 1, across do
      box { name = "slab" .. s .. "_" .. a, group = "loose", size = { size / across, long, high }, free = true,
        at = { (a - 1) * size / across + off * size, 0, courses * size / 2 + (s - 1) * high } }
      volume = volume + size / across * long * high
    end
  end
end }
for p = 1, piers do recorder { name = "foot" .. p, quantity = "reaction", block = "foot" .. p } end
recorder { name = "top", quantity = "displacement", block = "slab" .. slabs .. "_1" }
local period = 2 * math.pi * math.sqrt(volume * density / (piers * size ^ 2 * math.min(kn / courses, contact)))
analysis { duration = 10 * period, output_dt = period / 50, frame_dt = 10 * period, start = start }
-- Most and least of the resultant of all feet, over all weight.
local function resultant(run, pick)
  local columns = {}
  for p = 1, piers do
    for _, axis in ipairs { "x", "y", "z" } do columns[#columns + 1] = run.history("foot" .. p .. "_f" .. axis .. "_N") end
  end
  local best
  for i = 1, #columns[1] do
    local sum = { 0, 0, 0 }
    for c, column in ipairs(columns) do sum[(c - 1) % 3 + 1] = sum[(c - 1) % 3 + 1] + column[i] end
    local force = math.sqrt(sum[1] ^ 2 + sum[2] ^ 2 + sum[3] ^ 2) / (volume * density * g)
    best = best and pick(best, force) or force
  end
  return best
end
metric("least_over_weight", "", function(run) return resultant(run, math.min) end)
metric("most_over_weight", "", function(run) return resultant(run, math.max) end)
metric("sways", "over the displacement of the top slab by all weight", function(run)
  local way, sag = 0, 0
  for _, axis in ipairs { "x", "y", "z" } do
    local name = "top_u" .. axis .. "_rel_m"
    way, sag = way + (run.max(name) - run.min(name)) ^ 2, sag + run.first(name) ^ 2
  end
  return math.sqrt(way / sag)
end)
expect("metrics.least_over_weight", 1, { abs = 1e-3, source = "statics" })
expect("metrics.most_over_weight", 1, { abs = 1e-3, source = "statics" })
expect("metrics.sways", 0.01, { below = true, source = "statics" })
expect("energy.residual_relative", 1e-3, { below = true, source = "gate" })
