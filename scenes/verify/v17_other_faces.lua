-- V17 on faces that are no rectangles: triangles, hexagons, and faces cut by the edge of a neighbour.
--
-- What happens   Held prisms are pressed, tilted about axes of several directions and lifted until little is in contact. Dry beds press
--                with int kn max(-g, 0). Beds that yield press with at most fc; their path presses every place more and more, so that no
--                history shows. Force and both moments must equal these integrals. Mortar that softens also pulls, with the secant of each
--                contact point's cell: this tends to the integral of the softening law as the cells shrink.
-- Source         moments of linear fields over polygons, in closed form; linear softening, Hillerborg et al. 1976.
-- How to run     erbs run scenes/verify/v17_other_faces.lua [-D size=...] [-D kn=...] [-D ft=...] [-D Gf=...]
-- What to look at  dry, yielding: largest error of force (over fc A, with softening ft A) and moments; softening_N: with N points per side.
label("quick")
local size, kn = param("size", 0.3, "of the faces [m]"), param("kn", 1e11, "[Pa/m]")
local fc, ft, Gf = param("fc", 5 * MPa, "[Pa]"), param("ft", 0.5 * MPa, "[Pa]"), param("Gf", 20, "fracture energy [J/m2]")
local depth = 2 * fc / kn  -- m, at the deepest place of dry beds

gravity(0)
material { name = "brick", density = 1800 }
local half = size / 2
local function regular(n, turn)
  local p = {}
  for i = 1, n do p[i] = { half * math.cos(2 * pi * i / n + turn), half * math.sin(2 * pi * i / n + turn) } end
  return p
