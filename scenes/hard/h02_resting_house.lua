-- Hard case: a brick house rests on its mortar, neither shaken nor damped, and must not move.
--
-- What happens   Ten seconds under its own weight, from static equilibrium. An unbalanced force, a lost history, a jump at an update of the
--                reference, or energy pumped in by the steps would all show as drift. The house is small by default; full = 1 is the house
--                of scenes/shake_table_house.lua.
-- How to run     erbs run scenes/hard/h02_resting_house.lua [-D full=1] [-D duration=60]
-- What to look at  drift_per_second (over the smallest edge), reaction_error, joints_broken, tremor.
label("quick")
local full = param("full", 0, "1: the whole three-storey house")
local duration = param("duration", 10, "[s]")
local density, slab_density = param("density", 1800, "bricks [kg/m3]"), param("slab_density", 2400, "slabs and lintels [kg/m3]")
local t = 5 * mm

material { name = "brick", density = density }
material { name = "concrete", density = slab_density }
ground { size = 20, material = "concrete" }
local whole = full == 1
local E = param("E", whole and 1.07e10 or 2e9, "of the mortar; the small house takes a softer one for a longer step [Pa]")
local width, length = whole and 1525 * mm or 1220 * mm, whole and 1830 * mm or 1525 * mm
local opening = { width = 450 * mm, height = whole and 635 * mm or 315 * mm, sill = whole and 420 * mm or 105 * mm }
local house = building {
  plan = { width, length },
  at = { -width / 2, -length / 2, 0 },
  storeys = whole and 3 or 1,
  courses = whole and 13 or 6,
  brick = { length = 300 * mm, width = 125 * mm, height = 100 * mm },
  material = "brick",
  joint = t,
  closer = 40 * mm,
  slab = { thickness = 50 * mm, material = "concrete" },
  lintel = { bearing = 100 * mm, material = "concrete" },
  openings = {
    { wall = "south", name = "window", centre = width / 2, width = opening.width, sill = opening.sill, height = opening.height },
    { wall = "east", name = "window", centre = length / 2, width = opening.width, sill = opening.sill, height = opening.height },
  },
}
joint { law = mortar { E = E, nu = 0.2, thickness = t, ft = 0.2 * MPa, c = 0.3 * MPa, mu = 0.6 }, thickness = t, tolerance = 8 * mm }
analysis { duration = duration, start = "equilibrium", output_dt = duration / 20, frame_dt = duration }

local weight = g * (house.report.brick_volume * density + (house.report.lintel_volume + house.report.slab_volume) * slab_density)
local top = house.slabs[#house.slabs]
recorder { name = "base", quantity = "reaction" }
recorder { name = "top", quantity = "displacement", block = top }
recorder { name = "top", quantity = "rotation", block = top }
recorder { name = "bricks", quantity = "velocity", blocks = house.blocks }
metric("drift_per_second", "1/s", function(run)
  local largest = 0
  for _, axis in ipairs { "x", "y", "z" } do
    largest = math.max(largest, math.abs(run.last("top_u" .. axis .. "_rel_m") - run.first("top_u" .. axis .. "_rel_m")))
  end
  return largest / (100 * mm) / duration
end)
metric("reaction_error", "", function(run)
  local worst = 0
  for _, force in ipairs(run.history("base_fz_N")) do worst = math.max(worst, math.abs(-force / weight - 1)) end
  return worst
end)
metric("sideways_reaction", "", function(run) return math.max(run.peak("base_fx_N"), run.peak("base_fy_N")) / weight end)
metric("tremor", "m/s", function(run) return run.peak("bricks_vz_rel_m_s") end)
-- The static start leaves 1e-11 of the load, and the house vibrates within that. Noise in the start displaces every half bed by sqrt(2/3)
-- of the noise (root mean square of a difference), with random signs. The n half beds of the lowest course then swing by kn A sqrt(n) times
-- that; twenty rows never show five times as much. Any growth would exceed this bound within ten seconds.
local half_bed = 150 * mm * 125 * mm
local beds = 2 * (width + length) * 125 * mm / half_bed
local swing = 5 * math.sqrt(2 / 3 * beds) * start_noise * E / t * half_bed / weight
expect("metrics.drift_per_second", 1e-6, { below = true, source = "at rest" })
expect("metrics.reaction_error", 1e-6 + swing, { below = true, source = "reaction = weight" })
expect("metrics.sideways_reaction", 1e-6 + swing, { below = true, source = "no load sideways" })
expect("joints_broken", 0, { abs = 0, source = "stresses are a tenth of the strengths" })
expect("energy.residual_relative", 1e-6, { below = true, source = "elastic gate" })
expect("collapse.collapsed", false)
