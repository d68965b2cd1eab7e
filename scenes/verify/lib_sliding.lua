-- Rigid sliding on paper: one block with Coulomb friction on a base, integrated from event to event. Included by other scenes.
--
-- sliding{ drive, limit, ends, steps } solves the relative motion x'' = -drive(t) with the friction limit `limit` (m/s2): stuck while
-- |drive| <= limit, otherwise x'' = -drive(t) + limit against the motion. Steps of 4th order between events; events by bisection. Returns {
-- largest, at_end, speed, stops = {times at which it comes to rest} }.
function sliding(o)
  local t, x, v, way = 0, 0, 0, 0  -- way: sign of the sliding, 0 when stuck
  local h = o.ends / (o.steps or 20000)
  local out = { largest = 0, speed = 0, stops = {}, at = {} }
  local next_ask = 1
  local function acceleration(time, s) return -o.drive(time) - s * o.limit end
  local function step(time, dt, s)  -- Simpson's rule: accurate enough for a smooth drive
    local a0, a1, a2 = acceleration(time, s), acceleration(time + dt / 2, s), acceleration(time + dt, s)
    return x + v * dt + dt * dt * (a0 + 2 * a1) / 6, v + dt * (a0 + 4 * a1 + a2) / 6
  end
  while t < o.ends - 1e-12 do
    local dt = math.min(h, o.ends - t)
    if way == 0 then
      if math.abs(o.drive(t + dt)) > o.limit then  -- slip starts within this step, where |drive| passes the limit
        local lo, hi = 0, dt
        if math.abs(o.drive(t)) > o.limit then hi = 0 end
        for _ = 1, 60 do
          if hi == 0 then break end
          local middle = (lo + hi) / 2
          if math.abs(o.drive(t + middle)) > o.limit then hi = middle else lo = middle end
        end
        t = t + hi
        way = o.drive(t + 1e-12) > 0 and -1 or 1
      else
        t = t + dt
      end
    else
      local x1, v1 = step(t, dt, way)
      if v1 * way < 0 then
        local lo, hi = 0, dt
        for _ = 1, 60 do
          local middle = (lo + hi) / 2
          local _, vm = step(t, middle, way)
          if vm * way < 0 then hi = middle else lo = middle end
        end
        x1, v1, dt = (step(t, hi, way)), 0, hi
        t = t + hi
        if math.abs(o.drive(t)) > o.limit then way = o.drive(t) > 0 and -1 or 1
        else way = 0 out.stops[#out.stops + 1] = t end
      else
        t = t + dt
      end
      x, v = x1, v1
      out.largest, out.speed = math.max(out.largest, math.abs(x)), math.max(out.speed, math.abs(v))
    end
  end
  out.at_end = x
  return out
end
