-- V05: flat blocks on inclined planes stick below the angle of friction and slide above it.
--
-- What happens   Several coefficients of friction, each on three planes: 0.02 degrees below atan(mu), 0.02 above, and steeper by `steeper`.
--                Below, the block stays. Just above, it slides off with g cos b (tan b - mu). On the steep plane it slides s = g (sin b -
--                mu cos b) t^2 / 2, a metre or more.
-- Source         Coulomb; the blocks are thin, so they slide and do not topple.
-- How to run     erbs run scenes/verify/v05_incline.lua [-D size=...] [-D kn=...] [-D steeper=10*deg] [-D way=2]
-- What to look at  slip_<mu>_below, _above, _steep: metres, and over the formula.
label("quick")
local size = param("size", 0.3, "longer side of the blocks [m]")
local kn = param("kn", 2e9, "[Pa/m]")
local steeper = param("steeper", 6 * deg, "of the third plane, over the angle of friction [rad]")
local margin = param("margin", 0.02 * deg, "of the planes just below and above [rad]")
local way = param("way", 1.05, "slid on the steep planes [m]")
local density = param("density", 1800, "[kg/m3]")
if steeper <= 0 or math.atan(0.9) + steeper >= pi / 2 then error("steeper must be above 0 and below 48 degrees: the third plane of the roughest blocks", 0) end

local cases, number = {}, 0
local function plane(name, mu, angle, kind, until_)
  number = number + 1
  local block, slope, height = "block_" .. name, "slope_" .. name, size / 10
  material { name = "stone" .. number, density = density, friction = mu, kn = kn, ks = 0.4 * kn }
  -- x runs down the slope: rotated by +angle about y.
  transform { at = { 0, 1.5 * size * number, 0 }, rotation = { 0, angle, 0 }, function()
    box { name = slope, group = slope, material = "stone" .. number, size = { 2 * size + 1.5 * way, size, 0.1 }, at = { -size, -size / 2, -0.1 }, fixed = true }
    box { name = block, group = block, material = "stone" .. number, size = { size, 0.6 * size, height }, at = { -size / 2, -0.3 * size, 0 } }
  end }
  joint { law = dry { kn = kn, ks = 0.4 * kn, mu = mu }, between = { slope, block } }
  recorder { name = name, quantity = "displacement", block = block }
  recorder { name = name, quantity = "velocity", block = block }
  local a = math.max(0, g * (math.sin(angle) - mu * math.cos(angle)))
  -- Slip along the slope from t = 0 to row i.
  local function slip(run, i)
    local s, x, z = 0, run.history(name .. "_ux_rel_m"), run.history(name .. "_uz_rel_m")
    s = (x[i] - x[1]) * math.cos(angle) - (z[i] - z[1]) * math.sin(angle)
    return s
  end
  local function last_row(run)
    for i, time in ipairs(run.time) do if time > until_ then return i - 1 end end
    return #run.time
  end
  metric("slip_" .. name, "m", function(run) return slip(run, last_row(run)) end)
  if kind == "steep" then
    metric("slip_over_formula_" .. name, "", function(run)
      local i = last_row(run)
      return slip(run, i) / (a * run.time[i] ^ 2 / 2)
    end)
  end
  return a
end
local steep = {}
local duration = 0
for _, mu in ipairs { 0.3, 0.6, 0.9 } do
  local a = g * (math.sin(math.atan(mu) + steeper) - mu * math.cos(math.atan(mu) + steeper))
  duration = math.max(duration, math.sqrt(2 * way / a))
end
for _, mu in ipairs { 0.3, 0.6, 0.9 } do
  local tag, b = string.format("%d", math.floor(100 * mu + 0.5)), math.atan(mu)
  plane(tag .. "_below", mu, b - margin, "below", duration)
  local a = plane(tag .. "_above", mu, b + margin, "above", duration)
  local steep = plane(tag .. "_steep", mu, b + steeper, "steep", duration)
  -- Below: only the elastic deformation of the bed (W sin b / (ks A), about 1e-7 m).
  expect("metrics.slip_" .. tag .. "_below", 0, { abs = 1e-5 * size, source = "tan b < mu: sticks" })
  -- Above by 0.02 degrees: at least half the slip of the formula, so the threshold lies within 0.02 degrees.
  expect("metrics.slip_" .. tag .. "_above", 0.5 * a * duration ^ 2 / 2, { above = true, source = "tan b > mu: slides" })
  -- 0.1 %: the vibration of the bed from the start, and events within a step.
  expect("metrics.slip_over_formula_" .. tag .. "_steep", 1, { abs = 1e-3, source = "g (sin b - mu cos b) t^2 / 2" })
end
-- The planes just above have no equilibrium: gravity grows in a damped ramp, then clock and velocities start from zero.
analysis { duration = duration, start = "ramp", output_dt = duration / 100, dt_fraction = 0.5 }
