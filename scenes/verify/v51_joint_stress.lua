-- V51: normal and shear stress of joints, intact and cracked, as the recorder gives them.
--
-- What happens   Columns stand under their own weight. Blocks carry N at an eccentricity e, within the core and beyond it, on mortar and on
--                dry beds. Blocks rest on slopes below their angle of friction. Everything is at rest from the start.
-- Source         sigma = -rho g z; N/A +- 6 N e / (b h^2) while closed, -2 N / (3 b (h/2 - e)) at the edge once open (no tension, Navier);
--                -rho g t cos a and rho g t sin a under a slab of thickness t on a slope.
-- How to run     erbs run scenes/verify/v51_joint_stress.lua [-D side=...] [-D kn=...] [-D rule=1]
-- What to look at  own_weight_*, edge_*, mean_*, slope_*: recorded over paper.
label("quick")
local H, B = param("side", 0.5, "h, side along the eccentricity [m]"), param("width", 0.3, "b, the other side [m]")
local kn, height = param("kn", 1e11, "[Pa/m]"), param("height", 0.2, "of the blocks [m]")
local courses, density = param("courses", 6, "of the columns"), param("density", 2000, "[kg/m3]")
local rule = param("rule", 1, "1: simpson, 2: gauss; points along a side: 3")
family({ kn = { 1e10, 1e12 }, side = { 0.2, 2 }, height = { 0.05, 1 }, courses = { 1, 20 }, rule = { 1, 2 } }, { combinations = 6 })
local rules = { "simpson", "gauss" }
gravity(10)
material { name = "stone", density = density }
local unit = density * 10  -- Pa/m
local beds = {
  mortar = mortar { kn = kn, ks = 0.4 * kn, ft = 2 * MPa, c = 2 * MPa, mu = 0.6 },  -- stays intact
  weak = mortar { kn = kn, ks = 0.4 * kn, ft = 0, c = 0, mu = 0.9 },
  dry = dry { kn = kn, ks = 0.4 * kn, mu = 0.9 },
}
local function bed(law, a, b) joint { law = beds[law], between = { a, b }, rule = rules[rule], points = { 3, 3 } } end
local function stress(name, a, b)
  recorder { name = name, quantity = "normal_stress", blocks = { a }, others = { b } }
  recorder { name = name, quantity = "shear_stress", blocks = { b }, others = { a } }
end
local function ratio(name, column, paper, tolerance, source)
  metric(name, "", function(run) return run.first(column) / paper end)
  expect("metrics." .. name, 1, { abs = tolerance, source = source })
end
-- Springs are stiff: their settlement over the size of the blocks is the error of the small-displacement joint.
local settled = 10 * unit * height * courses / kn / math.min(H, B)

local place = 0
for _, law in ipairs { "mortar", "weak", "dry" } do
  place = place + 1
  local below = "ground_" .. law
  box { name = below, group = below, size = { H, B, 0.1 }, at = { 2 * H * place, 0, -0.1 }, fixed = true }
  for i = 1, courses do
    local name = string.format("%s_%d", law, i)
    box { name = name, group = name, size = { H, B, height }, at = { 2 * H * place, 0, (i - 1) * height } }
    bed(law, below, name)
    stress(name, below, name)
    local paper = -unit * (courses - i + 1) * height
    for _, what in ipairs { "mean", "min", "max" } do
      ratio("own_weight_" .. name .. "_" .. what, name .. "_normal_stress_" .. what .. "_Pa", paper, 1e-6 + settled, "rho g z")
    end
    below = name
  end
end

local load = unit * height * H * B
for _, law in ipairs { "mortar", "weak", "dry" } do
  for i, e in ipairs { 0.05, 0.15, 0.25, 0.35, 0.42 } do
    place = place + 1
    local name = string.format("%s_e%d", law, i)
    local base = "base_" .. name
    box { name = base, group = base, size = { H, B, 0.1 }, at = { 2 * H * place, 0, -0.1 }, fixed = true }
    box { name = name, group = name, size = { H, B, height }, at = { 2 * H * place, 0, 0 } }
    moment { block = name, wave = load * e * H, direction = "y" }
    bed(law, base, name)
    stress(name, base, name)
    local mean, bend = -load / (B * H), 6 * load * e * H / (B * H ^ 2)
    local open = law ~= "mortar" and e > 1 / 6
    local least = open and -2 * load / (3 * B * (H / 2 - e * H)) or mean - bend
    -- The weight moves sideways by theta h / 2, which adds to e; the edge of an open bed grows with 1 / (1/2 - e).
    local theta = open and -least / kn / (3 * (0.5 - e) * H) or bend / kn / (H / 2)
    local shift = theta * height / 2 / H
    local tolerance = 1e-6 + settled + 10 * shift / (0.5 - e)
    ratio("mean_" .. name, name .. "_normal_stress_mean_Pa", mean, 1e-6 + settled, "N / A")
    ratio("edge_" .. name, name .. "_normal_stress_min_Pa", open and least or mean - bend, tolerance,
      open and "2 N / (3 b (h/2 - e))" or "N / A + 6 N e / (b h^2)")
    if open then
      metric("other_edge_" .. name, "Pa", function(run) return run.first(name .. "_normal_stress_max_Pa") end)
      expect("metrics.other_edge_" .. name, 0, { abs = 1e-9, source = "an open bed pulls nowhere" })
    else
      ratio("other_edge_" .. name, name .. "_normal_stress_max_Pa", mean + bend, tolerance * bend / math.abs(mean + bend) + tolerance,
        "N / A - 6 N e / (b h^2)")
    end
  end
end

local thick = height / 10  -- the overturning moment of the shear is small: the mean is what counts
for i, angle in ipairs { 5 * deg, 20 * deg, 35 * deg } do
  for _, law in ipairs { "mortar", "dry" } do
    place = place + 1
    local name = string.format("%s_slope%d", law, i)
    local base = "base_" .. name
    transform { at = { 2 * H * place, 0, 0 }, rotation = { 0, angle, 0 }, function()
      box { name = base, group = base, size = { H, B, 0.1 }, at = { 0, 0, -0.1 }, fixed = true }
      box { name = name, group = name, size = { H, B, thick }, at = { 0, 0, 0 } }
    end }
    bed(law, base, name)
    stress(name, base, name)
    ratio("slope_normal_" .. name, name .. "_normal_stress_mean_Pa", -unit * thick * math.cos(angle), 1e-6 + settled, "rho g t cos a")
    ratio("slope_shear_" .. name, name .. "_shear_stress_mean_Pa", unit * thick * math.sin(angle), 1e-6 + settled, "rho g t sin a")
  end
end
analysis { duration = 4e-3, start = "equilibrium", output_dt = 4e-3, frame_dt = 4e-3, frame_stress = true }
expect("energy.residual_relative", 1e-4, { below = true })
