-- A block, two stacked blocks or a column of drums under one pulse of the ground, for pulse_columns.lua and safe_island.lua
--
-- What happens   n equal blocks stand dry on each other, the lowest on two narrow feet; or round drums, on their whole rims. The ground moves by
--                one pulse. They fall, or rock and slide back to rest.
-- Source         Makris and Roussos 2000 and Zhang and Makris 2001 for the pulses and the axes; Psycharis 1990 for two blocks; Mavroeidis and
--                Papageorgiou 2003 for the near-fault pulse. Feet and stiffness as in scenes/verify/parts/rocking_block.lua, which says why.
-- How to run     erbs run scenes/studies/pulse_column.lua -D n=3 [-D sides=16] -D pulse='"ricker"' -D omega=3 -D amplitude=2
-- What to look at  metrics.overturned (1: it fell); metrics.theory: 1 if one rigid block of the outline falls, by its exact equation
local n = param("n", 1, "blocks, one on the other")
local sides = param("sides", 0, "of round drums, prisms whose corners lie on the circle; 0: square blocks")
local pulse = param("pulse", "full_sine", "half_sine, full_sine, full_cosine, ricker, or mp_pulse: gamma 1.5, phase 0")
local width, height = param("width", 0.4, "[m]"), param("height", 1.2, "of all blocks together [m]")
local omega = param("omega", 2, "circular frequency of the pulse over p of the whole [-]")
local amplitude = param("amplitude", 2, "peak acceleration over g tan(alpha) of the whole [-]")
local settlement = param("settlement", 1e-5, "of the full base under the weight, over half the width [-]")

local b, density, foot, hollow, each = width / 2, 2500, 0.008 * width, 1e-3 * height, height / n
local kn = density * g * height / (settlement * b)
material { name = "stone", density = density, kn = kn, ks = 0.4 * kn, friction = n == 1 and 2 or 0.7, restitution = 0.24 }
box { name = "base", material = "stone", fixed = true, size = { 6 * height, 1.5 * width, height / 2 }, at = { -3 * height, -0.75 * width, -height / 2 } }
local function part(x0, x1, z0, z1)
  local v = {}
  for _, x in ipairs { x0, x1 } do
    for _, y in ipairs { -b, b } do
      for _, z in ipairs { z0, z1 } do v[#v + 1] = { x, y, z } end
    end
  end
  return { vertices = v }
end
if sides > 0 then
  local polygon = {}
  for i = 1, sides do  -- a side faces +x and, of an even number, one -x
    polygon[i] = { b * math.cos(2 * pi * (i - 0.5) / sides), b * math.sin(2 * pi * (i - 0.5) / sides) }
  end
  for i = 1, n do prism { name = "block" .. i, material = "stone", free = true, polygon = polygon, height = each, at = { 0, 0, (i - 1) * each } } end
else
  block { name = "block1", material = "stone", free = true,
    parts = { part(-b, -b + foot, 0, hollow), part(b - foot, b, 0, hollow), part(-b, b, hollow, each) } }
  for i = 2, n do
    box { name = "block" .. i, material = "stone", free = true, size = { width, width, each }, at = { -b, -b, (i - 1) * each } }
  end
end

local alpha = math.atan(width / height)
local p = math.sqrt(3 * g / (2 * math.sqrt(width ^ 2 + height ^ 2)))
local frequency = omega * p / (2 * pi)
local makes = { half_sine = half_sine, full_sine = full_sine, full_cosine = full_cosine, ricker = ricker, mp_pulse = mp_pulse }
local make = makes[pulse] or error("pulse must be half_sine, full_sine, full_cosine, ricker or mp_pulse, not " .. pulse, 0)
local keys = { amplitude = 1, frequency = frequency }
if pulse == "mp_pulse" then keys.gamma = 1.5 end
local lasts = ({ half_sine = 0.5, full_sine = 1, full_cosine = 1, ricker = 12 / pi, mp_pulse = 1.5 })[pulse] / frequency
local unit, peak = make(keys), 0
for i = 0, 2000 do peak = math.max(peak, math.abs(unit(lasts * i / 2000 * 0.999999))) end
keys.amplitude = amplitude * g * math.tan(alpha) / peak
local wave = make(keys)
ground_motion { wave = wave, direction = "x" }
analysis { duration = lasts + 8 / p, start = "rest", output_dt = 1e-2, frame_dt = 10, stop_after_collapse = 0.01 }
metric("overturned", "", function(run) return run.collapse.collapsed and 1 or 0 end)
metric("theory", "", function()
  return rocking { width = width, height = height, wave = wave, duration = lasts + 8 / p }.overturned and 1 or 0
end)
