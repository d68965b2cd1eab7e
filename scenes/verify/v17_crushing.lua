-- V17 for beds that yield in compression: eccentric pressure on a section without tension, with a compressive strength fc.
--
-- What happens   Held blocks are pressed to N and rotated at constant N: the pressure is max(0, min(fc, kn (c - theta x))), x from the toe.
--                Then they are lifted along the elastic line until no pressure is left, and rotated back. They are pressed again on the bed
--                that the crushed toe has left. The blocks with the least pressure are then rotated the other way, where the other toe must
--                behave like the first. Free blocks carry N at e and must find their rotation in the static start.
-- Source         With n = N / (fc B), d = fc / (kn theta) and the toe crushed over b = n - d/2: M = N (H - n)/2 - fc B d^2 / 24. This tends
--                to the rigid-plastic N (H/2) (1 - N / (fc A)); crushing has taken fc B theta b^2 / 2. Far below fc: V17.
-- How to run     erbs run scenes/verify/v17_crushing.lua [-D side=...] [-D kn=...] [-D fc=...] [-D slimmest=0.02]
-- What to look at  moment_error, force_error: while pressed and rotated; unloading_error, again_error: later; moment_*: M at the end of the
--                rotation.
label("quick")
local H, B = param("side", 0.3, "side along the eccentricity [m]"), param("width", 0.125, "the other side [m]")
local kn, fc = param("kn", 1e11, "[Pa/m]"), param("fc", 5 * MPa, "of the weaker beds [Pa]")
local slimmest = param("slimmest", 0.05, "elastic length d at the end, over the side; more where the angle would pass 0.02")
slimmest = math.max(slimmest, 4 * fc / kn / (0.02 * H))  -- beyond 0.03 contact, which has no fc, takes over the joint
local stage = param("stage", 300, "steps of each stage")

