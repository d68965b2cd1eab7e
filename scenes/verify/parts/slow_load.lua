-- The ground acceleration grows slowly to `lambda` g and stays: a horizontal load on every block in proportion to its mass. It grows over
-- `grow` seconds, smoothly at both ends; then `hold` seconds show whether a block moves away by `moved` (m).
return function(keys)
  local times, values, grow, n = {}, {}, keys.grow or 1, 20
  for i = 0, n do
    local x = i / n
    times[i + 1], values[i + 1] = grow * x, keys.lambda * g * x * x * (3 - 2 * x)
  end
  ground_motion { wave = table_wave { times = times, values = values, hold = true }, direction = keys.direction or "x" }
  analysis { duration = grow + (keys.hold or 2), output_dt = 0.01, frame_dt = 0.05, dt_fraction = keys.dt_fraction, stop_when_moved = keys.moved,
    -- 1 %: little energy passes through a slowly loaded structure, and the residual is relative to it.
    energy_gate = 1e-2 }
end
