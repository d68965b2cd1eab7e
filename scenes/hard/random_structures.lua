-- Hard case: small random structures, shaken once and then left alone
--
-- What happens   A seed draws a stack on a slope, a pier, an arch, a corbel, a wall or a portal of up to 60 blocks, dry or in mortar that
--                may crack. A bump or a few cycles of the base shake it in any direction. After that nothing acts on the structure.
-- Source         No paper is needed. Energy is neither created nor lost; friction and dashpots only take energy; blocks do not sink into
--                each other; momentum is conserved; a structure that neither fell nor still rocks has come to rest.
-- How to run     erbs run scenes/hard/random_structures.lua -D seed=17 [-D kind=3] [-D duration=5]
--                erbs test scenes/hard/random_structures.lua --seeds 500
-- What to look at  drift (m/s, of the fastest block that does not come to rest, without vibration; -1 if blocks fell or still rock), made
--                (final energy over the largest supply by base and gravity), taken (least energy taken by friction, cracks, dashpots and
--                contacts made anew), reset, max_penetration_relative, energy.residual_relative.
-- Measure        "Still rocks": the widest joint opens and closes by more than 20 um within a quarter of a second, in the last two thirds
--                of the wait. "Comes to rest": in the last third of the wait a block walks less than half as fast as in the third before.
local seed = param("seed", 1, "of the draw")
local kind = param("kind", 0, "1 stack, 2 pier, 3 arch, 4 corbel, 5 wall, 6 portal; 0: drawn")
local wait = param("wait", 12, "after the shaking [s]")
local kn_given = param("kn", 0, "0: drawn [Pa/m]")
local still = 20e-6  -- m
local drift_most = 1e-5  -- m/s

local draw = include "parts/draw.lua" (seed)
local uniform, log_uniform, whole, chance = draw.uniform, draw.log_uniform, draw.whole, draw.chance

local drawn = whole(1, 6)
if kind == 0 then kind = drawn end
local kn = log_uniform(1e9, 1e12)
if kn_given > 0 then kn = kn_given end
local mu = uniform(0.3, 1)
local density = uniform(1600, 2600)
material { name = "brick", density = density, friction = mu, kn = math.min(kn, 5e10), ks = 0.4 * math.min(kn, 5e10) }

local built = include "parts/structures.lua" (draw, kind, mu)
local blocks, height, volume, slope = built.blocks, built.height, built.volume, built.slope

-- Mortar that a bump may crack: its strength is of the order of the stresses in the structure.
local cracks = chance(0.3)
local bed
if cracks then
  local ft = density * g * height * log_uniform(0.1, 3)
  local brittle = chance(0.5)
  bed = { kn = kn, ks = 0.4 * kn, ft = ft, c = ft * uniform(1, 2), mu = mu, Gf1 = brittle and 0 or ft ^ 2 / kn * uniform(1, 5), Gf2 = brittle and 0 or 4 * ft ^ 2 / kn * uniform(1, 5) }
end

local heading, up, over = uniform(0, 2 * pi), uniform(-1, 1), nil
if chance(0.5) then  -- a bump in any direction
  local flat = math.sqrt(1 - up ^ 2)
  local frequency = log_uniform(4, 25)
  over = 0.05 + 0.5 / frequency
  ground_motion { wave = half_sine { amplitude = uniform(0.3, 1.6) * g, frequency = frequency, start = 0.05 }, direction = { flat * math.cos(heading), flat * math.sin(heading), up } }
else
  local frequency, cycles = log_uniform(4, 15), whole(1, 3)
  over = 0.05 + cycles / frequency
  ground_motion { wave = sine { amplitude = uniform(0.1, 0.8) * g, frequency = frequency, start = 0.05, duration = cycles / frequency }, direction = { math.cos(heading), math.sin(heading), 0.3 * up } }
