-- Hard case: small blocks meet fast in the air and part with the given restitution
--
-- What happens   Without gravity a block is thrown flat at another, at the default time step: from so near that the first step counts, and
--                from so far that the pair comes late into the list of neighbours. A step moves it by as much as the list sees.
-- Source         Newton's restitution; v22_restitution_at_the_step has falls of bricks.
-- How to run     erbs run scenes/hard/m09_thrown_blocks.lua [-D speed=40] [-D kn=1e11] [-D size=0.2]
-- What to look at  e_I: speed after over speed before the impact of pair I
label("quick")
local speed, size, kn = param("speed", 10, "[m/s]"), param("size", 0.05, "length of a block [m]"), param("kn", 1e9, "[Pa/m]")
family({ speed = { 2, 5, 20 }, size = { 0.05, 0.2, 1 }, kn = { 1e9, 1e10, 1e11, 1e12 } }, { combinations = 8 })
gravity(0)
local height, apart = 0.33 * size, { 0.0237, 0.0383, 0.1, 0.2213, 0.2779, 0.154 }
local last = 0.2779 / speed + 20 * math.sqrt(2000 * height / kn)
for i, gap in ipairs(apart) do
  local e = ({ 0.1, 0.8, 0.3 })[i % 3 + 1]
  local name = "stone" .. i
  material { name = name, density = 2000, kn = kn, ks = 0.4 * kn, friction = 0.6, restitution = e }
  for part, z in ipairs { 0, height + gap } do
    local block = ("block%d_%d"):format(i, part)
    box { name = block, material = name, size = { size, 0.42 * size, height }, center = { 5 * i * size, 0, z }, free = true,
      initial = { velocity = { 0, 0, part == 2 and -speed or 0 } } }
    recorder { name = block, quantity = "velocity", block = block, axis = "z" }
  end
  metric("e_" .. i, "", function(run)
    return (run.at(("block%d_2_vz_rel_m_s"):format(i), last) - run.at(("block%d_1_vz_rel_m_s"):format(i), last)) / speed
  end)
  expect("metrics.e_" .. i, e, { abs = 0.01, source = "as asked for; the step's own error of a blow" })
end
analysis { duration = 1.02 * last, start = "rest", output_dt = last / 200, frame_dt = 1 }
expect("energy.residual_relative", 1e-3, { below = true, source = "each blow errs by 1e-4 of what passed at most" })
