-- V67: a heavy block that lands on a light one loses its energy in the contacts on both sides of it
--
-- What happens   A heavy block flies without gravity at a light one that touches a wall. Both contacts bear the same force, and the blow
--                lasts as the heavy block swings on them. It asks for a dashpot far stronger than a step bears for the light block alone.
--                Capped at that, the blow lost next to nothing: at default settings .85 of the speed was left, .98 behind a light plate.
-- Source         Hunt and Crossley 1975 for a light block without mass: each contact closes at half the speed, so that a restitution e of
--                either becomes that of half the factor X, X - ln(1 + X) = -e X - ln(1 - e X).
-- How to run     erbs run scenes/verify/v67_blow_through_a_light_block.lua [-D restitution=.5] [-D width=.5] [-D speed=10]
-- What to look at  metrics.over_paper: what lags behind the blow (`begin_lag()` in `engine/contact/law/pair_law.h`) leaves somewhat more or
--                less of the speed than on paper: at most .1, at any step.
label("quick")
local e, speed, kn = param("restitution", 0.3), param("speed", 1.4, "[m/s]"), param("kn", 5e10, "[Pa/m]")
local width, thickness, heavy = param("width", 0.2, "[m]"), param("thickness", 0.1, "[m]"), param("heavy", 1, "side of the heavy block [m]")
local turn = param("turn", 0, "[degrees] of the way from x")
family({ restitution = { 0.05, 0.5, 0.8 }, speed = { 0.1, 10 }, kn = { 1e10, 1e12 }, width = { 0.15, 0.3, 1.2 }, thickness = { 0.03 },
  heavy = { 0.5, 0.7 }, turn = { 30, 90 } }, { combinations = 16 })

local function balance(X, left) return X - math.log(1 + X) + left * X + math.log(1 - left * X) end
local function root(f, low, high)
  for _ = 1, 200 do
    local middle = (low + high) / 2
    if f(middle) > 0 then low = middle else high = middle end
  end
  return low
end
local X = root(function(x) return balance(x, e) end, 1e-6, 1 / e)
local paper = root(function(left) return balance(X / 2, left) end, 1e-9, math.min(1, 2 / X))

gravity(0)
material { name = "stone", density = 2000, restitution = e, kn = kn, ks = 0.4 * kn }
local mass, area = 2000 * heavy ^ 3, math.min(width, heavy) ^ 2
local blow, gap = math.pi * math.sqrt(2 * mass / (kn * area)), 0.01 * speed
transform { rotation = { 0, 0, turn * deg }, function()
  box { name = "wall", size = { 0.5, 3, 3 }, center = { -0.25, 0, 0 }, fixed = true }
  box { name = "light", size = { thickness, width, width }, center = { thickness / 2, 0, 0 }, free = true }
  box { name = "heavy", size = { heavy, heavy, heavy }, center = { thickness + gap + heavy / 2, 0, 0 }, free = true,
    initial = { velocity = { -speed, 0, 0 } } }
end }
recorder { name = "heavy", quantity = "velocity", block = "heavy" }
local duration = gap / speed + 5 * blow
analysis { duration = duration, output_dt = duration / 200, frame_dt = duration, start = "rest" }
local function left(run)
  return (run.last "heavy_vx_rel_m_s" * math.cos(turn * deg) + run.last "heavy_vy_rel_m_s" * math.sin(turn * deg)) / speed
end
metric("left", "", left)
metric("over_paper", "", function(run) return left(run) - paper end)
expect("metrics.over_paper", 0, { abs = 0.1, source = "Hunt and Crossley" })
expect("energy.residual_relative", 1e-3, { below = true, source = "gate" })
