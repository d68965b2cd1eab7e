-- V19: limit of the time step of chains of 1 to 100 blocks, held at one or both ends, by bisection.
--
-- What happens   The stiffness of each chain is chosen so that the formula gives the same limit 2 / omega_max. Just below the limit a
--                disturbance keeps its size, just above it grows without end. Bisection finds the threshold of each chain.
-- Source         Courant, Friedrichs and Lewy 1928; omega_max of a chain of n: 2 sqrt(k/m) cos(pi / (2 n + 1)) held at one end, 2 sqrt(k/m)
--                cos(pi / (2 n + 2)) at both.
-- How to run     erbs run scenes/verify/v19_family.lua
-- What to look at  collapse_*: dt over the limit of the formula at which each chain starts to grow.
label("fixed_dt")
local limit, edge, density, steps = 1e-4, 0.1, 1800, 6000
local start = 1e-9
gravity(0)
material { name = "brick", density = density }
local cases = {}
for _, n in ipairs { 1, 2, 5, 30, 100 } do
  for _, ends in ipairs { 1, 2 } do
    local name = "n" .. n .. (ends == 1 and "_one" or "_both")
    -- omega_max / (2 sqrt(k/m)). One end held: half of a chain of 2 n held at both ends. Both ends held: the sine modes of n.
    local factor = ends == 1 and math.cos(pi / (2 * n + 1)) or math.cos(pi / (2 * n + 2))
    cases[#cases + 1] = { name = name, n = n, ends = ends, kn = density * edge * (1 / (limit * factor)) ^ 2 }
  end
end
local share = param("share", 0.999, "dt over the limit, of all")
local function scale_of(name) return param(name, 0, "the same, of one chain alone") end
local alone
for _, case in ipairs(cases) do
  local own = scale_of(case.name)
  if own > 0 then share, alone = own, case.name end
end
for i, case in ipairs(cases) do
  if not alone or alone == case.name then
    local group = case.name
    -- Soft shear keeps rocking and sway of the cubes far below the axial modes of the chain.
    joint { law = mortar { kn = case.kn, ks = 0.01 * case.kn, ft = 1e9, c = 1e9, mu = 0.6 }, between = { group, group } }
    box { name = group .. "_foot", group = group, size = { edge, edge, edge }, at = { i, 0, -edge }, fixed = true }
    for k = 1, case.n do
      box { name = group .. k, group = group, size = { edge, edge, edge }, at = { i, 0, (k - 1) * edge },
        initial = k == case.n and { position = { 0, 0, start } } or nil }
    end
    if case.ends == 2 then box { name = group .. "_head", group = group, size = { edge, edge, edge }, at = { i, 0, case.n * edge }, fixed = true } end
    recorder { name = case.name, quantity = "displacement", block = group .. case.n, axis = "z" }
    metric("largest_" .. case.name, "", function(run) return run.peak(case.name .. "_uz_rel_m") / start end)
    if not alone then expect("metrics.largest_" .. case.name, 1 + 1e-6, { below = true, source = "leapfrog below its limit" }) end
  end
  bisect { param = case.name, lo = 0.99, hi = 1.01, rel = 5e-4, collapsed_when = function(run)
    return run.status == "diverged" or run.peak(case.name .. "_uz_rel_m") > 2 * start
  end }
  -- Half the last bracket, and growth slower than a doubling in `steps` steps: acosh(x) steps = 7, x - 1 = 7e-7.
  expect("metrics.collapse_" .. case.name, 1, { abs = 5e-4, source = "2 / omega_max" })
end
analysis { duration = steps * share * limit, dt = share * limit, unstable = true, start = "rest", output_dt = 20 * limit, frame_dt = 1,
  energy_gate = alone and 1e6 or 0 }  -- a chain that grows until it breaks has given its answer
