-- Hard case 24: a wall is tilted slowly, by rotating its base or gravity: quasi-static, with all the work in the ledger.
--
-- What happens   A bonded wall is tilted by five degrees at 0.15 degrees per second. A rotating base adds centripetal and Euler
--                accelerations; rotating gravity changes the potential of the weight. In both cases the kinetic energy must stay below 1e-4
--                of the change of potential energy. The reaction must equal the weight in the axes of the wall, and the ledger must close.
-- Source         equilibrium at each angle.
-- How to run     erbs run scenes/hard/h24_rotating_gravity_and_base.lua [-D gravity_turns=1] [-D rate=0.3*deg]
-- What to look at  kinetic_over_potential (grows with the square of the rate), reaction_error, energy.residual_relative, gravity_most (the
--                same with rotating gravity).
label("quick")
local turned = param("gravity_turns", 0, "above 0: gravity turns instead of the base")
local rate, angle = param("rate", 0.15 * deg, "mean [rad/s]"), param("angle", 5 * deg, "[rad]")
local courses, across = param("courses", 6, ""), 3
local E, t = param("E", 2e7, "of the mortar, soft for a long step [Pa]"), 10 * mm
local l, w, h, density = 0.3, 0.2, 0.2, 1800

material { name = "brick", density = density }
box { name = "base", group = "base", size = { 1.2, 0.6, 0.2 }, at = { -0.1, -0.2, -0.2 - t }, fixed = turned > 0 }
local mass, names = 0, {}
for c = 0, courses - 1 do
  for i = 0, across - 1 do
    local name = c .. "_" .. i
    box { name = name, group = "wall", size = { l, w, h }, at = { i * (l + t) + (c % 2) * 0.1, 0, c * (h + t) } }
    recorder { name = name, quantity = "velocity", block = name }
    names[#names + 1] = name
    mass = mass + density * l * w * h
  end
end
joint { law = mortar { E = E, nu = 0.2, thickness = t, ft = 1 * MPa, c = 1 * MPa, mu = 0.7 }, tolerance = 0.1 * mm }
-- The angle rises and ends smoothly: a polynomial of fifth degree with the mean rate `rate`.
local duration, times, values, back = angle / rate, {}, {}, {}
for i = 0, 400 do
  local s = i / 400
  times[i + 1], values[i + 1] = duration * s, angle * s ^ 3 * (10 - 15 * s + 6 * s ^ 2)
  back[i + 1] = -values[i + 1]
end
if turned > 0 then tilt { wave = table_wave { times = times, values = back, hold = true }, axis = "x" }
else turning { block = "base", wave = table_wave { times = times, values = values, hold = true }, axis = "x", about = { 0, 0, 0 } } end
recorder { name = "base", quantity = "reaction" }
analysis { duration = duration, output_dt = duration / 200, frame_dt = duration / 10 }
-- Change of potential energy: m g times the displacement of the centroid.
local high = courses * (h + t) / 2
local potential = mass * g * high * (1 - math.cos(angle)) + mass * g * w / 2 * math.sin(angle)
metric("kinetic_over_potential", "", function(run)
  local worst = 0
  for i = 1, #run.time do
    local sum = 0
    for _, name in ipairs(names) do
      for _, axis in ipairs { "x", "y", "z" } do sum = sum + run.history(name .. "_v" .. axis .. "_rel_m_s")[i] ^ 2 / 2 end
    end
    worst = math.max(worst, sum * density * l * w * h)
  end
  return worst / potential
end)
-- In world axes the rotated base carries the weight straight down; under rotating gravity the reaction is the rotated weight.
local function reaction_error(run)
  local fy, fz = run.last("base_fy_N"), run.last("base_fz_N")
  local b = turned > 0 and angle or 0
  return math.max(math.abs(fy + mass * g * math.sin(b)), math.abs(fz + mass * g * math.cos(b))) / (mass * g)
end
-- Remaining vibration at the end of the smooth ramp, and kn A times the noise in the start.
local allowed = 1e-4 + start_noise * across * E / t * l * w / (mass * g)
metric("reaction_error", "", reaction_error)
ensemble { n = 1, seed = 1, param = "gravity_turns", name = "gravity", value = function(run)
  return math.max(reaction_error(run) / allowed, run.energy.residual_relative / 1e-3)  -- the worse of both, over its tolerance
end }
expect("metrics.kinetic_over_potential", 1e-4, { below = true, source = "quasi-static" })
expect("metrics.reaction_error", allowed, { below = true, source = "weight in the wall's axes" })
expect("metrics.gravity_most", 1, { below = true, source = "the same with gravity turned: reaction and ledger as here" })
expect("energy.residual_relative", 1e-3, { below = true, source = "bonded gate" })
expect("joints_broken", 0, { abs = 0, source = "nothing cracks" })
