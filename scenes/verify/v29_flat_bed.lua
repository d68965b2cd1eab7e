-- V29: a block that rocks with its whole face on a bed keeps more of its spin than Housner's block, whose edges alone touch.
--
-- What happens   A block is set spinning about its edge and rocks to a share of alpha. At each impact its face sweeps shut on the bed, and the bed
--                throws it over the other edge. Peaks before and after give the spin kept, and from it follows where the impulse acts.
-- Source         Angular momentum about the place x of the impulse, from the middle of the base: spin after over before = (c - b x) / (c + b x),
--                c = I / m + h^2; x = b is Housner 1963. A face that presses as fast as it is approached takes the impulse at b / 3; a bed that takes
--                energy takes it further out, and one that returns more further in. `erbs check` tells of it (engine/analysis/flat_bed.h).
-- How to run     erbs run scenes/verify/v29_flat_bed.lua [-D width=...] [-D height=...] [-D kn=...] [-D restitution=...] [-D damping=...]
-- What to look at  place (of the first two impulses, over b): near .45 at restitution .3; kept, beside housner.
label("quick")
local width, height, kn = param("width", 0.3, "[m]"), param("height", 1, "[m]"), param("kn", 1e10, "[Pa/m]")
local phi, damping, restitution = param("phi", 0.4, "of alpha"), param("damping", 0.1, "of the joint"), param("restitution", 0.3, "of the contact")
family({ width = { 0.15, 0.4 }, height = { 0.7, 2 }, kn = { 1e9, 1e11, 1e12 }, damping = { 0.5, 1 }, phi = { 0.2, 0.7 } }, { combinations = 8 })
if width > 0.6 * height then error("the block is too stout to rock on; make it higher", 0) end
if height > 8 * width then error("so slender a block loses too little at an impact for its peaks to tell where; make it wider", 0) end
local toe = math.sqrt(2 * 2200 * width * height * g * height / width / kn)  -- m, of the bed under the edge at alpha, for a block 1 m deep
if toe > 0.05 * width / 2 then error("the toe is too wide a share of the base for the peaks to tell the energy; make kn or width larger", 0) end
local alpha, p = math.atan(width, height), math.sqrt(1.5 * g / math.sqrt(width ^ 2 + height ^ 2))
local spin = p * math.sqrt(2 * (math.cos(alpha - phi * alpha) - math.cos(alpha)))
material { name = "stone", density = 2200, friction = 1, restitution = restitution }
box { name = "base", size = { 3, 2, 0.2 }, center = { 0, 0, -0.1 }, fixed = true }
box { name = "block", size = { width, 1, height }, center = { 0, 0, height / 2 }, initial = { velocity = { spin * height / 2, 0, spin * width / 2 }, spin = { 0, spin, 0 } } }
joint { law = dry { kn = kn, mu = 1, damping = damping } }
recorder { name = "block", quantity = "rotation", block = "block", axis = "y" }
local function peaks(run)
  local all, top, side = {}, 0, 1
  for _, turn in ipairs(run.history("block_ry_rad")) do
    if turn * side < 0 then all[#all + 1], top, side = top, 0, -side end
    top = math.max(top, math.abs(turn))
  end
  return all
end
local function energy(turn) return math.cos(alpha - turn) - math.cos(alpha) end
local b, c = width / 2, (width ^ 2 + 4 * height ^ 2) / 12
local function kept(run)
  local top = peaks(run)
  return (energy(top[3]) / energy(top[1])) ^ 0.25  -- two impacts
end
metric("kept", "", kept)
metric("housner", "", (c - b * b) / (c + b * b))
metric("place", "", function(run)
  local share = kept(run)
  return c * (1 - share) / (1 + share) / b ^ 2
end)
local quarter = math.log(1 / (1 - phi) + math.sqrt(1 / (1 - phi) ^ 2 - 1)) / p  -- s, Housner 1963, eq. 2
analysis { duration = 8 * quarter, start = "rest", output_dt = 1e-3, frame_dt = 1 }
expect("metrics.place", 0.45, { abs = 0.1, source = "the face returns .3 of the speed: between b / 3 and b" })
expect("energy.residual_relative", 1e-3, { below = true, source = "nothing is made" })
