-- Hard case: the time step is at its limit while contacts come and go
--
-- What happens   Stiff blocks rain on a tower of soft dry joints, whose step is 0.99 of its limit. Each new contact lowers the limit. The
--                step must follow at once, and must grow again when the rain has run off.
-- Source         omega^2 of the whole is at most that of the joints at rest plus that of the new contacts (Weyl); the energy is the witness
-- How to run     erbs run scenes/hard/h18_step_at_the_limit.lua [-D fraction=0.9]
-- What to look at  energy.residual_relative, shortened: steps over the number that the joints alone would need
label("quick")
local fraction = param("fraction", 0.99, "of the limit")
local kn = param("kn", 2e8, "of the joints [Pa/m]")
local hard = param("hard", 2e10, "of debris [Pa/m]")
gravity(g)
material { name = "stone", density = 2000, kn = hard, ks = 0.4 * hard, friction = 0.6, restitution = 0.2 }
joint { law = dry { kn = kn, ks = 0.4 * kn, mu = 0.6 }, between = { "tower", "tower" } }
box { name = "foot", group = "tower", size = { 4, 4, 0.2 }, at = { -2, -2, -0.2 }, fixed = true }
for i = 1, 6 do box { name = "course" .. i, group = "tower", size = { 0.4, 0.3, 0.2 }, at = { -0.2, -0.15, 0.2 * (i - 1) } } end
for i = 1, 12 do
  box { name = "rain" .. i, size = { 0.15, 0.1, 0.08 }, center = { 0.1 * (i % 3 - 1), 0.08 * (i % 2), 1.4 + 0.18 * i }, free = true,
    initial = { rotation = { 0.3 * i, 0.2 * i, 0.1 * i }, velocity = { 0, 0, -1 } } }
end
recorder { name = "top", quantity = "displacement", block = "course6" }
analysis { duration = 1.5, dt_fraction = fraction, output_dt = 0.01, frame_dt = 1.5 }
metric("shortened", "", function(run) return run.steps * run.dt_critical_s * fraction / run.time_s end)
expect("status", "completed", { source = "stable" })
expect("energy.residual_relative", 1e-2, { below = true, source = "gate" })
expect("metrics.shortened", 1.2, { above = true, source = "contacts 100 times as stiff as the joints" })
