-- V71: restitution of large and soft blocks, on a face, an edge or a corner
--
-- What happens   A block flies onto a plate, without gravity. Its contact is so soft that the blow lasts as long as contacts remember how
--                fast they were struck. A speed that is forgotten during the blow makes the dashpot too strong: .259 for .3 flat, .274 on the
--                corner of an octahedron.
-- Source         The restitution of the material: Hunt and Crossley's dashpot as for any stiffness and mass (V22).
-- How to run     erbs run scenes/verify/v71_soft_restitution.lua [-D side=10] [-D kn=1e8] [-D restitution=.5]
-- What to look at  metrics.restitution
label("quick")
local e, kn, speed = param("restitution", 0.3), param("kn", 1e9, "[Pa/m]"), param("speed", 1, "[m/s]")
local side, density = param("side", 5, "[m]"), param("density", 8000, "[kg/m3]")
local on = param("on", 0, "0: a face, 1: an edge, 2: a corner")
family({ on = { 1, 2 }, restitution = { 0.05, 0.1, 0.5, 0.8 }, kn = { 1e7, 1e8, 1e12 }, speed = { 0.1, 5 }, side = { 0.05, 0.5, 1 }, density = { 500, 2000 } },
  { combinations = 16 })

gravity(0)
material { name = "stone", density = density, kn = kn, ks = 0.4 * kn, restitution = e }
ground { size = 40 * side, depth = 4 * side, material = "stone" }
local half, rotation = side / 2, on == 1 and 45 * deg or 0
local lowest = on == 1 and half * math.sqrt(2) or half
local start = { velocity = { 0, -speed * math.sin(rotation), -speed * math.cos(rotation) } }  -- downwards, once rotated
transform { rotation = { rotation, 0, 0 }, at = { 0, 0, lowest + 0.01 * side }, function()
  if on == 2 then
    block { name = "block", vertices = { { half, 0, 0 }, { -half, 0, 0 }, { 0, half, 0 }, { 0, -half, 0 }, { 0, 0, half }, { 0, 0, -half } }, free = true, initial = start }
  else box { name = "block", size = { side, side, side }, center = { 0, 0, 0 }, free = true, initial = start } end
end }
recorder { name = "block", quantity = "velocity", block = "block", axis = "z" }
local duration = 0.02 * side / speed + (on > 0 and 800 or 12) * math.sqrt(density * side / kn)
analysis { duration = duration, output_dt = duration / 500, frame_dt = duration }
metric("restitution", "", function(run) return run.last "block_vz_rel_m_s" / speed end)
expect("metrics.restitution", e, { abs = 0.005, source = "as asked for" })
expect("energy.residual_relative", 1e-3, { below = true, source = "gate" })
