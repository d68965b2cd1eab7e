-- V47: a rough bed is sheared under constant weight, away from its mated position and back.
--
-- What happens   A block lies on a driven plate; a wall with stiff normal and very soft shear springs holds it in place. The plate moves
--                slowly. The asperities lift the block by tan(psi) of the slip; the angle falls to zero over the slip w = `wear_slip`.
-- Source         Sheared straight away: uplift = tan(psi) slip (1 - slip / (2 w)), at most tan(psi) w / 2. Back and forth: the integral of
--                tan(psi) (1 - way / w) d|slip|, way = Int |d slip|. The plate does the work mu W slip, of which W uplift is not lost.
-- How to run     erbs run scenes/verify/v47_dilatancy.lua [-D kn=...] [-D mu=...] [-D weight=2]
-- What to look at  uplift_*: largest error over the largest uplift; lost_over_paper: friction over mu W slip - W uplift.
label("quick")
local kn, mu = param("kn", 1e10, "of the beds [Pa/m]"), param("mu", 0.7, "of the beds")
local interlock = param("interlock", 1, "of the beds")
local heavier = param("weight", 1, "factor on the weight of the blocks")
family({ kn = { 1e8, 1e9, 1e11, 1e12 }, mu = { 0.65, 1 }, weight = { 0.1, 20 } }, { combinations = 6 })
local density, L, h = 2000 * heavier, 0.4, 0.1
local weight, duration = density * 9.81 * L * L * h, 1
local elastic = mu * weight / (0.4 * kn * L * L)  -- m, slip before sliding, which lifts nothing
if elastic > 0.1 * 2 * mm then error("the elastic slip is too large a share of the whole; make kn larger or the blocks lighter", 0) end
material { name = "stone", density = density, kn = kn, ks = 0.4 * kn, friction = mu }
-- The wall: shear springs of 1e3 Pa/m carry some 0.05 N.
local hold = mortar { kn = kn, ks = 1e3, ft = 1e8, c = 1e8, mu = 0 }

local cases = {
  { name = "away", psi = 15, wear_slip = 4 * mm, travel = 8 * mm, axis = 1 },
  { name = "backwards", psi = 15, wear_slip = 4 * mm, travel = -8 * mm, axis = 1 },
  { name = "sideways", psi = 8, wear_slip = 20 * mm, travel = 3 * mm, axis = 2 },
  { name = "steep", psi = 30, wear_slip = 2 * mm, travel = 3 * mm, axis = 1 },
  { name = "long", psi = 5, wear_slip = 60 * mm, travel = 12 * mm, axis = 2 },
  { name = "and_back", psi = 15, wear_slip = 6 * mm, travel = 3 * mm, axis = 1, cycles = 1 },
}
for i, case in ipairs(cases) do
  local block, plate, wall, at = "block_" .. case.name, "plate_" .. case.name, "wall_" .. case.name, 3 * i
  local function box_at(name, lo, size, more)
    local along = case.axis == 1
    local it = { name = name, group = name, material = "stone",
      at = along and { lo[1], at, lo[2] } or { at, lo[1], lo[2] }, size = along and { size[1], L, size[2] } or { L, size[1], size[2] } }
    for key, value in pairs(more or {}) do it[key] = value end
    box(it)
  end
  box_at(plate, { -0.1, -0.1 }, { L + 0.2, 0.1 }, { free = true })
  box_at(block, { 0, 0 }, { L, h })
  box_at(wall, { L, 0.02 }, { 0.1, h }, { fixed = true })
  joint { law = dilatant { kn = kn, mu = mu, psi = case.psi * deg, wear_slip = case.wear_slip, interlock = interlock }, between = { plate, block } }
  joint { law = hold, between = { block, wall } }
  joint { none = true, between = { plate, wall } }
  local halves = case.cycles and 2 * case.cycles or 1
  motion { block = plate, direction = case.axis == 1 and "x" or "y",
    wave = function(t) return case.travel * (1 - math.cos(pi * halves * math.min(t / duration, 1))) / 2 end }
  for _, name in ipairs { plate, block } do recorder { name = name, quantity = "displacement", block = name } end
  -- Uplift of the mated faces at each row, from the recorded slip.
  local function paper(run)
    local column = (case.axis == 1 and "_ux" or "_uy") .. "_rel_m"
    local base, own, tan = run.history(plate .. column), run.history(block .. column), math.tan(case.psi * deg)
    local uplift, way, before, out = 0, 0, 0, {}
    for k = 1, #base do
      local slip = base[k] - own[k] - (base[1] - own[1])
      local step = math.abs(slip - before)
      local wears = math.max(0, math.min(step, case.wear_slip - way))
      if step > 0 then uplift = uplift + tan * (1 - (way + wears / 2) / case.wear_slip) * wears * (math.abs(slip) - math.abs(before)) / step end
      way, before, out[k] = way + step, slip, uplift
    end
    return out, way, uplift
  end
  metric("uplift_" .. case.name, "", function(run)
    local expected, largest, worst = paper(run), 0, 0
    local up = run.history(block .. "_uz_rel_m")
    for k = 1, #up do
      worst, largest = math.max(worst, math.abs(up[k] - up[1] - expected[k])), math.max(largest, math.abs(expected[k]))
    end
    return worst / largest
  end)
  expect("metrics.uplift_" .. case.name, 0,
    { abs = 5e-3 + 3 * elastic / math.min(case.wear_slip, math.abs(case.travel)), source = "tan(psi) slip (1 - slip / (2 wear_slip))" })
  case.paper = paper
end
metric("closed_form_away", "", function(run)
  return (run.last("block_away_uz_rel_m") - run.first("block_away_uz_rel_m")) / (math.tan(15 * deg) * 4 * mm / 2)
end)
expect("metrics.closed_form_away", 1, { abs = 2e-3, source = "tan(psi) wear_slip / 2" })
metric("lost_over_paper", "", function(run)
  local work = 0
  for _, case in ipairs(cases) do
    local _, way, uplift = case.paper(run)
    work = work + weight * (mu * way - uplift)
  end
  return run.metrics.energy.friction_J / work
end)
-- Light blocks on the stiffest beds tremble as they slide, and rub up to 2.2 % less; .9999 at the defaults.
expect("metrics.lost_over_paper", 1, { abs = 0.025, source = "mu W slip - W uplift" })
-- Below 1e-8 where the faces stay closed; light blocks on stiff beds tremble, and each opening errs a little.
expect("energy.residual_relative", 5e-4, { below = true, source = "ledger" })
analysis { duration = duration + 0.1, output_dt = 1 * ms, start = "equilibrium" }
