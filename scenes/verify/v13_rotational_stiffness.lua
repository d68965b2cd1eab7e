-- V13: rotational stiffness of a joint for every quadrature rule and number of contact points, side by side.
--
-- What happens   Each block is held at a small rotation about one axis of its joint, and the moment of the joint is read. Its ratio to kn B
--                H^3 / 12 follows from the rule alone. Midpoints give 1 - 1/N^2 (one point: zero), trapezoids 1 + 2/(N - 1)^2 (corners
--                only: 3), Simpson and Gauss exactly 1. Rules are tensor products: N points along H, whatever the other side has. Torsion
--                of a square face has the same factor.
-- Source         int s^2 over the rule against H^3 / 12.
-- How to run     erbs run scenes/verify/v13_rotational_stiffness.lua [-D long=0.3] [-D short=0.125] [-D kn=...]
-- What to look at  ratio_<rule>_<points>_<axis>. One point per half brick has no rotational stiffness: never use it. A moment on a free
--                block of the default rule, in static equilibrium, gives the same stiffness.
label("quick")
local long, short = param("long", 0.3, "side of the face along x [m]"), param("short", 0.125, "along y [m]")
local kn, ks = param("kn", 1e11, "[Pa/m]"), param("ks", 0.4e11, "[Pa/m]")
local angle = param("angle", 1e-7, "rotation, small against sqrt(1e-10): the arms turn by its square [rad]")
local density = param("density", 1800, "[kg/m3]")

gravity(0)
material { name = "brick", density = density }
local function midpoint(n) return 1 - 1 / n ^ 2 end
local function trapezoid(n) return 1 + 2 / (n - 1) ^ 2 end
local function exact() return 1 end
local rules = {
  { rule = "midpoint", ratio = midpoint, points = { 1, 2, 3, 4, 6, 8 } },
  { rule = "trapezoid", ratio = trapezoid, points = { 2, 3, 4, 5, 9 } },
  { rule = "simpson", ratio = exact, points = { 3, 4, 5, 6, 7 } },
  { rule = "gauss", ratio = exact, points = { 2, 3, 4 } },
}
local law = mortar { kn = kn, ks = ks, ft = 1e9, c = 1e9, mu = 0.6 }
-- k of the whole face about x (bends along y), y (bends along x) and z (torsion of a square face)
local stiffness = { x = kn * long * short ^ 3 / 12, y = kn * short * long ^ 3 / 12, z = ks * short ^ 4 / 6 }
local row = 0
local function pair(name, nx, ny, rule, axis, ratio)
  row = row + 1
  local lx, at = axis == "z" and short or long, { 1.0 * (row % 8), 1.0 * (row // 8), 0 }
  local turn = { x = { angle, 0, 0 }, y = { 0, angle, 0 }, z = { 0, 0, angle } }
  local base, block = "base_" .. name, "block_" .. name
  box { name = base, group = base, size = { lx, short, 0.1 }, at = { at[1], at[2], -0.1 }, fixed = true }
  box { name = block, group = block, size = { lx, short, 0.1 }, at = at, initial = { rotation = turn[axis] } }
  joint { law = law, between = { base, block }, rule = rule, points = { nx, ny } }
  motion { block = block, wave = 0, direction = "z" }
  recorder { name = name, quantity = "joint_moment", blocks = { base }, others = { block }, axis = axis }
  metric("ratio_" .. name, "", function(run) return run.last(name .. "_m" .. axis .. "_N_m") / angle / stiffness[axis] end)
  -- Only round-off of the arms and the square of the angle.
  expect("metrics.ratio_" .. name, ratio, { abs = 1e-10, source = "V13: " .. rule })
end
for _, set in ipairs(rules) do
  for _, n in ipairs(set.points) do
    local ratio, other = set.ratio(n), set.rule == "trapezoid" and 2 or set.rule == "simpson" and 3 or 2
    pair(set.rule .. "_" .. n .. "_y", n, other, set.rule, "y", ratio)  -- points along the longer side come first
    pair(set.rule .. "_" .. n .. "_x", other, n, set.rule, "x", ratio)
    pair(set.rule .. "_" .. n .. "_z", n, n, set.rule, "z", ratio)
  end
end

-- A free block under a moment about either axis: the static start must give M / k, and the joint passes the moment on.
for k, axis in ipairs { "x", "y" } do
  local name, moment_at = "free_" .. axis, 10.0
  box { name = "base_" .. name, group = "base", size = { long, short, 0.1 }, at = { k, -2, -0.1 }, fixed = true }
  box { name = name, group = "free", size = { long, short, 0.1 }, at = { k, -2, 0 } }
  moment { block = name, wave = moment_at, direction = axis }
  recorder { name = name, quantity = "rotation", block = name, axis = axis }
  metric("ratio_" .. name, "", function(run) return moment_at / run.first(name .. "_r" .. axis .. "_rad") / stiffness[axis] end)
  -- The start leaves 1e-11 of the load unbalanced; the rotation M / k = 1e-7 adds an error of second order.
  expect("metrics.ratio_" .. name, 1, { abs = 1e-6, source = "kn B H^3 / 12, Simpson 3 x 3" })
end
joint { law = law, between = { "base", "free" } }
analysis { duration = 1e-4, start = "equilibrium", output_dt = 1e-6 }
