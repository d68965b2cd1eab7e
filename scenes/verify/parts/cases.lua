-- Several structures in one scene, each with the value on paper at which it begins to move; bisection finds this value again.
--
-- cases { { name, value, build = function(value) ... ... end, lo, hi, rel, expect = { ... } }, ... }
--   name, value   metric <name>_over_paper is the value found over this one
--   build         builds the structure under `value` of its load and says in analysis{} when it has moved (stop_when_moved); it may
--                 return a function(run) that decides this instead
--   lo, hi        shares of `value` at which it stands and at which it moves (default 0.95 and 1.05)
--   rel           width of the last bracket (default 0.004)
--   expect        tolerance of <name>_over_paper, as in expect{}
-- The scene's own run shows the first structure at `show` of its value. A study changes the param of its own name; its runs see from it
-- which structure to build.
local unchanged = -1
local judged = expect  -- another name, so that this file does not count as a scene with expectations

return function(cases)
  local chosen
  for _, case in ipairs(cases) do
    case.share = param(case.name, unchanged, "load, of the value on paper")
    if case.share ~= unchanged then chosen = case end
  end
  local asked = chosen or cases[1]
  local moved = asked.build((chosen and chosen.share or asked.show or 1.05) * asked.value)
  for _, case in ipairs(cases) do
    bisect { param = case.name, name = case.name .. "_over_paper", lo = case.lo or 0.95, hi = case.hi or 1.05, rel = case.rel or 0.004, points = 2,
      collapsed_when = function(run)
        if moved then return moved(run) end
        return run.collapse.collapsed or run.collapse.moved
      end }
    metric(case.name .. "_on_paper", case.unit or "", case.value)
    judged("metrics." .. case.name .. "_over_paper", 1, case.expect)
  end
end
