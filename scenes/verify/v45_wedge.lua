-- V45: a smooth wedge rests between two faces.
--
-- What happens   Wedges of several half angles rest between two faces without friction. Each face carries W / (2 sin(half)).
-- Source         Statics: half = 45 degrees 0.70711 W.
-- How to run     erbs run scenes/verify/v45_wedge.lua [-D kn=...]
-- What to look at  left_*, right_*: normal force over W.
label("quick")
local kn = param("kn", 1e10, "[Pa/m]")
local density, d, length, cut = 2000, 0.2, 0.5, 0.2

material { name = "stone", density = density, kn = kn, ks = 0.4 * kn, friction = 0 }
joint { law = dry { kn = kn, ks = 0.4 * kn, mu = 0 } }
for i, degrees in ipairs { 45, 30, 60, 20 } do
  local half, x = degrees * deg, 2 * i
  local s, wedge = d * math.tan(half), "wedge_" .. degrees
  local weight = (1 - cut ^ 2) * s * d * length * density * g
  prism { name = wedge, axis = "x", height = length, at = { x, 0, 0 }, material = "stone", polygon = { { -cut * s, cut * d }, { cut * s, cut * d }, { s, d }, { -s, d } } }
  for side, way in pairs { [-1] = "left", [1] = "right" } do
    local name = way .. "_" .. degrees
    prism { name = name, axis = "x", height = 1.2 * length, at = { x - 0.1 * length, 0, 0 }, material = "stone", fixed = true,
      polygon = { { 0, -0.5 * d }, { side * 2 * s, -0.5 * d }, { side * 2 * s, 2 * d }, { 0, 0 } } }
    recorder { name = name, quantity = "normal_force", blocks = { wedge }, others = { name } }
    metric(name, "W", function(run) return math.abs(run.last(name .. "_normal_N")) / weight end)
    -- 1e-4: the wedge sinks in.
    expect("metrics." .. name, 1 / (2 * math.sin(half)), { rel = 1e-4, source = "W / (2 sin(half))" })
  end
end
analysis { duration = 0.05, output_dt = 0.01 }
