-- Hard case: a box or a prism falls on an edge and slaps down, while it stays a little tilted across its spin
--
-- What happens   A box comes down on a corner of its edge. First the edge lands, then the face, and neither quite flat: the pressed strip
--                grows a hundredfold within a few steps. The faces beside the edge of a hexagon are 30 degrees from flat meanwhile.
-- Source         Energy identity. The corners that come down next tell how much of the face presses and when (`foresee()`, impact_bound.cpp).
-- How to run     erbs run scenes/hard/m11_tilted_slap.lua [-D roll=0.3] [-D tilt=0.01] [-D fall=0.05] [-D height=0.5] [-D sides=6]
-- What to look at  energy.residual_relative: up to 5.9e-3 where only the turn of the face in the plane of its tilt was foreseen, and 1.8e-3 (of
--                a hexagonal column that topples 3e-2) where edges of bodies with more than eight corners were not.
local roll = param("roll", 0.3, "about the edge [rad]")
local tilt = param("tilt", 0.01, "along the edge [rad]")
local fall = param("fall", 0.05, "of the lowest corner [m]")
local length, width, height = param("length", 1, "[m]"), param("width", 1, "[m]"), param("height", 0.5, "[m]")
local sides = param("sides", 0, "0: a box, else a prism of so many sides, an edge down at the roll 0")
local kn = param("kn", 1e10, "[Pa/m]")
local friction, restitution = param("friction", 0.6, ""), param("restitution", 0.3, "")
family({ roll = { 0, 0.05, 0.6, 0.9 }, tilt = { 0, 0.001, 0.03, 0.15, 0.4 }, fall = { 0.01, 0.3 }, width = { 0.1, 0.4 }, height = { 0.1, 1.5 }, length = { 0.2, 2 },
  sides = { 5, 6, 7 }, kn = { 1e9, 1e11, 1e12 }, friction = { 0, 1 }, restitution = { 0.05, 0.9 } }, { combinations = 24 })
material { name = "stone", density = 2000, kn = kn, ks = 0.4 * kn, friction = friction, restitution = restitution }
ground { size = 40 }
local angle = math.sqrt(roll ^ 2 + tilt ^ 2)
local x, y = angle > 0 and roll / angle or 0, angle > 0 and tilt / angle or 0
local sine, versine = math.sin(angle), 1 - math.cos(angle)
local polygon, low = {}, 0
if sides == 0 then polygon = { { -width / 2, -height / 2 }, { width / 2, -height / 2 }, { width / 2, height / 2 }, { -width / 2, height / 2 } } end
for i = 1, sides do
  local at = 2 * pi * i / sides
  polygon[i] = { math.sin(at) * width / 2, -math.cos(at) * height / 2 }
end
for _, corner in ipairs(polygon) do  -- of the rotation vector (roll, tilt, 0) by Rodrigues' formula
  local above = x * sine * corner[1] + (1 - (x ^ 2 + y ^ 2) * versine) * corner[2]
  low = math.max(low, math.abs(y * sine) * length / 2 - above)
end
prism { name = "block", axis = "x", height = length, polygon = polygon, at = { -length / 2, 0, low + fall },
  rotation = { roll, tilt, 0 }, free = true }
analysis { duration = math.sqrt(2 * fall / g) + 4 * math.sqrt(math.max(length, width, height) / g), frame_dt = 1 }
expect("energy.residual_relative", 1e-3, { below = true, source = "nothing is made, nothing lost unbooked" })
expect("momentum_residual", 1e-8, { below = true, source = "contacts conserve momentum" })
