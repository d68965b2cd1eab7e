-- V06: blocks at 0.9 of the angle of friction do not creep for a minute.
--
-- What happens   Dry joints carry 0.9 of their strength. Some laws contain a ratchet (contacts made anew, lost history, friction at a point
--                that wanders) and let the blocks creep down by round-off.
-- Source         Contact mechanics demands zero. With friction at the centre of pressure a brick at 0.88 of its limit may flutter.
-- How to run     erbs run scenes/verify/v06_creep.lua [-D share=0.98] [-D duration=600] [-D kn=...]
-- What to look at  creep_* (over the block's size, from a tenth of the run to its end), speed_*.
label("quick")
local share = param("share", 0.9, "of the angle of friction")
local duration = param("duration", 60, "[s]")
local kn = param("kn", 1e8, "soft, for a long step [Pa/m]")
local size = param("size", 0.3, "longer side [m]")
if share >= 1 then error("share must be below 1: past the angle of friction blocks slide", 0) end

material { name = "stone", density = 1800, friction = 0.6, kn = kn, ks = 0.4 * kn }
for i, mu in ipairs { 0.3, 0.6, 0.9 } do
  for turn = 0, 1 do  -- straight down the slope, and rotated by 30 degrees about its normal
    local name = string.format("mu%d_%d", math.floor(10 * mu + 0.5), turn)
    local slope, block, angle = "slope_" .. name, "block_" .. name, share * math.atan(mu)
    transform { at = { 2 * i, 2 * turn, 0 }, rotation = { 0, angle, 0 }, function()
      box { name = slope, group = slope, size = { 4 * size, 4 * size, 0.1 }, at = { -2 * size, -2 * size, -0.1 }, fixed = true }
      box { name = block, group = block, size = { size, size / 2.4, size / 10 }, center = { 0, 0, size / 20 }, rotation = { 0, 0, turn * 30 * deg } }
    end }
    joint { law = dry { kn = kn, mu = mu }, between = { slope, block } }
    recorder { name = name, quantity = "displacement", block = block, axis = "x" }
    recorder { name = name, quantity = "velocity", block = block, axis = "x" }
    metric("creep_" .. name, "", function(run)
      return math.abs(run.last(name .. "_ux_rel_m") - run.at(name .. "_ux_rel_m", duration / 10)) / size
    end)
    metric("speed_" .. name, "m/s", function(run) return math.abs(run.last(name .. "_vx_rel_m_s")) end)
    expect("metrics.creep_" .. name, 1e-6, { below = true, source = "V06: sticks for ever" })
    expect("metrics.speed_" .. name, 1e-6, { below = true, source = "V06: sticks for ever" })
  end
end
analysis { duration = duration, start = "equilibrium", output_dt = duration / 100 }
