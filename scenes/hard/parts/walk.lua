-- How fast a block walks when nothing shakes it any more. Returns its speed (m/s) between the last two of three neighbouring windows (s),
-- and whether it comes to rest: less than half as fast as between the first two. Means have Hann weights, so that vibrations cancel out.
return function(run, name, window)
  local times, now, before = run.time, 0, 0
  local last = times[#times]
  for _, axis in ipairs { "x", "y", "z" } do
    local u, middle = run.history(name .. "_u" .. axis .. "_rel_m"), {}
    for k = 1, 3 do
      local from, sum, weights = last - (4 - k) * window, 0, 0
      for i = 1, #times do
        if times[i] >= from and times[i] <= from + window then
          local weight = math.sin(pi * (times[i] - from) / window) ^ 2
          sum, weights = sum + weight * u[i], weights + weight
        end
      end
      middle[k] = sum / weights
    end
    now, before = now + (middle[3] - middle[2]) ^ 2, before + (middle[2] - middle[1]) ^ 2
  end
  return math.sqrt(now) / window, now < 0.25 * before
end
