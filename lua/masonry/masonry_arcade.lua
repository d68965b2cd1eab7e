-- Arcades: arcade{...}, piers with round arches between them and spandrels above, tier on tier; plain Lua on top of prism{...}.
--
-- All heights are whole courses. The joints of a ring meet the beds at its back (extrados), and the top of the ring lies in the middle of a
-- course. So each piece of a course that meets the ring lies on one straight facet of it, down to the last bed below the crown. Over the
-- crown the course is split above each joint of the ring. Every piece is convex, and none ends in a thin edge.
--
-- Positions are { u, z } from the left end of the foot; u grows along the axis.

local parts, eps = masonry_parts, masonry_parts.eps
local fail = parts.fail

local tier_keys = {
  { name = "springing", unit = "m", type = "number", above = 0, required = true,
    help = "height of the springing line above the foot of the arcade; rounded to courses" },
  { name = "top", unit = "m", type = "number", above = 0, required = true,
    help = "height of its last course above the foot of the arcade; rounded to courses" },
  { name = "thickness", unit = "m", type = "number", above = 0, required = true,
    help = "least thickness of the rings; they end in the middle of a course" },
  { name = "crown", type = "integer", low = 1,
    help = "voussoirs above the last bed that meets the ring (even if an arch is a half); default about one for 1.5 courses" },
}
local block_keys = {
  { name = "length", unit = "m", type = "number", above = 0, required = true, help = "length along the axis" },
  { name = "height", unit = "m", type = "number", above = 0, required = true, help = "height of a course" },
}
masonry_functions[#masonry_functions + 1] = {
  name = "arcade",
  help = "Piers, round arches of voussoirs and the courses above them, cut along the arches, in one tier or several. Blocks meet without "
    .. "gaps; they are called arcade.c012.b003.r1 (course, number, row across) and arcade.t1.a02.v05.r1 (tier, arch, voussoir, row). "
    .. "Groups are <group>_pier, <group>_ring and <group>_spandrel.",
  returns = "blocks (names), base (names of the fixed ones), top (names of the last course), tops (m, of each tier), height, length (m), "
    .. "volume (m3), openings (by name, as t1.a02: tier, bay, span, thickness, springing, crown, center (m); ring, left, right (names)), "
    .. "piers (axis, width, foot (m); courses: names at its axis, by course from the foot of the arcade), summary",
  keys = {
    { name = "name", type = "string", default = "arcade", help = "first word of the names of its blocks" },
    { name = "group", type = "string", help = "first word of its groups; default the name" },
    { name = "at", unit = "m", type = "vec", default = { 0, 0, 0 }, help = "left end of its foot, in the middle of its width" },
    { name = "axis", type = "string", default = "x", choice = { "x", "y" }, help = "direction it runs in" },
    { name = "spans", unit = "m", type = "any", required = true,
      help = "clear width between the piers: a number, or a list with one for each arch" },
    { name = "piers", unit = "m", type = "any", required = true, help = "width of the piers: a number, or a list with one for each pier" },
    { name = "feet", unit = "m", type = "any",
      help = "where the ground is not level: height of the foot of the piers above that of the arcade, rounded to courses: a number, or a "
        .. "list with one for each pier; default 0" },
    { name = "bays", type = "integer", low = 1, help = "number of arches, where spans is one number" },
    { name = "ends", type = "string", default = "pier", choice = { "pier", "half" },
      help = "half: the first and the last arch are cut at their crown" },
    { name = "width", unit = "m", type = "number", above = 0, required = true, help = "width across the axis" },
    { name = "rows", type = "integer", low = 1, default = 1,
      help = "blocks across the width; in every other course shifted by half a block" },
    { name = "block", type = "table", keys = block_keys, required = true, help = "size of a block: { length*, height* }" },
    { name = "least", unit = "m", type = "number", above = 0,
      help = "narrowest piece that a perpend may leave; default 0.4 of the length" },
    { name = "tiers", type = "table", list = tier_keys, required = true,
      help = "from the bottom up: a list of { springing*, top*, thickness*, crown }" },
    { name = "fixed_courses", type = "integer", low = 0, default = 0, help = "courses at the foot of a pier that are part of the ground" },
    { name = "material", type = "string", help = "material of its blocks; default: the only one there is" },
    { name = "ring_material", type = "string", help = "material of the voussoirs; default that of the blocks" },
    { name = "quiet", type = "boolean", default = false, help = "true: do not print the summary" },
  },
}
local arcade_keys = masonry_functions[#masonry_functions].keys

-- The list of lengths that a key gives as a number or a list.
local function lengths(k, key, count, of_what, zero)
  local given, list = k[key], {}
  if type(given) == "number" then
    for i = 1, count or 0 do list[i] = given end
  elseif type(given) == "table" then
    for i, v in ipairs(given) do list[i] = v end
  else
    fail("arcade: %s must be a length in m or a list of lengths, not a %s", key, type(given))
  end
  for i, v in ipairs(list) do
    if type(v) ~= "number" or not (v < 1e6 and (v > 0 or zero and v == 0)) then
      fail("arcade: %s[%d] must be a %s", key, i, zero and "height of 0 m or more" or "length above 0 m")
    end
  end
  if #list == 0 then fail("arcade: %s is an empty list; give one length for each %s", key, of_what) end
  if count and #list ~= count then fail("arcade: %s has %d lengths for %d; give one for each %s", key, #list, count, of_what) end
  return list
end

-- Positions along the axis: bays { lo, hi, middle, half }, piers { lo, hi, axis, foot }, length, and the knots between which perpends are spread.
local function plan_of(k)
  if type(k.spans) == "number" and not k.bays then fail("arcade: spans is one number; give bays = ... as well, the number of arches") end
  local spans = lengths(k, "spans", k.bays, "arch")
  local half, bays, piers, u = k.ends == "half", {}, {}, 0
  if half and #spans < 2 then
    fail("arcade: ends = \"half\" cuts the first and the last of at least two arches; give two spans, or ends = \"pier\"")
  end
  local widths = lengths(k, "piers", half and #spans - 1 or #spans + 1, "pier")
  local function pier(i)
    piers[i] = { lo = u, hi = u + widths[i], width = widths[i], axis = u + widths[i] / 2, foot = 0 }
    u = u + widths[i]
  end
  if not half then pier(1) end
  for i, span in ipairs(spans) do
    local first, last = half and i == 1, half and i == #spans
    bays[i] = { span = span, half = first or last, first = first, last = last, lo = first and u - span / 2 or u }
    bays[i].hi, bays[i].middle = bays[i].lo + span, bays[i].lo + span / 2
    u = last and bays[i].middle or bays[i].hi
    if not last then pier(#piers + 1) end
  end
  for i, foot in ipairs(k.feet and lengths(k, "feet", #piers, "pier", true) or {}) do piers[i].foot = foot end
  local knots = { 0 }
  for i, p in ipairs(piers) do
    if half or (i > 1 and i < #piers) then knots[#knots + 1] = p.axis end
  end
  knots[#knots + 1] = u
  return { bays = bays, piers = piers, length = u, knots = knots }
end

-- Perpends of the solid bond in even or odd courses: blocks of equal length between two knots, shifted by half a block in odd ones.
local function bond_of(knots, length, odd)
  local list = {}
  for i = 2, #knots do
    local from, to = knots[i - 1], knots[i]
    local n = math.max(1, math.floor((to - from) / length + 0.5))
    for j = odd and 0 or 1, n - 1 do list[#list + 1] = from + (j + (odd and 0.5 or 0)) * (to - from) / n end
    if not odd and i < #knots then list[#list + 1] = to end
  end
  return list
end

-- Joints of the ring of a bay from left to right: inner and outer end { u, z }. z of joints at beds is a whole number of courses times the
-- height, as the beds are computed, so that they are equal to the last bit.
local function ring_of(k, tier, bay)
  local h, inner = k.block.height, bay.span / 2
  local n = math.ceil((inner + tier.thickness) / h + 0.5 - 1e-9)  -- courses that the ring reaches into
  local outer = (n - 0.5) * h
  local ring = { n = n, inner = inner, outer = outer, thickness = outer - inner, joints = {} }
  local left, last = {}, math.asin((n - 1) * h / outer)  -- rad above the horizontal, of the last joint at a bed
  for j = 0, n - 1 do left[j + 1] = { angle = math.asin(j * h / outer), bed = tier.first + j } end
  local arc = math.pi - 2 * last
  local crown = tier.crown or math.max(1, math.floor(arc * outer / (1.5 * h) + 0.5))
  if not tier.crown and (crown % 2 == 0) ~= bay.half then crown = crown + 1 end
  if bay.half and crown % 2 == 1 then
    fail("arcade: tiers: crown = %d puts a keystone where half an arch ends; give an even number", crown)
  end
  local all = {}
  for _, j in ipairs(left) do all[#all + 1] = j end
  for i = 1, crown - 1 do all[#all + 1] = { angle = last + arc * i / crown } end
  for i = #left, 1, -1 do all[#all + 1] = { angle = math.pi - left[i].angle, bed = left[i].bed } end
  local function point(j, r)
    local u, z = bay.middle - r * math.cos(j.angle), tier.first * h + r * math.sin(j.angle)
    if math.abs(math.cos(j.angle)) < 1e-12 then u = bay.middle end
    return { u, r == outer and j.bed and j.bed * h or z }
  end
  for _, j in ipairs(all) do
    local right_half, left_half = j.angle >= math.pi / 2 - 1e-12, j.angle <= math.pi / 2 + 1e-12
    if (right_half or not bay.first) and (left_half or not bay.last) then
      ring.joints[#ring.joints + 1] = { point(j, inner), point(j, outer) }
    end
  end
  ring.crown = tier.first * h + inner
  return ring
end

-- Rounds the heights of the tiers to courses, makes their rings and checks that all fits.
local function tiers_of(k, plan)
  local h, below, least, mistakes = k.block.height, 0, k.least, {}
  local function wrong(...) mistakes[#mistakes + 1] = string.format(...) end
  for t, tier in ipairs(k.tiers) do
    tier.from, tier.first, tier.last = below, math.floor(tier.springing / h + 0.5), math.floor(tier.top / h + 0.5)
    tier.rings = {}
    if tier.first <= below then
      wrong("arcade: tier %d springs at %g m, not above %s; raise its springing by a course at least", t, tier.springing,
        t == 1 and "the foot" or "the tier beneath")
    end
    for b, bay in ipairs(plan.bays) do tier.rings[b] = ring_of(k, tier, bay) end
    for b, ring in ipairs(tier.rings) do
      if ring.n < 2 then
        wrong("arcade: arch %d of tier %d is lower than two courses of %g m; make it larger, or the courses lower", b, t, h)
      end
      if tier.first + ring.n > tier.last then
        wrong("arcade: arch %d of tier %d reaches up to %g m, the tier ends at %g m; raise its top to %g m at least", b, t,
          (tier.first + ring.n - 0.5) * h, tier.last * h, (tier.first + ring.n) * h)
      end
    end
    for i, pier in ipairs(t == 1 and plan.piers or {}) do
      pier.first = math.floor(pier.foot / h + 0.5)  -- its lowest course
      if pier.first > 0 and pier.first + k.fixed_courses >= tier.first then
        wrong("arcade: feet[%d] = %g m leaves no pier below the springing line at %g m%s; at most %g m is allowed", i, pier.foot,
          tier.first * h, k.fixed_courses > 0 and " above its fixed courses" or "", (tier.first - k.fixed_courses - 1) * h)
      end
    end
    for i, pier in ipairs(plan.piers) do
      local b = k.ends == "half" and i or i - 1  -- bay to its left
      local left, right = tier.rings[b], tier.rings[b + 1]
      local taken = (left and left.thickness or 0) + (right and right.thickness or 0)
      if pier.width < taken + least - eps then
        wrong("arcade: pier %d is %g m wide; the rings of tier %d take %g m of it and a piece of %g m must fit beside them; "
          .. "widen it, or take thinner rings", i, pier.width, t, taken, least)
      end
    end
    below = tier.last
  end
  parts.stop_if(mistakes)
end

-- Underside of course c of a tier above its springing line: the bed, and the backs of the rings where they rise above it.
local function underside(k, plan, tier, c)
  local low, high, points = c * k.block.height, (c + 1) * k.block.height, {}
  local function add(u, z)
    points[#points + 1] = { u, math.min(math.max(z, low), high) }
  end
  if k.ends == "pier" then add(0, low) end
  for _, ring in ipairs(tier.rings) do
    for _, joint in ipairs(ring.joints) do add(joint[2][1], joint[2][2]) end
  end
  if k.ends == "pier" then add(plan.length, low) end
  return points
end

local function lay_course(k, plan, out, laid, c, all, group)
  local top, number, edges = (c + 1) * k.block.height, 0, parts.row_edges(k.width, k.rows, c % 2 == 1)
  laid[c] = {}
  for _, points in ipairs(all) do
    local fixed = c < (points.first or 0) + k.fixed_courses
    for _, polygon in ipairs(parts.cut(points, top, parts.perpends_of(points, top, plan.bond[c % 2], k.least))) do
      number = number + 1
      local names, volume = parts.lay_across(k, polygon, edges, {
        name = string.format("%s.c%03d.b%03d", k.name, c + 1, number), group = k.group .. group, material = k.material,
        fixed = fixed,
      })
      local lo, hi = math.huge, -math.huge
      for _, p in ipairs(polygon) do lo, hi = math.min(lo, p[1]), math.max(hi, p[1]) end
      laid[c][#laid[c] + 1] = { names = names, lo = lo, hi = hi }
      for _, name in ipairs(names) do
        local list = fixed and out.base or out.blocks
        list[#list + 1] = name
      end
      if not fixed then out.volume = out.volume + volume end
    end
  end
end

local function lay_ring(k, out, t, b, ring)
  local names = {}
  for i = 1, #ring.joints - 1 do
    local a, d = ring.joints[i], ring.joints[i + 1]
    local voussoir, volume = parts.lay_across(k, { a[1], d[1], d[2], a[2] }, parts.row_edges(k.width, k.rows, i % 2 == 1), {
      name = string.format("%s.t%d.a%02d.v%02d", k.name, t, b, i), group = k.group .. "_ring", material = k.ring_material or k.material,
    })
    out.volume = out.volume + volume
    for _, name in ipairs(voussoir) do out.blocks[#out.blocks + 1], names[#names + 1] = name, name end
  end
  return names
end

-- A point of the plan { u, z } as { x, y, z }.
local function place(k, u, z)
  return k.axis == "x" and { k.at[1] + u, k.at[2], k.at[3] + z } or { k.at[1], k.at[2] + u, k.at[3] + z }
end

local function describe_opening(k, out, laid, t, b, bay, ring, names)
  local tier = k.tiers[t]
  local found = { tier = t, bay = b, span = bay.span, thickness = ring.thickness, springing = k.at[3] + tier.first * k.block.height,
    crown = k.at[3] + ring.crown, center = place(k, bay.middle, tier.first * k.block.height), ring = names, left = {}, right = {} }
  for c = tier.from, tier.first - 1 do
    for _, piece in ipairs(laid[c]) do
      local side = math.abs(piece.hi - bay.lo) < eps and found.left or math.abs(piece.lo - bay.hi) < eps and found.right or {}
      for _, name in ipairs(piece.names) do side[#side + 1] = name end
    end
  end
  out.openings[string.format("t%d.a%02d", t, b)] = found
end

local function describe_piers(k, plan, out, laid)
  for i, pier in ipairs(plan.piers) do
    out.piers[i] = { axis = place(k, pier.axis, 0), width = pier.width, foot = pier.first * k.block.height, courses = {} }
    for c = 0, k.tiers[#k.tiers].last - 1 do
      local names = {}
      for _, piece in ipairs(laid[c]) do
        if piece.lo < pier.axis + eps and piece.hi > pier.axis - eps then table.move(piece.names, 1, #piece.names, #names + 1, names) end
      end
      out.piers[i].courses[c + 1] = names
    end
  end
end

local function empty()
  return { blocks = {}, base = {}, top = {}, tops = {}, openings = {}, piers = {}, height = 0, length = 0, volume = 0, summary = "" }
end

local function raise(k, plan)
  local out, laid, h = empty(), {}, k.block.height
  plan.bond = { [0] = bond_of(plan.knots, k.block.length, false), bond_of(plan.knots, k.block.length, true) }
  for t, tier in ipairs(k.tiers) do
    for c = tier.from, tier.first - 1 do
      local all = {}
      for _, pier in ipairs(plan.piers) do
        if c >= pier.first then all[#all + 1] = { { pier.lo, c * h }, { pier.hi, c * h }, first = pier.first } end
      end
      lay_course(k, plan, out, laid, c, all, "_pier")
    end
    for b, ring in ipairs(tier.rings) do describe_opening(k, out, laid, t, b, plan.bays[b], ring, lay_ring(k, out, t, b, ring)) end
    for c = tier.first, tier.last - 1 do
      lay_course(k, plan, out, laid, c, parts.stretches(underside(k, plan, tier, c), (c + 1) * h), "_spandrel")
    end
    out.tops[t] = tier.last * h
  end
  out.height, out.length = out.tops[#out.tops], plan.length
  for _, piece in ipairs(laid[#laid]) do table.move(piece.names, 1, #piece.names, #out.top + 1, out.top) end
  describe_piers(k, plan, out, laid)
  return out
end

local function summarise(k, plan, out)
  local lines = { string.format("%s: %d blocks, %d of them fixed; %g m long, %g m high, %g m wide; %d arches, %d piers", k.name,
    #out.blocks + #out.base, #out.base, out.length, out.height, k.width, #plan.bays * #k.tiers, #plan.piers) }
  for t, tier in ipairs(k.tiers) do
    local least, most, count = math.huge, 0, 0
    for _, ring in ipairs(tier.rings) do
      least, most, count = math.min(least, ring.thickness), math.max(most, ring.thickness), math.max(count, #ring.joints - 1)
    end
    lines[#lines + 1] = string.format("  tier %d: springing %g m, top %g m, rings %s to %s thick, at most %d voussoirs", t,
      tier.first * k.block.height, tier.last * k.block.height, parts.millimetres(least), parts.millimetres(most), count)
  end
  out.summary = table.concat(lines, "\n")
end

--- Piers, arches and the courses above them.
arcade = parts.public(function(options)
  local mistakes = {}
  local k = parts.read("arcade", options, arcade_keys, mistakes)
  parts.stop_if(mistakes)
  k.group, k.least = k.group or k.name, k.least or 0.4 * k.block.length
  if #k.tiers == 0 then fail("arcade: tiers is empty; give at least one tier, { springing = ..., top = ..., thickness = ... }") end
  if k.least > k.block.length / 2 then
    fail("arcade: least = %g m is more than half a block; at most %g m is allowed", k.least, k.block.length / 2)
  end
  if k.bays and type(k.spans) == "table" and #k.spans ~= k.bays then
    fail("arcade: bays = %d, but spans lists %d; leave bays out", k.bays, #k.spans)
  end
  local plan = plan_of(k)
  tiers_of(k, plan)
  if k.fixed_courses > k.tiers[1].first then
    fail("arcade: fixed_courses = %d reaches above the first springing line, course %d; take at most that", k.fixed_courses,
      k.tiers[1].first)
  end
  local out = raise(k, plan)
  summarise(k, plan, out)
  if not k.quiet then print(out.summary) end
  return out
end, empty)