end
local start = chance(0.15) and "rest" or chance(0.15) and "ramp" or "equilibrium"
if cracks and chance(0.4) then  -- softer once the bond is gone
  bed.kn_cracked = kn * log_uniform(0.02, 1)
  bed.ks_cracked = 0.4 * (chance(0.5) and bed.kn_cracked or kn * log_uniform(0.02, 1))
end
joint { law = cracks and mortar(bed) or dry { kn = kn, mu = mu } }

for _, name in ipairs(blocks) do recorder { name = name, quantity = "displacement", block = name } end
recorder { name = "all", quantity = "opening", blocks = blocks }
local function after(t, times)
  for i, value in ipairs(times) do if value >= t then return i end end
end
local function fell(run) return run.collapse.collapsed or run.collapse.fallen_fraction > 0 end
metric("fell", "", function(run) return fell(run) and 1 or 0 end)
local function swing(run)  -- of the widest joint, within any quarter of a second of the time in which blocks are checked for walking
  local opening, times, most = run.history "all_opening_m", run.time, 0
  local from = after(times[#times] - 2 / 3 * wait, times)
  while from <= #times do
    local least, widest, till = math.huge, -math.huge, times[from] + 0.25
    while from <= #times and times[from] < till do
      least, widest, from = math.min(least, opening[from]), math.max(widest, opening[from]), from + 1
    end
    most = math.max(most, widest - least)
  end
  return most
end
metric("swing", "m", swing)
local drift = include "parts/walk.lua"
metric("drift_any", "m/s", function(run) return drift(run, blocks, wait / 3, true) end)
metric("drift", "m/s", function(run) return (fell(run) or swing(run) > still) and -1 or drift(run, blocks, wait / 3) end)
local function passed(run)
  local e = run.energy
  return math.abs(e.base_work_J) + math.abs(e.gravity_J) + math.abs(e.friction_J) + math.abs(e.damping_J) + math.abs(e.contact_damping_J) + 1e-12
end
metric("reset", "", function(run) return math.abs(run.energy.reset_J) / passed(run) end)
-- Relative to the energy that passed, at least to the energy that lifts all blocks by a thousandth of the height. At a start in equilibrium
-- the elastic energy stored by then makes `made` smaller than it is.
local lifted = 1e-3 * volume * density * g * height
metric("made", "", function(run)
  local e = run.energy
  local left = e.kinetic_J + e.gravity_J + e.elastic_J + e.friction_J + e.fracture_J + e.crushing_J + e.damping_J + e.contact_damping_J + e.reset_J
  return (left - e.base_work_J) / math.max(lifted, math.abs(e.base_work_J) + math.abs(e.gravity_J) + math.abs(e.kinetic_J))
end)
metric("taken", "", function(run)
  local e = run.energy
  return math.min(e.friction_J, e.damping_J, e.contact_damping_J, e.fracture_J) / passed(run)
end)
metric("residual", "", function(run) return run.energy.residual_relative / (fell(run) and 1e-2 or 1e-3) end)
metric("kind", "", kind)
metric("slope", "rad", slope)
metric("blocks", "", #blocks)
metric("kn", "Pa/m", kn)
metric("mortar", "", cracks and 1 or 0)
analysis { duration = over + wait, start = start, output_dt = 2e-3, frame_dt = 10 }
expect("status", "completed")
expect("metrics.residual", 1, { below = true, source = "of 1e-3, of 1e-2 once blocks fell" })
expect("metrics.drift", drift_most, { below = true, source = "what has come to rest stays" })
expect("metrics.made", 1e-2, { below = true, source = "not more than what base and gravity gave" })
expect("metrics.reset", 2e-3, { below = true, source = "what contacts lose when they are made anew" })
expect("metrics.taken", -1e-4, { above = true, source = "friction, cracks and dashpots take" })
expect("max_penetration_relative", 0.1, { below = true, source = "a brick on kn = 1e9 Pa/m sinks in by .06 of its height as it falls flat from 1 m" })
expect("momentum_residual", 1e-8, { below = true, source = "action and reaction, with sound joints on poses up to lazy_rotation = 1e-4 rad old: its square" })
