-- V04, the other side: without the gyroscopic term (scalar Euler equation of Gu and Miao, eq. (1)) the brick never flips.
--
-- What happens   The brick of v04_dzhanibekov.lua keeps its spin in the body for ever. The option exists for comparison only.
-- How to run     erbs run scenes/verify/v04_without_gyroscopic.lua
-- What to look at  smallest_spin: the component about the middle axis of the world keeps its initial value.
label("quick")
local spin = param("spin", 10, "about the middle axis [rad/s]")
local nudge = param("nudge", 0.05, "about the other two [rad/s]")
gravity(0)
material { name = "brick", density = 1900 }
box { name = "brick", size = { 0.30, 0.125, 0.10 }, center = { 0, 0, 0 }, free = true, initial = { spin = { nudge, spin, nudge } } }
recorder { name = "brick", quantity = "spin", block = "brick" }
analysis { duration = 20, dt = 5e-4, start = "rest", gyroscopic = false, energy_gate = 1 }
metric("smallest_spin", "rad/s", function(run) return run.min("brick_wy_rad_s") end)
-- The spin is constant in the body and, since the body rotates about it, in the world; only the interpolation of half steps remains.
expect("metrics.smallest_spin", spin, { rel = 1e-9, source = "I w' = 0" })
