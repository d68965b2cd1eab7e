-- Hard case 23: meaning of an accelerogram between its samples, at its end, and scaled to a model.
--
-- What happens   A record is linear in acceleration between its samples, so velocity is piecewise quadratic and displacement piecewise
--                cubic. Both are integrated in closed form, whatever the step. A heavy free block stays behind while the ground moves: its
--                path relative to the ground is minus the ground displacement. A record scaled to a model of half the size (time times
--                0.707, displacement times 0.5) is compared with the full record at scaled instants.
-- Source         closed-form integrals of a polyline; similarity t ~ sqrt(L), u ~ L at equal acceleration.
-- How to run     erbs run scenes/hard/h23_accelerogram.lua [-D scale=0.25] [-D dt=0.003]
-- What to look at  ground_*_error, block_error, similarity_error; velocity_end and displacement_end are reported, not corrected.
label("quick", "fixed_dt")
local scale = param("scale", 0.5, "of length, of the model")
local dt = param("dt", 1.7 * ms, "no divisor of the record's step [s]")
local duration = param("duration", 10, "[s]")
gravity(0)
material { name = "stone", density = 2000 }
-- A polyline record with a kink at every sample: a sum of sines without a common period, sampled at 0.02 s.
local times, values = {}, {}
for i = 0, math.floor(0.8 * duration / 0.02) do
  local time = 0.02 * i
  times[#times + 1] = time
  values[#values + 1] = i == 0 and 0 or 2 * math.sin(7.3 * time) * math.exp(-0.2 * time) + 1.1 * math.sin(31.7 * time + 1) + (i % 3 - 1) * 0.8
end
values[#values] = 0
local function exact(time)  -- v and u of the ground, piece by piece
  local v, u = 0, 0
  for i = 2, #times do
    local t0, t1 = times[i - 1], math.min(times[i], time)
    if time <= t0 then return v, u end
    local s, slope = t1 - t0, (values[i] - values[i - 1]) / (times[i] - times[i - 1])
    u = u + v * s + values[i - 1] * s ^ 2 / 2 + slope * s ^ 3 / 6
    v = v + values[i - 1] * s + slope * s ^ 2 / 2
  end
  return v, u + v * math.max(0, time - times[#times])
end
ground_motion { wave = table_wave { times = times, values = values }, direction = "x" }
-- The true record, full along y and scaled along z: two directions of one scene. Its end values are those of the file.
local full = record { file = "../records/elcentro_1940_ns.csv" }
local small = record { file = "../records/elcentro_1940_ns.csv", time_factor = math.sqrt(scale) }
ground_motion { wave = full, direction = "y" }
ground_motion { wave = small, direction = "z" }
box { name = "block", size = { 1, 1, 1 }, center = { 0, 0, 0 }, free = true }
recorder { name = "block", quantity = "displacement", block = "block" }
recorder { name = "ground", quantity = "ground_velocity" }
recorder { name = "ground", quantity = "ground_displacement" }
analysis { duration = duration, dt = dt, start = "rest", output_dt = 10 * ms, frame_dt = 1 }

local function columns(run, stem, unit, axis) return run.history(stem .. axis .. unit) end
metric("ground_velocity_error", "", function(run)
  local v, worst, largest = columns(run, "ground_v", "_m_s", "x"), 0, 0
  for i, time in ipairs(run.time) do
    local wanted = exact(time)
    worst, largest = math.max(worst, math.abs(v[i] - wanted)), math.max(largest, math.abs(wanted))
  end
  return worst / largest
end)
metric("ground_displacement_error", "", function(run)
  local u, worst, largest = columns(run, "ground_u", "_m", "x"), 0, 0
  for i, time in ipairs(run.time) do
    local _, wanted = exact(time)
    worst, largest = math.max(worst, math.abs(u[i] - wanted)), math.max(largest, math.abs(wanted))
  end
  return worst / largest
end)
metric("block_error", "", function(run)  -- leapfrog takes the exact mean of the acceleration: its error falls with dt^2 and does not depend on the kinks
  local worst, largest = 0, 0
  for _, axis in ipairs { "x", "y", "z" } do
    local ground, block = columns(run, "ground_u", "_m", axis), columns(run, "block_u", "_rel_m", axis)
    for i = 1, #ground do
      worst, largest = math.max(worst, math.abs(ground[i] + block[i])), math.max(largest, math.abs(ground[i]))
    end
  end
  return worst / largest
end)
metric("similarity_error", "", function(run)  -- u of the scaled record at t is `scale` times that of the full record at t / sqrt(scale)
  local worst, largest = 0, 0
  local u = columns(run, "ground_u", "_m", "z")
  for i, time in ipairs(run.time) do
    local at = time / math.sqrt(scale)
    if at < duration then
      local wanted = scale * run.at("ground_uy_m", at)
      worst, largest = math.max(worst, math.abs(u[i] - wanted)), math.max(largest, math.abs(wanted))
    end
  end
  return worst / largest
end)
metric("velocity_end", "m/s", function(run) return run.last("ground_vy_m_s") end)
metric("displacement_end", "m", function(run) return run.last("ground_uy_m") end)
expect("metrics.ground_velocity_error", 1e-12, { below = true, source = "piecewise quadratic" })
expect("metrics.ground_displacement_error", 1e-12, { below = true, source = "piecewise cubic" })
-- The slope jumps every 0.02 s. The error of the path is at most the change of acceleration times dt^2 / 8, for displacements of
-- decimetres.
expect("metrics.block_error", 2e-5, { below = true, source = "impulses are exact, paths to dt^2" })
-- Rows of the full record, 10 ms apart, are read by straight lines: a dt^2 / 8 = 4e-5 m, for displacements of decimetres.
expect("metrics.similarity_error", 1e-3, { below = true, source = "u ~ L, t ~ sqrt(L)" })
expect("energy.residual_relative", 1e-9, { below = true, source = "the ground's work on a rigid body" })
