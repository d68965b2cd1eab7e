-- Buttresses: buttress{...}, a stepped or battered pier against a wall, plain Lua on top of prism{...}.

local parts, eps = masonry_parts, masonry_parts.eps

local block_keys = {
  { name = "length", unit = "m", type = "number", above = 0, required = true, help = "length of a block away from the wall" },
  { name = "height", unit = "m", type = "number", above = 0, required = true, help = "height of a course without its joint" },
}
masonry_functions[#masonry_functions + 1] = {
  name = "buttress",
  help = "A pier against a wall, in bond: battered (its outer face leans), stepped, or upright. Blocks are called buttress.c03.b02.r1 "
    .. "(course, number from the wall, row along the wall).",
  returns = "blocks (names), foot, top, back (names of the first course, of the last, and of the blocks at the wall), depths (m, of each "
    .. "course at its middle), height (m), volume (m3)",
  keys = {
    { name = "name", type = "string", default = "buttress", help = "first word of the names of its blocks, and their group" },
    { name = "group", type = "string", help = "group of the blocks; default the name" },
    { name = "at", unit = "m", type = "vec", default = { 0, 0, 0 },
      help = "point of the wall's face in the middle of its width, at the foot" },
    { name = "towards", type = "string", default = "x", choice = { "x", "-x", "y", "-y" }, help = "direction away from the wall" },
    { name = "width", unit = "m", type = "number", above = 0, required = true, help = "width along the wall" },
    { name = "depth", unit = "m", type = "number", above = 0, required = true, help = "projection from the wall at the foot" },
    { name = "top_depth", unit = "m", type = "number", above = 0, help = "projection at the top; default that at the foot" },
    { name = "steps", type = "integer", low = 0, default = 0,
      help = "0: the outer face leans evenly; else the number of set-backs between foot and top" },
    { name = "courses", type = "integer", low = 1, required = true, help = "number of courses" },
    { name = "block", type = "table", keys = block_keys, required = true, help = "size of a block: { length*, height* }" },
    { name = "rows", type = "integer", low = 1, default = 1,
      help = "blocks along the wall; in every other course shifted by half a block" },
    { name = "joint", unit = "m", type = "number", low = 0, default = 0,
      help = "thickness of bed joints, and of the joint to the wall; 0 is dry" },
    { name = "least", unit = "m", type = "number", above = 0,
      help = "narrowest piece that a perpend may leave; default 0.4 of the length" },
    { name = "material", type = "string", help = "material of its blocks; default: the only one there is" },
  },
}
local buttress_keys = masonry_functions[#masonry_functions].keys

-- Projection (m) at the bottom and at the top of course c of n, counted from 0.
local function depths_of(k, c)
  local n, taper = k.courses, k.depth - k.top_depth
  if k.steps == 0 then return k.depth - taper * c / n, k.depth - taper * (c + 1) / n end
  local step = math.floor(c * (k.steps + 1) / n)  -- steps + 1 stretches of equal height
  return k.depth - taper * step / k.steps, k.depth - taper * step / k.steps
end

local function check(k, mistakes)
  local function wrong(...) mistakes[#mistakes + 1] = "buttress: " .. string.format(...) end
  if k.top_depth > k.depth then wrong("top_depth = %g m is more than depth = %g m; a buttress does not overhang", k.top_depth, k.depth) end
  if k.steps > 0 and k.top_depth == k.depth then wrong("steps = %d, but top_depth is depth; make top_depth smaller", k.steps) end
  if k.steps >= k.courses then wrong("steps = %d need more than %d courses", k.steps, k.courses) end
  if k.least > k.block.length / 2 then
    wrong("least = %g m is more than half a block; at most %g m is allowed", k.least, k.block.length / 2)
  end
  if k.joint > 0 and k.top_depth <= k.joint then wrong("top_depth = %g m leaves nothing beside a joint of %g m", k.top_depth, k.joint) end
end

local function empty() return { blocks = {}, foot = {}, top = {}, back = {}, depths = {}, height = 0, volume = 0 } end

-- Lays one course: { u, z } with u away from the wall. Perpends are bed-to-bed, so that only the outermost piece has the leaning face.
local function lay_course(k, out, c, place)
  local z, t = c * (k.block.height + k.joint) + k.joint, k.joint
  local low, high = depths_of(k, c)
  local top = z + k.block.height
  local perpends = {}
  for j = 0, math.ceil(k.depth / k.block.length) do
    local u = t + (j + (c % 2 == 1 and 0.5 or 1)) * k.block.length
    if u - t > k.least - eps and high - u > k.least - eps then perpends[#perpends + 1] = u end
  end
  local names, edges = {}, parts.row_edges(k.width, k.rows, c % 2 == 1)
  local from = t
  for i = 1, #perpends + 1 do
    local to = perpends[i]
    -- the piece ends at the middle of its perpend, less half the joint; the last one at the outer face
    local a, b = to and to - t / 2 or low, to and to - t / 2 or high
    local polygon = { { from, z }, { a, z }, { b, top }, { from, top } }
    if place.sign < 0 then
      for n, p in ipairs(polygon) do polygon[n] = { -p[1], p[2] } end
    end
    local laid, volume = parts.lay_across(place, polygon, edges, {
      name = string.format("%s.c%02d.b%02d", k.name, c + 1, i), group = k.group, material = k.material,
    })
    table.move(laid, 1, #laid, #names + 1, names)
    if i == 1 then table.move(laid, 1, #laid, #out.back + 1, out.back) end
    out.volume, from = out.volume + volume, to and to + t / 2
  end
  table.move(names, 1, #names, #out.blocks + 1, out.blocks)
  out.depths[c + 1] = (low + high) / 2
  if c == 0 then out.foot = names end
  out.top, out.height = names, top
end

--- A stepped or battered pier against a wall.
buttress = parts.public(function(options)
  local mistakes = {}
  local k = parts.read("buttress", options, buttress_keys, mistakes)
  parts.stop_if(mistakes)
  k.group, k.least, k.top_depth = k.group or k.name, k.least or 0.4 * k.block.length, k.top_depth or k.depth
  check(k, mistakes)
  parts.stop_if(mistakes)
  local sign = k.towards:sub(1, 1) == "-" and -1 or 1
  local place = { at = k.at, width = k.width, joint = k.joint, axis = k.towards:match("[xy]"), sign = sign }
  local out = empty()
  for c = 0, k.courses - 1 do lay_course(k, out, c, place) end
  return out
end, empty)