gravity(1)  -- of the free blocks: small, so that the moment of their sideways displaced weight is small
material { name = "brick", density = 1800 }
-- Force and moment of a strip of width B with the depths y(x) = min(most, c - theta x) - away - max(0, crushed - set x), where positive.
local function section(c, theta, most, away, crushed, set)
  local force, moment, x = 0, 0, { 0, H }
  local function y(at) return math.min(most, c - theta * at) - away - math.max(0, crushed - set * at) end
  local function bend(at) if at > 0 and at < H then table.insert(x, #x, at) end end
  if theta ~= 0 then bend((c - most) / theta) end
  if set ~= 0 then bend(crushed / set) end  -- one of the two at most
  local corners = { x[1] }
  for i = 2, #x do  -- point where pressure begins or ends
    local y0, y1 = y(x[i - 1]), y(x[i])
    if y0 * y1 < 0 then corners[#corners + 1] = x[i - 1] + y0 / (y0 - y1) * (x[i] - x[i - 1]) end
    corners[#corners + 1] = x[i]
  end
  for i = 2, #corners do
    local x0, x1 = corners[i - 1], corners[i]
    local y0, y1, l = math.max(0, y(x0)), math.max(0, y(x1)), x1 - x0
    force = force + B * kn * l * (y0 + y1) / 2
    moment = moment + B * kn * l * (y0 * (H / 2 - x0) / 2 + y1 * (H / 2 - x1) / 2 + (y1 - y0) * l / 6)
  end
  return force, moment
end
-- Depth of the toe at which the section carries N.
local known = {}
local function toe(force, theta, most)
  local key = string.format("%.17g %.17g %.17g", force, theta, most)
  if known[key] then return known[key] end
  local lo, hi = 0, most + theta * H
  for _ = 1, 64 do
    local c = (lo + hi) / 2
    if section(c, theta, most, 0, 0, 0) < force then lo = c else hi = c end
  end
  known[key] = (lo + hi) / 2
  return known[key]
end

local dt, rows, cases, number, crushing = 1e-6, 30, {}, 0, 0
local function at_stage(k) return k * stage * dt end
for _, strength in ipairs { fc, 4 * fc } do
  for _, share in ipairs { 0.001, 0.1, 0.3, 0.45, 0.7 } do
    for _, rule in ipairs { { "simpson", 3 }, { "midpoint", 2 }, { "gauss", 2 } } do
      number = number + 1
      local name, force, depth = string.format("case%d", number), share * strength * H * B, strength / kn
      local elastic = share < 0.01  -- far below fc: rotated until a tenth of the side is in contact
      local last = elastic and 2 * share * depth / (0.01 * H) or depth / (slimmest * H)
      local times, turns, lifts = { 0 }, { 0 }, { 0 }
      local function node(time, turn, lift) times[#times + 1], turns[#turns + 1], lifts[#lifts + 1] = time, turn, lift end
      node(at_stage(1), 0, -toe(force, 0, depth))
      for i = 1, rows do
        local theta = last * (i / rows) ^ 2
        node(at_stage(1 + 3 * i / rows), theta, theta * H / 2 - toe(force, theta, depth))
      end
      local c = toe(force, last, depth)
      local b = math.max(0, (c - depth) / last)  -- crushed length
      node(at_stage(5), last, last * H / 2 - c + math.min(c, depth))
      -- Opened no wider than necessary: contact takes over a joint whose faces have separated.
      node(at_stage(6), last, last * H / 2)
      node(at_stage(7), 0, 0)
      node(at_stage(8), 0, -0.5 * depth)
      local mirrored = share <= 0.3 and not elastic
      node(at_stage(9), 0, 0)
      if mirrored then
        node(at_stage(10), -last, last * H / 2)
        node(at_stage(11), -last, last * H / 2 - c)
      end
      local turn, lift = table_wave { times = times, values = turns, hold = true }, table_wave { times = times, values = lifts, hold = true }
      local x, base = 2 * H * number, "base_" .. name
      box { name = base, group = base, size = { H, B, 0.1 }, at = { x, 0, -0.1 }, fixed = true }
      box { name = name, group = name, size = { H, B, 0.1 }, at = { x, 0, 0 } }
      turning { block = name, axis = "y", wave = turn, about = { x + H / 2, B / 2, 0 } }
      motion { block = name, direction = "z", wave = lift }
      local law = mortar { kn = kn, ks = 0.4 * kn, ft = 0, c = 0, mu = 0, fc = strength }
      joint { law = law, between = { base, name }, rule = rule[1], points = H >= B and { rule[2], 3 } or { 3, rule[2] } }
      recorder { name = name, quantity = "joint_moment", blocks = { base }, others = { name }, axis = "y" }
      recorder { name = name, quantity = "normal_force", blocks = { base }, others = { name } }
      cases[number] = { name = name, force = force, share = share, strength = strength, depth = depth, last = last, c = c, b = b, turn = turn,
        lift = lift, mirrored = mirrored, elastic = elastic }
      crushing = crushing + (mirrored and 2 or 1) * strength * B * last * b ^ 2 / 2
    end
  end
end

-- Largest error of force (over N) and moment (over N H/2) in a stage, against `paper`(case, turn, lift).
local function errors(run, from, to, paper)
  local forces, moments = 0, 0
  for _, case in ipairs(cases) do
    local N, M = run.history(case.name .. "_normal_N"), run.history(case.name .. "_my_N_m")
    for i, time in ipairs(run.time) do
      if time > at_stage(from) + dt / 2 and time < at_stage(to) + dt / 2 then
        local force, moment = paper(case, case.turn(time), case.lift(time))
        forces = math.max(forces, math.abs(-N[i] - force) / case.force)
        moments = math.max(moments, math.abs(math.abs(M[i]) - moment) / (case.force * H / 2))
      end
    end
  end
  return forces, moments
end
local function pressed(case, turn, lift) return section(turn * H / 2 - lift, turn, case.depth, 0, 0, 0) end
local function lifted(case, turn, lift) return section(case.c, turn, case.depth, lift - (turn * H / 2 - case.c), 0, 0) end
local function again(case, _, lift) 
  local force, moment = section(-lift, 0, case.depth, 0, math.max(0, case.c - case.depth), case.b > 0 and case.last or 0)
  return force, math.abs(moment)
end
metric("force_error", "", function(run) return (errors(run, 0, 4, pressed)) end)
metric("moment_error", "", function(run) return (select(2, errors(run, 0, 4, pressed))) end)
metric("unloading_error", "", function(run) return math.max(errors(run, 4, 5, lifted)) end)
metric("again_error", "", function(run) return math.max(errors(run, 7.1, 8, again)) end)
-- The closed forms err only by the rotation of the arms, theta^2; an error of 1 % is allowed.
local square = (4 * fc / kn / (slimmest * H)) ^ 2
for _, what in ipairs { "force_error", "moment_error", "unloading_error", "again_error" } do
  expect("metrics." .. what, 0, { abs = 1e-8 + 2 * square, source = "Int kn max(0, z - g) dA, -z the set; 1 % is allowed" })
end

local function row_at(run, when)
  for i, time in ipairs(run.time) do if time > at_stage(when) - dt / 2 then return i end end
end
for _, case in ipairs(cases) do
  metric("moment_" .. case.name, "", function(run)
    local i = row_at(run, 4)
    return math.abs(run.history(case.name .. "_my_N_m")[i]) / (case.force * H / 2)
  end)
  if case.elastic then
    local a = math.sqrt(2 * case.force / (kn * B * case.last))
    expect("metrics.moment_" .. case.name, 1 - 2 * a / (3 * H), { rel = 1e-6 + 2 * square, source = "N (H/2 - a/3)" })
  elseif case.share > 0.5 * slimmest and 1 - case.share > 0.5 * slimmest then
    local n, d = case.share * H, slimmest * H
    expect("metrics.moment_" .. case.name, ((H - n) - d ^ 2 / (12 * n)) / H, { rel = 1e-6 + 2 * square, source = "N (H - n)/2 - fc B d^2/24" })
  end
  if case.mirrored and case.c - case.depth < case.last * (H / 2 - slimmest * H) then
    metric("other_toe_" .. case.name, "", function(run)
      local M = run.history(case.name .. "_my_N_m")
      return -run.last(case.name .. "_my_N_m") / M[row_at(run, 4)]
    end)
    expect("metrics.other_toe_" .. case.name, 1, { abs = 1e-6 + 2 * square, source = "symmetry" })
  end
end
metric("crushing_over_paper", "", function(run) return run.metrics.energy.crushing_J / crushing end)
-- The first step beyond fc begins below it.
expect("metrics.crushing_over_paper", 1, { abs = 1e-4, source = "fc B theta b^2 / 2" })

local height = param("height", 0.1, "of the free blocks [m]")
local weight = 1800 * 1 * H * B * height
for i, e in ipairs { { 0.3, 0.3 }, { 0.3, 0.1 }, { 0.6, 0.2 } } do
  local n, d, name = e[1] * H, e[2] * H, "free" .. i
  local strength = weight / (B * n)
  local theta = strength / kn / d
  box { name = "base_" .. name, group = "base_free" .. i, size = { H, B, 0.1 }, at = { 2 * H * i, 2, -0.1 }, fixed = true }
  box { name = name, group = name, size = { H, B, height }, at = { 2 * H * i, 2, 0 } }
  moment { block = name, wave = weight * (H - n) / 2 - strength * B * d ^ 2 / 24, direction = "y" }
  joint { law = mortar { kn = kn, ks = 0.4 * kn, ft = 0, c = 0, mu = 0.6, fc = strength }, between = { "base_free" .. i, name } }
  recorder { name = name, quantity = "rotation", block = name, axis = "y" }
  metric("turn_" .. name, "", function(run) return run.first(name .. "_ry_rad") / theta end)
  metric("drift_" .. name, "", function(run) return run.last(name .. "_ry_rad") / run.first(name .. "_ry_rad") - 1 end)
  -- dM/dtheta = fc B d^2 / (12 theta) against N theta h/2 of the sideways displaced weight, and 1e-8 of the load where Newton stops.
  local soft = 12 * n / d ^ 2
  expect("metrics.turn_" .. name, 1, { abs = soft * height * theta + 1e-7 * soft * H, source = "d = fc / (kn theta)" })
  expect("metrics.drift_" .. name, 0, { abs = 1e-5, source = "at rest" })
end
analysis { duration = at_stage(11), dt = dt, start = "equilibrium", output_dt = 10 * dt }
expect("energy.residual_relative", 1e-4, { below = true, source = "ledger: crushing is booked place by place" })
