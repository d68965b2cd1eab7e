-- Hard case 3: a block on a slope, held by friction, is rotated by 360 degrees with the slope; its shear force must rotate with it.
--
-- What happens   Blocks lie on slopes below the angle of friction: one bonded with mortar, one on a dry joint, one on contact only. Every
--                slope rotates by 360 degrees about the vertical through its block. In the axes of the slope nothing changes: normal force
--                and shear together must carry the weight and nothing else, and no slip may accumulate. A shear kept in world axes would
--                point uphill after half a turn.
-- Source         N = m g cos b, T = m g sin b; Euler's w x I w of a block that rotates about no principal
--                axis.
-- How to run     erbs run scenes/hard/h03_shear_turned_along.lua [-D slope=0.3] [-D turns=-3] [-D high=0.2]
--                valid until the bed opens, h tan b = l / 3, or its least loaded point slips, tan b (1 + 3 mu h / l) = mu
-- What to look at  sideways_* (horizontal force over the weight), wander_* (displacement in the axes of the slope, m).
label("quick")
local slope, mu = param("slope", 20 * deg, "[rad]"), param("mu", 0.6, "")
local turns, time = param("turns", 1, ""), param("time", 8, "of the turn [s]")
local kn = param("kn", 2e8, "[Pa/m]")
local l, w, h, density = param("long", 0.3, "[m]"), param("wide", 0.2, "[m]"), param("high", 0.1, "[m]"), 2000
local settle = 2  -- s: the block on contact sinks in and comes to rest
local duration = settle + time + 1
local weight = density * l * w * h * g
local ks = 0.4 * kn
local soft = param("soft", 1, "kn of the joints over that of the contact")

material { name = "stone", density = density, kn = kn / soft, ks = ks / soft, friction = mu, restitution = 0 }
joint { law = mortar { kn = kn, ks = ks, ft = 1 * MPa, c = 1 * MPa, mu = mu }, between = { "bonded", "bonded" } }
joint { law = dry { kn = kn, ks = ks, mu = mu }, between = { "dry", "dry" } }
-- So many corners that they lie closer than steps: a coarse table gives an impulse at every corner.
local times, angles, corners = {}, {}, 50000
for i = 0, corners do
  local x = i / corners
  times[i + 1], angles[i + 1] = settle + time * x, 2 * pi * turns * x ^ 3 * (10 - 15 * x + 6 * x ^ 2)
end
local sunk = weight * math.cos(slope) * soft / (kn * l * w)  -- penetration of the block on contact
local kinds = { "bonded", "dry", "open" }
for i, kind in ipairs(kinds) do
  local centre = { 2 * i, 0, 0 }
  local down = (h + 0.1) / 2
  box { name = kind .. "_slope", group = kind, size = { 0.6, 0.6, 0.1 }, fixed = true, rotation = { 0, slope, 0 },
    center = { centre[1] - down * math.sin(slope), 0, -down * math.cos(slope) } }
  box { name = kind, group = kind, size = { l, w, h }, center = centre, rotation = { 0, slope, 0 }, free = kind == "open",
    initial = kind == "open" and { position = { -sunk * math.sin(slope), 0, -sunk * math.cos(slope) } } or nil }
  turning { block = kind .. "_slope", about = centre, axis = "z", wave = table_wave { times = times, values = angles, hold = true } }
  recorder { name = kind, quantity = "displacement", block = kind, axis = "xy" }
  recorder { name = kind .. "_slope", quantity = "reaction", block = kind .. "_slope" }
end
analysis { duration = duration, start = "equilibrium", output_dt = 0.02, frame_dt = 0.5 }
local function turned(t)
  local x = math.min(1, math.max(0, (t - settle) / time))
  return 2 * pi * turns * x ^ 3 * (10 - 15 * x + 6 * x ^ 2)
end
local wander, moves = {}, {}
for _, kind in ipairs(kinds) do
  metric("sideways_" .. kind, "", function(run)
    local fx, fy, worst = run.history(kind .. "_slope_fx_N"), run.history(kind .. "_slope_fy_N"), 0
    for i, t in ipairs(run.time) do
      if t >= settle then worst = math.max(worst, math.sqrt(fx[i] ^ 2 + fy[i] ^ 2) / weight) end
    end
    return worst
  end)
  -- Displacement of the centroid in the axes of the slope since the rotation began.
  metric("wander_" .. kind, "m", function(run)
    local x, y, first, worst = run.history(kind .. "_ux_rel_m"), run.history(kind .. "_uy_rel_m"), nil, 0
    for i, t in ipairs(run.time) do
      if t >= settle then
        local c, s = math.cos(turned(t)), math.sin(turned(t))
        local a, b = c * x[i] + s * y[i], c * y[i] - s * x[i]
        first = first or { a, b }
        worst = math.max(worst, math.abs(a - first[1]), math.abs(b - first[2]))
      end
    end
    wander[kind] = worst
    return worst
  end)
  -- Effects of the rotation at its fastest. First, a block that rotates about no principal axis resists with the moment (I1 - I3) w^2 sin b
  -- cos b, which tilts it on its bed and moves its centroid. Second, its centroid has settled by r off the vertical axis and feels the
  -- centrifugal acceleration w^2 r, which moves it as well; the 10 % allow for this. Noise in the start displaces a block, and it vibrates;
  -- the block on contact has lost this vibration before the rotation.
  local fastest, k = 1.875 * 2 * pi * turns / time, kind == "open" and kn / soft or kn
  local tilting, sb, cb = k * w * l ^ 3 / 12, math.sin(slope), math.cos(slope)
  local moved = h / 2 * cb * density * l * w * h / 12 * (l ^ 2 - h ^ 2) * fastest ^ 2 * sb * cb / tilting
  moves[kind] = moved
  local off = weight * sb * cb * (1 / (0.4 * k * l * w) + h ^ 2 / 4 / tilting)
  local swing = kind == "open" and 0 or math.sqrt(2) * start_noise
  expect("metrics.sideways_" .. kind, 3e-5 + fastest ^ 2 * off / g + k * l * w * swing / weight, { below = true, source = "the weight, w^2 r, and corners of the table" })
  expect("metrics.wander_" .. kind, moved, { abs = 0.1 * moved + 1e-9 * h + 2 * swing, source = "(I1 - I3) w^2 sin b cos b on the bed; nothing slips" })
end
-- The block on contact has dashpots. They see block and slope rotate as one and add nothing. So this block moves like the block on the dry
-- joint. The small difference is that of a contact patch and a thin joint (penetration over height, and the angle of rotation).
metric("open_over_dry", "", function() return wander.open / (soft * wander.dry) end)
expect("metrics.open_over_dry", 1, { abs = 0.01 + 4 * start_noise / moves.dry, source = "no work of dashpots in a rigid motion" })
expect("energy.residual_relative", 1e-2, { below = true, source = "gate" })
