-- V60: a tall stack of rigid blocks on elastic beds, pushed until it topples: the capacity that its leaning takes away.
--
-- What happens   The multiplier grows through states of equilibrium. Beds open along the height, each a little; the stack bends towards the
--                push, its weight acts further out, and the toe of each bed is pressed. Both leave less than the rigid stack has.
-- Source         Each bed is a section without tension (Navier): at the eccentricity e = M / N of its force it turns by 12 M / (kn t b^3) up to
--                e = b / 6, then by 2 N / (9 kn t (b / 2 - e)^2). From the top down, at a given rotation of the topmost block, moments follow
--                from the blocks above, turned as they are, and rotations from the moments; the multiplier is the one with which the floor
--                does not turn, and the capacity is the greatest of them over that rotation (Yokel 1971 for one without lateral load).
--                From case 15 on the corners bear, a quarter of the bed each: a bed then turns by 4 M / (kn t b^3) up to e = b / 2. From case
--                21 on they yield at fc: up to the e at which those of one edge, half of the bed, do, N (1 + 2 e / b) = fc b t.
-- How to run     erbs run scenes/verify/v60_tall_stack.lua [-D case=3]
-- What to look at  stack_least, stack_most: capacity over the one on paper. on_paper_over_rigid: what the lean leaves.
local b, t, density = 4, 1, 2000  -- m, m, kg/m3
local cases = {}
for _, blocks in ipairs { 5, 12, 30 } do
  for _, kn in ipairs { 1e9, 3e9, 1e10, 1e11 } do cases[#cases + 1] = { blocks = blocks, kn = kn, height = 20 } end
end
for _, shear in ipairs { 4, 40 } do cases[#cases + 1] = { blocks = 12, kn = 1e9, height = 20, shear = shear } end
for _, blocks in ipairs { 5, 30 } do
  for _, kn in ipairs { 1e8, 1e9, 1e10 } do
    cases[#cases + 1] = { blocks = blocks, kn = kn, height = 20, corners = true, shear = kn < 1e9 and 4 or nil }
  end
end
for _, kn in ipairs { 1e9, 1e10 } do  -- the lowest bed bears this share of fc
  for _, share in ipairs { 0.4, 0.6, 0.8 } do cases[#cases + 1] = { blocks = 5, kn = kn, height = 20, corners = true, share = share } end
end
local number = param("case", 1, "the case")
local c = cases[number] or error("case is 1 to " .. #cases)
local h = c.height / c.blocks
local ks = (c.shear or 0.4) * c.kn

material { name = "stone", density = density, kn = c.kn, ks = ks, friction = 0.7 }
box { name = "floor", size = { 12, 12, 1 }, at = { -6, -6, -1 }, fixed = true }
column { name = "stack", blocks = c.blocks, size = { b, t, h } }
local fc = c.share and density * g * c.height / c.share or math.huge
local law = c.share and mortar { kn = c.kn, ks = ks, mu = 0.7, ft = 0, c = 0, fc = fc } or dry { kn = c.kn, ks = ks, mu = 0.7 }
if c.corners then joint { law = law, rule = "trapezoid", points = 4, pressure = "points" } else joint { law = law } end
analysis { kind = "pushover", bracket = 0.002 }

local weight = density * b * t * h * g
local function turned_by(N, M)  -- rad, rotation of a bed; nothing where the force leaves it
  local e = M / N
  if c.corners then return e < b / 2 and N * (1 + 2 * e / b) < fc * b * t and 4 * M / (c.kn * t * b ^ 3) or nil end
  if e < b / 6 then return 12 * M / (c.kn * t * b ^ 3) end
  return e < b / 2 and 2 * N / (9 * c.kn * t * (b / 2 - e) ^ 2) or nil
end
-- Whether the floor would have to turn against the push: the multiplier is too small for this rotation of the topmost block.
local function too_small(multiplier, rotation)
  local x, z, blocks, at = 0, 0, 0, { x = 0, z = 0 }  -- centre of a block; the ones above: their number and mean place
  for _ = 1, c.blocks do
    at.x, at.z = (at.x * blocks + x) / (blocks + 1), (at.z * blocks + z) / (blocks + 1)
    blocks = blocks + 1
    local bed_x, bed_z = x - h / 2 * math.sin(rotation), z - h / 2 * math.cos(rotation)
    local N = blocks * weight * (math.cos(rotation) - multiplier * math.sin(rotation))
    local turn = turned_by(N, blocks * weight * (multiplier * (at.z - bed_z) + at.x - bed_x))
    if not turn then return false end
    rotation = rotation - turn
    local closure = N / (c.kn * b * t)  -- of the middle; matters for the softest beds, which are pressed all over or at their corners
    x, z = bed_x - h / 2 * math.sin(rotation), bed_z + closure - h / 2 * math.cos(rotation)
  end
  return rotation > 0
end
local function on_paper()
  local best, rigid = 0, b / c.height
  for i = 1, 400 do
    local lo, hi = 0, rigid
    for _ = 1, 40 do
      local mid = (lo + hi) / 2
      if too_small(mid, 0.5 * rigid * (i / 400) ^ 2) then lo = mid else hi = mid end
    end
    best = math.max(best, lo)
  end
  return best
end
local paper = on_paper()
metric("on_paper", "", paper)
metric("on_paper_over_rigid", "", paper * c.height / b)
converge { param = "case", name = "stack", values = (function() local all = {} for i = 1, #cases do all[i] = i end return all end)(),
  value = function(run) return run.capacity.multiplier / paper end }
-- The capacity is that of the last state in equilibrium, up to .2 % low. Shear of the beds, left out on paper, adds to the lean: .4 % in
-- case 9, gone with a hundred times their ks.
expect("metrics.stack_least", 1, { between = { 0.99, 1.003 }, source = "sections without tension, second order" })
expect("metrics.stack_most", 1, { between = { 0.99, 1.003 }, source = "likewise" })
