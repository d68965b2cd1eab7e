-- Calibration of the contact of wall and base by stiffness and friction alone, after Gomes (method 1)
--
-- What happens   Without any damping ks is raised until the wall does not slip, then kn is fitted to the times and peaks of Housner's free rocking, then
--                friction. Undamped springs lose energy only by vibration: the fit is rough on a flat face, and the figure shows how rough.
-- Source         P. J. S. Gomes (IST Lisbon), 2.3 and Fig. 2; Housner 1963
-- How to run     erbs calibrate scenes/studies/calibrate_wall.lua [-D foot=0.008]
-- What to look at  calibration.svg, calibration.json
local theory = rocking { width = 0.6, height = 3, theta = 0.05, duration = 4 }
local times, peaks, t, phi = {}, {}, {}, {}
for n = 1, 6 do
  times[n], peaks[n] = "metrics.t_" .. n, "metrics.phi_" .. n
  t[n], phi[n] = theory.impacts[n], theory.amplitudes[n + 1]
end
calibration {
  title = "Free rocking of the wall: stiffness and friction (method 1)",
  scene = "rocking_wall.lua",
  stages = {
    { raise = { ks = { 1e8, 1e12, log = true } }, key = "metrics.slip", below = 0.005 },
    { fit = { kn = { 1e9, 1e13, log = true } } },
    { fit = { friction = { 0.3, 1.2 } } },
  },
  targets = {
    { label = "time of impact [s]", keys = times, values = t },
    { label = "peak |theta| / alpha [-]", keys = peaks, values = phi },
  },
  history = { column = "block_ry_rad", label = "rotation [rad]", known = "Housner 1963", t = theory.t, values = theory.theta },
}
