-- How fast a block walks while nothing shakes it any more: the speed (m/s) of its mean place between the last two of three neighbouring windows (s).
-- And whether it only swings, or has nearly stopped: its swing dwindles from window to window and is more than twenty times as wide as the mean moves
-- in one, or the mean moves less than half as far as between the first two. What creeps does neither. Means are weighted as Hann did, so that
-- a swing cancels out of them.
local function walk(run, name, window)
  local times, now, before, swing, swung = run.time, 0, 0, 0, 0
  local last = times[#times]
  for _, axis in ipairs { "x", "y", "z" } do
    local u, middle, range = run.history(name .. "_u" .. axis .. "_rel_m"), {}, {}
    for k = 1, 3 do
      local from, sum, weights, low, high = last - (4 - k) * window, 0, 0, math.huge, -math.huge
      for i = 1, #times do
        if times[i] >= from and times[i] <= from + window then
          local weight = math.sin(pi * (times[i] - from) / window) ^ 2
          sum, weights, low, high = sum + weight * u[i], weights + weight, math.min(low, u[i]), math.max(high, u[i])
        end
      end
      middle[k], range[k] = sum / weights, high - low
    end
    now, before = now + (middle[3] - middle[2]) ^ 2, before + (middle[2] - middle[1]) ^ 2
    swing, swung = swing + range[3] ^ 2, swung + range[2] ^ 2
  end
  return math.sqrt(now) / window, now < 0.25 * before or (swing < swung and 400 * now < swing)
end

-- Speed (m/s) of the one of these blocks that walks fastest: `of_all`, or of those that neither swing nor have nearly stopped.
return function(run, names, window, of_all)
  local most = 0
  for _, name in ipairs(names) do
    local speed, stops = walk(run, name, window)
    if of_all or not stops then most = math.max(most, speed) end
  end
  return most
end
