-- Keys of wall{...} and building{...}: one table serves reading, messages and help. The reader reports all mistakes at once.
-- First of the masonry files, in the order of CMakeLists.txt. Each adds to masonry_parts for the next ones.

-- type: number (ends `low` and `high` are allowed, end `above` is not), integer, string, boolean, vec (three numbers), table

local brick_keys = {
  { name = "length", unit = "m", type = "number", above = 0, required = true, help = "length along the wall" },
  { name = "width", unit = "m", type = "number", above = 0, required = true, help = "width across the wall: the thickness of the wall" },
  { name = "height", unit = "m", type = "number", above = 0, required = true, help = "height of one course without its joint" },
}
local opening_keys = {
  { name = "wall", type = "string", help = "name of its wall (building only)" },
  { name = "name", type = "string", help = "default: kind and number, e.g. window2" },
  { name = "kind", type = "string", default = "window", choice = { "window", "door" }, help = "a door starts at the floor" },
  { name = "storey", type = "any", default = "all", help = "1, 2, ..., a list of them, or \"all\"" },
  { name = "at", unit = "m", type = "number", low = 0, help = "left jamb, from the wall's left end seen from outside" },
  { name = "centre", unit = "m", type = "number", low = 0, help = "middle of the opening, instead of `at`" },
  { name = "width", unit = "m", type = "number", above = 0, required = true, help = "between the jambs" },
  { name = "sill", unit = "m", type = "number", low = 0, default = 0, help = "height above the floor; rounded to courses" },
  { name = "height", unit = "m", type = "number", above = 0, required = true, help = "clear height; rounded to courses" },
  { name = "lintel", type = "boolean", default = true, help = "false: nothing spans the opening (it must end at the top)" },
}
local lintel_keys = {
  { name = "bearing", unit = "m", type = "number", above = 0, help = "length that rests on either jamb; default half a brick" },
  { name = "courses", type = "integer", low = 1, default = 1, help = "height in courses" },
  { name = "material", type = "string", help = "default: that of the bricks" },
  { name = "group", type = "string", default = "lintel", help = "group of its blocks" },
}
local slab_keys = {
  { name = "thickness", unit = "m", type = "number", above = 0, required = true, help = "thickness without its bed joint" },
  { name = "overhang", unit = "m", type = "number", low = 0, default = 0, help = "width beyond the outer faces of the walls" },
  { name = "material", type = "string", help = "default: that of the bricks" },
  { name = "group", type = "string", default = "slab", help = "group of its blocks" },
}
local base_keys = {
  { name = "thickness", unit = "m", type = "number", above = 0, required = true, help = "thickness; its top is at `at`" },
  { name = "margin", unit = "m", type = "number", low = 0, default = 0, help = "width beyond the walls on every side" },
  { name = "material", type = "string", help = "default: that of the bricks" },
  { name = "group", type = "string", default = "base", help = "group of its block" },
}
local common_keys = {
  { name = "at", unit = "m", type = "vec", default = { 0, 0, 0 }, help = "position of the plan's origin; z is the top of the support" },
  { name = "brick", type = "table", keys = brick_keys, required = true, help = "size of a whole brick" },
  { name = "joint", unit = "m", type = "number", low = 0, required = true, help = "thickness of bed and head joints; 0 is dry masonry" },
  { name = "closer", unit = "m", type = "number", above = 0, default = 0.04, help = "shortest piece that may be cut" },
  { name = "joint_max", unit = "m", type = "number", low = 0, help = "widest head joint; default 1.5 joints" },
  { name = "shift", type = "integer", low = 0, high = 1, default = 0, help = "1: start with the other of the two alternating courses" },
  { name = "openings", type = "table", list = opening_keys, default = {}, help = "doors and windows" },
  { name = "lintel", type = "table", keys = lintel_keys, default = {}, help = "the pieces over openings" },
  { name = "base", type = "table", keys = base_keys, help = "a fixed plate below; default none (stand on ground{} or another block)" },
  { name = "material", type = "string", default = "brick", help = "material of the bricks" },
  { name = "quiet", type = "boolean", default = false, help = "true: do not print the summary" },
}

