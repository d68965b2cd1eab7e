-- V59: one capacity by four ways: push, tilting, control of the displacement, and an acceleration of the ground that grows slowly.
--
-- What happens   A column, an arch and a wall pushed out of its plane are each brought to their capacity in four ways. On the way "ramp" the
--                ground accelerates to .9 of the capacity on paper, then by .3 % of it a second; the capacity is the acceleration at which
--                the top has moved by some millimetres since then: by then the structure has left equilibrium a second or two ago.
-- Source         V37, V40, V43 of this book: b / h; four hinges (parts/arch_hinges.lua); thickness over height.
-- How to run     erbs run scenes/verify/v59_four_ways.lua [-D case=4]
-- What to look at  NAME_least and NAME_most: capacities over the one on paper, within 1 % of each other.
local hinges = include "parts/arch_hinges.lua"
local number = param("case", 1, "4 (structure - 1) + way: 1 push, 2 tilting, 3 control of the displacement, 4 ramp")
local rate = param("rate", 0.003, "of the ramp, over the capacity on paper [1/s]")
local kn = param("kn", 1e11, "of all joints, stiff: hinges are pressed in by little [Pa/m]")

local function stone(mu)
  material { name = "stone", density = 2000, kn = kn, ks = 0.4 * kn, friction = mu }
  joint { law = dry { kn = kn, ks = 0.4 * kn, mu = mu } }
end
local function floor() box { name = "floor", size = { 10, 10, 0.5 }, at = { -5, -5, -0.5 }, fixed = true } end
local structures = {
  { name = "column", paper = 0.2, least = 0.962, axis = "x", monitor = "column.b10", far = 5 * mm, build = function()
      stone(0.7); floor()
      column { name = "column", blocks = 10, size = { 1, 1, 0.5 } }
    end },
  { name = "arch", paper = hinges.multiplier(7, 0.15, 157.5 * deg), least = 0.943, axis = "x", monitor = "arch.v04", far = 3 * mm, build = function()
      stone(3)
      arch { name = "arch", radius = 10, thickness = 1.5, width = 1, voussoirs = 7, embrace = 157.5 * deg }
    end },
  { name = "wall", paper = 0.2 / (6 * 0.175), least = 0.959, axis = "y", monitor = "wall.c06.b02", far = 0.8 * mm, build = function()
      stone(0.65); floor()
      wall { brick = { length = 0.4, width = 0.2, height = 0.175 }, length = 1.2, courses = 6, joint = 0, closer = 0.1, at = { -0.6, -0.1, 0 },
        material = "stone", quiet = true }
    end },
}
local c, way = structures[(number - 1) // 4 + 1], (number - 1) % 4 + 1
c.build()
metric("on_paper", "", c.paper)

local slow = 5  -- s, at which the slow part begins
local function ramp()
  local times, values, steps = {}, {}, 25
  for i = 0, steps do
    local x = i / steps
    times[i + 1], values[i + 1] = slow * x, -0.9 * c.paper * g * x * x * (3 - 2 * x)
  end
  times[#times + 1], values[#values + 1] = slow + 0.12 / rate, -1.02 * c.paper * g
  ground_motion { wave = table_wave { times = times, values = values, hold = true }, direction = c.axis }
  recorder { name = "top", quantity = "displacement", blocks = { c.monitor }, axis = c.axis }
  analysis { duration = slow + 0.12 / rate, output_dt = 0.01, frame_dt = 5, stop_when_moved = 5 * c.far }
end
if way == 4 then ramp()
else
  analysis { kind = way == 2 and "tilt" or "pushover", direction = c.axis, bracket = 0.002, monitor = { block = c.monitor },
    control = way == 3 and "displacement" or nil, displacement = way == 3 and 2 * c.far or nil }
end

local function capacity(run)
  if way ~= 4 then return run.capacity.multiplier / c.paper end
  local column = "top"
  for _, name in ipairs(run.columns) do if name:find("top", 1, true) then column = name end end
  local start, history = run.at(column, slow), run.history(column)
  for i, t in ipairs(run.time) do
    if t > slow and history[i] - start > c.far then return 0.9 + rate * (t - slow) end
  end
  error("the top has not moved by " .. c.far .. " m")
end
metric("capacity_over_paper", "", capacity)
for i, one in ipairs(structures) do
  local values = {}
  for k = 1, 4 do values[k] = 4 * (i - 1) + k end
  converge { param = "case", name = one.name, values = values, value = capacity }
  -- Joints of this stiffness press the hinges in: the same in each way.
  local one_percent = { between = { one.least, one.least + 0.01 }, source = "four ways to one capacity; hinges pressed in" }
  expect("metrics." .. one.name .. "_least", one.least, one_percent)
  expect("metrics." .. one.name .. "_most", one.least, one_percent)
end
