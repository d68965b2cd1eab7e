-- A block that stands on feet along its edges: footed_block{...}, plain Lua on top of block{...}.

local parts = masonry_parts

masonry_functions[#masonry_functions + 1] = {
  name = "footed_block",
  help = "A block that stands on small feet along its lower edges instead of its whole face, like test blocks with a slightly hollow base. "
    .. "An impact then acts at its edges, as Housner assumes.",
  returns = "name, width and height of a foot (m), share of the feet in the face: a joint or contact presses them like the whole face if its "
    .. "kn is divided by it",
  keys = {
    { name = "name", type = "string", default = "block", help = "name of the block" },
    { name = "group", type = "string", help = "group of the block" },
    { name = "size", unit = "m", type = "vec", required = true, help = "size along x, y, z, feet included" },
    { name = "at", unit = "m", type = "vec", default = { 0, 0, 0 }, help = "middle of its lower face, on the bed" },
    { name = "rocks", type = "string", default = "x", choice = { "x", "y", "xy" },
      help = "direction in which it rocks: feet along both edges across it; xy: four feet at the corners" },
    { name = "foot", type = "number", above = 0, high = 0.5, default = 0.008, help = "width of a foot over that of the block" },
    { name = "hollow", type = "number", above = 0, high = 0.5, default = 0.001, help = "height of the feet over that of the block" },
    { name = "material", type = "string", help = "material of the block; default: the only one there is" },
    { name = "free", type = "boolean", default = false, help = "allowed to have no joint: its feet are contacts from the start" },
    { name = "initial", type = "table", help = "initial state, as in block{}" },
  },
}
local keys = masonry_functions[#masonry_functions].keys

-- A convex part between two corners.
local function part(low, high)
  local vertices = {}
  for _, x in ipairs { low[1], high[1] } do
    for _, y in ipairs { low[2], high[2] } do
      for _, z in ipairs { low[3], high[3] } do vertices[#vertices + 1] = { x, y, z } end
    end
  end
  return { vertices = vertices }
end

--- A block that stands on feet along its edges.
footed_block = parts.public(function(options)
  local mistakes = {}
  local k = parts.read("footed_block", options, keys, mistakes)
  for i = 1, 3 do
    if #mistakes == 0 and not (k.size[i] > 0) then mistakes[1] = "footed_block: size must be three lengths above 0 m" end
  end
  parts.stop_if(mistakes)
  local x, y, z, at = k.size[1] / 2, k.size[2] / 2, k.size[3], k.at
  local hollow, across, along = k.hollow * z, { { -x, x } }, { { -y, y } }
  if k.rocks ~= "y" then across = { { -x, -x + 2 * k.foot * x }, { x - 2 * k.foot * x, x } } end
  if k.rocks ~= "x" then along = { { -y, -y + 2 * k.foot * y }, { y - 2 * k.foot * y, y } } end
  local pieces, area = {}, 0
  for _, u in ipairs(across) do
    for _, v in ipairs(along) do
      pieces[#pieces + 1] = part({ u[1], v[1], 0 }, { u[2], v[2], hollow })
      area = area + (u[2] - u[1]) * (v[2] - v[1])
    end
  end
  pieces[#pieces + 1] = part({ -x, -y, hollow }, { x, y, z })
  local name = block { name = k.name, group = k.group, material = k.material, free = k.free, initial = k.initial, parts = pieces, at = at }
  return { name = name, width = k.foot * (k.rocks == "y" and 2 * y or 2 * x), height = hollow, share = area / (4 * x * y) }
end, function() return { name = "", width = 0, height = 0, share = 1 } end)
