-- V22 at the default time step: bricks rebound with the given restitution
--
-- What happens   Bricks fall flat on the ground, each with its own restitution, and pairs of them meet head on, all at the default step.
-- Source         As v22_central_collision. An impact of low restitution needs a stronger dashpot than an explicit step at the limit can
--                bear. The returned energy then depends on where in a step the impact begins. So the step is shortened before the impact,
--                by the energy that may be in error (engine/joints/event_bound.h): every restitution comes out as given.
-- How to run     erbs run scenes/verify/v22_restitution_at_the_step.lua [-D kn=...] [-D height=...]
-- What to look at  falls_*, meets_*: restitutions
local kn = param("kn", 5e10, "[Pa/m]")
local height = param("height", 0.3, "of the fall [m]")
local size = { 0.3, 0.125, 0.1 }
gravity(g)
material { name = "soil", density = 2000, kn = kn, ks = 0.4 * kn, restitution = 1 }
ground { size = 60, material = "soil" }
local hit, place = math.sqrt(2 * height / g), 0
for _, e in ipairs { 0.05, 0.2, 0.25, 0.5, 0.8 } do
  local name = ("e%03d"):format(math.floor(100 * e + 0.5))
  material { name = name, density = 1800, kn = kn, ks = 0.4 * kn, restitution = e, friction = 0 }
  place = place + 2
  box { name = "falls_" .. name, size = size, at = { place, 0, height }, material = name, free = true }
  recorder { name = "falls_" .. name, quantity = "velocity", block = "falls_" .. name, axis = "z" }
  metric("falls_" .. name, "", function(run) return (run.at("falls_" .. name .. "_vz_rel_m_s", 1.1 * hit) + 0.1 * g * hit) / (g * hit) end)
  for _, sign in ipairs { -1, 1 } do
    box { name = ("meets_%s_%d"):format(name, sign), size = size, center = { place, 6 + sign * (size[2] / 2 + 0.01), 40 }, material = name, free = true,
      initial = { velocity = { 0, -sign, 0 } } }
    recorder { name = ("meets_%s_%d"):format(name, sign), quantity = "velocity", block = ("meets_%s_%d"):format(name, sign), axis = "y" }
  end
  metric("meets_" .. name, "", function(run) return (run.at(("meets_%s_1_vy_rel_m_s"):format(name), hit) - run.at(("meets_%s_-1_vy_rel_m_s"):format(name), hit)) / 2 end)
  for _, kind in ipairs { "falls", "meets" } do
    expect(("metrics.%s_%s"):format(kind, name), e, { abs = 0.01, source = "as asked for; the step's own error of a blow" })
  end
end
analysis { duration = 1.2 * hit, start = "rest", output_dt = hit / 1000, frame_dt = 1 }
expect("energy.residual_relative", 1e-3, { below = true, source = "each blow errs by 1e-4 of what passed at most" })
