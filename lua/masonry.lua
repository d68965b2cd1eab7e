-- Masonry in running bond: wall{...} and building{...}, plain Lua on top of box{...}.
--
-- A run is a straight stretch of wall seen from outside, its coordinate u growing from left to right. Two patterns of head joints
-- alternate from course to course; at a corner one wall runs through in one pattern and the other wall in the other. What fills a
-- stretch (whole bricks, halves, cut closers, wider joints) is decided in bond.lua. Beside an opening the pattern of the solid wall is
-- kept and only the piece at the jamb is cut.

local bond, eps = masonry_bond, masonry_bond.eps
local read, stop_if, fail = masonry_keys.read, masonry_keys.stop_if, masonry_keys.fail
local nearest, millimetres = masonry_keys.nearest, masonry_keys.millimetres
masonry_bond, masonry_keys = nil, nil  -- scenes see only wall, building and masonry_functions

-- ---- runs: the straight stretches of a plan ------------------------------------------------------------------------------------

-- corner.lo .. corner.hi: the stretch of this run that the wall at its end occupies too. A run that goes through covers it in the
-- courses of its parity and stops one joint short of it in the others.
local function make_runs(corners, closed, names, width)
  local runs, count = {}, closed and #corners or #corners - 1
  for i = 1, count do
    local a, b = corners[i], corners[i % #corners + 1]
    local dx, dy = b[1] - a[1], b[2] - a[2]
    local length = math.abs(dx) + math.abs(dy)
    if length < eps or math.min(math.abs(dx), math.abs(dy)) > eps then
      fail("plan: the stretch from corner %d to %d is not parallel to x or y; turn the whole building with transform{}", i, i % #corners + 1)
    end
    runs[i] = { name = names[i] or "wall" .. i, origin = a, d = { dx / length, dy / length }, length = length, openings = {} }
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

-- Ends of the run in courses of that parity: start, stop, and the head joints there (where it abuts the wall of the corner).
local function ends(masonry, index, run, parity)
  local through = (index + parity) % 2 == 1
  local start, stop, joints = 0, run.length, {}
  if run.first then start = through and run.first.lo or run.first.hi + masonry.t end
  if run.last then stop = through and run.last.hi or run.last.lo - masonry.t end
  if run.first and not through then joints[#joints + 1] = start - masonry.t / 2 end
  if run.last and not through then joints[#joints + 1] = stop + masonry.t / 2 end
  return start, stop, joints, through
end

-- The two patterns of the solid run: run.pattern[0] and [1]. The through course is chosen first; the other keeps clear of its joints.
local function make_patterns(masonry, index, run)
  local first = (index % 2 == 1) and 0 or 1
  run.pattern = {}
  for _, parity in ipairs { first, 1 - first } do
    local start, stop = ends(masonry, index, run, parity)
    local _, _, below = ends(masonry, index, run, 1 - parity)
    for _, joint in ipairs(run.pattern[1 - parity] or {}) do below[#below + 1] = joint.u end
    local course = bond.lay(masonry, start, stop, below, nil)
    if not course then fail("wall \"%s\" of %s is too short for a piece of at least %s", run.name, millimetres(stop - start), millimetres(masonry.closer)) end
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
  for _, s in ipairs(given) do
    if math.type(s) ~= "integer" or s < 1 or s > count then
      fail("opening \"%s\": storey = %s; allowed: 1 to %d, a list of them, or \"all\"", opening.name, tostring(s), count)
    end
  end
  return given
end

-- Snaps to courses, finds the lintel's stretch and checks that all of it fits in the wall.
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
    hole.lintel = { lo = hole.lo - masonry.bearing, hi = hole.hi + masonry.bearing, bottom = hole.top + 1, top = hole.top + masonry.lintel.courses }
    if hole.lintel.top > count then fail("the lintel over \"%s\" ends above the storey's last course; make the opening lower", name) end
  elseif hole.top < count then
    fail("opening \"%s\" has no lintel but masonry above it; let it end at the storey's top or leave lintel = false out", name)
  end
  local reach = hole.lintel or hole
  if hole.lo < edge_lo - eps or hole.hi > edge_hi + eps or reach.lo < edge_lo + masonry.t - eps or reach.hi > edge_hi - masonry.t + eps then
    fail("opening \"%s\" with its lintel reaches from %s to %s along wall \"%s\"; allowed: %s to %s", name, millimetres(reach.lo),
      millimetres(reach.hi), run.name, millimetres(edge_lo), millimetres(edge_hi))
  end
  return hole
end

local function place_openings(masonry, runs, openings)
  local by_name, names, numbers, used = {}, {}, {}, {}
  for i, run in ipairs(runs) do by_name[run.name], names[i] = run, run.name end
  for _, opening in ipairs(openings) do
    local run = by_name[opening.wall or #runs == 1 and runs[1].name or ""]
    if not run then
      fail("opening: wall = \"%s\" is not known; did you mean \"%s\"? (%s)", tostring(opening.wall), nearest(opening.wall or "", names),
        table.concat(names, ", "))
    end
    local places = storeys_of(opening, #masonry.courses)
    for _, storey in ipairs(places) do
      local name = opening.name
      if not name then
        local stem = run.name .. opening.kind
        numbers[stem] = (numbers[stem] or 0) + 1
        name = opening.kind .. numbers[stem]
      elseif #places > 1 then
        name = name .. "_" .. storey
      end
      if used[run.name .. name] then fail("two openings of wall \"%s\" are called \"%s\"", run.name, name) end
      used[run.name .. name] = true
      run.openings[#run.openings + 1] = place_opening(masonry, run, opening, storey, name)
    end
  end
end

-- What interrupts the bricks of a course, from left to right: openings (free faces) and lintels (a head joint at either end).
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
      fail("openings \"%s\" and \"%s\" of wall \"%s\" (with their lintels) leave no room for a piece of %s between them",
        left.hole.name, right.hole.name, run.name, millimetres(masonry.closer))
    end
  end
  return found
end

-- ---- building it ---------------------------------------------------------------------------------------------------------------

-- A box from u = lo..hi along the run, over the wall's thickness, with its foot at z.
local function run_box(masonry, run, name, lo, hi, z, height, material, group)
  local x0, y0 = run.origin[1] + run.d[1] * lo, run.origin[2] + run.d[2] * lo
  local x1 = run.origin[1] + run.d[1] * hi + run.n[1] * masonry.width
  local y1 = run.origin[2] + run.d[2] * hi + run.n[2] * masonry.width
  local at = { masonry.at[1] + math.min(x0, x1), masonry.at[2] + math.min(y0, y1), z }
  local size = { math.abs(x1 - x0), math.abs(y1 - y0), height }
  masonry.out.blocks[#masonry.out.blocks + 1] = box { name = name, size = size, at = at, material = material, group = group }
  return size[1] * size[2] * size[3]
end

local function note_joint(masonry, below, u, width)
  local report = masonry.out.report
  local key = millimetres(width)
  report.head_joints[key] = (report.head_joints[key] or 0) + 1
  for _, b in ipairs(below) do
    local d = math.abs(b - u)
    report.least_lap = math.min(report.least_lap, d)
    if d < masonry.t + eps then report.stacked = report.stacked + 1 end
    if d < masonry.full / 4 - eps then report.short_laps = report.short_laps + 1 end
  end
end

-- A lintel rests on its jambs by at least the bearing; it is made up to a quarter brick longer at either end where whole bricks then
-- fit beside it: at a joint of the pattern, or n bricks away from the neighbour. side: -1 left end, +1 right end; far: where the
-- stretch beside it ends.
local function lengthen_lintel(masonry, lintel, side, far, below, pattern)
  local own = side < 0 and lintel.lo or lintel.hi
  local pitch, found, least = masonry.full + masonry.t, own, math.huge
  local ends_at = { own, far - side * math.floor(side * (far - own) / pitch + eps) * pitch }
  for _, joint in ipairs(pattern) do ends_at[#ends_at + 1] = joint.u + side * joint.width / 2 - side * masonry.t end
  for _, u in ipairs(ends_at) do
    local longer = side * (u - own)
    if longer > -eps and longer < masonry.full / 4 then
      local face = u + side * masonry.t
      local laid = bond.lay(masonry, math.min(face, far), math.max(face, far), below, pattern)
      if laid and laid.cost < least - eps then found, least = u, laid.cost end
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
end

-- The bricks of a stretch, numbered on from `brick`; returns the last number.
local function lay_pieces(masonry, run, laid, stem, brick, z)
  local report = masonry.out.report
  for _, piece in ipairs(laid.pieces) do
    brick = brick + 1
    local kind = bond.piece_kind(masonry, piece.length)
    report.pieces[kind] = report.pieces[kind] + 1
    if kind == "cut" then
      local key = millimetres(piece.length)
      report.cuts[key] = (report.cuts[key] or 0) + 1
      report.shortest = math.min(report.shortest, piece.length)
    end
    local volume = run_box(masonry, run, string.format("%sb%02d", stem, brick), piece.u, piece.u + piece.length, z, masonry.height,
      masonry.material, run.group)
    report.brick_volume = report.brick_volume + volume
  end
  return brick
end

-- One course of one run; returns the positions of its head joints for the course above. `beneath`: of the course beneath, if any.
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
    if o.lintel then
      joint(o.lo - masonry.t / 2, masonry.t)
      joint(o.hi + masonry.t / 2, masonry.t)
      if course == o.lintel.bottom then lay_lintel(masonry, run, o, z) end
    end
  end
  parts[#parts + 1] = { u, stop }
  for _, part in ipairs(parts) do
    local laid = bond.lay(masonry, part[1], part[2], below, pattern)
    if not laid then
      fail("wall \"%s\", course %d: nothing fits from %s to %s with pieces of at least %s; move the opening beside it", run.name, number,
        millimetres(part[1]), millimetres(part[2]), millimetres(masonry.closer))
    end
    brick = lay_pieces(masonry, run, laid, stem, brick, z)
    for _, j in ipairs(laid.joints) do joint(j.u, j.width) end
  end
  return joints
end

-- Everything from the support up: storeys of courses, each with its slab.
local function build(masonry, runs)
  local out, z, number = masonry.out, masonry.at[3], 0
  for storey, courses in ipairs(masonry.courses) do
    local below = {}
    -- On the ground or a slab no joint lies beneath; the first course looks ahead to the pattern of the second.
    for i, run in ipairs(runs) do
      below[i] = {}
      for _, joint in ipairs(run.pattern[masonry.shift % 2]) do below[i][#below[i] + 1] = joint.u end
    end
    for course = 1, courses do
      number, z = number + 1, z + masonry.t
      for i, run in ipairs(runs) do below[i] = lay_course(masonry, i, run, storey, course, number, z, below[i], course > 1 and below[i] or {}) end
      z = z + masonry.height
    end
    if masonry.slab then
      local s, plan, name = masonry.slab, masonry.plan_box, masonry.prefix .. "slab" .. storey
      z = z + masonry.t
      local size = { plan.hi[1] - plan.lo[1] + 2 * s.overhang, plan.hi[2] - plan.lo[2] + 2 * s.overhang, s.thickness }
      local at = { masonry.at[1] + plan.lo[1] - s.overhang, masonry.at[2] + plan.lo[2] - s.overhang, z }
      out.blocks[#out.blocks + 1] = box { name = name, size = size, at = at, material = s.material or masonry.material, group = s.group }
      out.slabs[storey] = name
      out.report.slab_volume = out.report.slab_volume + size[1] * size[2] * size[3]
      z = z + s.thickness
    end
    out.tops[storey] = z - masonry.at[3]
  end
  out.height = z - masonry.at[3]
end

local function build_base(masonry)
  local b, plan, name = masonry.base, masonry.plan_box, masonry.prefix .. "base"
  if not b then return end
  local m = masonry.at
  masonry.out.base = box {
    name = name, material = b.material or masonry.material, group = b.group, fixed = true,
    at = { m[1] + plan.lo[1] - b.margin, m[2] + plan.lo[2] - b.margin, m[3] - b.thickness },
    size = { plan.hi[1] - plan.lo[1] + 2 * b.margin, plan.hi[2] - plan.lo[2] + 2 * b.margin, b.thickness },
  }
end

-- "wall south: 5 whole, head joints 6.25 mm" for either pattern of the solid run.
local function describe_pattern(masonry, index, run, parity)
  local start, stop, _, through = ends(masonry, index, run, parity)
  local words, count, u, widest = {}, { full = 0, half = 0, cut = 0 }, start, masonry.t
  local function piece(to)
    local kind = bond.piece_kind(masonry, to - u)
    count[kind] = count[kind] + 1
    if kind == "cut" then words[#words + 1] = "closer of " .. millimetres(to - u) end
  end
  for _, joint in ipairs(run.pattern[parity]) do
    piece(joint.u - joint.width / 2)
    u, widest = joint.u + joint.width / 2, math.max(widest, joint.width)
  end
  piece(stop)
  if count.half > 0 then table.insert(words, 1, count.half == 1 and "1 half" or count.half .. " halves") end
  table.insert(words, 1, count.full .. " whole")
  local role = (run.first or run.last) and (through and "through" or "between corners") or "plain ends"
  return { wall = run.name, parity = parity, role = role, length = stop - start, head_joint = widest,
    text = string.format("%s, %s, %s: %s, head joints %s", run.name, role, millimetres(stop - start), table.concat(words, " + "), millimetres(widest)) }
end

local function sorted_counts(counts)
  local keys, words = {}, {}
  for key in pairs(counts) do keys[#keys + 1] = key end
  table.sort(keys, function(a, b) return tonumber(a:match("^%S+")) < tonumber(b:match("^%S+")) end)
  for i, key in ipairs(keys) do words[i] = counts[key] .. " x " .. key end
  return #words > 0 and table.concat(words, ", ") or "none"
end

local function summarise(masonry, runs)
  local out, r, lines = masonry.out, masonry.out.report, {}
  local function line(...) lines[#lines + 1] = string.format(...) end
  line("%s: %d blocks = %d whole bricks, %d halves, %d closers, %d lintels, %d slabs; height %s", masonry.title, #out.blocks, r.pieces.full,
    r.pieces.half, r.pieces.cut, #out.lintels, #out.slabs, millimetres(out.height))
  for i, run in ipairs(runs) do
    for parity = 0, 1 do
      r.patterns[#r.patterns + 1] = describe_pattern(masonry, i, run, parity)
      line("  %s", r.patterns[#r.patterns].text)
    end
  end
  line("  closers (cut pieces): %s", sorted_counts(r.cuts))
  line("  head joints: %s", sorted_counts(r.head_joints))
  if r.least_lap < math.huge then
    line("  shortest lap %s; laps below a quarter brick: %d, of them head joints above each other: %d", millimetres(r.least_lap), r.short_laps, r.stacked)
  end
  for _, run in ipairs(runs) do
    for _, hole in ipairs(run.openings) do
      r.openings[#r.openings + 1] = { wall = run.name, name = hole.name, storey = hole.storey, lo = hole.lo, hi = hole.hi, sill = hole.sill, height = hole.height }
      line("  %s.%s, storey %d: %s to %s, sill %s, height %s", run.name, hole.name, hole.storey, millimetres(hole.lo), millimetres(hole.hi),
        millimetres(hole.sill), millimetres(hole.height))
    end
  end
  out.summary = table.concat(lines, "\n")
end

-- From checked keys to blocks. corners: outer corners of the plan.
local function raise(k, title, corners, closed, names, courses)
  local lo, hi = { math.huge, math.huge }, { -math.huge, -math.huge }
  for _, c in ipairs(corners) do
    for i = 1, 2 do lo[i], hi[i] = math.min(lo[i], c[i]), math.max(hi[i], c[i]) end
  end
  local masonry = {
    full = k.brick.length, width = k.brick.width, height = k.brick.height, half = k.brick.length / 2, t = k.joint, closer = k.closer,
    joint_max = k.joint_max or 1.5 * k.joint, step = k.brick.length / 30, bearing = k.lintel.bearing or k.brick.length / 2,
    at = k.at, material = k.material, lintel = k.lintel, slab = k.slab, base = k.base, shift = k.shift, courses = courses, laid = {},
    prefix = k.prefix, title = title, plan_box = { lo = lo, hi = hi },
  }
  if masonry.closer > masonry.half then fail("closer = %s is more than half a brick (%s)", millimetres(masonry.closer), millimetres(masonry.half)) end
  masonry.out = {
    blocks = {}, slabs = {}, lintels = {}, tops = {}, walls = {},
    report = { pieces = { full = 0, half = 0, cut = 0 }, cuts = {}, head_joints = {}, patterns = {}, openings = {}, stacked = 0, short_laps = 0,
      least_lap = math.huge, shortest = k.brick.length, brick_volume = 0, lintel_volume = 0, slab_volume = 0 },
  }
  local runs = make_runs(corners, closed, names, masonry.width)
  for i, run in ipairs(runs) do
    run.group = k.wall_group(run.name)
    masonry.out.walls[i] = run.group
    make_patterns(masonry, i, run)
  end
  place_openings(masonry, runs, k.openings)
  build_base(masonry)
  build(masonry, runs)
  summarise(masonry, runs)
  if not k.quiet then print(masonry.out.summary) end
  return masonry.out
end

-- A function whose mistakes are errors at the line that called it.
local function public(body)
  return function(...)
    local ok, result = pcall(body, ...)
    if ok then return result end
    if type(result) == "table" and result.masonry then error(result.masonry, 2) end
    error(result, 0)
  end
end

---@class brick_size
---@field length number  m, along the wall
---@field width number   m, across the wall: the wall's thickness
---@field height number  m, of one course without its joint

---@class masonry_opening
---@field wall? string      name of the wall it is in (building only)
---@field name? string      default: kind and number, e.g. window2
---@field kind? "window"|"door"  a door starts at the floor
---@field storey? integer|integer[]|"all"
---@field at? number        m, left jamb from the wall's left end seen from outside
---@field centre? number    m, middle of the opening, instead of `at`
---@field width number      m, between the jambs
---@field sill? number      m above the floor; snapped to courses
---@field height number     m, clear; snapped to courses
---@field lintel? boolean   false: nothing spans it (it must end at the storey's top)

---@class masonry_lintel
---@field bearing? number   m, length that rests on either jamb; default half a brick
---@field courses? integer  height in courses; default 1
---@field material? string  default: that of the bricks
---@field group? string     default "lintel"

---@class masonry_slab
---@field thickness number  m, without its bed joint
---@field overhang? number  m, beyond the outer faces of the walls
---@field material? string  default: that of the bricks
---@field group? string     default "slab"

---@class masonry_base
---@field thickness number  m; its top is at `at`
---@field margin? number    m, beyond the walls on every side
---@field material? string  default: that of the bricks
---@field group? string     default "base"

---@class masonry_common
---@field at? number[]      m, where the plan's origin stands; z is the top of the support
---@field brick brick_size
---@field joint number      m, thickness of bed and head joints; 0 is dry masonry
---@field closer? number    m, shortest piece that may be cut; default 40 mm
---@field joint_max? number m, widest head joint; default 1.5 joints
---@field shift? 0|1        1: start with the other of the two alternating courses
---@field openings? masonry_opening[]
---@field lintel? masonry_lintel
---@field base? masonry_base  a fixed plate below; default none
---@field material? string  of the bricks; default "brick"
---@field quiet? boolean    true: do not print the summary

---@class wall_options : masonry_common
---@field name? string      first word of its blocks' names; default "wall"
---@field group? string     group of the bricks; default the name
---@field length number     m, end to end
---@field axis? "x"|"y"     direction it runs in
---@field courses? integer  number of courses; or give height
---@field height? number    m, instead of courses; snapped to whole ones

---@class building_options : masonry_common
---@field name? string      first word of all block names; default none
---@field group? string     groups of the walls are <group>_<wall>; default "wall"
---@field plan number[]|number[][]  m, outer size {x, y}, or outer corners {{x,y}, ...} counter-clockwise
---@field closed? boolean   false: the last corner is not joined to the first
---@field walls? string[]   names of the runs; default south, east, north, west for a rectangle, else wall1, ...
---@field storeys? integer  default 1
---@field courses integer|integer[]  per storey: a number, or a list with one for each
---@field slab? masonry_slab  a rigid plate on the walls of every storey; default none

---@class masonry_result
---@field blocks string[]   names, from the bottom up
---@field walls string[]    groups of the walls, in the order of the plan
---@field slabs string[]    names, by storey
---@field lintels string[]
---@field base? string
---@field tops number[]     m, top of every storey above the support
---@field height number     m
---@field report table      pieces, cuts, head_joints, patterns, openings, stacked, short_laps, least_lap, shortest, volumes (m3)
---@field summary string    the report in words

--- A free-standing straight wall in running bond, both ends plain. Blocks are called wall.c01.b01 (course, brick).
---@param options wall_options
---@return masonry_result
wall = public(function(options)
  local mistakes = {}
  local k = read("wall", options, masonry_functions[1].keys, mistakes)
  if (k.courses == nil) == (k.height == nil) then mistakes[#mistakes + 1] = "wall: give courses or height, one of them" end
  stop_if(mistakes)
  local courses = k.courses or math.max(1, round(k.height / (k.brick.height + k.joint)))
  local stop = k.axis == "x" and { k.length, 0 } or { 0, k.length }
  k.prefix, k.wall_group = "", function() return k.group or k.name end
  -- along y the wall's thickness would lie at x < 0: move the run so that `at` stays its lower corner
  local shift_x = k.axis == "y" and k.brick.width or 0
  return raise(k, k.name, { { shift_x, 0 }, { stop[1] + shift_x, stop[2] } }, false, { k.name }, { courses })
end)

--- Walls along a plan with interlocked corners, storey on storey, with openings, lintels and slabs. Blocks are called south.c12.b03
--- (wall, course from the ground, brick), lintel.south.window1 and slab2; walls are the groups wall_south, ...
---@param options building_options
---@return masonry_result
building = public(function(options)
  local mistakes = {}
  local k = read("building", options, masonry_functions[2].keys, mistakes)
  stop_if(mistakes)
  local corners, names, p = k.plan, k.walls or {}, k.plan
  if type(p[1]) == "number" and type(p[2]) == "number" and #p == 2 then
    if math.min(p[1], p[2]) <= 2 * k.brick.width then fail("building: plan {%g, %g} is no wider than two walls", p[1], p[2]) end
    corners = { { 0, 0 }, { p[1], 0 }, { p[1], p[2] }, { 0, p[2] } }
    if not k.walls then names = { "south", "east", "north", "west" } end
  elseif #p < 2 then
    fail("building: plan must be an outer size {x, y} or a list of outer corners {{x, y}, ...}")
  end
  for i, c in ipairs(corners) do
    if type(c) ~= "table" or type(c[1]) ~= "number" or type(c[2]) ~= "number" then fail("building: plan: corner %d must be {x, y}", i) end
  end
  if k.closed and #corners % 2 == 1 then fail("building: a closed plan parallel to x and y has an even number of corners, not %d", #corners) end
  if k.slab and #corners ~= 4 then fail("building: a slab needs a plan of four corners; leave it out and lay plates with box{}") end
  local courses = k.courses
  if type(courses) ~= "table" then
    courses = {}
    for s = 1, k.storeys do courses[s] = k.courses end
  end
  for s = 1, k.storeys do
    if math.type(courses[s]) ~= "integer" or courses[s] < 1 then fail("building: courses must be a whole number above 0, or a list of %d", k.storeys) end
  end
  if #courses ~= k.storeys then fail("building: courses has %d numbers for %d storeys", #courses, k.storeys) end
  k.prefix, k.wall_group = k.name ~= "" and k.name .. "." or "", function(wall_name) return k.group .. "_" .. wall_name end
  return raise(k, k.name ~= "" and k.name or "building", corners, k.closed, names, courses)
end)
