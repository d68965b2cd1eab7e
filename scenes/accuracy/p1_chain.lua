-- P1: period of one mode of a chain of blocks on springs.
--
-- What happens   Eight blocks on top of each other, without gravity, vibrate vertically in their fourth mode. Only the time step causes an
--                error. Leapfrog raises the frequency by the share (w dt)^2 / 24, so the error falls with dt^2. Contact points do not
--                matter.
-- Source         w_k = 2 sqrt(K/m) sin((2k - 1) pi / (2 (2N + 1))), N equal masses fixed at one end.
-- How to run     erbs accuracy scenes/accuracy/p1_chain.lua
-- What to look at  The order of the error in the time step: 2.00.
local n, mode = 8, param("mode", 4)
local kn, h, cycles = param("kn", 1e9, "[Pa/m]"), 0.1, 12
material { name = "brick", density = 1800 }
gravity(0)
local q = (2 * mode - 1) * pi / (2 * n + 1)
local w = 2 * math.sqrt(kn / (1800 * h)) * math.sin(q / 2)
box { name = "base", size = { 0.3, 0.125, h }, at = { 0, 0, -h }, fixed = true }
for i = 1, n do
  box { name = "b" .. i, size = { 0.3, 0.125, h }, at = { 0, 0, (i - 1) * h }, initial = { velocity = { 0, 0, 1e-4 * math.sin(i * q) } } }
end
joint { law = mortar { kn = kn, ks = 0.4 * kn, ft = 1e9, c = 1e9, mu = 0.6 } }
recorder { name = "first", quantity = "displacement", block = "b1", axis = "z" }
metric("period", "s", function(run) return run.period "first_uz_rel_m" end)
-- (w dt)^2 / 24 at 0.9 of the limit, where w dt of this mode is about 1.
expect("metrics.period", 2 * pi / w, { rel = 0.05, source = "fixed chain" })
analysis { duration = (cycles + 0.1) * 2 * pi / w, start = "rest", output_dt = 1e-9, frame_dt = 1 }
