-- V19: half of the step D_min / v_p of Hakuno and Meguro exceeds the limit of bricks on stiff thin mortar; the run reports it.
--
-- What happens   A wall of the bricks of Gu and Miao (5 mm of mortar, E = 10.7 GPa) runs with half of rule (5). The limit of this rule is
--                the passage of a wave between two centroids. But the mass is in the bricks and the spring in the thin joint. So the true
--                limit is shorter by 3.6 (an estimate from one block gave 2.7). Without unstable = true the step is refused; with it the
--                run ends as "diverged".
-- Source         Hakuno and Meguro 1993; Gu and Miao eq. (5): "not always convergent, use half of it".
-- How to run     erbs run scenes/verify/v19_hakuno_rule.lua
-- What to look at  over_limit: step of the rule over 2 / omega_max; status.
label("quick", "fixed_dt")
local E, t, density = param("E", 1.07e10, "of the mortar [Pa]"), param("thickness", 5 * mm, "[m]"), 1900
material { name = "brick", density = density }
local l, w, h = 0.3, 0.125, 0.1
box { name = "foot", size = { 1.5, w, h }, at = { -0.1, 0, -h - t }, fixed = true }
for course = 0, 4 do
  for i = 0, 3 do
    box { name = course .. "_" .. i, size = { l, w, h }, at = { i * (l + t) + course % 2 * (l + t) / 2, 0, course * (h + t) } }
  end
end
joint { law = mortar { E = E, nu = 0.2, thickness = t, ft = 0.3 * MPa, c = 0.5 * MPa, mu = 0.7 }, tolerance = 0.1 * mm }
ground_motion { wave = sine { amplitude = 0.1 * g, frequency = 5 }, direction = "x" }
analysis { duration = 0.5, dt_rule = "hakuno_half", unstable = true }
metric("over_limit", "", function(run) return run.dt_s / run.dt_critical_s end)
expect("status", "diverged")
expect("metrics.over_limit", 0, { between = { 1.5, 4 }, source = "an estimate from one block has 2.7" })
