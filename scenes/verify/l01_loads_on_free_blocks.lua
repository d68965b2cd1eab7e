-- Every function that moves a block, against an integral on paper
--
-- What happens   Cubes of 1 kg float far apart without weight. Each is pushed by one kind of wave at any phase, or rotated, moved or
--                thrown. After one second its velocity is the impulse over its mass.
-- Source         v = int F dt / m; a cube of side a rotates with the inertia m a^2 / 6.
-- How to run     erbs run scenes/verify/l01_loads_on_free_blocks.lua
-- What to look at  metrics.json: one metric per function.
-- Tolerance      1e-9: the mean of each force over a step is exact. While the force still changes, the recorded velocity errs by F' dt^2 /
--                (8 m). A Lua function is sampled every millisecond: 2e-6 m/s for 3 t^2. The midpoint rule rotates by the share (w dt)^2 /
--                12 too little: 6.7e-7 of 2 rad.
label("quick")
material { name = "unit", density = 1000 }
gravity(0)
analysis { duration = 1, dt = 1 * ms, output_dt = 0.1, start = "rest" }

local count = 0
local function cube(name, initial)
  count = count + 1
  return box { name = name, size = { 0.1, 0.1, 0.1 }, center = { 0, 50 * count, 0 }, free = true, initial = initial }
end
local function last(name, unit, column, value, tolerance)
  metric(name, unit, function(run) return run.last(column) end)
  expect("metrics." .. name, value, { abs = tolerance, source = "integral on paper" })
end

local w, phase = 2 * pi * 3, 60 * deg
local function pushed(name, wave, v, tolerance)
  force { block = cube(name), wave = wave, direction = "x" }
  recorder { name = name, quantity = "velocity", block = name, axis = "x", frame = "abs" }
  last(name, "m/s", name .. "_vx_abs_m_s", v, tolerance or 1e-9)
end
pushed("constant", 2, 2)
pushed("sine", sine { amplitude = 2, frequency = 3, phase = phase, start = 0.1, duration = 0.2 },
  2 / w * (math.cos(phase) - math.cos(phase + 0.2 * w)))
pushed("half_sine", half_sine { amplitude = 2, frequency = 3, phase = phase, start = 0.1 }, 2 / w * (math.cos(phase) + 1))
pushed("full_sine", full_sine { amplitude = 2, frequency = 3, phase = phase }, 2 / w * (math.cos(phase) - 1))
pushed("pulse", pulse { amplitude = 2, start = 0.1234567, duration = 0.0654321 }, 2 * 0.0654321)  -- edges inside a step
pushed("table_wave", table_wave { times = { 0, 0.25, 0.5 }, values = { 0, 4, 2 } }, 0.5 + 0.75)
pushed("table_held", table_wave { times = { 0, 0.25, 0.5 }, values = { 0, 4, 2 }, hold = true }, 0.5 + 0.75 + 1)
pushed("of_time", function(t) return 3 * t * t end, 1, 2e-6)

moment { block = cube("turned"), wave = pulse { amplitude = 0.01, start = 0.1, duration = 0.2 }, direction = "z" }
recorder { name = "turned", quantity = "spin", block = "turned", axis = "z" }
last("moment", "rad/s", "turned_wz_rad_s", 0.01 * 0.2 / (0.1 ^ 2 / 6), 1e-12)

motion { block = cube("driven"), wave = sine { amplitude = 20 * mm, frequency = 2, phase = 90 * deg }, direction = { 0, 3, 4 } }
recorder { name = "driven", quantity = "displacement", block = "driven" }
last("motion_x", "m", "driven_ux_rel_m", 0, 1e-12)
last("motion_y", "m", "driven_uy_rel_m", 12 * mm, 1e-12)
last("motion_z", "m", "driven_uz_rel_m", 16 * mm, 1e-12)

cube("thrown", { position = { 0.1, 0, 0 }, rotation = { 0, 0, 0.3 }, velocity = { 1, 0, 0 }, spin = { 0, 0, 2 } })
for _, quantity in ipairs { "displacement", "rotation" } do recorder { name = "thrown", quantity = quantity, block = "thrown" } end
last("initial_place", "m", "thrown_ux_rel_m", 1.1, 1e-9)
last("initial_angle", "rad", "thrown_rz_rad", 2.3, 7e-7)
expect("energy.residual_relative", 1e-9, { below = true })
