-- Hard case: a poured pile comes to rest
--
-- What happens   200 bricks fall from heights of up to several metres, hit each other, slide and come to rest. A heap shows errors that
--                single bricks hide: normals that switch, friction without memory, dashpots that pump energy. After ten seconds the heap is
--                still, from each of three starts.
-- Source         hard case 26; contact law: potential of the inner distance, friction of the patch, impact law of Hunt and Crossley
-- How to run     erbs run scenes/hard/h26_poured_pile.lua [-D seed=2] [-D pours=0: this start alone]
-- What to look at  median_speed (m/s), height_loss (loss of potential energy over the last second, over what is left),
--                max_penetration_relative, energy.residual_relative; pours_most: the worst of these over its limit, in the other starts
local seed = param("seed", 1, "of the pour")
local pours = param("pours", start_noise > 0 and 0 or 2, "other starts; noise makes one by itself")
local n = param("bricks", 200, "")
local duration = param("duration", 10, "[s]")
local kn = param("kn", 5e9, "[Pa/m]")
local fraction = param("fraction", 0.9, "of the step's bound")
local size = { 0.3, 0.125, 0.1 }
local state = seed * 7919 + 17
local function random()
  state = (state * 1103515245 + 12345) % 2147483648
  return state / 2147483648
end
gravity(g)
material { name = "brick", density = 1800, kn = kn, ks = 0.4 * kn, friction = 0.6, restitution = 0.2 }
ground { size = 60, material = "brick" }
local names, per = {}, 3
for k = 0, n - 1 do
  local i, j, layer = k % (per * per) // per, k % per, k // (per * per)
  local name = "b" .. k + 1
  names[#names + 1] = name
  box { name = name, free = true, size = size, center = { 0.36 * i + 0.03 * random(), 0.36 * j + 0.03 * random(), 0.25 + 0.36 * layer },
    initial = { rotation = { 3 * random(), 3 * random(), 3 * random() }, velocity = { 0.3 * (random() - 0.5), 0.3 * (random() - 0.5), -1 } } }
  recorder { name = name, quantity = "velocity", block = name }
end
local function median_speed(run)
  local speeds = {}
  for _, name in ipairs(names) do
    local square = 0
    for _, axis in ipairs { "x", "y", "z" } do square = square + run.last(name .. "_v" .. axis .. "_rel_m_s") ^ 2 end
    speeds[#speeds + 1] = math.sqrt(square)
  end
  table.sort(speeds)
  return speeds[(n + 1) // 2]
end
recorder { name = "all", quantity = "displacement", blocks = names, axis = "z" }
local function height_loss(run)  -- over the potential energy left, per second
  local fallen = run.at("all_uz_rel_m", duration) - run.at("all_uz_rel_m", duration - 1)
  return -fallen / (0.25 + 0.36 * (n / (per * per) - 1) / 2 + run.last("all_uz_rel_m"))
end
metric("median_speed", "m/s", median_speed)
metric("height_loss", "", height_loss)
analysis { duration = duration, dt_fraction = fraction, start = "rest", output_dt = 0.1, frame_dt = duration / 4 }
expect("metrics.median_speed", 1e-5, { below = true, source = "at rest" })
expect("metrics.height_loss", 1e-6, { below = true, source = "at rest" })
expect("max_penetration_relative", 0.25, { below = true, source = "of the thinner body: the inner distance turns over at half" })
expect("energy.residual_relative", 1e-2, { below = true, source = "gate" })
if pours > 0 then
  ensemble { n = pours, seed = 1, name = "pours", value = function(run)
    return math.max(median_speed(run) / 1e-5, height_loss(run) / 1e-6, run.max_penetration_relative / 0.25, run.energy.residual_relative / 1e-2)
  end }
  expect("metrics.pours_failed", 0, { abs = 0, source = "every pour ends" })
  expect("metrics.pours_most", 1, { below = true, source = "all of the above from other starts" })
end
