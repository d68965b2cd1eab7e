-- V45: a wedge in a groove, tilted along the groove, begins to slide.
--
-- What happens   A wedge lies in a groove whose faces are at `half` from the vertical. Gravity tilts slowly along the groove. Each face
--                carries W / (2 sin(half)), so the wedge slides as with a friction of mu / sin(half): at tan(slope) = mu / sin(half).
-- Source         Statics.
-- How to run     erbs run scenes/verify/v45_groove.lua [-D groove_30=1.01] [-D mu=0.4]
-- What to look at  groove_*_over_paper: tan(slope) found over that on paper.
local mu, kn = param("mu", 0.3, "of the grooves"), param("kn", 1e10, "[Pa/m]")
local density = 2000

-- A wedge of half angle `half`, point down, in a groove along x.
local function groove(half, friction, length)
  material { name = "stone", density = density, kn = kn, ks = 0.4 * kn, friction = friction }
  joint { law = dry { kn = kn, ks = 0.4 * kn, mu = friction } }
  local d = 0.2
  local s = d * math.tan(half)
  -- truncated at the point, so that it has no sharp edge
  local cut = 0.2
  prism { name = "wedge", axis = "x", height = length, at = { -length / 2, 0, 0 }, material = "stone", polygon = { { -cut * s, cut * d }, { cut * s, cut * d }, { s, d }, { -s, d } } }
  for side, name in pairs { [-1] = "left", [1] = "right" } do
    prism { name = name, axis = "x", height = 3 * length, at = { -1.5 * length, 0, 0 }, material = "stone", fixed = true,
      polygon = { { 0, -0.5 * d }, { side * 2 * s, -0.5 * d }, { side * 2 * s, 2 * d }, { 0, 0 } } }
  end
end
local cases = { { name = "groove_45", value = mu / math.sin(45 * deg), half = 45 * deg }, { name = "groove_30", value = mu / math.sin(30 * deg), half = 30 * deg }, { name = "groove_60", value = mu / math.sin(60 * deg), half = 60 * deg } }
for _, case in ipairs(cases) do
  case.lo, case.hi, case.rel, case.unit = 0.995, 1.005, 0.001, "tan"
  case.expect = { rel = 0.002, source = "mu / sin(half angle)" }  -- 0.2 %: a wedge that creeps at the threshold must move 2 mm in its time
  case.build = function(slope)
    groove(case.half, mu, 0.5)
    local times, values = {}, {}
    for i = 0, 20 do
      local x = i / 20
      times[i + 1], values[i + 1] = x, math.atan(slope) * x * x * (3 - 2 * x)
    end
    tilt { wave = table_wave { times = times, values = values, hold = true }, axis = "y" }
    analysis { duration = 3, output_dt = 0.02, frame_dt = 0.1, stop_when_moved = 0.002 }
  end
end
(include "parts/cases.lua")(cases)