end
-- `over`: extent of the base in x; the part of a face beyond it is no joint.
local faces = {
  { name = "triangle", corners = { { -half, -half }, { half, -half }, { -half, half } }, over = 1 },
  { name = "hexagon", corners = regular(6, 0.2), over = 1 },
  { name = "skew", corners = { { -half, -0.6 * half }, { 0.2 * half, -half }, { half, -0.3 * half }, { 0.8 * half, 0.7 * half }, { -0.4 * half, half } }, over = 1 },
  { name = "clipped_triangle", corners = { { -half, -half }, { half, -0.2 * half }, { -0.3 * half, half } }, over = 0.35 },
  { name = "clipped_hexagon", corners = regular(6, 0.1), over = 0.2 },
}
-- The part of a polygon where f(x, y) = a + b x + c y >= 0.
local function clip(p, a, b, c)
  local out = {}
  for i = 1, #p do
    local u, v = p[i], p[i % #p + 1]
    local fu, fv = a + b * u[1] + c * u[2], a + b * v[1] + c * v[2]
    if fu >= 0 then out[#out + 1] = u end
    if (fu < 0) ~= (fv < 0) then
      local t = fu / (fu - fv)
      out[#out + 1] = { u[1] + t * (v[1] - u[1]), u[2] + t * (v[2] - u[2]) }
    end
  end
  return out
end
-- int f, int f x, int f y of f = a + b x + c y.
local function moments(p, a, b, c)
  local n, mx, my = 0, 0, 0
  for i = 2, #p - 1 do
    local t = { p[1], p[i], p[i + 1] }
    local area = ((t[2][1] - t[1][1]) * (t[3][2] - t[1][2]) - (t[3][1] - t[1][1]) * (t[2][2] - t[1][2])) / 2
    local f, sum, x, y = {}, 0, 0, 0
    for k = 1, 3 do
      f[k] = a + b * t[k][1] + c * t[k][2]
      sum, x, y = sum + f[k], x + t[k][1], y + t[k][2]
    end
    n = n + area / 3 * sum
    for k = 1, 3 do
      mx, my = mx + area / 12 * f[k] * t[k][1], my + area / 12 * f[k] * t[k][2]
    end
    mx, my = mx + area / 12 * sum * x, my + area / 12 * sum * y
  end
  return n, mx, my
end
-- Traction of the gap g = a + b x + c y for a law that is piecewise linear in g; each piece { from, to, value at from, value at to }.
local function traction(p, a, b, c, pieces)
  local n, mx, my = 0, 0, 0
  for _, piece in ipairs(pieces) do
    local part = clip(clip(p, a - piece[1], b, c), piece[2] - a, -b, -c)
    local slope = (piece[4] - piece[3]) / (piece[2] - piece[1])
    local dn, dx, dy = moments(part, piece[3] + slope * (a - piece[1]), slope * b, slope * c)
    n, mx, my = n + dn, mx + dx, my + dy
  end
  return n, mx, my
end

local far = 1  -- m, beyond every gap
local soft = kn / 10  -- softer mortar, so that the cells resolve the peak of its law
local peak, opening = ft / soft, 2 * Gf / ft
local laws = {
  dry = { law = dry { kn = kn, mu = 0 }, pieces = { { -far, 0, -kn * far, 0 } } },
  yielding = { law = mortar { kn = kn, ks = 0.4 * kn, ft = 0, c = 0, mu = 0, fc = fc }, pieces = { { -far, -fc / kn, -fc, -fc }, { -fc / kn, 0, -fc, 0 } } },
  softening = { law = mortar { kn = soft, ks = 0.4 * soft, ft = ft, c = 100 * ft, mu = 0, Gf1 = Gf },
    pieces = { { -far, 0, -soft * far, 0 }, { 0, peak, 0, ft }, { peak, opening, ft, 0 } } },
}
local dt, steps, cases, number = 1e-6, 400, {}, 0
local function case(kind, face, direction, rule, points, open)
  number = number + 1
  local name, x0 = string.format("case%d", number), 2 * size * number
  local base, corners = "base_" .. name, {}
  local reach = face.over * half
  for i, c in ipairs(face.corners) do corners[i] = { x0 + c[1], c[2] } end
  box { name = base, group = base, size = { 2 * half + reach - half, 4 * half, 0.1 }, at = { x0 - half, -2 * half, -0.1 }, fixed = true }
  prism { name = name, group = name, polygon = corners, height = 0.1, at = { 0, 0, 0 } }
  local p = clip(face.corners, reach, -1, 0)
  local area, cx, cy = moments(p, 1, 0, 0)
  cx, cy = cx / area, cy / area
  -- The deepest place keeps its depth while the tilt grows until the farthest place has the gap `open`.
  local ax, ay, near, away = math.cos(direction), math.sin(direction), 1e9, -1e9
  for _, c in ipairs(p) do
    local h = ax * (c[2] - cy) - ay * (c[1] - cx)
    near, away = math.min(near, h), math.max(away, h)
  end
  local theta = (depth + open) / (away - near)
  local times, turns, lifts = { 0 }, { 0 }, { 0 }
  for i = 1, 2 do  -- pressed all over, then tilted about the deepest place, which sinks a little further
    times[i + 1], turns[i + 1] = i * steps * dt, (i - 1) * theta
    lifts[i + 1] = -depth * (0.4 + 0.6 * (i - 1)) - near * turns[i + 1]
  end
  local turn, lift = table_wave { times = times, values = turns, hold = true }, table_wave { times = times, values = lifts, hold = true }
  turning { block = name, axis = { ax, ay, 0 }, wave = turn, about = { x0 + cx, cy, 0 } }
  motion { block = name, direction = "z", wave = lift }
  joint { law = laws[kind].law, between = { base, name }, rule = rule, points = points }
  recorder { name = name, quantity = "joint_moment", blocks = { base }, others = { name }, axis = "xy" }
  recorder { name = name, quantity = "normal_force", blocks = { base }, others = { name } }
  cases[#cases + 1] = { name = name, kind = kind, points = points, last = theta, error = function(run)
    local N, Mx, My, worst, sum = run.history(name .. "_normal_N"), run.history(name .. "_mx_N_m"), run.history(name .. "_my_N_m"), 0, 0
    local scale = area * (kind == "softening" and ft or fc)
    for i, t in ipairs(run.time) do
      if i > 1 then
        local b, c = -turn(t) * ay, turn(t) * ax
        local n, mx, my = traction(p, lift(t) - b * cx - c * cy, b, c, laws[kind].pieces)
        mx, my = mx - n * cx, my - n * cy
        -- The base is pulled up by n: moments about x are y n, about y -x n.
        local here = math.max(math.abs(N[i] - n), math.abs(Mx[i] - my) / half, math.abs(My[i] + mx) / half) / scale
        worst, sum = math.max(worst, here), sum + here ^ 2
      end
    end
    return worst, math.sqrt(sum / #run.time)
  end }
end
for i, face in ipairs(faces) do
  for k, direction in ipairs { 0, 1, 2.2, 4 } do
    for _, kind in ipairs { "dry", "yielding" } do
      case(kind, face, direction + 0.1 * i, k % 2 == 0 and "simpson" or "gauss", { 3, 3 }, depth * (0.5 + k))
    end
  end
  for _, n in ipairs { 4, 8, 16 } do case("softening", face, 0.7 * i, "midpoint", { n, n }, opening) end
end
local function worst(run, kind, n)
  local most = 0
  for _, c in ipairs(cases) do
    if c.kind == kind and (n == nil or c.points[1] == n) then most = math.max(most, c.error(run)) end
  end
  return most
end
local steepest = 0
for _, c in ipairs(cases) do steepest = math.max(steepest, c.last) end
for _, kind in ipairs { "dry", "yielding" } do
  metric(kind, "", function(run) return worst(run, kind) end)
  -- Faces rotate by the tilt: its square.
  expect("metrics." .. kind, 0, { abs = 1e-9 + steepest ^ 2, source = "Int kn min(max(-g, 0), fc / kn) dA; 1 % is allowed" })
end
local function typical(run, n)  -- root mean square over the path and the faces
  local sum, count = 0, 0
  for _, c in ipairs(cases) do
    if c.kind == "softening" and c.points[1] == n then sum, count = sum + select(2, c.error(run)) ^ 2, count + 1 end
  end
  return math.sqrt(sum / count)
end
for _, n in ipairs { 4, 8, 16 } do
  metric("softening_" .. n, "", function(run) return typical(run, n) end)
  -- A cell has the secant of its widest opening, so it carries too little elsewhere: an error of first order in the cell size.
  expect("metrics.softening_" .. n, 1 / n, { below = true, source = "Int sigma(g) dA of the softening law" })
end
analysis { duration = 2 * steps * dt, dt = dt, start = "rest", output_dt = 40 * dt }
expect("energy.residual_relative", 1e-3, { below = true, source = "ledger" })
