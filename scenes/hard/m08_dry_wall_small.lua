-- Hard case: a small dry wall shaken across its plane, with mirrored and rotated copies
--
-- What happens   About 60 dry bricks rock while the base moves across the wall for a few cycles. A copy that is mirrored, or rotated in
--                plan together with its ground motion, is the same wall: all copies must get one verdict.
-- Source         No direction is special (v26_objectivity, for structures that do not crack).
-- How to run     erbs run scenes/hard/m08_dry_wall_small.lua [-D copy=3] [-D pga=0.5*g] [-D kn=...]
-- What to look at  verdicts_least, verdicts_most (1: it falls), bow (m, largest displacement of the middle of the top),
--                energy.residual_relative.
local copy = param("copy", 1, "1 as it is, 2 mirrored, 3 turned by a quarter, 4 by 37 degrees, 5 by half")
local pga, frequency = param("pga", 0.3 * g, "[m/s2]"), param("frequency", 2, "[Hz]")
local kn, mu = param("kn", 5e9, "[Pa/m]"), param("mu", 0.6, "")
local courses, bricks, size = param("courses", 12, ""), param("bricks", 5, "in a course"), { 0.3, 0.125, 0.1 }
family({ pga = { 0.2 * g, 0.5 * g }, kn = { 1e9, 1e10 } }, { combinations = 0 })
local turn = ({ 0, 0, 90 * deg, 37 * deg, 180 * deg })[copy]
local hand = copy == 2 and -1 or 1
material { name = "brick", density = 1800, friction = mu, restitution = 0.2, kn = kn, ks = 0.4 * kn }
local blocks = {}
transform { rotation = { 0, 0, turn }, function()
  box { name = "base", size = { (bricks + 2) * size[1], 1, 0.2 }, center = { 0, 0, -0.1 }, fixed = true }
  for c = 1, courses do
    local from, stop = -bricks / 2 * size[1], bricks / 2 * size[1]
    local first = c % 2 == 0 and 0.5 or 1
    while from < stop - 1e-6 do
      local to = math.min(from + first * size[1], stop)
      first = 1
      blocks[#blocks + 1] = "b" .. #blocks
      box { name = blocks[#blocks], size = { to - from, size[2], size[3] }, center = { hand * (from + to) / 2, 0, (c - 0.5) * size[3] } }
      from = to
    end
  end
end }
joint { law = dry { kn = kn, mu = mu } }
local across = { -math.sin(turn), math.cos(turn), 0 }
ground_motion { wave = sine { amplitude = pga, frequency = frequency, duration = 2 / frequency }, direction = across }
recorder { name = "top", quantity = "displacement", block = blocks[#blocks - math.floor(bricks / 2)] }
metric("bow", "m", function(run)
  local most, x, y = 0, run.history "top_ux_rel_m", run.history "top_uy_rel_m"
  for i = 1, #x do most = math.max(most, math.abs(x[i] * across[1] + y[i] * across[2])) end
  return most
end)
analysis { duration = 2 / frequency + 0.6, output_dt = 5e-3, frame_dt = 1 }
converge { param = "copy", name = "verdicts", values = { 1, 2, 3, 4, 5 }, value = function(run) return run.collapse.collapsed and 1 or 0 end }
expect("metrics.verdicts_failed", 0, { abs = 0, source = "all run" })
metric("split", "", function(run)
  local all = run.metrics.metrics
  return all.verdicts_most and all.verdicts_most - all.verdicts_least  -- a run that was stopped has none
end)
expect("metrics.split", 0, { abs = 0, source = "one verdict" })
expect("energy.residual_relative", 1e-2, { below = true, source = "gate" })
