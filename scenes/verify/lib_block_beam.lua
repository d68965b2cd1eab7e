-- A chain of rigid blocks on elastic joints as a beam: its exact natural frequencies and mode shapes by transfer matrices. Included by
-- other scenes.
--
-- beam{ n, length, height, width, E, nu, density, base, ends, ratio }: `height` is the side in bending; `base` multiplies the stiffness of
-- the joints at the supports (2: half the tributary length); `ratio` is the rotational stiffness over kn B H^3 / 12; ends = "cantilever" |
-- "pinned". Returns kn, ks, d, mass, frequency(i) in rad/s and shape(w): { u, turn } of each centroid.
--
-- State at a section: displacement u, rotation th (u' = th), shear V, moment M. A rigid block of mass m and inertia J: V' = V - m w^2 u_c,
-- M' = M - J w^2 th - d/2 (V + V'). A joint: jumps V / Ks and M / Kt. Pestel and Leckie 1963, Matrix Methods in Elastomechanics, ch. 3.
function beam(o)
  local b = { n = o.n, d = o.length / o.n, ratio = o.ratio or 1 }
  b.kn, b.ks = o.E / b.d, 5 / 6 * o.E / (2 * (1 + o.nu)) / b.d
  b.mass = o.density * o.width * o.height * b.d
  local inertia = b.mass * (o.height ^ 2 + b.d ^ 2) / 12
  local Ks, Kt = b.ks * o.width * o.height, b.ratio * b.kn * o.width * o.height ^ 3 / 12
  local pinned, base = o.ends == "pinned", o.base or 2
  -- Carries a state from support to support; `visit` receives the centroid of each block.
  local function carry(w, u, th, V, M, visit)
    u = u + V / (base * Ks)
    if not pinned then th = th + M / (base * Kt) end
    for i = 1, o.n do
      local uc = u + th * b.d / 2
      if visit then visit(uc, th) end
      local V1 = V - b.mass * w * w * uc
      M = M - inertia * w * w * th - b.d / 2 * (V + V1)
      V, u = V1, u + th * b.d
      if i < o.n then u, th = u + V / Ks, th + M / Kt end
    end
    if pinned then u = u + V / (base * Ks) end
    return u, th, V, M
  end
  -- Two states that satisfy the first support, and their violation of the conditions at the other end: a 2 x 2 determinant.
  local function ends(w)
    local u1, _, V1, M1 = carry(w, 0, pinned and 1 or 0, pinned and 0 or 1, 0)
    local u2, _, V2, M2 = carry(w, 0, 0, pinned and 1 or 0, pinned and 0 or 1)
    if pinned then return u1, M1, u2, M2 end
    return V1, M1, V2, M2
  end
  local function determinant(w) local a, c, e, f = ends(w) return a * f - e * c end
  local found = {}
  function b.frequency(i)
    local euler = math.sqrt(o.E * o.height ^ 2 / (12 * o.density)) / o.length ^ 2
    local step = 0.02 * euler
    local w, last = found[#found] and found[#found] + step or step, nil
    last = determinant(w)
    while #found < i do
      local now = determinant(w + step)
      if now * last < 0 then
        local lo, hi, sign = w, w + step, last > 0 and 1 or -1
        for _ = 1, 70 do
          local middle = (lo + hi) / 2
          if determinant(middle) * sign > 0 then lo = middle else hi = middle end
        end
        found[#found + 1] = (lo + hi) / 2
      end
      w, last = w + step, now
      step = 0.02 * euler * (1 + #found)
    end
    return found[i]
  end
  function b.shape(w)
    local a, c, e, f = ends(w)
    local x, y = e, -a  -- a x + e y = 0
    if math.abs(a) + math.abs(e) < math.abs(c) + math.abs(f) then x, y = f, -c end
    local scale = math.max(math.abs(x), math.abs(y))
    x, y = x / scale, y / scale
    local shape, largest = {}, 0
    carry(w, 0, pinned and x or 0, pinned and y or x, pinned and 0 or y, function(u, th)
      shape[#shape + 1] = { u = u, turn = th }
      largest = math.max(largest, math.abs(u))
    end)
    for _, s in ipairs(shape) do s.u, s.turn = s.u / largest, s.turn / largest end
    return shape
  end
  return b
end
