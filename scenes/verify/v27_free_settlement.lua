-- V27: stacks of blocks under their own weight: reaction, joint forces and settlement.
--
-- What happens   The static start brings each stack to rest on its joints, and it stays at rest. One stack has equal bricks on dry joints,
--                one has unequal blocks on mortar beds, one also carries a load.
-- Source         equilibrium: N_i = weight above; settlement of block i = sum over the joints below of N / (kn A).
-- How to run     erbs run scenes/verify/v27_free_settlement.lua [-D n=50] [-D kn=...] [-D density=...]
-- What to look at  force_error, settlement_error, reaction_error, drift (largest motion during the run over the settlement).
label("quick")
local n = param("n", 10, "blocks of a stack")
local kn = param("kn", 1e10, "[Pa/m]")
local density = param("density", 1800, "[kg/m3]")
local load = param("load", 2 * kN, "on top of the third stack [N]")

material { name = "brick", density = density }
local stacks, total = {}, 0
local function stack(name, x, law, t, size_of, top)
  local z, blocks = 0, {}
  box { name = name .. "_foot", group = name, size = { 1, 1, 0.1 }, at = { x - 0.5, -0.5, -0.1 }, fixed = true }
  for i = 1, n do
    local s = size_of(i)
    z = z + t
    local block = { name = name .. i, weight = density * s[1] * s[2] * s[3] * g, size = s }
    box { name = block.name, group = name, size = s, at = { x - s[1] / 2, -s[2] / 2, z } }
    z = z + s[3]
    local below = blocks[i - 1]
    block.area = below and math.min(s[1], below.size[1]) * math.min(s[2], below.size[2]) or s[1] * s[2]
    recorder { name = block.name, quantity = "displacement", block = block.name, axis = "z" }
    recorder { name = block.name, quantity = "normal_force", blocks = { below and below.name or name .. "_foot" }, others = { block.name } }
    blocks[i] = block
  end
  if top then force { block = name .. n, wave = top, direction = { 0, 0, -1 } } end
  joint { law = law, between = { name, name }, thickness = t }
  local above = top or 0
  for i = n, 1, -1 do
    above = above + blocks[i].weight
    blocks[i].force = above
  end
  total = total + above
  local settled = 0
  for i = 1, n do
    settled = settled + blocks[i].force / (kn * blocks[i].area)
    blocks[i].settlement = settled
  end
  stacks[#stacks + 1] = { name = name, blocks = blocks }
end
local function unequal(i) return { 0.3 + 0.02 * (i % 3), 0.125 + 0.01 * (i % 4), 0.08 + 0.01 * (i % 5) } end
stack("equal", 0, dry { kn = kn, mu = 0.6 }, 0, function() return { 0.3, 0.125, 0.1 } end)
stack("unequal", 3, mortar { kn = kn, ks = 0.4 * kn, ft = 0.2 * MPa, c = 0.3 * MPa, mu = 0.6 }, 5 * mm, unequal)
stack("loaded", 6, dry { kn = kn, mu = 0.6 }, 0, unequal, load)
recorder { name = "base", quantity = "reaction" }

local function worst(run, error_of)
  local largest = 0
  for _, s in ipairs(stacks) do
    for _, block in ipairs(s.blocks) do largest = math.max(largest, math.abs(error_of(block))) end
  end
  return largest
end
metric("force_error", "", function(run)
  return worst(run, function(b) return -run.last(b.name .. "_normal_N") / b.force - 1 end)
end)
metric("settlement_error", "", function(run)
  return worst(run, function(b) return -run.last(b.name .. "_uz_rel_m") / b.settlement - 1 end)
end)
metric("drift", "", function(run)
  return worst(run, function(b) return (run.max(b.name .. "_uz_rel_m") - run.min(b.name .. "_uz_rel_m")) / b.settlement end)
end)
metric("reaction_error", "", function(run) return -run.last("base_fz_N") / total - 1 end)
analysis { duration = 0.1, start = "equilibrium", output_dt = 0.01 }
-- The unbalanced force at the start is below 1e-11 of the largest load; afterwards it vibrates undamped.
expect("metrics.force_error", 0, { abs = 1e-8, source = "weight above" })
expect("metrics.settlement_error", 0, { abs = 1e-8, source = "sum of N / (kn A)" })
expect("metrics.drift", 0, { abs = 1e-8, source = "at rest" })
expect("metrics.reaction_error", 0, { abs = 1e-8, source = "whole weight" })
