-- H14, second part: bodies that already overlap when contact takes over must feel no sudden force and store no energy from nowhere.
--
-- What happens   rocker: a block rotates about the end of its joint, which stays open by `ajar`. Its contact body extends by half a joint
--                around that end, over the mortar of the joint beside it, and dips into the block below. At the release to contact (0.03
--                rad) it is about 0.14 mm deep, and the joint carries nothing. pusher: a block moves down onto a block to which it has no
--                joint, and ends millimetres deep in it.
-- Source         continuity, as in H14: contact counts the depth from its value at the start. Force of the contact on paper: kn times the
--                overlap of the lower face since then, w d^2 / sin 2a for a corner at depth d rotated by a, A d for a flat face.
-- How to run     erbs run scenes/hard/h14_overlap_from_nothing.lua [-D kn=...] [-D ajar=...] [-D deep=...]
-- What to look at  jump_*: largest change of force in one step over the force, while the block rotates or comes down; force_*: final
--                contact force over that on paper; reset_J: no energy from nowhere.
label("quick")
local kn = param("kn", 1e9, "of joints [Pa/m]")
local ajar, angle = param("ajar", 0.01 * mm, "[m]"), param("angle", 0.035, "[rad]")
local deep = param("deep", 8 * mm, "of the pusher in the end [m]")
local soft = param("soft", 1e9, "kn of the pusher [Pa/m]")
local l, w, h, t, density = 0.12, 0.125, 0.1, 10 * mm, 1800
local duration = 0.5
material { name = "brick", density = density, friction = 0.6, restitution = 1, kn = soft, ks = 0.4 * soft }
local strong = mortar { kn = 20 * kn, ks = 8 * kn, ft = 1 * GPa, c = 1 * GPa, mu = 0.6 }
damping { joint_ratio = 0.5 }  -- the blocks below come to rest before the end
gravity(0)
joint { none = true }
-- The blocks below are free, on a strong bed.
for i, name in ipairs { "rocker", "pusher" } do
  box { name = "bed_" .. name, group = "bed_" .. name, size = { 0.3, 0.3, 0.1 }, center = { 2 * i, 0, -0.1 }, fixed = true }
  box { name = "under_" .. name, group = "under_" .. name, size = { 0.3, 0.3, 0.05 }, center = { 2 * i, 0, -0.025 } }
  joint { law = strong, between = { "bed_" .. name, "under_" .. name } }
  recorder { name = "under_" .. name, quantity = "displacement", block = "under_" .. name, axis = "z" }
  recorder { name = name, quantity = "reaction", blocks = { "bed_" .. name }, axis = "z" }
end

local ramp = { 0, 0.1 * duration, 0.6 * duration, duration }
box { name = "rocker", group = "rocker", size = { l, w, h }, center = { 2 - l / 2, 0, t + h / 2 } }
box { name = "beside", group = "beside", size = { l, w, h }, center = { 2 + l / 2 + t, 0, t + h / 2 } }
joint { law = dry { kn = kn, ks = 0.4 * kn, mu = 0.6 }, between = { "under_rocker", "rocker" }, thickness = t }
joint { law = dry { kn = kn, ks = 0.4 * kn, mu = 0.6 }, between = { "rocker", "beside" }, thickness = t }
motion { block = "beside", direction = "x", wave = table_wave { times = ramp, values = { 0, 0.05, 0.05, 0.05 }, hold = true } }
motion { block = "rocker", direction = "z", wave = table_wave { times = ramp, values = { 0, ajar, ajar, ajar }, hold = true } }
turning { block = "rocker", about = { 2, 0, t / 2 }, axis = "y", wave = table_wave { times = ramp, values = { 0, 0, angle, angle }, hold = true } }

local a, gap = 0.05, 0.3 * mm
box { name = "pusher", group = "pusher", size = { a, a, h }, center = { 4, 0, gap + h / 2 } }
motion { block = "pusher", direction = "z", wave = table_wave { times = ramp, values = { 0, 0, -gap - deep, -gap - deep }, hold = true } }

-- Depth of the overlap over time, as if the block below had not moved.
local depth = {
  rocker = function(time) return t / 2 * math.sin(angle * math.min(1, (time / duration - 0.1) / 0.5)) - ajar end,
  pusher = function(time) return (gap + deep) * math.min(1, (time / duration - 0.1) / 0.5) - gap end,
}
local law = {
  rocker = function(d) return kn * w * d ^ 2 / math.sin(2 * angle) end,
  pusher = function(d) return soft * a * a * d end,
}
for name, of_depth in pairs(law) do
  metric("force_" .. name, "", function(run)
    local F, first = run.history(name .. "_fz_N"), 1
    while F[first] == 0 do first = first + 1 end
    local pressed = depth[name](duration) - depth[name](run.time[math.max(1, first - 1)]) + run.last("under_" .. name .. "_uz_rel_m")
    return -run.last(name .. "_fz_N") / of_depth(pressed)
  end)
  metric("jump_" .. name, "", function(run)
    local F, most = run.history(name .. "_fz_N"), 0
    for k = 2, #F do
      if run.time[k] > 0.1 * duration and run.time[k] < 0.59 * duration then most = math.max(most, math.abs(F[k] - F[k - 1])) end
    end
    return -most / run.last(name .. "_fz_N")
  end)
  if start_noise == 0 then expect("metrics.force_" .. name, 1, { rel = 2e-2, source = "kn times the overlap" }) end  -- the start of contact is known to a step or two only
  expect("metrics.jump_" .. name, 0.03, { below = true, source = "no force from nothing" })
end
metric("reset", "J", function(run) return math.abs(run.energy.reset_J) end)
expect("metrics.reset", 1e-9, { below = true, source = "no energy from nothing" })
analysis { duration = duration, output_dt = 1e-7, frame_dt = duration / 10 }
-- 5e-11 without noise. Noise of 1e-8 m in the start vibrates, damped, before anything else moves, and the residual is relative to its
-- energy alone: 0.45 % at 0.9 of the step limit.
expect("energy.residual_relative", 1e-2, { below = true, source = "ledger with friction and a hand-over" })
expect("status", "completed")
