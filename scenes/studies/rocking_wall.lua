-- One wall that rocks freely on its bed, for the calibrations of the contact of wall and base
--
-- What happens   A wall of .6 x 3 m is tilted and released. Its impacts and its peaks between them stand beside Housner's rigid block. The contact
--                has a stiffness along and across, friction, and a restitution; with feet the impacts act at the edges.
-- Source         Housner 1963; wall, tilt of .05 rad and both methods: P. J. S. Gomes (IST Lisbon), Fig. 2; xi and kn of method 2: Pena et al.
--                2005 as he prints them, eqs. (10), (12), (15)
-- How to run     erbs run scenes/studies/rocking_wall.lua [-D kn=1e11] [-D foot=0.008];  erbs calibrate scenes/studies/calibrate_wall.lua
-- What to look at  t_n: time of impact n; phi_n: greatest |theta| / alpha after impact n; slip: greatest slip over half the width; softening
local width, height, depth = param("width", 0.6, "[m]"), param("height", 3, "[m]"), param("depth", 4, "[m]")
local density, theta = param("density", 1800, "[kg/m3]"), param("theta", 0.05, "tilt at the start [rad]")
local kn, ks = param("kn", 1e10, "of the bed [Pa/m]"), param("ks", 0, "of the bed, 0: as kn [Pa/m]")
if ks == 0 then ks = kn end
local friction = param("friction", 0.577, "of the bed [-]")
local restitution = param("restitution", 1, "of the bed, 1: no damping [-]")
local xi = param("xi", -1, "damping ratio, instead of the restitution: exp(-pi xi / sqrt(1 - xi^2)); -1: none is given [-]")
local foot = param("foot", 0, "width of a foot over that of the wall; 0: the whole face stands on the bed [-]")
local impacts = 6
if xi >= 0 then restitution = xi < 1 and math.exp(-math.pi * xi / math.sqrt(1 - xi ^ 2)) or 0 end

local theory = rocking { width = width, height = height, theta = theta, duration = 6, kn = kn, density = density, restitution = restitution }
local b = width / 2
material { name = "wall", density = density, kn = kn, ks = ks, friction = friction, restitution = restitution }
box { name = "base", material = "wall", fixed = true, size = { 4 * height, 1.5 * depth, 0.4 }, center = { 0, 0, -0.2 } }
local initial = { rotation = { 0, theta, 0 }, about = { b, 0, 0 } }
if foot > 0 then footed_block { name = "block", material = "wall", free = true, size = { width, depth, height }, foot = foot, initial = initial }
else box { name = "block", material = "wall", free = true, size = { width, depth, height }, at = { -b, -depth / 2, 0 }, initial = initial } end
recorder { name = "block", quantity = "rotation", block = "block", axis = "y" }
recorder { name = "left", quantity = "displacement", block = "block", axis = "x", point = { -b, 0, 0 } }
recorder { name = "right", quantity = "displacement", block = "block", axis = "x", point = { b, 0, 0 } }
analysis { duration = theory.impacts[impacts] + 1.2, start = "rest", output_dt = 1e-3, frame_dt = 0.05 }

-- Times of impacts, and the greatest |theta| / alpha before the first, between the first and the second, ...
local function swings(run)
  local turn, t, times, peaks, peak = run.history "block_ry_rad", run.time, {}, {}, 0
  for i = 1, #turn do
    if i > 1 and turn[i - 1] * turn[i] < 0 then
      times[#times + 1] = t[i - 1] + (t[i] - t[i - 1]) * turn[i - 1] / (turn[i - 1] - turn[i])
      peaks[#peaks + 1], peak = peak / theory.alpha, 0
    end
    peak = math.max(peak, math.abs(turn[i]))
  end
  peaks[#peaks + 1] = peak / theory.alpha
  return times, peaks
end
for n = 1, impacts do
  metric("t_" .. n, "s", function(run) return (swings(run))[n] end)
  metric("phi_" .. n, "", function(run)
    local _, peaks = swings(run)
    return peaks[n + 1]
  end)
end
-- The edge about which the wall turns stays in place, but for the toe; the other one moves back as the wall turns.
metric("slip", "", function(run)
  local left, right, turn, most = run.history "left_ux_rel_m", run.history "right_ux_rel_m", run.history "block_ry_rad", 0
  for i = 1, #turn do
    if math.abs(turn[i]) > 0.1 * theta then most = math.max(most, math.abs(turn[i] > 0 and right[i] or left[i])) end
  end
  return most / b
end)

-- What the toe of a flat bed takes off the static acceleration that overturns the wall.
metric("softening", "", 1 - theory.bed.threshold / theory.threshold)

-- Method 2 as it is printed, with k = 2 in mu^k, and without an exponent of the bracket: both were lost in print.
local p, mu, mass = theory.p, theory.mu, density * width * height * depth
local R = math.sqrt(width ^ 2 + height ^ 2) / 2
metric("pena_gamma", "N", mass * R * p ^ 2)                                                            -- (12)
metric("pena_xi", "", 2 * pi * p * (0.0045 * math.log(mass * R * p ^ 2 / mu ^ 2) - 0.0238))            -- (15)
metric("pena_stiffness", "N/m", mass * p ^ 2)                                                          -- (10)
-- Taken in N/m it lets the block sink by g / p^2 = 4 R / 3, more than its width: a factor of the unit is missing in print.
metric("pena_settlement", "m", g / p ^ 2)
