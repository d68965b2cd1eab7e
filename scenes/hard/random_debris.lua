-- Hard case: random bodies that fall, collide, spin and pile up
--
-- What happens   A seed draws up to 24 bodies - bricks, plates, rods, wedges, prisms, frusta, tetrahedra, angles of two parts - of sizes up
--                to 1:6 and of two materials. They are poured on the ground or a shaken one, thrown at each other without gravity, let
--                slide down a slope against a wall, spun on the ground, or fall as fragments that mortar holds together.
-- Source         No paper is needed. Energy is neither created nor lost; friction and dashpots only take energy; momentum is conserved;
--                bodies do not pass through each other or the ground; what friction can hold comes to rest.
-- How to run     erbs run scenes/hard/random_debris.lua -D seed=17 [-D kind=2] [-D wait=6]
--                erbs test scenes/hard/random_debris.lua --seeds 500
-- What to look at  residual (of the ledger, over 1e-3), taken (least energy taken by friction, cracks and dashpots, over what passed), reset
--                (the same, of contacts made anew), sunk (depth of a body under the ground over its size), speed (m/s, median of the bodies
--                at the end; -1 where they may go on), max_penetration_relative, momentum_residual
local seed = param("seed", 1, "of the draw")
local kind = param("kind", 0, "1 poured, 2 poured on a shaken ground, 3 thrown without gravity, 4 slope and wall, 5 spinning, 6 fragments; 0: drawn")
local wait = param("wait", 4, "after the last body was to land [s]")
local kn_given = param("kn", 0, "0: drawn [Pa/m]")
local most = param("most", 24, "bodies")

local draw = include "parts/draw.lua" (seed)
local uniform, log_uniform, whole, chance = draw.uniform, draw.log_uniform, draw.whole, draw.chance
local function direction()
  local z, a = uniform(-1, 1), uniform(0, 2 * pi)
  local r = math.sqrt(1 - z * z)
  return { r * math.cos(a), r * math.sin(a), z }
end
local function times(a, v) return { a * v[1], a * v[2], a * v[3] } end
local function cross(a, b) return { a[2] * b[3] - a[3] * b[2], a[3] * b[1] - a[1] * b[3], a[1] * b[2] - a[2] * b[1] } end
local function plus(a, b) return { a[1] + b[1], a[2] + b[2], a[3] + b[3] } end

local drawn = whole(1, 6)
if kind == 0 then kind = drawn end
local falls = kind ~= 3
local kn = log_uniform(5e9, 1e12)
if kn_given > 0 then kn = kn_given end
local mu = chance(0.1) and 0 or uniform(0.1, 1.2)
for _, name in ipairs { "light", "heavy" } do
  material { name = name, density = name == "light" and uniform(800, 2000) or uniform(2000, 3000), friction = mu,
    restitution = chance(0.15) and 0 or uniform(0, 0.8), kn = kn * uniform(0.5, 1), ks = 0.4 * kn }
end
local function stone() return chance(0.5) and "light" or "heavy" end

