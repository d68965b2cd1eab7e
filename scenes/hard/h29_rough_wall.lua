-- Hard case: a dry wall of rough stones, shaken until stones slide, ride up on their asperities, open and fall
--
-- What happens   Joints of dilatant{} at default settings: uplift, reversal, wear, opening, tipping and release to contact all occur.
-- Source         Energy identity; uplift takes less than the work of friction (V47 has the closed form of one bed).
-- How to run     erbs run scenes/hard/h29_rough_wall.lua [-D pga=2*g] [-D psi=30*deg] [-D across=1]
-- What to look at  energy.residual_relative, energy.friction_J, max_penetration_relative.
local pga, frequency = param("pga", 1.2 * g, "[m/s2]"), param("frequency", 3, "[Hz]")
local psi, wear = param("psi", 12 * deg, "dilation angle [rad]"), param("wear", 5 * mm, "slip that wears the asperities off [m]")
local kn, across = param("kn", 1e10, "[Pa/m]"), param("across", 0, "1: shaken across the wall")
family({ pga = { 0.3 * g, 2.5 * g }, psi = { 0, 30 * deg }, wear = { 1 * mm, 20 * mm }, kn = { 1e9, 1e11 }, across = { 1 } }, { combinations = 6 })
material { name = "stone", density = 2200, friction = 0.6 }
ground { size = 60, material = "stone" }
for row = 0, 5 do
  for i = 0, 3 do
    box { name = "s" .. row .. "_" .. i, size = { 0.4, 0.2, 0.2 }, at = { 0.4 * i + (row % 2) * 0.2, 0, 0.2 * row }, material = "stone" }
  end
end
joint { law = dilatant { kn = kn, mu = 0.6, psi = psi, wear_slip = wear } }
ground_motion { wave = sine { amplitude = pga, frequency = frequency, duration = 2 }, direction = across > 0 and "y" or "x" }
analysis { duration = 3 }
-- The tolerance of a collapse is 1e-2; what slides, opens and lands a hundred times may leave a tenth of it.
expect("energy.residual_relative", 1e-3, { below = true, source = "ledger" })
expect("energy.friction_J", 0, { above = true, source = "sliding dissipates: tan(psi) < mu" })
expect("max_penetration_relative", 0.1, { below = true, source = "no block sinks into another" })
expect("momentum_residual", 1e-8, { below = true, source = "joints and contacts conserve momentum" })
