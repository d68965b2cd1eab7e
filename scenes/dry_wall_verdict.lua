-- Does a dry wall stand? The share of twins that fall, over the peak acceleration of the ground
--
-- What happens   A dry wall of 0.30 x 0.125 x 0.10 m bricks, 25 courses, h/t = 20, is shaken across its plane by 2 Hz for 4 s. The
--                amplitude grows during the first 0.5 s. One run says little, so twins start with tiny displacements: each run is one draw
--                of many.
-- Source         The verdicts of other codes on this wall change with their time steps. Metric `rigid_falls_at` is the time at which a
--                rigid wall of the same outline falls by Housner's equation.
-- How to run     erbs run scenes/dry_wall_verdict.lua -D twins=20 [-D peak=0.25*g] [-D damping=0.5] [-D corners=1] [--dt-fraction 0.3]
-- What to look at  falls_mean, the share that has fallen; tests/bench/README.md has the table.
local peak, dashpots = param("peak", 0.3 * g, "[m/s2]"), param("damping", 0.3, "of the dry joints")
local bricks, courses = param("bricks", 10, "in a course; the length of the wall matters little"), param("courses", 25, "")
local twins, seed = param("twins", 0, "runs of an ensemble"), param("seed", 0, "of a twin")
local kn, mu, ramp = param("kn", 5e9, "of joints and contacts [Pa/m]"), param("mu", 0.6, "friction"), param("ramp", 0.5, "of the amplitude [s]")
local corners = param("corners", 0, "1: faces bear at their four corners alone")
local mass_ratio = param("mass_ratio", 0, "damping by mass, of critical at 2 Hz, as codes have it that damp what moves")
local t = 0.125

material { name = "brick", density = 1800, friction = mu, restitution = 0.3, kn = kn, ks = 0.4 * kn }
-- 1e-6 m: far above round-off and far below the accuracy of a mason
local hair = 1e-6 * math.sin(12.9898 * seed)
transform { at = { hair, hair, 0 }, rotation = { 0, 0, hair }, function()
  wall { length = bricks * 0.3, courses = courses, brick = { length = 0.3, width = t, height = 0.1 }, joint = 0, base = { thickness = 0.1, margin = 0.1 }, quiet = true }
end }
if corners == 1 then joint { law = dry { kn = kn, mu = mu, damping = dashpots }, points = { 2, 2 }, rule = "trapezoid" }
else joint { law = dry { kn = kn, mu = mu, damping = dashpots } } end
if mass_ratio > 0 then damping { mass = 2 * mass_ratio * 2 * pi * 2 } end
local function shaking(time) return peak * math.min(1, time / ramp) * math.sin(4 * pi * time) * (time < 4 and 1 or 0) end
ground_motion { direction = "y", wave = shaking }
local duration = param("duration", 5, "[s]")
local rigid = rocking { width = t, height = courses * 0.1, wave = shaking, duration = duration }
metric("rigid_falls_at", "s", rigid.overturned and rigid.overturned_at or -1)  -- -1: it stands
analysis { duration = duration, frame_dt = 0.05, stop_after_collapse = 0.1 }
metric("fell", "", function(run) return run.collapse.collapsed and 1 or 0 end)
if twins > 0 then ensemble { n = twins, seed = 1, name = "falls", value = function(run) return run.collapse.collapsed and 1 or 0 end } end
