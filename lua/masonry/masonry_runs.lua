-- Runs (the straight stretches of a plan, with their corners), openings, and the courses of bricks and lintels along them.

local eps, millimetres = masonry_parts.eps, masonry_parts.millimetres
local fail, did_you_mean = masonry_parts.fail, masonry_parts.did_you_mean
local widen_joint = widen_joint  -- function of the program, hidden from scenes
local lay, lap_cost, piece_kind = masonry_parts.lay, masonry_parts.lap_cost, masonry_parts.piece_kind
local first_from = masonry_parts.first_from

-- ---- runs: the straight stretches of a plan ------------------------------------------------------------------------------------

-- run.first and run.last, each { lo, hi }: the part of a run that it shares with the wall at its corner. A run that goes through
-- covers this part in courses of its own parity; in the other courses it stops one joint short of it.
local function make_runs(corners, closed, names, width)
  local runs, count = {}, closed and #corners or #corners - 1
  for i = 1, count do
    local a, b = corners[i], corners[i % #corners + 1]
    local dx, dy = b[1] - a[1], b[2] - a[2]
    local length = math.abs(dx) + math.abs(dy)
    if length < eps or math.min(math.abs(dx), math.abs(dy)) > eps then
      fail("plan: the stretch from corner %d to %d is not parallel to x or y; turn the whole building with transform{}", i,
        i % #corners + 1)
    end
    runs[i] = { name = names[i] or "wall" .. i, origin = a, d = { dx / length, dy / length }, length = length, openings = {}, pieces = {} }
    runs[i].n = { -runs[i].d[2], runs[i].d[1] }  -- to the left of d: inward for a counter-clockwise plan
  end
  for i, run in ipairs(runs) do
    local after = runs[i + 1] or (closed and runs[1]) or nil
    if after then
      local turn = run.d[1] * after.d[2] - run.d[2] * after.d[1]
      if math.abs(turn) < 0.5 then fail("plan: corner %d does not turn; leave it out", i % #corners + 1) end
      run.last = turn > 0 and { lo = run.length - width, hi = run.length } or { lo = run.length, hi = run.length + width }
      after.first = turn > 0 and { lo = 0, hi = width } or { lo = -width, hi = 0 }
    end
  end
  return runs
end

-- Ends of the run in courses of this parity: start, stop, and the head joints where the run abuts the wall of a corner.
local function ends(masonry, index, run, parity)
  local through = (index + parity) % 2 == 1
  local start, stop, joints = 0, run.length, {}
  if run.first then start = through and run.first.lo or run.first.hi + masonry.t end
  if run.last then stop = through and run.last.hi or run.last.lo - masonry.t end
  if run.first and not through then joints[#joints + 1] = start - masonry.t / 2 end
  if run.last and not through then joints[#joints + 1] = stop + masonry.t / 2 end
  return start, stop, joints, through
end

-- The two patterns of the solid run: run.pattern[0] and [1]. The through course comes first; the other one avoids its joints.
local function make_patterns(masonry, index, run)
  local first = (index % 2 == 1) and 0 or 1
  run.pattern = {}
  for _, parity in ipairs { first, 1 - first } do
    local start, stop = ends(masonry, index, run, parity)
    local _, _, below = ends(masonry, index, run, 1 - parity)
    for _, joint in ipairs(run.pattern[1 - parity] or {}) do below[#below + 1] = joint.u end
    table.sort(below)
    local course = lay(masonry, start, stop, below, nil)
    if not course then
      fail("wall \"%s\" of %s cannot be laid with pieces of at least %s; make it longer", run.name, millimetres(stop - start),
        millimetres(masonry.closer))
    end
    run.pattern[parity] = course.joints
  end
end

-- ---- openings ------------------------------------------------------------------------------------------------------------------

local function round(x) return math.floor(x + 0.5) end

local function storeys_of(opening, count)
  local given = opening.storey
  if given == "all" then
    given = {}
    for s = 1, count do given[s] = s end
  elseif type(given) ~= "table" then
    given = { given }
  end
  local storeys = {}
  for i, s in ipairs(given) do
    storeys[i] = math.tointeger(s)
    if not storeys[i] or s < 1 or s > count then
      fail("opening \"%s\": storey = %s; allowed: 1 to %d, a list of them, or \"all\"", opening.name or opening.kind, tostring(s), count)
    end
  end
  return storeys
end

-- Snaps an opening to courses, finds the extent of its lintel and checks that both fit in the wall.
local function place_opening(masonry, run, opening, storey, name)
  local pitch, count = masonry.height + masonry.t, masonry.courses[storey]
  local from = (opening.at or opening.centre and opening.centre - opening.width / 2)
  if not from or (opening.at and opening.centre) then fail("opening \"%s\": give at (left jamb) or centre, one of them", name) end
  if opening.kind == "door" and opening.sill > 0 then fail("opening \"%s\": a door has no sill; say kind = \"window\"", name) end
  local hole = { name = name, kind = opening.kind, lo = from, hi = from + opening.width, storey = storey }
  hole.bottom = round(opening.sill / pitch) + 1                                  -- first course left out
  hole.top = hole.bottom + math.max(1, round((opening.height - masonry.t) / pitch)) - 1  -- last course left out
  hole.sill, hole.height = (hole.bottom - 1) * pitch, (hole.top - hole.bottom + 1) * pitch + masonry.t
  local edge_lo = (run.first and run.first.hi + masonry.t or 0) + masonry.closer
  local edge_hi = (run.last and run.last.lo - masonry.t or run.length) - masonry.closer
  if hole.top > count then fail("opening \"%s\" ends in course %d, the storey has %d; make it lower", name, hole.top, count) end
  if opening.lintel and hole.top < count then
    hole.lintel = { lo = hole.lo - masonry.bearing, hi = hole.hi + masonry.bearing }
    hole.lintel.bottom, hole.lintel.top = hole.top + 1, hole.top + masonry.lintel.courses
    if hole.lintel.top > count then fail("the lintel over \"%s\" ends above the storey's last course; make the opening lower", name) end
  elseif hole.top < count then
    fail("opening \"%s\" has no lintel but masonry above it; let it end at the storey's top or leave lintel = false out", name)
  end
  local reach = hole.lintel or hole
  if hole.lo < edge_lo - eps or hole.hi > edge_hi + eps or reach.lo < edge_lo + masonry.t - eps or reach.hi > edge_hi - masonry.t + eps then
    fail("opening \"%s\" with its lintel reaches from %s to %s along wall \"%s\"; allowed: %s to %s; move it or make it narrower", name,
      millimetres(reach.lo), millimetres(reach.hi), run.name, millimetres(edge_lo), millimetres(edge_hi))
  end
  return hole
end

local function place_openings(masonry, runs, openings)
  local by_name, names, numbers, used = {}, {}, {}, {}
  for i, run in ipairs(runs) do by_name[run.name], names[i] = run, run.name end
  for _, opening in ipairs(openings) do
    local run = by_name[opening.wall or #runs == 1 and runs[1].name or ""]
    if not run then
      fail("opening: wall = \"%s\" is not known%s", opening.wall or "", did_you_mean(opening.wall or "", names))
    end
    local places = storeys_of(opening, #masonry.courses)
    for _, storey in ipairs(places) do
      local name = opening.name
      if not name then
        local stem = run.name .. opening.kind
        numbers[stem] = (numbers[stem] or 0) + 1
        name = opening.kind .. numbers[stem]
      elseif #places > 1 then
        name = name .. (name:find("%d$") and "_" or "") .. storey
      end
      if used[run.name .. name] then fail("two openings of wall \"%s\" are called \"%s\"; rename one", run.name, name) end
      used[run.name .. name] = true
      run.openings[#run.openings + 1] = place_opening(masonry, run, opening, storey, name)
    end
  end
end

-- Interruptions of the bricks of a course, from left to right: openings (free faces) and lintels (a head joint at either end).
local function obstacles(masonry, run, storey, course)
  local found = {}
  for _, hole in ipairs(run.openings) do
    if hole.storey == storey then
      local lintel = hole.lintel
      if course >= hole.bottom and course <= hole.top then found[#found + 1] = { lo = hole.lo, hi = hole.hi, gap = 0, hole = hole } end
      if lintel and course >= lintel.bottom and course <= lintel.top then
        found[#found + 1] = { lo = lintel.lo, hi = lintel.hi, gap = masonry.t, hole = hole, lintel = lintel }
      end
    end
  end
  table.sort(found, function(a, b) return a.lo < b.lo end)
  for i = 2, #found do
    local left, right = found[i - 1], found[i]
    if left.hi + left.gap + masonry.closer + right.gap > right.lo + eps then
      fail("openings \"%s\" and \"%s\" of wall \"%s\" (with their lintels) leave no room for a piece of %s between them; move them apart",
        left.hole.name, right.hole.name, run.name, millimetres(masonry.closer))
    end
  end
  return found
end

-- ---- building it ---------------------------------------------------------------------------------------------------------------

-- A box from u = lo to hi along the run, through the wall's thickness, with its bottom at z.
local function run_extent(masonry, run, lo, hi, z, height)
  local x0, y0 = run.origin[1] + run.d[1] * lo, run.origin[2] + run.d[2] * lo
  local x1 = run.origin[1] + run.d[1] * hi + run.n[1] * masonry.width
  local y1 = run.origin[2] + run.d[2] * hi + run.n[2] * masonry.width
  local at = { masonry.at[1] + math.min(x0, x1), masonry.at[2] + math.min(y0, y1), z }
  return at, { math.abs(x1 - x0), math.abs(y1 - y0), height }
end

local function run_box(masonry, run, name, lo, hi, z, height, material, group)
  local at, size = run_extent(masonry, run, lo, hi, z, height)
  masonry.out.blocks[#masonry.out.blocks + 1] = box { name = name, size = size, at = at, material = material, group = group }
  return size[1] * size[2] * size[3]
end

local function note_joint(masonry, below, u, width)
  local report = masonry.out.report
  local key = millimetres(width)
  report.head_joints[key] = (report.head_joints[key] or 0) + 1
  for i = math.max(1, first_from(below, u - masonry.full) - 1), math.min(#below, first_from(below, u + masonry.full)) do
    local d = math.abs(below[i] - u)
    report.least_lap = math.min(report.least_lap, d)
    if d < masonry.t + eps then report.stacked = report.stacked + 1 end
    if d < masonry.full / 4 - eps then report.short_laps = report.short_laps + 1 end
  end
end

-- Lengthens one end of a lintel. A lintel rests on each jamb by at least the bearing. It grows by up to a quarter brick in two cases: whole
-- bricks then fit beside it (its end at a joint of the pattern, or n bricks from the neighbour); its end would otherwise lie too close to a
-- joint beneath. side: -1 left end, +1 right end; far: end of the stretch beside it.
local function lengthen_lintel(masonry, lintel, side, far, below, pattern)
  local own = side < 0 and lintel.lo or lintel.hi
  local pitch, found, least = masonry.full + masonry.t, own, math.huge
  local ends_at = { own, far - side * math.floor(side * (far - own) / pitch + eps) * pitch }
  for _, joint in ipairs(pattern) do ends_at[#ends_at + 1] = joint.u + side * joint.width / 2 - side * masonry.t end
  if lap_cost(masonry, own + side * masonry.t / 2, below) > 1 then
    for k = 1, math.floor(masonry.full / 4 / masonry.step) do ends_at[#ends_at + 1] = own + side * k * masonry.step end
  end
  for _, u in ipairs(ends_at) do
    local longer = side * (u - own)
    if longer > -eps and longer < masonry.full / 4 then
      local face = u + side * masonry.t
      local laid = lay(masonry, math.min(face, far), math.max(face, far), below, pattern)
      local cost = laid and laid.cost + lap_cost(masonry, u + side * masonry.t / 2, below)
      if cost and cost < least - eps then found, least = u, cost end
    end
  end
  if side < 0 then lintel.lo = found else lintel.hi = found end
end

local function lengthen_lintels(masonry, run, storey, course, below, pattern, start, stop)
  local all = obstacles(masonry, run, storey, course)
  for i, o in ipairs(all) do
    if o.lintel and course == o.lintel.bottom then
      lengthen_lintel(masonry, o.lintel, -1, all[i - 1] and all[i - 1].hi + all[i - 1].gap or start, below, pattern)
      lengthen_lintel(masonry, o.lintel, 1, all[i + 1] and all[i + 1].lo - all[i + 1].gap or stop, below, pattern)
      o.lo, o.hi = o.lintel.lo, o.lintel.hi
    end
  end
  return all
end

local function lay_lintel(masonry, run, o, z)
  local rows, name = masonry.lintel.courses, string.format("%slintel.%s.%s", masonry.prefix, run.name, o.hole.name)
  local volume = run_box(masonry, run, name, o.lo, o.hi, z, rows * masonry.height + (rows - 1) * masonry.t,
    masonry.lintel.material or masonry.material, masonry.lintel.group)
  masonry.out.report.lintel_volume = masonry.out.report.lintel_volume + volume
  masonry.out.lintels[#masonry.out.lintels + 1] = name
  o.hole.lintel_name = name
  local l = o.lintel
  run.pieces[#run.pieces + 1] = { name = name, lo = l.lo, hi = l.hi, storey = o.hole.storey, bottom = l.bottom, top = l.top }
end

-- Lays the bricks of a stretch, numbered from `brick` + 1; returns the last number.
local function lay_pieces(masonry, run, storey, course, laid, stem, brick, z)
  local report = masonry.out.report
  for i, piece in ipairs(laid.pieces) do
    brick = brick + 1
    local kind = piece_kind(masonry, piece.length)
    report.pieces[kind] = report.pieces[kind] + 1
    if kind == "cut" then
      local key = millimetres(piece.length)
      report.cuts[key] = (report.cuts[key] or 0) + 1
      report.shortest = math.min(report.shortest, piece.length)
    end
    local name = string.format("%sb%02d", stem, brick)
    local volume = run_box(masonry, run, name, piece.u, piece.u + piece.length, z, masonry.height, masonry.material, run.group)
    run.pieces[#run.pieces + 1] = { name = name, lo = piece.u, hi = piece.u + piece.length, storey = storey, bottom = course, top = course }
    report.brick_volume = report.brick_volume + volume
    for k = math.max(1, i - 1), math.min(i, #laid.joints) do  -- so that the joint rule of the masonry also bridges wider joints
      if masonry.t > 0 and laid.joints[k].width > masonry.t + eps then widen_joint(masonry.t, laid.joints[k].width) end
    end
  end
  return brick
end

-- Lays one course of one run; returns the positions of its head joints for the next course. `beneath`: joints of the course beneath.
local function lay_course(masonry, index, run, storey, course, number, z, below, beneath)
  local parity, joints, brick = (course + masonry.shift) % 2, {}, 0
  local pattern = run.pattern[parity]
  local start, stop, at_ends = ends(masonry, index, run, parity)
  local stem = string.format("%s%s.c%02d.", masonry.prefix, run.name, number)
  local function joint(u, width)
    joints[#joints + 1] = u
    note_joint(masonry, beneath, u, width)
  end
  for _, u in ipairs(at_ends) do joint(u, masonry.t) end
  local parts, u = {}, start
  for _, o in ipairs(lengthen_lintels(masonry, run, storey, course, below, pattern, start, stop)) do
    parts[#parts + 1] = { u, o.lo - o.gap }
    u = o.hi + o.gap
    if o.lintel and course == o.lintel.bottom then
      joint(o.lo - masonry.t / 2, masonry.t)
      joint(o.hi + masonry.t / 2, masonry.t)
      lay_lintel(masonry, run, o, z)
    elseif o.lintel then  -- the joints at the ends of a lintel continue upwards
      joints[#joints + 1], joints[#joints + 2] = o.lo - masonry.t / 2, o.hi + masonry.t / 2
    end
  end
  parts[#parts + 1] = { u, stop }
  for _, part in ipairs(parts) do
    local laid = lay(masonry, part[1], part[2], below, pattern)
    if not laid then
      fail("wall \"%s\", course %d: nothing fits from %s to %s with pieces of at least %s; move the opening beside it", run.name, number,
        millimetres(part[1]), millimetres(part[2]), millimetres(masonry.closer))
    end
    brick = lay_pieces(masonry, run, storey, course, laid, stem, brick, z)
    for _, j in ipairs(laid.joints) do joint(j.u, j.width) end
  end
  table.sort(joints)
  return joints
end

-- ---- what stands where ---------------------------------------------------------------------------------------------------------

-- The opening as a scene sees it: its place, its size, and the names of the blocks around it, from the left or from below.
local function describe_opening(masonry, run, hole)
  local floor = masonry.out.tops[hole.storey - 1] or 0
  local at, size = run_extent(masonry, run, hole.lo, hole.hi, masonry.at[3] + floor + hole.sill, hole.height)
  local found = {
    name = hole.name, wall = run.name, kind = hole.kind, storey = hole.storey, lo = hole.lo, hi = hole.hi, sill = hole.sill,
    width = hole.hi - hole.lo, height = hole.height, at = at, size = size, lintel = hole.lintel_name,
    left = {}, right = {}, above = {}, below = {},
    center = { at[1] + size[1] / 2, at[2] + size[2] / 2, at[3] + size[3] / 2 },
  }
  local function put(side, piece) found[side][#found[side] + 1] = piece.name end
  for _, p in ipairs(run.pieces) do
    if p.storey == hole.storey then
      local over = p.lo < hole.hi - eps and p.hi > hole.lo + eps
      if over and p.top == hole.bottom - 1 then put("below", p) end
      if over and p.bottom == hole.top + 1 then put("above", p) end
      if p.top >= hole.bottom and p.bottom <= hole.top then
        if math.abs(p.hi - hole.lo) < eps then put("left", p) end
        if math.abs(p.lo - hole.hi) < eps then put("right", p) end
      end
    end
  end
  if #found.above == 0 then found.above[1] = masonry.out.slabs[hole.storey] end
  if #found.below == 0 then found.below[1] = masonry.out.slabs[hole.storey - 1] or masonry.out.base end
  return found
end

-- Fills in openings, top and storey_top of the result. Several walls: openings are called south.window1, ...
local function describe(masonry, runs)
  local out = masonry.out
  for s, courses in ipairs(masonry.courses) do
    local names = { out.slabs[s] }
    for _, run in ipairs(out.slabs[s] and {} or runs) do
      for _, p in ipairs(run.pieces) do
        if p.storey == s and p.top == courses then names[#names + 1] = p.name end
      end
    end
    out.storey_top[s], out.top = names, names
  end
  for _, run in ipairs(runs) do
    for _, hole in ipairs(run.openings) do
      out.openings[(#runs > 1 and run.name .. "." or "") .. hole.name] = describe_opening(masonry, run, hole)
    end
  end
end

masonry_parts.describe = describe
masonry_parts.make_runs, masonry_parts.make_patterns, masonry_parts.ends = make_runs, make_patterns, ends
masonry_parts.place_openings, masonry_parts.lay_course = place_openings, lay_course