-- Adds the keys that both functions share. Appends to the help of a key that is a table the names of its inner keys.
local function with_common(keys)
  for _, key in ipairs(common_keys) do keys[#keys + 1] = key end
  local whole = {}
  for i, key in ipairs(keys) do
    whole[i] = {}
    for name, value in pairs(key) do whole[i][name] = value end
    if key.keys or key.list then
      local names = {}
      for n, inner in ipairs(key.keys or key.list) do names[n] = inner.name .. (inner.required and "*" or "") end
      whole[i].help = string.format("%s: %s{ %s }", key.help, key.list and "a list of " or "", table.concat(names, ", "))
    end
  end
  return whole
end

local masonry_returns = "blocks (names), walls (groups), slabs, lintels, base, height (m), volume (m3), tops (m, of each storey), "
  .. "top (names: the slab or the last course), storey_top (the same of each storey), openings (by name, of a building as south.window1: "
  .. "kind, storey, lo, hi, sill, width, height, at, size, center (m); left, right, above, below (names), lintel), report, summary"

--- All functions that these files add to the language, for help, editors and tests.
masonry_functions = {
  {
    name = "wall",
    help = "A free-standing straight wall in running bond, both ends plain.",
    returns = masonry_returns,
    keys = with_common {
      { name = "name", type = "string", default = "wall", help = "first word of the names of its blocks, and their group" },
      { name = "group", type = "string", help = "group of the bricks; default the name" },
      { name = "length", unit = "m", type = "number", above = 0, required = true, help = "length from end to end" },
      { name = "axis", type = "string", default = "x", choice = { "x", "y" }, help = "direction of the wall" },
      { name = "courses", type = "integer", low = 1, help = "number of courses; or give height" },
      { name = "height", unit = "m", type = "number", above = 0, help = "height instead of courses; rounded to whole courses" },
    },
  },
  {
    name = "building",
    help = "Walls along a plan with interlocked corners, storey on storey, with openings, lintels and slabs.",
    returns = masonry_returns,
    keys = with_common {
      { name = "name", type = "string", default = "", help = "first word of all block names; default none" },
      { name = "group", type = "string", default = "wall", help = "groups of the walls are <group>_<wall>" },
      { name = "plan", unit = "m", type = "table", required = true,
        help = "outer size {x, y}, or outer corners {{x,y}, ...} counter-clockwise" },
      { name = "closed", type = "boolean", default = true, help = "false: the last corner is not joined to the first" },
      { name = "walls", type = "table", help = "names of the walls; default south, east, north, west for a rectangle, else wall1, ..." },
      { name = "storeys", type = "integer", low = 1, default = 1, help = "number of storeys" },
      { name = "courses", type = "any", required = true, help = "courses per storey: a number, or a list with one for each storey" },
      { name = "slab", type = "table", keys = slab_keys, help = "a rigid plate on the walls of every storey; default none" },
    },
  },
}

-- ---- reading and messages ------------------------------------------------------------------------------------------------------

local did_you_mean, escaped = did_you_mean, escaped  -- functions of the program, hidden from scenes

local function millimetres(x) return string.format("%g mm", math.floor(x * 1e5 + 0.5) / 100) end

local function is_finite(x) return x == x and x ~= math.huge and x ~= -math.huge end
local function is_vec(v)
  if type(v) ~= "table" or #v ~= 3 then return false end
  for i = 1, 3 do if type(v[i]) ~= "number" or not is_finite(v[i]) then return false end end
  return true
end

local read  -- read(what, given, keys, mistakes) -> a table with the defaults filled in

local function read_value(what, key, value, mistakes)
  local function wrong(...) mistakes[#mistakes + 1] = string.format("%s: %s ", what, key.name) .. string.format(...) end
  local kind = math.type(value) == "integer" and "integer" or type(value)
  if key.type == "number" or key.type == "integer" then
    if type(value) ~= "number" then return wrong("must be a number, not a %s", kind) end
    if not is_finite(value) then return wrong("is no finite number (0/0 or 1/0?); give one") end
    if key.type == "integer" and (value ~= math.floor(value) or math.abs(value) > 1e9) then
      return wrong("= %g must be a whole number, at most 1e9", value)
    end
    if key.above and not (value > key.above) then
      return wrong("= %g must be above %g%s", value, key.above, key.unit and " " .. key.unit or "")
    end
    if (key.low and not (value >= key.low)) or (key.high and not (value <= key.high)) then
      local low = key.low or key.above
      return wrong("= %g is out of range; allowed: %s", value, key.high and low .. " to " .. key.high or low .. " or more")
    end
  elseif key.type == "vec" then
    if not is_vec(value) then return wrong("must be three finite numbers {x, y, z}") end
  elseif key.type ~= "any" and key.type ~= kind then
    return wrong("must be a %s, not a %s", key.type, kind)
  end
  if kind == "string" and (#value > 1000 or escaped(value) ~= value) then
    return wrong("holds control characters or bytes that are no UTF-8, or is longer than 1000: \"%s\"; write it in plain letters",
      escaped(value):sub(1, 60))
  end
  local allowed = not key.choice
  for _, choice in ipairs(key.choice or {}) do allowed = allowed or value == choice end
  if not allowed then
    return wrong("= \"%s\" is not known; allowed: %s", value, table.concat(key.choice, ", "))
  end
  if key.type == "integer" then return math.tointeger(value) end  -- -D gives a float even for a whole number
  if key.keys then return read(what .. "." .. key.name, value, key.keys, mistakes) end
  if key.list then
    local all = {}
    for i, item in ipairs(value) do all[i] = read(string.format("%s.%s[%d]", what, key.name, i), item, key.list, mistakes) end
    return all
  end
  return value
end

function read(what, given, keys, mistakes)
  if type(given) ~= "table" then
    mistakes[#mistakes + 1] = string.format("%s: must be a table of named keys, not a %s", what, type(given))
    return {}
  end
  local out, known, names = {}, {}, {}
  for i, key in ipairs(keys) do known[key.name], names[i] = key, key.name end
  local strange = {}
  for name in pairs(given) do
    if not known[name] then strange[#strange + 1] = escaped(tostring(name)) end
  end
  table.sort(strange)
  local meant = {}  -- keys that a misspelt key stands for: not reported as missing
  for _, name in ipairs(strange) do
    local advice = did_you_mean(name, names)
    mistakes[#mistakes + 1] = string.format("%s: unknown key \"%s\"%s", what, name, advice)
    meant[advice:match('^; did you mean "(.*)"%?$') or ""] = true
  end
  for _, key in ipairs(keys) do
    local value = given[key.name]
    if value == nil then value = key.default end
    if value ~= nil then
      out[key.name] = read_value(what, key, value, mistakes)
    elseif key.required and not meant[key.name] then
      mistakes[#mistakes + 1] = string.format("%s: %s is missing (%s%s); add %s = ...", what, key.name, key.unit and key.unit .. "; " or "", key.help, key.name)
    end
  end
  return out
end

-- Ends the call with all mistakes found so far; `public` in masonry.lua reports them at the user's line.
local function stop_if(mistakes)
  if #mistakes > 0 then error({ masonry = table.concat(mistakes, "\n") }, 0) end
end

local function fail(...) stop_if { string.format(...) } end

masonry_parts = { read = read, stop_if = stop_if, fail = fail, did_you_mean = did_you_mean, millimetres = millimetres, eps = 1e-7 }
