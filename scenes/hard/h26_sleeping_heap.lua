-- Hard case: a heap of bricks sleeps; a falling brick and a ground motion wake it
--
-- What happens   Bricks are poured and come to rest; with analysis{ sleep = true } they are then skipped by the step. A brick falls among
--                them when its tray is drawn away, and wakes the bricks that it moves. In the end the ground shakes, and no brick sleeps
--                while it does.
-- Source         hard case 26; engine/solve/contacts/sleep.h: a brick falls asleep below a speed of 1e-6 sqrt(g L) and an acceleration of 1e-4 g
-- How to run     erbs run scenes/hard/h26_sleeping_heap.lua [-D awake=1: without sleep] [-D bricks=100]
-- What to look at  asleep_* (share of bricks with a speed of exactly zero), apart_* (m, mean position of all bricks with sleep and
--                without), energy.sleep_J, energy.residual_relative, log.txt: mean number of sleeping bricks
local awake = param("awake", 0, "any other number: nothing sleeps")
local n = param("bricks", 30, "poured")
local drawn = param("drawn", 4, "[s] when the tray is drawn away")
local shaken = param("shaken", 5.2, "[s] when the ground begins to shake")
local duration = shaken + 0.5
local size, state = { 0.3, 0.125, 0.1 }, 4711
local function random()
  state = (state * 1103515245 + 12345) % 2147483648
  return state / 2147483648
end
gravity(g)
material { name = "brick", density = 1800, kn = 5e9, ks = 2e9, friction = 0.6, restitution = 0.2 }
material { name = "ice", density = 1800, kn = 5e9, ks = 2e9, friction = 0.02 }
ground { size = 60, material = "brick" }
local names = {}
for k = 0, n - 1 do
  local i, j, layer = k % 4 // 2, k % 2, k // 4
  local name = "b" .. k + 1
  names[#names + 1] = name
  box { name = name, material = "brick", free = true, size = size, center = { 0.36 * i + 0.03 * random(), 0.36 * j + 0.03 * random(), 0.25 + 0.36 * layer },
    initial = { rotation = { 3 * random(), 3 * random(), 3 * random() }, velocity = { 0.3 * (random() - 0.5), 0.3 * (random() - 0.5), -1 } } }
  recorder { name = name, quantity = "velocity", block = name }
end
recorder { name = "heap", quantity = "displacement", blocks = names }
local top = 0.25 + 0.36 * (n // 4 + 1)
box { name = "tray", material = "ice", free = true, size = { 0.5, 0.3, 0.02 }, center = { 0.2, 0.2, top } }
box { name = "late", material = "ice", free = true, size = size, center = { 0.2, 0.2, top + 0.06 } }
motion { block = "tray", direction = "y", wave = table_wave { times = { 0, drawn, drawn + 0.1, 99 }, values = { 0, 0, -1.5, -1.5 } } }
recorder { name = "late", quantity = "velocity", block = "late" }
recorder { name = "late_u", quantity = "displacement", block = "late", axis = "z" }
ground_motion { direction = "x", wave = sine { amplitude = 0.5 * g, frequency = 3, start = shaken, duration = 10 } }
analysis { duration = duration, start = "rest", sleep = awake == 0, output_dt = 0.02, frame_dt = duration / 10 }

local function asleep(run, t)
  local still = 0
  for _, name in ipairs(names) do
    local square = 0
    for _, axis in ipairs { "x", "y", "z" } do square = square + run.at(name .. "_v" .. axis .. "_rel_m_s", t) ^ 2 end
    if square == 0 then still = still + 1 end
  end
  return still / n
end
local function place(run, t)
  return run.at("heap_ux_rel_m", t) + run.at("heap_uy_rel_m", t) + run.at("heap_uz_rel_m", t)
end
local function late_speed(run, t) return -run.at("late_vz_rel_m_s", t) end
metric("asleep_first", "", function(run) return asleep(run, drawn - 0.1) end)
metric("asleep_again", "", function(run) return asleep(run, shaken - 0.04) end)
metric("asleep_shaken", "", function(run) return asleep(run, duration) end)
metric("late_before", "m/s", function(run) return late_speed(run, drawn - 0.02) end)
metric("late_falls", "m/s", function(run) return late_speed(run, drawn + 0.24) - late_speed(run, drawn + 0.14) end)
if start_noise == 0 then
  ensemble { n = 1, seed = 1, param = "awake", name = "lively", value = function(run) return place(run, drawn - 0.1) end }
  ensemble { n = 1, seed = 1, param = "awake", name = "lively_then", value = function(run) return place(run, drawn + 1) end }
end
if start_noise == 0 and awake == 0 then
  metric("apart_first", "m", function(run) return math.abs(place(run, drawn - 0.1) - run.metrics.metrics.lively_mean) end)
  metric("apart_then", "m", function(run) return math.abs(place(run, drawn + 1) - run.metrics.metrics.lively_then_mean) end)
end

expect("metrics.asleep_first", 0.3, { above = true, source = "those on which nothing creeps any more: of nine pours of 16 to 48 bricks 0.36 to 1, seven of them 0.7 or more" })
expect("metrics.asleep_again", 0, { above = true, source = "it wakes what it stirs, not all" })
expect("metrics.asleep_shaken", 0, { abs = 0, source = "none sleeps while the ground shakes" })
expect("metrics.late_before", 0, { abs = 0, source = "asleep on its tray" })
expect("metrics.late_falls", 0.1 * g, { rel = 1e-3, source = "free fall: g t, rows to a step" })
if start_noise == 0 and awake == 0 then
  expect("metrics.apart_first", 1.5e-6 * drawn, { below = true, source = "in each of three coordinates 1e-6 sqrt(g L), L = 0.1 m, for half of the time" })
  expect("metrics.apart_then", 1e-3, { below = true, source = "a hundredth of a brick: once the late brick has struck, chaos parts them; of ten pours by 3e-6 to 2.2e-4 m" })
end
expect("energy.sleep_J", (n + 1) * 6.75 * 1e-12 * shaken, { below = true, source = "m v^2 at the bound of speed, at most once a second for each brick" })
expect("energy.residual_relative", 1e-2, { below = true, source = "gate" })
