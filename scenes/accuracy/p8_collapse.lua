-- P8: time of collapse of a wall, as a statistic of twins.
--
-- What happens   The ground rocks a dry wall of 22 bricks across its plane at 2 Hz until it falls. Twins, twenty by default, are laid with
--                other errors of a thousandth. A single run cannot be compared; mean and scatter of the time at which a twentieth of the
--                mass has fallen can.
-- Source         No number on paper: the reference is the mean of the most twins, uncertain by its standard error.
-- How to run     erbs accuracy scenes/accuracy/p8_collapse.lua
-- What to look at  The number of twins is the knob: the standard error falls with its root.
label("coarse_study", "quality_only")
local seed, noise = param("seed", 1, "of the errors of laying"), param("noise", 1e-3, "[rad]")
local twins = param("twins", 20, "runs of the ensemble")
accuracy { param = "twins", values = { 5, 20, 80 }, error = "time_error" }
local t = 0
material { name = "brick", density = 1800, friction = 0.6, kn = 1e8, ks = 4e7 }
ground { size = 6 }
local l, w, h, courses, bricks = 300 * mm, 125 * mm, 100 * mm, 6, 3
local state = math.floor(seed) % 2147483647 + 1
local function slant()
  state = state * 48271 % 2147483647
  return noise * (2 * state / 2147483647 - 1)
end
local count, blocks = 0, {}
for course = 0, courses - 1 do
  local x, z = -bricks * (l + t) / 2, t + course * (h + t)
  local half = course % 2 == 1
  for i = 0, half and bricks or bricks - 1 do
    local length = half and (i == 0 or i == bricks) and (l - t) / 2 or l
    count = count + 1
    blocks[count] = "brick" .. count
    box { name = blocks[count], group = "wall", size = { length, w, h }, at = { x, -w / 2, z }, initial = { rotation = { slant(), slant(), slant() } } }
    x = x + length + t
  end
end
joint { law = dry { kn = 1e8, ks = 4e7, mu = 0.6 } }
ground_motion { wave = sine { amplitude = param("pga", 0.4 * g), frequency = 2, duration = 2 }, direction = "y" }
analysis { duration = 2.5, dt_fraction = 0.25, output_dt = 1e-3, frame_dt = 1, start = "rest", stop_after_collapse = 0, energy_gate = 1 }
ensemble { n = twins, seed = 1, name = "time", value = function(run) return run.collapse.time_s end }
