-- Bond of one course of one stretch of wall: the pieces, and the positions of the head joints.
--
-- If whole and half bricks do not fill a stretch, there are three remedies: a cut closer, a half brick, or slightly wider head joints.
-- The remedy of least cost wins. The cost counts cuts, most of all small ones, and head joints close to a head joint beneath.
-- Positions u run along the wall, in metres.

local eps = masonry_parts.eps  -- m, lengths closer than this are equal

local function piece_kind(job, length)
  if math.abs(length - job.full) < eps then return "full" end
  if math.abs(length - job.half) < eps then return "half" end
  return "cut"
end

-- Cost of a piece: 1 for a cut, up to 2 for a small one, 0.2 more away from the ends of its stretch; 0.4 for a half.
local function piece_cost(job, length, at_end)
  local kind = piece_kind(job, length)
  if kind == "full" then return 0 end
  if kind == "half" then return 0.4 end
  return 1 + math.max(0, (job.half - length) / job.half) + (at_end and 0 or 0.2)
end

-- The first index of a rising list whose value is at least x; one past its end if there is none.
local function first_from(list, x)
  local lo, hi = 1, #list + 1
  while lo < hi do
    local middle = (lo + hi) // 2
    if list[middle] < x then lo = middle + 1 else hi = middle end
  end
  return lo
end

-- Cost of a head joint at u by its lap, the distance from the nearest head joint beneath: high below a quarter of a brick, low
-- below a half. `below` rises.
local function lap_cost(masonry, u, below)
  local lap, quarter, cost, after = masonry.full, masonry.full / 4, 0, first_from(below, u)
  for i = math.max(1, after - 1), math.min(after, #below) do lap = math.min(lap, math.abs(below[i] - u)) end
  if lap < quarter - eps then cost = 1 + 6 * (quarter - lap) / quarter end
  if lap < masonry.half then cost = cost + 0.3 * (masonry.half - lap) / masonry.half end
  return cost
end

local function joint_cost(job, u)
  local cost = job.joint_costs[u]
  if not cost then
    cost = lap_cost(job, u, job.below)
    job.joint_costs[u] = cost
  end
  return cost
end

-- The cheapest filling of [s, job.stop], as a chain { length, joint = {u, width} | nil, rest = chain, cost }. The next joint is
-- tried at the joints of the pattern, after a whole and a half brick, and at every `step` (cut bricks).
local function fill(job, s)
  local key = math.floor(s * 1e5 + 0.5)
  local answer = job.memo[key]
  if answer then return answer end
  answer = { cost = math.huge }
  job.memo[key] = answer
  local rest, first = job.stop - s, math.abs(s - job.start) < eps
  if rest < job.full + eps and rest > job.closer - eps then
    answer.cost, answer.length = piece_cost(job, rest, true), rest
  end
  local function try(u, width, extra)
    local length = u - width / 2 - s
    if length < job.closer - eps or length > job.full + eps or u + width / 2 + job.closer > job.stop + eps then return end
    local here = piece_cost(job, length, first) + joint_cost(job, u) + extra
    if here >= answer.cost then return end
    local after = fill(job, u + width / 2)
    if here + after.cost < answer.cost - 1e-9 then
      answer.cost, answer.length, answer.joint, answer.rest = here + after.cost, length, { u = u, width = width }, after
    end
  end
  if job.pattern then
    for i = first_from(job.pattern_u, s), first_from(job.pattern_u, s + 2 * job.full) - 1 do
      try(job.pattern[i].u, job.pattern[i].width, 0)
    end
  end
  local off_pattern = job.pattern and 0.6 or 0
  try(s + job.full + job.t / 2, job.t, off_pattern)
  try(s + job.half + job.t / 2, job.t, off_pattern)
  if s - job.start < job.reach or rest < job.reach + job.full then  -- cut bricks belong near the ends of a stretch
    for k = math.ceil((s + job.closer) / job.step), math.floor((s + job.full) / job.step) do
      try(k * job.step + job.t / 2, job.t, off_pattern)
    end
  end
  return answer
end

-- Filling without a cut: n whole bricks (and a half at the end) with equal head joints wider than t.
local function widened(job, with_half)
  local span, t = job.stop - job.start - (with_half and job.half or 0), job.t
  local n = math.floor((span + t + eps) / (job.full + t))
  local joints = n - (with_half and 0 or 1)
  if joints < 1 then return nil end
  local width = (span - n * job.full) / joints
  if width < t + eps or width > job.joint_max + eps then return nil end
  local lengths, cost, u, chain, last = {}, 0.4 * joints * (width - t) / math.max(t, eps), job.start, nil, nil
  for i = 1, n do lengths[i] = job.full end
  if with_half then lengths[n + 1] = job.half end
  for i, length in ipairs(lengths) do
    local link = { length = length }
    cost = cost + piece_cost(job, length, true)
    if i < #lengths then
      link.joint = { u = u + length + width / 2, width = width }
      cost = cost + joint_cost(job, link.joint.u)
      u = u + length + width
    end
    if last then last.rest = link else chain = link end
    last = link
  end
  chain.cost = cost
  return chain
end

-- Pieces and head joints of one stretch [start, stop], without a joint at its ends. below: positions of the head joints beneath, rising.
-- pattern: joints {u, width} of the solid wall, which the course keeps where it can; nil while the pattern itself is chosen.
local function lay(masonry, start, stop, below, pattern)
  local near, kept, kept_u = {}, pattern and {}, {}
  local signature = { string.format("%.2f %.2f |", start * 1e3, stop * 1e3) }
  local function within(u) return u > start - masonry.full and u < stop + masonry.full end
  for _, u in ipairs(below) do
    if within(u) then near[#near + 1], signature[#signature + 1] = u, string.format("%.2f", u * 1e3) end
  end
  for _, p in ipairs(pattern or {}) do
    if within(p.u) then
      kept[#kept + 1], kept_u[#kept_u + 1], signature[#signature + 1] = p, p.u, string.format("p%.2f", p.u * 1e3)
    end
  end
  local key = table.concat(signature, " ")
  local found = masonry.laid[key]
  if found ~= nil then return found end
  local job = setmetatable({
    start = start, stop = stop, reach = 2 * (masonry.full + masonry.t), below = near, pattern = kept,
    pattern_u = kept_u, memo = {}, joint_costs = {},
  }, { __index = masonry })
  local chain = fill(job, start)
  if not pattern then
    for _, with_half in ipairs { false, true } do
      local other = widened(job, with_half)
      if other and other.cost < chain.cost then chain = other end
    end
  end
  found = false
  if chain.length then
    found = { pieces = {}, joints = {}, cost = chain.cost }
    local u = start
    while chain do
      found.pieces[#found.pieces + 1] = { u = u, length = chain.length }
      if chain.joint then
        found.joints[#found.joints + 1] = chain.joint
        u = chain.joint.u + chain.joint.width / 2
      end
      chain = chain.rest
    end
  end
  masonry.laid[key] = found
  return found
end

masonry_parts.lay, masonry_parts.lap_cost, masonry_parts.piece_kind = lay, lap_cost, piece_kind
masonry_parts.first_from = first_from
