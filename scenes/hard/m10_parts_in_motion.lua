-- Hard case: a fragment whose bricks move apart from the first step on
--
-- What happens   Without gravity a bar of bricks in brittle mortar starts unstrained, but its bricks move against each other: it breaks in
--                its first steps, before any event could be foreseen, and its pieces fly on.
-- Source         Energy and momentum: a ledger that closes, and the centre of mass that moves on as it started
-- How to run     erbs run scenes/hard/m10_parts_in_motion.lua [-D speed=2] [-D kn=1e12] [-D bricks=6] [-D ft=1e6]
-- What to look at  energy.residual_relative; drift (m, of the centre of mass from its straight way)
label("quick")
local speed, kn = param("speed", 0.3, "of neighbours against each other [m/s]"), param("kn", 2e11, "[Pa/m]")
local ft, n = param("ft", 4e5, "tensile strength [Pa]"), param("bricks", 2, "of the bar")
local skew = param("skew", 0.8, "of the motion from the axis of the bar [rad]")
family({ speed = { 0.05, 0.3, 2 }, kn = { 1e9, 2e11, 1e12 }, ft = { 1e4, 4e5, 2e6 }, bricks = { 2, 3, 8, 24 }, skew = { 0, 0.8, pi / 2 } }, { combinations = 20 })
gravity(0)
material { name = "brick", density = 2000, friction = 0.6, restitution = 0.3, kn = math.min(kn, 5e10), ks = 0.4 * math.min(kn, 5e10) }
local l, w, h = 0.3, 0.15, 0.1
local names, mean = {}, { 0, 0 }
for i = 1, n do
  local along = (i % 2 == 0 and 0.5 or -0.5) * speed * (1 + 0.1 * i / n)
  local velocity = { along * math.cos(skew), along * math.sin(skew), 0 }
  mean = { mean[1] + velocity[1] / n, mean[2] + velocity[2] / n }
  names[i] = box { name = "b" .. i, size = { l, w, h }, at = { i * l, 0, 0 }, free = true, initial = { velocity = velocity } }
end
joint { law = mortar { kn = kn, ks = 0.4 * kn, ft = ft, c = 1.5 * ft, mu = 0.6 } }
recorder { name = "all", quantity = "displacement", blocks = names }
local duration = 0.1
metric("drift", "m", function(run)
  local x, y = run.last "all_ux_rel_m" - mean[1] * run.time[#run.time], run.last "all_uy_rel_m" - mean[2] * run.time[#run.time]
  return math.sqrt(x * x + y * y)
end)
analysis { duration = duration, start = "rest", output_dt = duration / 100, frame_dt = 1,
  energy_gate = 1e-3 }  -- soft mortar that holds swings by a third of a millimetre: no linear spring
expect("energy.residual_relative", 1e-3, { below = true, source = "each event errs by 1e-4 of what passed at most" })
expect("metrics.drift", 1e-7, { below = true, source = "momentum; the noise of the grid moves it by 1e-8" })
expect("momentum_residual", 1e-8, { below = true, source = "action and reaction" })
