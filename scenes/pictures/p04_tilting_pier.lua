-- A dry pier on a tilting table
--
-- What happens   Gravity turns by 25 degrees within 1.2 s, as on a table that tilts. The dry pier overturns at its edge.
-- How to run     erbs test scenes/pictures
-- What to look at  The picture shows the table tilted, the arrow of gravity, and the angle in the strip.
material { name = "stone", density = 2400, friction = 0.8, restitution = 0.2 }
ground { z = 0, size = 4, material = "stone" }
joint { law = dry { kn = 5e9, ks = 2e9, mu = 0.8 } }
for i = 0, 5 do box { group = "pier", size = { 0.2, 0.3, 0.15 }, at = { 0, 0, i * 0.15 }, material = "stone" } end
tilt { wave = table_wave { times = { 0, 1.2 }, values = { 0, -25 * deg }, hold = true }, axis = "y" }
gravity(g)
analysis { duration = 1.7 }
camera { name = "side", eye = { 0.6, -3.4, 0.9 }, target = { 0.1, 0, 0.5 } }

-- One body turns about one edge: only the drawing of edges differs between drivers.
expect_image("side", 1.1, { pixels = 0.003, ssim = 0.99, source = "drivers round edges differently" })
expect_image("side", 1.6, { pixels = 0.003, ssim = 0.99, source = "drivers round edges differently" })
