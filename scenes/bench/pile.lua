-- A heap of falling bricks: contacts only
--
-- What happens   Bricks in a loose lattice, each slightly rotated, fall on each other and on the ground, with friction and impact losses.
-- How to run     erbs bench scenes/bench/pile.lua                 2,000 bricks
--                erbs run scenes/bench/pile.lua -D n=400 --video
-- What to look at  Touching pairs that one core evaluates per second.

local n = param("n", 2000, "bricks")
local per_row = math.ceil((n / 2.5) ^ (1 / 3))
material { name = "brick", density = 1800, friction = 0.6, restitution = 0.2 }
ground { z = 0, size = 40 }
local l, w, h = 0.3, 0.125, 0.1
local state = 16807
local function draw(low, high)  -- Park and Miller 1988
  state = 16807 * state % 2147483647
  return low + (high - low) * state / 2147483647
end
local gap = 0.035
for i = 0, n - 1 do
  local x, y, level = i % per_row, (i // per_row) % (2 * per_row), i // (2 * per_row * per_row)
  box {
    name = "b" .. i, size = { l, w, h }, center = { x * (l + gap), y * (w + gap), 0.08 + level * (h + gap) }, free = true,
    rotation = { draw(-0.1, 0.1), draw(-0.05, 0.05), draw(-0.1, 0.1) }, initial = { velocity = { 0, 0, -1 - 0.5 * level } },
  }
end
gravity(g)
analysis { duration = 2, start = "rest" }
