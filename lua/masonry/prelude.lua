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
-- in rising order, then strings in alphabetical order, then the other keys in Lua's order.
local raw_next, sort, type, getmetatable = next, table.sort, type, getmetatable

local function before(a, b)
  local x, y = type(a), type(b)
  if x ~= y then return x == "number" or (x == "string" and y ~= "number") end
  return a < b
end

function pairs(container)
  local meta = getmetatable(container)
  if type(meta) == "table" and meta.__pairs then return meta.__pairs(container) end
  local keys, rest, n, last = {}, {}, 0, nil
  for key in raw_next, container do
    if type(key) == "number" or type(key) == "string" then
      n = n + 1
      keys[n] = key
    else
      rest[#rest + 1] = key
    end
  end
  sort(keys, before)
  for i = 1, #rest do keys[n + i] = rest[i] end
  local i = 0
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
