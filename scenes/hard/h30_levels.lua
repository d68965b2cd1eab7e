-- Hard case: a bonded fragment falls into soft debris beside a stiff wall, with two levels of time
--
-- What happens   Loose bricks lie in a heap against a wall of stiff mortar. A fragment of nine bonded bricks falls into them. Contacts of the
--                heap act once in several steps of the stiff joints; a pair on a block with joints acts as often as these.
-- Source         Energy identity (engine/model/levels.h); impulses of slow springs resonate with fast modes where the interval comes near a
--                multiple of half their period (Fong, Darve and Lew 2008). With levels = 1 all act in every step.
-- How to run     erbs run scenes/hard/h30_levels.lua [-D levels=1] [-D debris=1e8] [-D bed=1e10]
-- What to look at  energy.residual_relative, energy.kinetic_J at the end, log.txt for the number of pair forces.
local levels = param("levels", 4, "time levels of contacts")
local debris, bed = param("debris", 2e9, "normal stiffness of contacts [Pa/m]"), param("bed", 1e12, "normal stiffness of mortar beds [Pa/m]")
local ft = param("ft", 0.3 * MPa, "tensile strength of the mortar [Pa]")
family({ levels = { 2, 3, 6 }, debris = { 1e8, 5e10 }, bed = { 1e9, 1e11 }, ft = { 0.05 * MPa, 5 * MPa } }, { combinations = 6 })
material { name = "brick", density = 1800, friction = 0.6, restitution = 0.2, kn = debris, ks = 0.4 * debris }
ground { size = 40, material = "brick" }
local size = { 0.3, 0.125, 0.1 }
for row = 0, 5 do
  for i = 0, 2 do
    box { name = ("wall%d_%d"):format(row, i), size = size, center = { -0.4, 0.125 * (i - 1), 0.05 + 0.1 * row }, group = "wall" }
  end
end
for k = 0, 11 do
  box {
    name = "heap" .. k, size = size, center = { -0.06 + 0.35 * (k % 2), 0.19 * (k // 2 % 3 - 1), 0.07 + 0.16 * (k // 6) },
    rotation = { 0.03 * math.sin(k), 0.05 * math.cos(k), 0.1 * math.sin(2 * k) }, free = true,
  }
end
for row = 0, 2 do
  for i = 0, 2 do
    box {
      name = ("fragment%d_%d"):format(row, i), size = size, center = { 0.05, 0.125 * (i - 1), 0.65 + 0.1 * row }, group = "fragment",
      initial = { velocity = { -0.5, 0, -2 } },
    }
  end
end
joint { law = mortar { kn = bed, ks = 0.4 * bed, ft = ft, c = 1.5 * ft, mu = 0.6 }, between = { "wall", "wall" } }
joint { law = mortar { kn = bed, ks = 0.4 * bed, ft = ft, c = 1.5 * ft, mu = 0.6 }, between = { "fragment", "fragment" } }
joint { law = dry { kn = bed, mu = 0.6 } , between = { "wall", "ground" } }
gravity(g)
analysis { duration = 1, start = "rest", levels = levels }
expect("energy.residual_relative", 5e-4, { below = true, source = "ledger; 1.7e-4 at most over the family" })
expect("max_penetration_relative", 0.15, { below = true, source = "no block sinks into another" })
expect("momentum_residual", 1e-8, { below = true, source = "joints and contacts conserve momentum" })
