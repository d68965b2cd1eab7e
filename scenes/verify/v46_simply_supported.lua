-- V46: natural frequencies of a beam of rigid blocks on two pins, from the spectrum of its response to an impulse.
--
-- What happens   The end blocks are pinned by joints of one contact point (no rotational stiffness), twice as stiff in shear. The spectrum
--                of a block away from the middle is compared with the exact chain, and the chain with Euler's f_n = n^2 pi / (2 L^2) sqrt(E
--                I / (rho A)).
-- Source         transfer matrices, lib_block_beam.lua; Euler, with Timoshenko's correction 1 - (n pi h / L)^2 / 24 (1 + 2.4 (1 + nu)).
-- How to run     erbs run scenes/verify/v46_simply_supported.lua [-D length=6] [-D height=0.5]
-- What to look at  f1_n10 ... (measured over exact chain), over_timoshenko_f1 ...
label("quick")
include "lib_block_beam.lua"
local length, height, width = param("length", 3, "[m]"), param("height", 0.3, "side in bending [m]"), param("width", 1, "[m]")
local E, nu, density = param("E", 5e9, "[Pa]"), param("nu", 0.2, ""), param("density", 2000, "[kg/m3]")
local time = param("time", 2, "length of the record [s]")
gravity(0)
material { name = "masonry", density = density }
for i, n in ipairs { 5, 10, 20, 40 } do
  local b = beam { n = n, length = length, height = height, width = width, E = E, nu = nu, density = density, ends = "pinned" }
  local name, x = "n" .. n, 2 * i
  local left, right = name .. "_left", name .. "_right"
  box { name = left, group = left, size = { height, width, 0.2 }, at = { x, 0, -0.2 }, fixed = true }
  box { name = right, group = right, size = { height, width, 0.2 }, at = { x, 0, length }, fixed = true }
  local pushed = math.max(1, math.floor(0.3 * n))  -- away from the middle and from the nodes of the first three modes
  for k = 1, n do
    box { name = name .. "_" .. k, group = name, size = { height, width, b.d }, at = { x, 0, (k - 1) * b.d },
      initial = k == pushed and { velocity = { 1e-4, 0, 0 } } or nil }
  end
  local function law(factor) return mortar { kn = factor * b.kn, ks = factor * b.ks, ft = 1e9, c = 1e9, mu = 0.6 } end
  joint { law = law(1), between = { name, name } }
  for _, support in ipairs { left, right } do joint { law = law(2), between = { support, name }, rule = "midpoint", points = { 1, 1 }, tolerance = 1e-6 } end
  recorder { name = name, quantity = "displacement", block = name .. "_" .. pushed, axis = "x" }
  for k = 1, n == 5 and 2 or 3 do
    local w = b.frequency(k)
    local f = w / (2 * pi)
    metric("f" .. k .. "_" .. name, "", function(run)
      local shifted = 2 / run.dt_s * math.asin(w * run.dt_s / 2) / (2 * pi)
      return run.frequency(name .. "_ux_rel_m", 0.85 * f, 1.15 * f) / shifted
    end)
    expect("metrics.f" .. k .. "_" .. name, 1, { abs = 0.01 / time / f, source = "exact chain, leapfrog's shift" })
    if n == 40 then
      local euler = k ^ 2 * pi / (2 * length ^ 2) * math.sqrt(E * height ^ 2 / (12 * density))
      local s = (k * pi * height / length) ^ 2 / 12
      metric("over_timoshenko_f" .. k, "", f / (euler * (1 - s / 2 * (1 + 2.4 * (1 + nu)))))
      -- The next term of the correction is of the order of its square; the error of the chain itself is about (n pi / N)^2 / 24.
      expect("metrics.over_timoshenko_f" .. k, 1, { abs = 2 * (s / 2 * (1 + 2.4 * (1 + nu))) ^ 2 + (k * pi / n) ^ 2 / 12, source = "n^2 pi / (2 L^2) sqrt(EI / rho A), first correction" })
    end
  end
end
analysis { duration = time, start = "rest", output_dt = time / 16384, frame_dt = time }