local names, starts, sizes, up = {}, {}, {}, { 0, 0, 1 }  -- of the bodies; up: out of the ground
-- A body of size up to `l` about the origin: `place` has its displacement, rotation and initial motion.
local function body(l, place)
  local name = "b" .. #names + 1
  names[#names + 1], starts[name], sizes[name] = name, place.at, l
  local common = { name = name, free = true, material = stone(), rotation = place.rotation, initial = place.initial }
  local function with(keys)
    for k, v in pairs(common) do keys[k] = v end
    return keys
  end
  local a, b, c = l, l * uniform(0.4, 1), l * uniform(0.3, 0.6)
  local shape = whole(1, 8)
  if shape == 1 then box(with { size = { a, b, c }, center = place.at })
  elseif shape == 2 then box(with { size = { a, b, a * uniform(0.1, 0.2) }, center = place.at })
  elseif shape == 3 then box(with { size = { a, a * uniform(0.12, 0.25), a * uniform(0.12, 0.25) }, center = place.at })
  elseif shape == 4 then prism(with { polygon = { { -a / 2, -b / 2 }, { a / 2, -b / 2 }, { -a / 2, b / 2 } }, height = c, at = place.at })
  elseif shape == 5 then
    local corners, polygon = whole(3, 8), {}
    for k = 1, corners do
      local angle = 2 * pi * (k + uniform(-0.2, 0.2)) / corners
      polygon[k] = { a / 2 * math.cos(angle), a / 2 * math.sin(angle) }
    end
    prism(with { polygon = polygon, height = c, at = place.at })
  elseif shape == 6 then
    local top, vertices = uniform(0.3, 0.9), {}
    for _, z in ipairs { -1, 1 } do
      for _, y in ipairs { -1, 1 } do
        for _, x in ipairs { -1, 1 } do
          local share = z > 0 and top or 1
          vertices[#vertices + 1] = plus(place.at, { share * x * a / 2, share * y * b / 2, z * c / 2 })
        end
      end
    end
    block(with { vertices = vertices })
  elseif shape == 7 then
    local vertices = {}
    for k, at in ipairs { { 1, 1, 1 }, { 1, -1, -1 }, { -1, 1, -1 }, { -1, -1, 1 } } do
      vertices[k] = plus(place.at, times(0.3 * l * uniform(0.8, 1.2), at))
    end
    block(with { vertices = vertices })
  else  -- an angle of two parts
    local thick, parts = a * uniform(0.2, 0.4), {}
    for k, size in ipairs { { a, b, thick }, { thick, b, a } } do
      parts[k] = { vertices = {} }
      local low = k == 1 and { -a / 2, -b / 2, -a / 2 } or { -a / 2, -b / 2, -a / 2 + thick }
      local high = k == 1 and { a / 2, b / 2, -a / 2 + thick } or { -a / 2 + thick, b / 2, a / 2 }
      for i = 0, 7 do
        parts[k].vertices[i + 1] = plus(place.at, { i % 2 == 0 and low[1] or high[1], i // 2 % 2 == 0 and low[2] or high[2], i // 4 == 0 and low[3] or high[3] })
      end
    end
    block(with { parts = parts })
  end
  recorder { name = name, quantity = "displacement", block = name }
  recorder { name = name, quantity = "velocity", block = name }
end

local base, n, ends = 0.12 * log_uniform(0.4, 5), whole(1, most), 0
local function size() return base * log_uniform(1, 6) / 2 end
local function any_rotation() return times(uniform(0, pi), direction()) end
-- Places of a lattice that leaves room for the largest body.
local pitch, per = 3.2 * base * 1.8, math.ceil(n ^ (1 / 3))
local function lattice(k) return { (k % per - per / 2) * pitch, (k // per % per - per / 2) * pitch, pitch * (0.8 + k // (per * per)) } end
local function floor(angle)
  if not angle then return ground { size = 400, material = "heavy" } end
end

if kind <= 2 then
  floor()
  for k = 0, n - 1 do
    body(size(), { at = lattice(k), rotation = any_rotation(),
      initial = { velocity = times(uniform(0, 3), direction()), spin = times(log_uniform(0.1, 20), direction()) } })
  end
  ends = math.sqrt(2 * (per + 1) * pitch / g) + 0.5
  if kind == 2 then
    local frequency = log_uniform(1, 10)
    ground_motion { wave = sine { amplitude = uniform(0.1, 1.5) * g, frequency = frequency, duration = math.ceil(ends * frequency) / frequency },
      direction = direction() }
    ends = math.ceil(ends * frequency) / frequency
  end
elseif kind == 3 then
  local speed = log_uniform(0.2, 20)
  for k = 0, n - 1 do
    local at = plus(lattice(k), { 0, 0, -pitch * (0.8 + per / 2) })
    local far = math.sqrt(at[1] ^ 2 + at[2] ^ 2 + at[3] ^ 2) + 1e-9
    body(size(), { at = at, rotation = any_rotation(), initial = { velocity = plus(times(-speed * uniform(0.5, 1) / far, at), times(0.2 * speed, direction())),
      spin = times(uniform(0, speed / base), direction()) } })
  end
  ends, wait = 3 * per * pitch / speed, 0
elseif kind == 4 then
  local angle = uniform(0.1, 0.9)
  up = { math.sin(angle), 0, math.cos(angle) }
  transform { rotation = { 0, angle, 0 }, function()
    box { name = "slope", size = { 40 * pitch + 20, 400, 1 }, center = { 0, 0, -0.5 }, fixed = true, material = "heavy" }
    box { name = "wall", size = { 1, 400, 6 * per * pitch + 20 }, center = { (2 * per + 1) * pitch, 0, 3 * per * pitch + 9 }, fixed = true, material = "heavy" }
    for k = 0, n - 1 do body(size(), { at = lattice(k), rotation = any_rotation(), initial = { spin = times(log_uniform(0.1, 5), direction()) } }) end
  end }
  ends = 2.5
elseif kind == 5 then
  n = math.min(n, 4)
  floor()
  for k = 0, n - 1 do
    local l = size()
    body(l, { at = { 12 * k * base, 0, l * uniform(0.9, 1.6) }, rotation = any_rotation(), initial = { spin = times(log_uniform(5, 200), direction()),
      velocity = { uniform(-2, 2), 0, uniform(-3, 0) } } })
  end
  ends = 2
else
  floor()
  n = math.max(1, n // 8)
  local l, w, h = base * 2, base, base * uniform(0.5, 0.9)
  local ft = log_uniform(1e4, 1e6)
  local softer = seed % 3 == 0 and 0.1 * kn or 0  -- once the bond is gone
  for f = 1, n do
    local courses, bricks = whole(2, 4), whole(1, 3)
    local spin, velocity = times(log_uniform(0.1, 5), direction()), { uniform(-2, 2), uniform(-2, 2), uniform(-6, 0) }
    local height, across = 5 * base * uniform(1, 2), math.sqrt((bricks * l) ^ 2 + (courses * h) ^ 2)
    transform { at = { (f - (n + 1) / 2) * 16 * base, 0, height }, rotation = any_rotation(), function()
      for c = 1, courses do
        for i = 1, bricks do
          local name = "b" .. #names + 1
          names[#names + 1] = name
          starts[name], sizes[name] = { 0, 0, height }, across  -- of the fragment's centre
          local center = { (i - (bricks + 1) / 2 + c % 2 / 2) * l, 0, (c - (courses + 1) / 2) * h }
          box { name = name, group = "f" .. f, free = true, size = { l, w, h }, center = center, material = "heavy",
            initial = { velocity = plus(velocity, cross(spin, center)), spin = spin } }
          recorder { name = name, quantity = "displacement", block = name }
          recorder { name = name, quantity = "velocity", block = name }
        end
      end
    end }
    joint { between = { "f" .. f, "f" .. f }, law = mortar { kn = kn, ks = 0.4 * kn, ft = ft, c = 1.5 * ft, mu = 0.6, Gf1 = chance(0.5) and 0 or ft ^ 2 / kn * uniform(1, 5), kn_cracked = softer, ks_cracked = 0.4 * softer } }
  end
  ends = 2
end
gravity(falls and g or 0)

metric("kind", "", kind)
metric("kn", "Pa/m", kn)
metric("friction", "", mu)
metric("bodies", "", #names)
metric("residual", "", function(run) return run.energy.residual_relative / 1e-3 end)
local function passed(run)
  local e = run.energy
  return math.abs(e.base_work_J) + math.abs(e.gravity_J) + math.abs(e.friction_J) + math.abs(e.damping_J) + math.abs(e.contact_damping_J) + 1e-12
end
metric("taken", "", function(run)
  local e = run.energy
  return math.min(e.friction_J, e.contact_damping_J, e.fracture_J) / passed(run)
end)
metric("reset", "", function(run) return math.abs(run.energy.reset_J) / passed(run) end)
local function speeds(run)
  local of = {}
  for i, name in ipairs(names) do
    local square = 0
    for _, axis in ipairs { "x", "y", "z" } do square = square + run.last(name .. "_v" .. axis .. "_rel_m_s") ^ 2 end
    of[i] = math.sqrt(square)
  end
  table.sort(of)
  return of
end
-- On a slope, without friction, or spun, bodies may go on for longer than the run.
local rests = (kind <= 2 or kind == 6) and mu > 0.15
-- Of a body that has passed through the ground: its depth over its size. On the slope the place at the start is in the axes of the slope.
local function sunk(run)
  local deepest = 0
  for _, name in ipairs(names) do
    local rise = run.last(name .. "_ux_rel_m") * up[1] + run.last(name .. "_uz_rel_m") * up[3]
    deepest = math.max(deepest, -(starts[name][3] + rise) / sizes[name])
  end
  return falls and deepest or 0
end
metric("sunk", "", sunk)
metric("speed", "m/s", function(run) return rests and speeds(run)[(#names + 1) // 2] or -1 end)
metric("fastest", "m/s", function(run) return speeds(run)[#names] end)
analysis { duration = ends + wait, start = "rest", output_dt = (ends + wait) / 400, frame_dt = 10 }
expect("status", "completed")
expect("metrics.residual", 1, { below = true, source = "a blow leaves at most 1e-3" })
expect("metrics.taken", -1e-4, { above = true, source = "friction, cracks and dashpots take" })
expect("metrics.reset", 2e-3, { below = true, source = "what contacts lose when they are made anew" })
expect("metrics.speed", 1e-3, { below = true, source = "what friction holds comes to rest" })
expect("metrics.sunk", 1, { below = true, source = "no body passes through the ground" })
expect("max_penetration_relative", 0.5, { below = true, source = "of the thinner body: the inner distance turns over at half" })
expect("momentum_residual", 1e-8, { below = true, source = "action and reaction" })
