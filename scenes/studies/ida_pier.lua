-- A mortared pier under one recorded ground motion, for the study ida_records.lua
--
-- What happens   A pier of mortared blocks stands on shaking ground. Its bed joints crack, it rocks on them, and it may fall.
-- Source         A case for incremental dynamic analysis (Vamvatsikos and Cornell 2002); the numbers are invented.
-- How to run     erbs run scenes/studies/ida_pier.lua -D pga=0.5*g [-D motion='"NAME.AT2"' --allow FOLDER]
-- What to look at  metrics.drift: largest displacement of the top over the height; metrics.sa_t1; collapse.collapsed
local motion, pga = param("motion", "elcentro_1940_ns.csv"), param("pga", 0.4 * g, "peak acceleration [m/s2]")
local seed, cv = param("seed", 1, "of the strengths of the joints"), param("cv", 0.3, "scatter of the bond [-]")
local width, height, n = param("width", 0.30, "[m]"), param("height", 1.6, "[m]"), 4

material { name = "brick", density = 1800, kn = 5e9, friction = 0.6, restitution = 0.2 }
box { name = "ground", size = { 6, 3, 0.3 }, at = { -3, -1.5, -0.3 }, fixed = true, material = "brick" }
for i = 1, n do
  box { name = "course" .. i, size = { width, width, height / n }, at = { -width / 2, -width / 2, (i - 1) * height / n }, material = "brick" }
end
joint { law = mortar { kn = 5e9, ft = 0.05 * MPa, c = 0.1 * MPa, mu = 0.6, Gf1 = 5, Gf2 = 20, damping = 0.2,
  scatter = { cv = cv, length = 0, seed = seed } } }

local file = motion == "elcentro_1940_ns.csv" and "records/" .. motion or motion
local wave = record { file = file, peak = pga }
ground_motion { wave = wave, direction = "x" }
recorder { name = "top", quantity = "displacement", block = "course" .. n, axis = "x" }
-- The last record ends at 54 s; a pier that still stands after 20 s has seen the strong part of all of them.
analysis { duration = param("duration", 20, "[s]"), stop_after_collapse = 0.01, frame_dt = 1 }
-- T1 of the free rocking of a slender block at half its capacity (Housner 1963, eq. 8): 4 / p arcosh(1 / (1 - .5)).
local p = math.sqrt(3 * g / (2 * math.sqrt(width ^ 2 + height ^ 2)))
metric("sa_t1", "m/s2", spectral_acceleration { wave = wave, period = 4 / p * math.log(2 + math.sqrt(3)), damping = 0.05 })
metric("drift", "", function(run) return run.peak("top_ux_rel_m") / height end)
