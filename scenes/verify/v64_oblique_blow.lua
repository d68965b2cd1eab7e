-- V64: a plate that strikes the ground flat while it slides loses mu times the momentum of the blow along the ground
--
-- What happens   A thin plate flies into the ground without gravity, rebounds with the restitution, and slides all the while. The impact
--                dashpot presses at once, and the springs along the face wind up slowly: with them alone the blow takes .29 of its share at
--                restitution .05, .76 at .3 (slide = 2). So a dashpot brakes along the face as well.
-- Source         Coulomb, Newton's restitution: the speed along the ground falls by mu (1 + e) times the speed of approach
-- How to run     erbs run scenes/verify/v64_oblique_blow.lua [-D restitution=.05] [-D slide=1.5] [-D kn=1e12]
-- What to look at  metrics.friction_over_mu (.9 to 1 at slide = 1.5, where the springs turn before the blow is over), metrics.restitution
label("quick")
local mu, e = param("mu", 0.4), param("restitution", 0.1)
local kn, size, approach = param("kn", 5e10, "[Pa/m]"), param("size", 0.3, "[m]"), param("approach", 1, "[m/s]")
local slide, turn = param("slide", 3, "speed along the ground, over what the blow takes"), param("turn", 0, "[degrees] of the way from x")
family({ mu = { 0.2, 0.7 }, restitution = { 0.05, 0.3, 0.9 }, kn = { 1e9, 1e11, 1e12 }, size = { 0.05, 2 }, approach = { 0.1, 5 }, slide = { 2, 6 },
  turn = { 30, 90 } },
  { combinations = 16 })
local thickness, along = size / 30, { math.cos(turn * deg), math.sin(turn * deg) }
local speed = slide * mu * (1 + e) * approach
gravity(0)
material { name = "stone", density = 1800, friction = mu, restitution = e, kn = kn, ks = 0.4 * kn }
box { name = "ground", size = { 20, 20, 0.2 }, center = { 0, 0, -0.1 }, fixed = true }
box { name = "plate", size = { size, size, thickness }, center = { 0, 0, thickness / 2 + 1e-3 * approach }, free = true,
  initial = { velocity = { speed * along[1], speed * along[2], -approach } } }
recorder { name = "plate", quantity = "velocity", block = "plate" }
local blow = math.sqrt(1800 * thickness / kn)  -- s, one over the circular frequency of the plate on the ground
local duration = 1e-3 + 20 * blow
analysis { duration = duration, output_dt = duration / 100, frame_dt = duration, start = "rest" }
local function rebound(run) return run.last "plate_vz_rel_m_s" end
metric("restitution", "", function(run) return rebound(run) / approach end)
metric("friction_over_mu", "", function(run)
  local left = run.last "plate_vx_rel_m_s" * along[1] + run.last "plate_vy_rel_m_s" * along[2]
  return (speed - left) / (rebound(run) + approach) / mu
end)
expect("metrics.restitution", e, { abs = 0.05, source = "Newton" })
expect("metrics.friction_over_mu", 1, { abs = 0.02, source = "Coulomb" })
expect("energy.residual_relative", 1e-3, { below = true, source = "gate" })
