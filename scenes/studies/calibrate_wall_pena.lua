-- Calibration of the contact of wall and base by stiffness and damping, after Pena et al. (method 2)
--
-- What happens   kn is raised until the toe takes 3 % off the static acceleration that overturns the wall, ks with it. Then the damping ratio xi is
--                fitted to the times and peaks of Housner's free rocking. Of an open bed the damping is the restitution of its contact, exp(-pi xi / sqrt(1 - xi^2)).
--                On feet the fit is xi = .298 +- .012, a restitution of .38, with an rms of .17 %. metrics.pena_xi is the ratio of the printed formula (15),
--                .39 for this wall, a restitution of .26: more than these feet need.
--                On a flat face no damping takes enough (V29).
-- Source         Pena et al. 2005 as printed by P. J. S. Gomes (IST Lisbon), eqs. (10) to (15). Its stiffness K = M p^2 lacks a factor of the unit: in
--                N/m the wall would sink by 4 R / 3 = 2 m (metrics.pena_settlement). So kn is not computed from it.
-- How to run     erbs calibrate scenes/studies/calibrate_wall_pena.lua -D foot=0.008        on feet; without -D on the whole face
-- What to look at  calibration.svg, calibration.json
local theory = rocking { width = 0.6, height = 3, theta = 0.05, duration = 4 }
local times, peaks, t, phi = {}, {}, {}, {}
for n = 1, 6 do
  times[n], peaks[n] = "metrics.t_" .. n, "metrics.phi_" .. n
  t[n], phi[n] = theory.impacts[n], theory.amplitudes[n + 1]
end
calibration {
  title = "Free rocking of the wall: stiffness and damping (method 2)",
  scene = "rocking_wall.lua",
  stages = {
    { raise = { kn = { 1e9, 1e13, log = true } }, key = "metrics.softening", below = 0.03 },
    { fit = { xi = { 0.01, 0.95 } } },
  },
  targets = {
    { label = "time of impact [s]", keys = times, values = t },
    { label = "peak |theta| / alpha [-]", keys = peaks, values = phi },
  },
  history = { column = "block_ry_rad", label = "rotation [rad]", known = "Housner 1963", t = theory.t, values = theory.theta },
}
