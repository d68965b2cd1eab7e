-- Hard case: a bonded fragment falls on loose bricks and squeezes them against the ground, with two levels of time
--
-- What happens   Six loose bricks lie on the ground, a little tilted. A column of bonded bricks, up to fifty times as heavy as one of them,
--                falls on them. Each of these bricks bears a fast contact above and a slow one below, both far larger than their sum.
-- Source         Energy identity: an impulse of a slow force F over an interval H errs by F^2 H^2 / (8 m) (engine/model/levels.h). With
--                levels = 1 all forces act in every step.
-- How to run     erbs run scenes/hard/h33_fragment_on_bricks.lua [-D levels=1] [-D scale=2] [-D fall=1]
-- What to look at  energy.residual_relative: up to 8e-2 (levels = 6) where the sum of all forces on a brick chose its interval, not its slow forces.
local levels = param("levels", 4, "time levels of contacts")
local kn = param("kn", 4e9, "normal stiffness of contacts [Pa/m]")
local bed = param("bed", 2e12, "normal stiffness of mortar beds [Pa/m]")
local scale = param("scale", 1.5, "size of the bricks of the fragment over that of the others")
local fall, tilt = param("fall", 0.5, "[m]"), param("tilt", 0.01, "of the fragment [rad]")
local restitution = param("restitution", 0.4, "")
family({ levels = { 2, 3, 6 }, kn = { 1e9, 2e10 }, bed = { 2e11, 1e13 }, scale = { 1, 2.5 }, fall = { 0.1, 1.5 }, tilt = { 0, 0.1 }, restitution = { 0.1, 0.8 } }, { combinations = 12 })
material { name = "brick", density = 1800, friction = 0.5, restitution = restitution, kn = kn, ks = 0.4 * kn }
ground { size = 60, material = "brick" }
local size = { 0.3, 0.125, 0.1 }
for k = 0, 5 do
  box {
    name = "loose" .. k, size = { 0.3, 0.12, 0.09 }, center = { 0.4 * (k % 2) - 0.2, 0.22 * (k // 2 - 1), 0.07 },
    rotation = { 0.02 * math.sin(1 + 3 * k), 0.02 * math.cos(2 * k), 0.03 * math.sin(5 * k) }, free = true,
  }
end
local length, height, bricks = scale * size[1], scale * size[3], 3
transform {
  at = { 0.05, 0, 0.17 + bricks * height / 2 + tilt * length + fall }, rotation = { 0.3 * tilt, tilt, 0.2 },
  function()
    for i = 1, bricks do
      box { name = "fragment" .. i, group = "fragment", size = { length, scale * size[2], height }, center = { 0, 0, (i - (bricks + 1) / 2) * height }, free = true }
    end
  end,
}
joint { law = mortar { kn = bed, ks = 0.4 * bed, ft = 0.5 * MPa, c = 0.75 * MPa, mu = 0.6 }, between = { "fragment", "fragment" } }
gravity(g)
analysis { duration = math.sqrt(2 * fall / g) + 0.15, start = "rest", levels = levels }
expect("energy.residual_relative", 1e-3, { below = true, source = "ledger; 7.3e-4 at most over the family" })
expect("momentum_residual", 1e-8, { below = true, source = "joints and contacts conserve momentum" })
