-- Units as factors to SI, and versions of xpcall and pairs that suit scenes.

m, cm, mm, km = 1, 1e-2, 1e-3, 1e3           -- m
s, ms = 1, 1e-3                              -- s
kg, t = 1, 1e3                               -- kg; t is the tonne
N, kN, MN = 1, 1e3, 1e6                      -- N
Pa, kPa, MPa, GPa = 1, 1e3, 1e6, 1e9         -- Pa
J, Hz = 1, 1                                 -- J, 1/s
pi, deg = math.pi, math.pi / 180             -- rad
g = 9.81                                     -- m/s2

-- Lua calls the handler of xpcall at the place of the error, where the time limit could no longer interrupt it. Here the handler is
-- called afterwards.
local pcall = pcall
local function finished(handler, sound, ...)
  if sound then return true, ... end
  return false, handler((...))
end
function xpcall(f, handler, ...) return finished(handler, pcall(f, ...)) end

-- Lua's own order of string keys differs from run to run, but a scene must be built the same way every time. Here numbers come first
-- in rising order, then strings in alphabetical order, then false and true, then the other keys in Lua's order.
local raw_next, rawget, sort, type, getmetatable, error = next, rawget, table.sort, type, getmetatable, error
local rank = { number = 1, string = 2, boolean = 3 }

local function before(a, b)
  local x, y = rank[type(a)] or 4, rank[type(b)] or 4
  if x ~= y then return x < y end
  if x == 3 then return b and not a end
  return x < 3 and a < b
end

local function sorted_keys(container)
  local keys, n = {}, 0
  for key in raw_next, container do
    n = n + 1
    keys[n] = key
  end
  sort(keys, before)
  return keys
end

function pairs(container)
  local meta = getmetatable(container)
  if type(meta) == "table" and meta.__pairs then return meta.__pairs(container) end
  local keys, i, last = sorted_keys(container), 0, nil
  return function()
    while true do
      i = i + 1
      last = keys[i]
      if last == nil then return nil end
      local value = container[last]
      if value ~= nil then return last, value end
    end
  end, container, nil
end

-- The order of a table is kept while next goes through it. Its first key alone needs no sorting, so that next(t) may ask whether t is
-- empty; it may be gone from the table when its successor is asked for.
local orders = setmetatable({}, { __mode = "k" })

local function order_of(container, key)
  local order = orders[container]
  if order and order.place[key] then return order end
  local keys = sorted_keys(container)
  if order and order.first == key and rawget(container, key) == nil then
    keys[#keys + 1] = key
    sort(keys, before)
  end
  order = { keys = keys, place = {} }
  for i = 1, #keys do order.place[keys[i]] = i end
  if not order.place[key] then error("next: this key is not in the table", 3) end
  orders[container] = order
  return order
end

function next(container, key)
  if key == nil then
    local first = raw_next(container)
    for other in raw_next, container do
      if before(other, first) then first = other end
    end
    orders[container] = first ~= nil and { first = first, place = {} } or nil
    if first == nil then return nil end
    return first, rawget(container, first)
  end
  local order = order_of(container, key)
  for i = order.place[key] + 1, #order.keys do
    local value = rawget(container, order.keys[i])
    if value ~= nil then return order.keys[i], value end
  end
  orders[container] = nil
  return nil
end
