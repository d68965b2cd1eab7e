-- Arches and columns: arch{...} and column{...}, plain Lua on top of prism{...} and box{...}.

local parts = masonry_parts
local fail = parts.fail

masonry_functions[#masonry_functions + 1] = {
  name = "arch",
  help = "An arch of voussoirs with radial joints and straight sides, round or pointed (two arcs). Blocks are called arch.v01, ... from the left.",
  returns = "blocks, abutments, volume (m3), centre_line (m)",
  keys = {
    { name = "name", type = "string", default = "arch", help = "first word of the names of its blocks" },
    { name = "group", type = "string", help = "group of the voussoirs; default the name; abutments are in <group>_abutment" },
    { name = "at", unit = "m", type = "vec", default = { 0, 0, 0 }, help = "middle of the span, at the height of the centre of the circle" },
    { name = "radius", unit = "m", type = "number", above = 0, required = true, help = "radius of the centre line" },
    { name = "thickness", unit = "m", type = "number", above = 0, required = true, help = "radial thickness of the ring" },
    { name = "width", unit = "m", type = "number", above = 0, required = true, help = "width across the span" },
    { name = "voussoirs", type = "integer", low = 1, required = true, help = "number of voussoirs (even for a pointed arch)" },
    { name = "embrace", unit = "rad", type = "number", above = 0, high = 1.5 * math.pi, default = math.pi, help = "angle of a round arch from springing to springing" },
    { name = "offset", unit = "m", type = "number", low = 0, default = 0, help = "pointed arch: distance of the centres of its two arcs from the middle; 0: round arch" },
    { name = "axis", type = "string", default = "x", choice = { "x", "y" }, help = "direction of the span" },
    { name = "abutments", type = "boolean", default = true, help = "fixed blocks at the springings" },
    { name = "material", type = "string", help = "material of all its blocks; default: the only one there is" },
  },
}
masonry_functions[#masonry_functions + 1] = {
  name = "column",
  help = "A stack of equal blocks, square or round (a prism of many sides). Blocks are called column.b01, ... from the bottom.",
  returns = "blocks, height (m)",
  keys = {
    { name = "name", type = "string", default = "column", help = "first word of the names of its blocks, and their group" },
    { name = "group", type = "string", help = "group of the blocks; default the name" },
    { name = "at", unit = "m", type = "vec", default = { 0, 0, 0 }, help = "middle of its foot" },
    { name = "blocks", type = "integer", low = 1, required = true, help = "number of blocks" },
    { name = "size", unit = "m", type = "vec", help = "size of one block along x, y, z" },
    { name = "diameter", unit = "m", type = "number", above = 0, help = "diameter of round drums, instead of size" },
    { name = "height", unit = "m", type = "number", above = 0, help = "height of one drum" },
    { name = "sides", type = "integer", low = 3, default = 24, help = "number of sides of a drum; its corners lie on the circle" },
    { name = "joint", unit = "m", type = "number", low = 0, default = 0, help = "thickness of the joints, also below the first block; 0 is dry" },
    { name = "material", type = "string", help = "material of all its blocks; default: the only one there is" },
  },
}
local arch_keys, column_keys = masonry_functions[#masonry_functions - 1].keys, masonry_functions[#masonry_functions].keys

-- Wraps a function so that its mistakes are reported at the line that called it. The script continues without the blocks, so that
-- later mistakes are reported as well.
local note_mistakes = note_mistakes  -- function of the program, hidden from scenes
local function public(body, nothing)
  return function(...)
    local ok, result = pcall(body, ...)
    if ok then return result end
    if type(result) ~= "table" or not result.masonry then error(result, 0) end
    note_mistakes(result.masonry)
    return nothing()
  end
end

-- Joints of a round ring from left to right: inner and outer end of each, { x, z } from the middle of the span.
local function round_joints(k)
  local joints, n = {}, k.voussoirs
  for i = 0, n do
    local angle = (math.pi + k.embrace) / 2 - k.embrace * i / n  -- from the x axis, the left springing first
    local function point(r) return { r * math.cos(angle), r * math.sin(angle) } end
    joints[#joints + 1] = { point(k.radius - k.thickness / 2), point(k.radius + k.thickness / 2) }
  end
  return joints
end

-- Joints of a pointed ring: two arcs about (offset, 0) and (-offset, 0); the joint at the crown is vertical.
local function pointed_joints(k)
  local joints, half, top = {}, k.voussoirs // 2, math.acos(k.offset / k.radius)
  local radii = { k.radius - k.thickness / 2, k.radius + k.thickness / 2 }
  for i = 0, half - 1 do
    local ends = {}
    for side, r in ipairs(radii) do ends[side] = { k.offset - r * math.cos(top * i / half), r * math.sin(top * i / half) } end
    joints[#joints + 1] = ends
  end
  local crown = {}
  for side, r in ipairs(radii) do crown[side] = { 0, math.sqrt(r * r - k.offset * k.offset) } end
  joints[#joints + 1] = crown
  for i = half, 1, -1 do
    local left = joints[i]
    joints[#joints + 1] = { { -left[1][1], left[1][2] }, { -left[2][1], left[2][2] } }
  end
  return joints
end

--- An arch of voussoirs: round or pointed.
arch = public(function(options)
  local mistakes = {}
  local k = parts.read("arch", options, arch_keys, mistakes)
  if #mistakes == 0 then
    if k.thickness >= 2 * k.radius then mistakes[1] = string.format("arch: thickness = %g m leaves no opening; make it less than twice the radius", k.thickness) end
    if k.offset > 0 and k.voussoirs % 2 == 1 then mistakes[#mistakes + 1] = string.format("arch: a pointed arch has an even number of voussoirs, not %d", k.voussoirs) end
    if k.offset > 0 and k.offset >= k.radius - k.thickness / 2 then
      mistakes[#mistakes + 1] = string.format("arch: offset = %g m must be below the inner radius %g m", k.offset, k.radius - k.thickness / 2)
    end
    if k.offset > 0 and k.embrace ~= math.pi then mistakes[#mistakes + 1] = "arch: embrace is of a round arch; leave it out where offset is given" end
    if k.offset == 0 and k.embrace / k.voussoirs >= math.pi then
      mistakes[#mistakes + 1] = string.format("arch: %d voussoir(s) over %g rad are too few; take at least %d", k.voussoirs, k.embrace, math.floor(k.embrace / math.pi) + 1)
    end
  end
  parts.stop_if(mistakes)
  local group, joints = k.group or k.name, k.offset > 0 and pointed_joints(k) or round_joints(k)
  local out = { blocks = {}, abutments = {}, volume = 0, centre_line = 0 }
  -- A prism across the arch over a polygon { x, z } of its plane. The polygon's axes are z, x for axis "y" and y, z for axis "x".
  local function piece(name, of_group, corners, fixed)
    local polygon = {}
    for i, c in ipairs(corners) do polygon[i] = k.axis == "x" and { c[2], c[1] } or { c[1], c[2] } end
    local at = k.axis == "x" and { k.at[1], k.at[2] - k.width / 2, k.at[3] } or { k.at[1] - k.width / 2, k.at[2], k.at[3] }
    return prism { name = name, group = of_group, material = k.material, fixed = fixed, polygon = polygon, axis = k.axis == "x" and "y" or "x", height = k.width, at = at }
  end
  for i = 1, #joints - 1 do
    local a, b = joints[i], joints[i + 1]
    out.blocks[i] = piece(string.format("%s.v%02d", k.name, i), group, { a[1], a[2], b[2], b[1] })
    local area = 0
    for _, edge in ipairs { { a[1], b[1] }, { b[1], b[2] }, { b[2], a[2] }, { a[2], a[1] } } do
      area = area + (edge[1][1] * edge[2][2] - edge[2][1] * edge[1][2]) / 2
    end
    out.volume = out.volume + math.abs(area) * k.width
    local function middle(j) return (j[1][1] + j[2][1]) / 2, (j[1][2] + j[2][2]) / 2 end
    local x0, z0 = middle(a)
    local x1, z1 = middle(b)
    out.centre_line = out.centre_line + math.sqrt((x1 - x0) ^ 2 + (z1 - z0) ^ 2)
  end
  if k.abutments then
    for i, j in ipairs { joints[1], joints[#joints] } do
      -- a block behind the springing joint, as thick as the ring
      local dx, dz = j[2][1] - j[1][1], j[2][2] - j[1][2]
      local back = i == 1 and { -dz, dx } or { dz, -dx }
      out.abutments[i] = piece(k.name .. (i == 1 and ".left" or ".right"), group .. "_abutment",
        { j[1], j[2], { j[2][1] + back[1], j[2][2] + back[2] }, { j[1][1] + back[1], j[1][2] + back[2] } }, true)
    end
  end
  return out
end, function() return { blocks = {}, abutments = {}, volume = 0, centre_line = 0 } end)

--- A stack of equal blocks.
column = public(function(options)
  local mistakes = {}
  local k = parts.read("column", options, column_keys, mistakes)
  if #mistakes == 0 then
    if (options.size == nil) == (options.diameter == nil) then mistakes[1] = "column: give size = { x, y, z }, or diameter and height of round drums" end
    if options.diameter and not options.height then mistakes[#mistakes + 1] = "column: height of one drum is missing (m)" end
    if options.size and options.height then mistakes[#mistakes + 1] = "column: height is of round drums; the third number of size says it" end
    if options.size and not (k.size[1] > 0 and k.size[2] > 0 and k.size[3] > 0) then mistakes[#mistakes + 1] = "column: size must be three lengths above 0 m" end
  end
  parts.stop_if(mistakes)
  local out, height, polygon = { blocks = {} }, k.size and k.size[3] or k.height, {}
  if k.diameter then
    for i = 1, k.sides do
      local angle = 2 * math.pi * (i - 0.5) / k.sides
      polygon[i] = { k.diameter / 2 * math.cos(angle), k.diameter / 2 * math.sin(angle) }
    end
  end
  for i = 1, k.blocks do
    local z, name = k.at[3] + k.joint + (i - 1) * (height + k.joint), string.format("%s.b%02d", k.name, i)
    local common = { name = name, group = k.group or k.name, material = k.material }
    if k.diameter then
      common.polygon, common.height, common.at = polygon, height, { k.at[1], k.at[2], z }
      out.blocks[i] = prism(common)
    else
      common.size, common.at = k.size, { k.at[1] - k.size[1] / 2, k.at[2] - k.size[2] / 2, z }
      out.blocks[i] = box(common)
    end
  end
  out.height = k.blocks * (height + k.joint)
  return out
end, function() return { blocks = {}, height = 0 } end)
