-- Hard case: a fast body hits a thin one
--
-- What happens   A brick of 10 kg strikes a slab of 20 mm at 20 m/s: flat, on an edge, on a corner and askew. The slab is fixed or lies
--                free on two supports. No body passes through another, and the brick rebounds no faster than it came.
-- Source         the inner distance turns over at half the thickness; energy
-- How to run     erbs run scenes/hard/h21_fast_impact.lua [-D speed=40] [-D fraction=0.9]
-- What to look at  max_penetration_relative, through_*, energy.residual_relative
-- Tolerance      the deepest corner reaches 15 mm at kn = 1e11 Pa/m, 3/4 of the slab; 4 mm at the 1e13 used here
label("quick")
local speed = param("speed", 20, "[m/s]")
local fraction = param("fraction", 0.5, "of the step's bound")
local kn = param("kn", 1e13, "[Pa/m]")
gravity(0)
local size = { 0.3, 0.2, 0.1 }
material { name = "brick", density = 10 / (size[1] * size[2] * size[3]), kn = kn, ks = 0.4 * kn, friction = 0.5, restitution = 1 }
material { name = "slab", density = 2400, kn = kn, ks = 0.4 * kn, friction = 0.5, restitution = 1 }
local poses = { flat = { 0, 0, 0 }, edge = { pi / 4, 0, 0 }, corner = { 0.7, 0.6, 0.2 }, skew = { 0.01, 0.02, 0.3 } }
for _, name in ipairs { "flat", "edge", "corner", "skew" } do
  for i, loose in ipairs { false, true } do
    local it, y = name .. (loose and "_loose" or "_fixed"), 10 * i
    local x = ({ flat = 0, edge = 5, corner = 10, skew = 15 })[name]
    box { name = it .. "_slab", material = "slab", size = { 2, 2, 0.02 }, center = { x, y, -0.01 }, fixed = not loose, free = loose }
    if loose then
      for k = -1, 1, 2 do box { name = it .. "_support" .. k, material = "slab", size = { 0.2, 2, 0.2 }, center = { x + 0.9 * k, y, -0.12 }, fixed = true } end
    end
    box { name = it, material = "brick", size = size, center = { x + 0.013, y + 0.017, 0.25 }, free = true,
      initial = { rotation = poses[name], velocity = { 0, 0, -speed } } }
    for _, part in ipairs { it, it .. "_slab" } do recorder { name = part, quantity = "displacement", block = part, axis = "z" } end
    metric("through_" .. it, "", function(run)  -- least height of the brick's centre over that of the slab; a brick that is half through would have less
      local a, b, least = run.history(it .. "_uz_rel_m"), run.history(it .. "_slab_uz_rel_m"), 1
      for k = 1, #a do least = math.min(least, 0.25 + a[k] - b[k]) end
      return least
    end)
    expect("metrics.through_" .. it, 0.04, { above = true, source = "half its least thickness, less a quarter of the slab's and more" })
  end
end
analysis { duration = 0.03, dt_fraction = fraction, start = "rest", output_dt = 1e-4, frame_dt = 0.03 }
expect("max_penetration_relative", 0.25, { below = true, source = "of the slab's thickness" })
expect("energy.residual_relative", 1e-2, { below = true, source = "gate" })
