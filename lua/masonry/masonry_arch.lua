-- Arches, barrel vaults and columns: arch{...}, barrel{...} and column{...}, plain Lua on top of prism{...} and box{...}.

local parts = masonry_parts
local public = parts.public

local ring_returns = "blocks (names), abutments (names), crown (names of the blocks at the crown), span (m, clear), height (m, of the "
  .. "crown's back above at), volume (m3), centre_line (m)"
local function ring_keys(what, more)
  local keys = {
    { name = "name", type = "string", default = what, help = "first word of the names of its blocks" },
    { name = "group", type = "string", help = "group of the voussoirs; default the name; abutments are in <group>_abutment" },
    { name = "at", unit = "m", type = "vec", default = { 0, 0, 0 },
      help = "middle of the span, at the height of the centre of the circle" },
    { name = "radius", unit = "m", type = "number", above = 0, required = true, help = "radius of the centre line" },
    { name = "thickness", unit = "m", type = "number", above = 0, required = true, help = "radial thickness of the ring" },
    { name = "width", unit = "m", type = "number", above = 0, required = true, help = "width across the span" },
    { name = "voussoirs", type = "integer", low = 1, required = true, help = "number of voussoirs (even for a pointed arch)" },
    { name = "embrace", unit = "rad", type = "number", above = 0, high = 1.5 * math.pi, default = math.pi,
      help = "angle of a round arch from springing to springing" },
    { name = "offset", unit = "m", type = "number", low = 0, default = 0,
      help = "pointed arch: distance of the centres of its two arcs from the middle; 0: round arch" },
    { name = "axis", type = "string", default = "x", choice = { "x", "y" }, help = "direction of the span" },
    { name = "abutments", type = "boolean", default = true, help = "fixed blocks at the springings" },
    { name = "material", type = "string", help = "material of all its blocks; default: the only one there is" },
  }
  for _, key in ipairs(more) do keys[#keys + 1] = key end
  return keys
end
masonry_functions[#masonry_functions + 1] = {
  name = "arch",
  help = "An arch of voussoirs with radial joints and straight sides, round or pointed (two arcs). Blocks are called arch.v01, ... from "
    .. "the left.",
  returns = ring_returns,
  keys = ring_keys("arch", {}),
}
masonry_functions[#masonry_functions + 1] = {
  name = "barrel",
  help = "A barrel vault in bond: an arch of several blocks across its width, staggered from voussoir to voussoir. Blocks are called "
    .. "barrel.v01.r1, ... (voussoir from the left, row across).",
  returns = ring_returns,
  keys = ring_keys("barrel", {
    { name = "rows", type = "integer", low = 2, required = true,
      help = "blocks across the width; in every other voussoir shifted by half a block" },
  }),
}
masonry_functions[#masonry_functions + 1] = {
  name = "column",
  help = "A stack of equal blocks, square or round (a prism of many sides). Blocks are called column.b01, ... from the bottom.",
  returns = "blocks (names), top (names of the last), height (m), volume (m3)",
  keys = {
    { name = "name", type = "string", default = "column", help = "first word of the names of its blocks, and their group" },
    { name = "group", type = "string", help = "group of the blocks; default the name" },
    { name = "at", unit = "m", type = "vec", default = { 0, 0, 0 }, help = "middle of its foot" },
    { name = "blocks", type = "integer", low = 1, required = true, help = "number of blocks" },
    { name = "size", unit = "m", type = "vec", help = "size of one block along x, y, z" },
    { name = "diameter", unit = "m", type = "number", above = 0, help = "diameter of round drums, instead of size" },
    { name = "height", unit = "m", type = "number", above = 0, help = "height of one drum" },
    { name = "sides", type = "integer", low = 3, default = 24, help = "number of sides of a drum; its corners lie on the circle" },
    { name = "joint", unit = "m", type = "number", low = 0, default = 0,
      help = "thickness of the joints, also below the first block; 0 is dry" },
    { name = "material", type = "string", help = "material of all its blocks; default: the only one there is" },
  },
}
local count = #masonry_functions
local arch_keys, barrel_keys = masonry_functions[count - 2].keys, masonry_functions[count - 1].keys
local column_keys = masonry_functions[count].keys

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

local function ring_mistakes(what, k, mistakes)
  local function wrong(...) mistakes[#mistakes + 1] = what .. ": " .. string.format(...) end
  if k.thickness >= 2 * k.radius then wrong("thickness = %g m leaves no opening; make it less than twice the radius", k.thickness) end
  if k.offset > 0 and k.voussoirs % 2 == 1 then wrong("a pointed arch has an even number of voussoirs, not %d", k.voussoirs) end
  if k.offset > 0 and k.offset >= k.radius - k.thickness / 2 then
    wrong("offset = %g m must be below the inner radius %g m", k.offset, k.radius - k.thickness / 2)
  end
  if k.offset > 0 and k.embrace ~= math.pi then wrong("embrace is of a round arch; leave it out where offset is given") end
  if k.offset == 0 and k.embrace / k.voussoirs >= math.pi then
    wrong("%d voussoir(s) over %g rad are too few; take at least %d", k.voussoirs, k.embrace, math.floor(k.embrace / math.pi) + 1)
  end
end

local function empty_ring()
  return { blocks = {}, abutments = {}, crown = {}, span = 0, height = 0, volume = 0, centre_line = 0 }
end

-- A block behind each springing joint, as thick as the ring.
local function lay_abutments(k, joints, group, out)
  for i, j in ipairs { joints[1], joints[#joints] } do
    local du, dz = j[2][1] - j[1][1], j[2][2] - j[1][2]
    local back = i == 1 and { -dz, du } or { dz, -du }
    local polygon = { j[1], j[2], { j[2][1] + back[1], j[2][2] + back[2] }, { j[1][1] + back[1], j[1][2] + back[2] } }
    out.abutments[i] = parts.lay_across(k, polygon, { 0, k.width }, {
      name = k.name .. (i == 1 and ".left" or ".right"), group = group .. "_abutment", material = k.material, fixed = true,
    })[1]
  end
end

-- A ring of voussoirs, each of one block or of several rows across the width.
local function lay_ring(what, keys, options)
  local mistakes = {}
  local k = parts.read(what, options, keys, mistakes)
  if #mistakes == 0 then ring_mistakes(what, k, mistakes) end
  parts.stop_if(mistakes)
  local group, joints, out = k.group or k.name, k.offset > 0 and pointed_joints(k) or round_joints(k), empty_ring()
  local function middle(j) return (j[1][1] + j[2][1]) / 2, (j[1][2] + j[2][2]) / 2 end
  for i = 1, #joints - 1 do
    local a, b = joints[i], joints[i + 1]
    local block = { name = string.format("%s.v%02d", k.name, i), group = group, material = k.material }
    local names, volume = parts.lay_across(k, { a[1], a[2], b[2], b[1] }, parts.row_edges(k.width, k.rows or 1, i % 2 == 0), block)
    local x0, z0 = middle(a)
    local x1, z1 = middle(b)
    out.volume, out.centre_line = out.volume + volume, out.centre_line + math.sqrt((x1 - x0) ^ 2 + (z1 - z0) ^ 2)
    out.height = math.max(out.height, a[2][2], b[2][2])
    table.move(names, 1, #names, #out.blocks + 1, out.blocks)
    if math.abs(i - (#joints) / 2) < 0.6 then table.move(names, 1, #names, #out.crown + 1, out.crown) end
  end
  out.span = joints[#joints][1][1] - joints[1][1][1]
  if k.abutments then lay_abutments(k, joints, group, out) end
  return out
end

--- An arch of voussoirs: round or pointed.
arch = public(function(options) return lay_ring("arch", arch_keys, options) end, empty_ring)
--- A barrel vault: an arch in bond across its width.
barrel = public(function(options) return lay_ring("barrel", barrel_keys, options) end, empty_ring)

--- A stack of equal blocks.
column = public(function(options)
  local mistakes = {}
  local k = parts.read("column", options, column_keys, mistakes)
  if #mistakes == 0 then
    if (options.size == nil) == (options.diameter == nil) then
      mistakes[1] = "column: give size = { x, y, z }, or diameter and height of round drums"
    end
    if options.diameter and not options.height then mistakes[#mistakes + 1] = "column: height of one drum is missing (m)" end
    if options.size and options.height then
      mistakes[#mistakes + 1] = "column: height is of round drums; the third number of size says it"
    end
    if options.size and not (k.size[1] > 0 and k.size[2] > 0 and k.size[3] > 0) then
      mistakes[#mistakes + 1] = "column: size must be three lengths above 0 m"
    end
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
  out.height, out.top = k.blocks * (height + k.joint), { out.blocks[#out.blocks] }
  local area = k.size and k.size[1] * k.size[2] or k.sides * k.diameter ^ 2 / 8 * math.sin(2 * math.pi / k.sides)
  out.volume = k.blocks * height * area
  return out
end, function() return { blocks = {}, top = {}, height = 0, volume = 0 } end)
