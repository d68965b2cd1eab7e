-- Masonry in running bond: wall{...} and building{...}, plain Lua on top of box{...}.
--
-- A run is a straight stretch of wall seen from outside; its coordinate u grows from left to right. Two patterns of head joints
-- alternate from course to course. At a corner one wall runs through in one pattern, the other wall in the other pattern.
-- masonry_bond.lua decides how a stretch is filled (whole bricks, halves, cut closers, wider joints). Beside an opening the pattern
-- of the solid wall continues, and only the piece at the jamb is cut.

local parts, eps = masonry_parts, masonry_parts.eps
local fail, millimetres, piece_kind, ends = parts.fail, parts.millimetres, parts.piece_kind, parts.ends
local empty_group = empty_group  -- function of the program, hidden from scenes
masonry_parts = nil  -- scenes see only the builders and masonry_functions

-- Lays all courses from the support up, storey by storey, each storey with its slab.
local function build(masonry, runs)
  local out, z, number = masonry.out, masonry.at[3], 0
  for storey, courses in ipairs(masonry.courses) do
    local below = {}
    -- No head joint lies beneath the first course on the ground or a slab; it avoids the joints of the second course instead.
    for i, run in ipairs(runs) do
      below[i] = {}
      for _, joint in ipairs(run.pattern[masonry.shift % 2]) do below[i][#below[i] + 1] = joint.u end
    end
    for course = 1, courses do
      number, z = number + 1, z + masonry.t
      for i, run in ipairs(runs) do
        below[i] = parts.lay_course(masonry, i, run, storey, course, number, z, below[i], course > 1 and below[i] or {})
      end
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

-- "south, through, 2000 mm: 5 whole, head joints 6.25 mm" for either pattern of the solid run.
local function describe_pattern(masonry, index, run, parity)
  local start, stop, _, through = ends(masonry, index, run, parity)
  local words, count, u, widest = {}, { full = 0, half = 0, cut = 0 }, start, masonry.t
  local function piece(to)
    local kind = piece_kind(masonry, to - u)
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
    text = string.format("%s, %s, %s: %s, head joints %s", run.name, role, millimetres(stop - start), table.concat(words, " + "),
      millimetres(widest)) }
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
    line("  shortest lap %s; laps below a quarter brick: %d, of them head joints above each other: %d", millimetres(r.least_lap), r.short_laps,
      r.stacked)
  end
  for _, run in ipairs(runs) do
    for _, hole in ipairs(run.openings) do
      r.openings[#r.openings + 1] = { wall = run.name, name = hole.name, storey = hole.storey, lo = hole.lo, hi = hole.hi,
        sill = hole.sill, height = hole.height }
      line("  %s.%s, storey %d: %s to %s, sill %s, height %s", run.name, hole.name, hole.storey, millimetres(hole.lo), millimetres(hole.hi),
        millimetres(hole.sill), millimetres(hole.height))
    end
  end
  out.summary = table.concat(lines, "\n")
end

-- The nearest of 1, 2, 5, 10, 20, 50, ... mm on a logarithmic scale: lengths of cut bricks are tried in such steps.
local function round_step(x)
  local decade = 10 ^ math.floor(math.log(x, 10))
  for _, step in ipairs { 1, 2, 5 } do
    if x < step * decade * math.sqrt(step == 2 and 2.5 or 2) then return step * decade end
  end
  return 10 * decade
end

local function empty_report(brick_length)
  return { pieces = { full = 0, half = 0, cut = 0 }, cuts = {}, head_joints = {}, patterns = {}, openings = {}, stacked = 0,
    short_laps = 0, least_lap = math.huge, shortest = brick_length, brick_volume = 0, lintel_volume = 0, slab_volume = 0 }
end

