-- Bricks fall onto a plate and pile up
--
-- What happens   Twelve bricks fall from small heights, turned at random, onto the ground and onto each other.
-- How to run     erbs test scenes/pictures
-- What to look at  The heap at 0.32 s, when the bricks of two layers have hit each other; speed by color.
material { name = "brick", density = 1800, friction = 0.6, restitution = 0.2, kn = 1e9 }
ground { z = 0, size = 3, material = "brick" }
gravity(g)
for i = 0, 11 do
  local x, y, layer = i % 2, i // 2 % 2, i // 4
  box { free = true, group = "bricks", size = { 0.24, 0.115, 0.071 }, center = { 0.3 * x - 0.15, 0.3 * y - 0.15 + 0.02 * layer, 0.2 + 0.3 * layer },
    initial = { rotation = { 0.3 * i, 0.2 * i, 0.5 * i } } }
end
analysis { duration = 0.5 }
camera { name = "corner", eye = { 1.2, -1.5, 1.1 }, target = { 0, 0, 0.2 } }

-- Blows multiply the least difference of bits, but only a few have happened by then.
expect_image("corner", 0.2, { pixels = 0.003, ssim = 0.99, color = "speed", source = "drivers round edges differently" })
expect_image("corner", 0.32, { pixels = 0.02, ssim = 0.96, color = "speed", source = "blows multiply differences of bits" })
