-- Hard case: a rain of bricks
--
-- What happens   Bricks in a loose lattice fall on each other and on the ground within some hundredths of a second. Their blows are thousands
--                of events at once, of which each errs by far less than one may. The step must be short while they last, and only then.
-- Source         Energy identity; event bound (engine/joints/event_bound.h)
-- How to run     erbs run scenes/hard/h32_rain_of_bricks.lua [-D n=3000] [-D kn=1e9] [-D speed=4]
-- What to look at  energy.residual_relative; `--profile` tells what held the step
local n, kn = param("n", 1500, "bricks"), param("kn", 5e10, "normal stiffness of contacts [Pa/m]")
local speed, mu = param("speed", 1, "of the lowest bricks at the start [m/s]"), param("mu", 0.6, "friction")
local restitution, duration = param("restitution", 0.2, ""), param("duration", 0.12, "[s]")
family({ n = { 100, 400, 3000 }, kn = { 1e9, 1e12 }, speed = { 0.2, 5 }, mu = { 0, 1 }, restitution = { 0, 0.8 } }, { combinations = 6 })
material { name = "brick", density = 1800, kn = kn, ks = 0.4 * kn, friction = mu, restitution = restitution }
ground { size = 40, material = "brick" }
local l, w, h, gap = 0.3, 0.125, 0.1, 0.04
local per_row = math.ceil((n / 2.5) ^ (1 / 3))
local state = 16807
local function draw(low, high)  -- Park and Miller 1988
  state = 16807 * state % 2147483647
  return low + (high - low) * state / 2147483647
end
for i = 0, n - 1 do
  local x, y, level = i % per_row, (i // per_row) % (2 * per_row), i // (2 * per_row * per_row)
  box {
    name = "b" .. i, size = { l, w, h }, center = { x * (l + gap), y * (w + gap), 0.08 + level * (h + gap) }, free = true,
    rotation = { draw(-0.1, 0.1), draw(-0.05, 0.05), draw(-0.1, 0.1) }, initial = { velocity = { 0, 0, -speed - 0.5 * level } },
  }
end
gravity(g)
analysis { duration = duration, start = "rest" }
expect("energy.residual_relative", 1e-3, { below = true, source = "ledger; 1.14e-3 where the errors of all blows were added up for good" })
expect("max_penetration_relative", 0.3, { below = true, source = "no brick sinks into another" })