-- Builds the blocks from checked keys. corners: outer corners of the plan.
local function raise(k, title, corners, closed, names, courses)
  local lo, hi = { math.huge, math.huge }, { -math.huge, -math.huge }
  for _, c in ipairs(corners) do
    for i = 1, 2 do lo[i], hi[i] = math.min(lo[i], c[i]), math.max(hi[i], c[i]) end
  end
  local masonry = {
    full = k.brick.length, width = k.brick.width, height = k.brick.height, half = k.brick.length / 2, t = k.joint, closer = k.closer,
    joint_max = k.joint_max or 1.5 * k.joint, step = round_step(k.brick.length / 30), bearing = k.lintel.bearing or k.brick.length / 2,
    at = k.at, material = k.material, lintel = k.lintel, slab = k.slab, base = k.base, shift = k.shift, courses = courses, laid = {},
    prefix = k.prefix, title = title, plan_box = { lo = lo, hi = hi },
  }
  if masonry.closer > masonry.half then
    fail("closer = %s is more than half a brick; at most %s is allowed", millimetres(masonry.closer), millimetres(masonry.half))
  end
  masonry.out = {
    blocks = {}, slabs = {}, lintels = {}, tops = {}, walls = {}, openings = {}, storey_top = {}, top = {},
    report = empty_report(k.brick.length),
  }
  local runs = parts.make_runs(corners, closed, names, masonry.width)
  for _, run in ipairs(runs) do  -- the plan reaches to the inner faces too: an open one has nothing opposite
    for _, s in ipairs { 0, run.length } do
      for i = 1, 2 do
        local inner = run.origin[i] + s * run.d[i] + masonry.width * run.n[i]
        lo[i], hi[i] = math.min(lo[i], inner), math.max(hi[i], inner)
      end
    end
  end
  for i, run in ipairs(runs) do
    run.group = k.wall_group(run.name)
    masonry.out.walls[i] = run.group
    parts.make_patterns(masonry, i, run)
  end
  parts.place_openings(masonry, runs, k.openings)
  build_base(masonry)
  build(masonry, runs)
  parts.describe(masonry, runs)
  summarise(masonry, runs)
  local report = masonry.out.report
  masonry.out.volume = report.brick_volume + report.lintel_volume + report.slab_volume
  if #masonry.out.lintels == 0 then empty_group(masonry.lintel.group) end
  if not k.quiet then print(masonry.out.summary) end
  return masonry.out
end

-- Wraps a function so that its mistakes are reported at the line that called it. The script continues with masonry of no blocks, so
-- that later mistakes are reported as well.
local note_mistakes = note_mistakes  -- functions of the program, hidden from scenes
local function public(body)
  return function(...)
    local ok, result = pcall(body, ...)
    if ok then return result end
    if type(result) ~= "table" or not result.masonry then error(result, 0) end
    note_mistakes(result.masonry)
    return { blocks = {}, walls = {}, slabs = {}, lintels = {}, tops = {}, openings = {}, storey_top = {}, top = {}, height = 0, volume = 0,
      report = empty_report(0), summary = "" }
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

---@class masonry_hole
---@field name string
---@field wall string
---@field kind "window"|"door"
---@field storey integer
---@field lo number         m, jambs along the wall
---@field hi number
---@field sill number       m, above the floor of its storey
---@field width number      m, between the jambs
---@field height number     m
---@field at number[]       m, its lower corner
---@field size number[]     m, along x, y, z
---@field center number[]   m
---@field lintel? string
---@field left string[]     names of the blocks at its jambs, from the bottom up, seen from outside
---@field right string[]
---@field above string[]    lintel, bricks or slab
---@field below string[]    bricks, slab or base

---@class masonry_result
---@field blocks string[]   names, from the bottom up
---@field walls string[]    groups of the walls, in the order of the plan
---@field slabs string[]    names, by storey
---@field lintels string[]
---@field base? string
---@field tops number[]     m, top of every storey above the support
---@field top string[]      names at the top: the slab, or the last course
---@field storey_top string[][]  the same of each storey
---@field openings table<string, masonry_hole>  by name: window1 of a wall, south.window1 of a building
---@field height number     m
---@field volume number     m3, of all blocks but the base
---@field report table      pieces, cuts, head_joints, patterns, openings, stacked, short_laps, least_lap, shortest, volumes (m3)
---@field summary string    the report in words

