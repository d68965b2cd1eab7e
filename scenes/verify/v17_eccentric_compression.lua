-- V17: dry joints open under eccentric compression: contact length and moment against rotation.
--
-- What happens   Held blocks are rotated by a given angle, with a given length a of their joint in contact: N = kn B theta a^2 / 2 and e =
--                M / N = H/2 - a/3, so a = 3 (H/2 - e). An open joint integrates min(gap, 0) over its polygon in closed form, so the result
--                does not depend on the rule of points. Free blocks carry N at e and must find their rotation in the static start.
-- Source         bed of springs without tension; e.g. Heyman 1966, Int. J. Solids Struct. 2, 249 for the limit.
-- How to run     erbs run scenes/verify/v17_eccentric_compression.lua [-D side=...] [-D kn=...] [-D height=...]
-- What to look at  moment_error (largest over all held blocks) and turn_* (free blocks: rotation over the formula).
label("quick")
local H, B = param("side", 0.3, "side along the eccentricity [m]"), param("width", 0.125, "the other side [m]")
local kn, height = param("kn", 1e11, "[Pa/m]"), param("height", 0.1, "of the free blocks, whose weight is their N [m]")
local angle = param("angle", 1e-6, "rotation of the held blocks: arms turn by it [rad]")

material { name = "brick", density = 1800 }
local load = 1800 * g * H * B * height
local held, count = {}, 0
local function points(along) return H >= B and { along, 3 } or { 3, along } end
for _, rule in ipairs { { "simpson", 3 }, { "midpoint", 2 }, { "gauss", 3 } } do
  for i = 0, 11 do
    local name, a = rule[1] .. i, H * (0.15 + 0.85 * i / 11)
    local base = "base_" .. name
    count = count + 1
    local at = { 2 * H * count, 0 }
    box { name = base, group = base, size = { H, B, 0.1 }, at = { at[1], at[2], -0.1 }, fixed = true }
    local lift = angle * (H / 2 - a)
    box { name = name, group = name, size = { H, B, 0.1 }, at = { at[1], at[2], 0 }, initial = { rotation = { 0, angle, 0 }, position = { 0, 0, lift } } }
    joint { law = dry { kn = kn, mu = 0 }, between = { base, name }, rule = rule[1], points = points(rule[2]) }
    motion { block = name, wave = lift, direction = "z" }
    recorder { name = name, quantity = "joint_moment", blocks = { base }, others = { name }, axis = "y" }
    recorder { name = name, quantity = "normal_force", blocks = { base }, others = { name } }
    held[#held + 1] = { name = name, a = a, force = kn * B * angle * a ^ 2 / 2 }
  end
end
local function largest(run, error_of)
  local worst = 0
  for _, case in ipairs(held) do
    local force, moment = -run.last(case.name .. "_normal_N"), math.abs(run.last(case.name .. "_my_N_m"))
    worst = math.max(worst, math.abs(error_of(case, force, moment)))
  end
  return worst
end
metric("moment_error", "", function(run)
  return largest(run, function(case, _, moment) return moment / (case.force * (H / 2 - case.a / 3)) - 1 end)
end)
metric("force_error", "", function(run) return largest(run, function(case, force) return force / case.force - 1 end) end)
metric("contact_length_error", "", function(run)
  return largest(run, function(case, force, moment) return 3 * (H / 2 - moment / force) / case.a - 1 end)
end)
-- A closed form: only the rotation of the arms by the angle remains, about 1e-6 of their length over the contact length.
expect("metrics.moment_error", 0, { abs = 1e-4, source = "N (H/2 - a/3); 1 % is allowed up to e = .45 H" })
expect("metrics.force_error", 0, { abs = 1e-4, source = "kn B theta a^2 / 2" })
expect("metrics.contact_length_error", 0, { abs = 1e-3, source = "a = 3 (H/2 - e)" })

for i, e in ipairs { 0.05, 0.15, 0.2, 0.264, 0.333, 0.382, 0.42, 0.44, 0.47 } do
  local name, a = string.format("free%d", i), math.min(H, 3 * (0.5 - e) * H)
  local base = "base_" .. name
  box { name = base, group = "base", size = { H, B, 0.1 }, at = { 2 * H * i, 2, -0.1 }, fixed = true }
  box { name = name, group = "free", size = { H, B, height }, at = { 2 * H * i, 2, 0 } }
  moment { block = name, wave = load * e * H, direction = "y" }
  recorder { name = name, quantity = "rotation", block = name, axis = "y" }
  local expected = e > 1 / 6 and 2 * load / (kn * B * a ^ 2) or load * e * H / (kn * B * H ^ 3 / 12)
  metric("turn_" .. name, "", function(run) return run.first(name .. "_ry_rad") / expected end)
  metric("drift_" .. name, "", function(run) return run.last(name .. "_ry_rad") / run.first(name .. "_ry_rad") - 1 end)
  -- The weight moves sideways by theta h/2, a share 3 h theta / a of the change of the moment (dM/dtheta = N a / (6 theta)). Newton stops
  -- at 1e-8 of the load, which dM/dtheta reduces by a / (3 H).
  expect("metrics.turn_" .. name, 1, { abs = 6 * height * expected / a + 1e-7 * H / a, source = e > 1 / 6 and "2 N / (kn B a^2)" or "M / (kn B H^3 / 12)" })
  expect("metrics.drift_" .. name, 0, { abs = 1e-5, source = "at rest" })
end
joint { law = dry { kn = kn, mu = 0.6 }, between = { "base", "free" } }
analysis { duration = 2e-3, start = "equilibrium", output_dt = 1e-4 }
