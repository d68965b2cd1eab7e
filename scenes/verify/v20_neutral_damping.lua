-- V20: the mass damping that just cancels the energy feed of the literal sequential scheme: c / m = dt w_b^2 / 2.
--
-- What happens   The chain of v20_sequential_growth.lua in random order, with mass damping. For each of three steps bisection finds the
--                damping at which the amplitude neither grows nor falls. It is thousands of times larger than any structural damping. This
--                is why Gu and Miao found that the damping ratio of the structure diverges, and why more iterations per step help.
-- Source         mean over orders of dt (K - D) / 2 on slow motion: - dt D / 2.
-- Measured       0.99, 0.95 and 0.87 of dt w_b^2 / 2 at 0.1, 0.25 and 0.5 of leapfrog's limit (fixed order: 0.995 at each);
--                figures/neutral.svg
-- How to run     erbs run scenes/verify/v20_neutral_damping.lua [-D n=100]; studies/ holds every run of the bisections
-- What to look at  collapse_c10, collapse_c25, collapse_c50: neutral damping over dt w_b^2 / 2.
label("fixed_dt")
include "lib_spring_chain.lua"
local n = param("n", 30, "blocks")
local seed = param("seed", 1, "of the random order")
local c = { [10] = param("c10", 0, "damping over dt w_b^2 / 2, at .1 of the limit"), [25] = param("c25", 0, "at .25"), [50] = param("c50", 0, "at .5") }
local percent, factor = 25, 1
for key, value in pairs(c) do if value > 0 then percent, factor = key, value end end

local chain = spring_chain { n = n, share = percent / 100 }
damping { mass = factor * chain.dt * chain.block_w2 / 2 }
local duration = 300 * chain.tau
analysis { duration = duration, dt = chain.dt, unstable = true, start = "rest", output_dt = duration / 40, frame_dt = duration,
  solver = "sequential", seed = seed }
metric("growth", "", chain.growth)
for _, key in ipairs { 10, 25, 50 } do
  bisect { param = "c" .. key, lo = 1.3, hi = 0.6, rel = 0.01, collapsed_when = function(run) return chain.growth(run) > 0 end }
  -- 15 %: the law is the first order in dt.
  expect("metrics.collapse_c" .. key, 1, { rel = 0.15, source = "c / m = dt w_b^2 / 2" })
end
-- Neutral damping of the fixed order by the characteristic equation: growth falls with the damping; found by halving. Only the scene's own
-- run draws.
if c[10] == 0 and c[25] == 0 and c[50] == 0 then
  local x, neutral = {}, {}
  for i = 1, 9 do
    local dt, lo, hi = 0.11 * i * chain.dt_critical, 0.9, 1.1
    for _ = 1, 8 do
      local middle = (lo + hi) / 2
      if chain.exact_growth(middle * dt * chain.block_w2 / 2, dt) > 0 then lo = middle else hi = middle end
    end
    x[i], neutral[i] = 0.11 * i, (lo + hi) / 2
  end
  figure { name = "neutral", title = "Mass damping that just cancels what the sequential sweep feeds", x = "dt over the limit of the leapfrog",
    y = "c/m over dt w_b^2 / 2", curves = { { label = "c/m = dt w_b^2 / 2", x = { 0, 1 }, y = { 1, 1 } },
      { label = "fixed order, characteristic equation", x = x, y = neutral },
      { label = "random order, measured", x = { 0.1, 0.25, 0.5 }, metrics = { "collapse_c10", "collapse_c25", "collapse_c50" } } } }
end