--- A free-standing straight wall in running bond, both ends plain. Blocks are called wall.c01.b01 (course, brick).
---@param options wall_options
---@return masonry_result
wall = public(function(options)
  local mistakes = {}
  local k = parts.read("wall", options, masonry_functions[1].keys, mistakes)
  parts.stop_if(type(options) == "table" and {} or mistakes)
  if (options.courses == nil) == (options.height == nil) then mistakes[#mistakes + 1] = "wall: give courses or height, one of them" end
  parts.stop_if(mistakes)
  local courses = k.courses or math.max(1, math.floor(0.5 + k.height / (k.brick.height + k.joint)))
  local stop = k.axis == "x" and { k.length, 0 } or { 0, k.length }
  k.prefix, k.wall_group = "", function() return k.group or k.name end
  -- along y the thickness would lie at x < 0: the run is moved so that `at` stays its lower corner
  local shift_x = k.axis == "y" and k.brick.width or 0
  return raise(k, k.name, { { shift_x, 0 }, { stop[1] + shift_x, stop[2] } }, false, { k.name }, { courses })
end)

--- Walls along a plan with interlocked corners, storey on storey, with openings, lintels and slabs. Blocks are called south.c12.b03
--- (wall, course from the ground, brick), lintel.south.window1 and slab2; walls are the groups wall_south, ...
---@param options building_options
---@return masonry_result
building = public(function(options)
  local mistakes = {}
  local k = parts.read("building", options, masonry_functions[2].keys, mistakes)
  parts.stop_if(mistakes)
  local corners, names, p = k.plan, k.walls or {}, k.plan
  if type(p[1]) == "number" and type(p[2]) == "number" and #p == 2 then
    if math.min(p[1], p[2]) <= 2 * k.brick.width then
      fail("building: plan {%g, %g} is no wider than two walls; make it larger", p[1], p[2])
    end
    corners = { { 0, 0 }, { p[1], 0 }, { p[1], p[2] }, { 0, p[2] } }
    if not k.walls then names = { "south", "east", "north", "west" } end
  elseif #p < 2 then
    fail("building: plan must be an outer size {x, y} or a list of outer corners {{x, y}, ...}")
  end
  for i, c in ipairs(corners) do
    if type(c) ~= "table" or type(c[1]) ~= "number" or type(c[2]) ~= "number" then fail("building: plan: corner %d must be {x, y}", i) end
  end
  if k.closed and #corners % 2 == 1 then
    fail("building: a closed plan parallel to x and y has an even number of corners, not %d", #corners)
  end
  local runs = k.closed and #corners or #corners - 1
  if k.walls and #k.walls ~= runs then
    fail("building: walls has %d names for %d runs of the plan; give one for each, or leave walls out", #k.walls, runs)
  end
  if k.slab and #corners ~= 4 then fail("building: a slab needs a plan of four corners; leave it out and lay plates with box{}") end
  if type(k.courses) == "table" and #k.courses ~= k.storeys then
    fail("building: courses has %d numbers for %d storeys; give one for each", #k.courses, k.storeys)
  end
  local courses = {}
  for s = 1, k.storeys do
    local n = type(k.courses) == "table" and k.courses[s] or k.courses
    courses[s] = type(n) == "number" and math.tointeger(n)  -- -D gives a float even for a whole number, and "5" is a word
    if not courses[s] or courses[s] < 1 then fail("building: courses must be a whole number above 0, or a list of %d", k.storeys) end
  end
  k.prefix, k.wall_group = k.name ~= "" and k.name .. "." or "", function(wall_name) return k.group .. "_" .. wall_name end
  return raise(k, k.name ~= "" and k.name or "building", corners, k.closed, names, courses)
end)
