-- A dry wall falls across its plane
--
-- What happens   Twelve courses of dry bricks in running bond are pushed across their plane by a base that moves off. The wall falls.
-- How to run     erbs test scenes/pictures
-- What to look at  Colors tell the displacement. The wall turns about its base, and bricks of the top are ahead.
material { name = "brick", density = 1800, friction = 0.6, restitution = 0.2, kn = 5e9 }
ground { z = 0, size = 4, material = "brick" }
joint { law = dry { kn = 5e9, ks = 2e9, mu = 0.6 } }
wall { length = 1.2, courses = 12, brick = { length = 0.24, width = 0.115, height = 0.071 }, joint = 0, at = { -0.6, 0, 0 } }
ground_motion { wave = sine { amplitude = 0.6 * g, frequency = 1.2 * Hz }, direction = "y" }
analysis { duration = 0.8 }
camera { name = "corner", eye = { 1.7, 2.1, 1.3 }, target = { 0, -0.1, 0.4 } }

-- Sliding at many faces makes the fall depend on bits late in the run; 0.45 s is well before the bricks hit the ground.
expect_image("corner", 0.45, { pixels = 0.005, ssim = 0.985, color = "displacement", source = "sliding of many faces; drivers round edges" })
expect_stored("collapse.fallen_fraction", { abs = 0.02, source = "bricks near the limit of a fall" })
