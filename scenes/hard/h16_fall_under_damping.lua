-- Hard case: mass damping must not brake falling blocks
--
-- What happens   Cubes hang by mortar that is too weak for them, are thrown off a ledge, or lie loose on each other when their support
--                fails. Mass damping of 10 1/s would limit a falling bonded block to g / 10 s = 0.98 m/s; debris must fall freely.
-- Source         sqrt(2 h / g)
-- How to run     erbs run scenes/hard/h16_fall_under_damping.lua [-D damping=100]
-- What to look at  fall_* (time over sqrt(h / g) to half the height), thrown
-- Tolerance      0.5 %: rows every 0.2 ms, and the mortar needs a few of its periods to let go.
label("quick")
local a = param("damping", 10, "[1/s]")
local h = param("height", 1, "[m]")
local side = 0.1
gravity(g)
material { name = "stone", density = 2000, kn = 1e9, ks = 4e8, friction = 0.6, restitution = 0.2 }
joint { law = mortar { kn = 1e10, ks = 4e9, ft = 500, c = 1e3, mu = 0.6 }, between = { "ceiling", "hung" } }  -- the stress of its weight is 1962 Pa
joint { law = mortar { kn = 1e10, ks = 4e9, ft = 500, c = 1e3, mu = 0.6 }, between = { "hung", "hung" } }
ground { size = 20, material = "stone" }
damping { mass = a, scope = "bonded" }
local function watch(name, height)
  recorder { name = name, quantity = "displacement", block = name, axis = "z" }
  metric("fall_" .. name, "", function(run)
    local t = run.crossings(name .. "_uz_rel_m", -height / 2, false)[1]
    return t and t / math.sqrt(height / g) or 0
  end)
  expect("metrics.fall_" .. name, 1, { rel = 0.005, source = "half the height after sqrt(h / g)" })
end
box { name = "beam", group = "ceiling", size = { 1, side, side }, at = { 0, 0, h + side }, fixed = true }
box { name = "hung", group = "hung", size = { side, side, side }, at = { 0.1, 0, h } }
watch("hung", h)
box { name = "upper", group = "hung", size = { side, side, side }, at = { 0.7, 0, h } }
box { name = "lower", group = "hung", size = { side, side, side }, at = { 0.7, 0, h - side } }
watch("lower", h - side)
box { name = "loose", size = { side, side, side }, at = { 3, 0, h }, free = true }
watch("loose", h)
box { name = "pair_low", size = { side, side, side }, at = { 5, 0, h - side }, free = true }
box { name = "pair_high", size = { side, side, side }, at = { 5, 0, h }, free = true }
watch("pair_low", h - side)
box { name = "thrown", size = { side, side, side }, at = { 7, 0, h }, free = true, initial = { velocity = { 2, 0, 0 } } }
recorder { name = "thrown", quantity = "velocity", block = "thrown", axis = "x" }
metric("thrown", "", function(run) return run.at("thrown_vx_rel_m_s", 0.9 * math.sqrt(2 * h / g)) / 2 end)
expect("metrics.thrown", 1, { rel = 1e-9, source = "nothing pushes across" })
watch("thrown", h)
analysis { duration = 1.2 * math.sqrt(2 * h / g), start = "rest", output_dt = 2e-4, frame_dt = 1 }
expect("energy.residual_relative", 1e-2, { below = true, source = "gate" })
