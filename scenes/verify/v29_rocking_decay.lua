-- V29: rocking decays as Housner's impacts have it, without any number fitted
--
-- What happens   Three granite blocks and a wall are tilted and released. By Housner's equation each impact keeps mu = 1 - 3/2 sin^2 alpha
--                of the spin. The contact has no such number: the loss comes from the impact of narrow feet that hardly rebound. The wider
--                and the more elastic they are, the more spin a block keeps (restitution = .5: amplitudes 2 to 9 % larger after three impacts).
-- Source         Housner 1963; rocking{} integrates the exact equation; blocks of Pena et al. 2007 (EESD 36, 2383), wall 0.6 x 3 m. phi_n
--                of pena1: .5 .38639 .30596 .24560 .19887 .16201 .13256 (linear); wall .25330 .22081 .19305 .16919 .14855 .13064 .11504.
-- How to run     erbs run scenes/verify/v29_rocking_decay.lua [-D restitution=...] [-D settlement=...] [-D foot=...]
-- What to look at  <block>_phi_n and <block>_t_n: amplitude and time of impact n over Housner's.
local restitution = param("restitution", 0.1, "of the blow")
local settlement, foot = param("settlement", 5e-7, "of the full base over half the width"), param("foot", 0.003, "width of a foot over that of the block")
local phi = param("phi", 0.5, "tilt of the granite blocks at the start over alpha")
local impacts = 6
family { restitution = { 0.05, 0.15 } }

local rocking_block = include "parts/rocking_block.lua"
local duration = 0
for _, row in ipairs { { "pena1", 0.25, 1.0, 0.754, 2670 }, { "pena2", 0.17, 1.0, 0.502, 2670 }, { "pena3", 0.12, 1.0, 0.375, 2670 }, { "wall", 0.6, 3.0, 1.0, 1800, 0.05 } } do
  local name, width, height = row[1], row[2], row[3]
  local it = rocking_block { name = name, width = width, height = height, depth = row[4], density = row[5], at = { 0, 3 * (#name + row[5] / 1000 + width * 10) },
    theta = row[6] or phi * math.atan(width / height), settlement = settlement, foot = foot, restitution = restitution, duration = 8 }
  local theory = it.theory
  duration = math.max(duration, 0.5 * (theory.impacts[impacts] + theory.impacts[impacts + 1]) + 0.02)
  for n = 1, impacts do
    metric(name .. "_phi_" .. n, "", function(run)
      local _, peaks = it.impacts(run)
      return peaks[n + 1] / theory.amplitudes[n + 1]
    end)
    metric(name .. "_t_" .. n, "", function(run) return it.impacts(run)[n] / theory.impacts[n] end)
    -- 3 % and 2 %: Housner's impact acts at a point, this one on feet of .3 % of the width; and the toe in the bed.
    expect("metrics." .. name .. "_phi_" .. n, 1, { rel = 0.03, source = "Housner, exact equation" })
    expect("metrics." .. name .. "_t_" .. n, 1, { rel = 0.02, source = "Housner, exact equation" })
  end
end
analysis { duration = duration, start = "rest", dt = param("dt", 2e-5), output_dt = 1e-3, frame_dt = 0.1 }
