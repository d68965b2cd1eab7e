-- Hard case: a dry arch comes to rest after a bump
--
-- What happens   The abutments of a round dry arch drop for 50 ms. Its voussoirs separate, hop and settle; then nothing moves any more.
-- Source         An arch thicker than 0.1075 of its radius stands under its own weight (Milankovitch); below the angle of friction joints
--                stick.
-- How to run     erbs run scenes/hard/m05_arch_after_bump.lua [-D voussoirs=21] [-D thickness=0.3] [-D kn=...] [-D sideways=1]
-- What to look at  drift (of the radius, per second, in the last half second; 0: all have come to rest, or swing to rest about a place that stays), sag of the crown (m), energy.residual_relative.
local voussoirs, radius, thickness = param("voussoirs", 11, ""), param("radius", 1, "[m]"), param("thickness", 0.2, "of the radius")
local kn, mu = param("kn", 1e10, "[Pa/m]"), param("mu", 0.6, "")
local amplitude, sideways = param("amplitude", 1.2 * g, "[m/s2]"), param("sideways", 0, "1: the bump comes sideways")
local rest = param("rest", 3, "after the bump [s]; looked at from 2 s on. Dashpots in proportion to stiffness let a soft arch swing on, by 1 / kn")
family({ voussoirs = { 5, 7, 21, 31 }, radius = { 0.3, 4 }, thickness = { 0.15, 0.3 }, kn = { 1e9, 1e11, 1e12 }, mu = { 0.4, 1 }, sideways = { 1 } }, { combinations = 8 })
material { name = "stone", density = 2000, friction = mu }
local made = arch { name = "arch", radius = radius, thickness = thickness * radius, width = 0.3, voussoirs = voussoirs, embrace = param("embrace", 150, "[deg]") * deg }
joint { law = dry { kn = kn, mu = mu } }
ground_motion { wave = half_sine { amplitude = sideways == 1 and 0.2 * amplitude or -amplitude, frequency = 10, start = 0.1 }, direction = sideways == 1 and "x" or "z" }
for _, name in ipairs(made.blocks) do recorder { name = name, quantity = "displacement", block = name } end
local drift = include "parts/walk.lua"
metric("drift", "1/s", function(run) return drift(run, made.blocks, 0.5) / radius end)
metric("sag", "m", function(run) return -run.last(made.blocks[math.ceil(voussoirs / 2)] .. "_uz_rel_m") end)
analysis { duration = 0.15 + rest, output_dt = 5e-3, frame_dt = 1 }
expect("collapse.collapsed", false)
expect("metrics.drift", 1e-6, { below = true, source = "an arch that stands sticks" })
expect("energy.residual_relative", 1e-3, { below = true, source = "nothing is made" })
