-- Horizontal load multiplier of a round arch of straight-sided voussoirs without sliding: the least lambda over all mechanisms of four
-- hinges. By the upper bound theorem the least one is the answer if there is no tension and no sliding (Heyman 1966). The load acts to +x.
--
-- Hinges lie at joints i < j < k < l, alternating between the inner and the outer edge. The first and the last part rotate about the hinges
-- at the abutments. The middle part rotates about the intersection of the lines through them (virtual work of three bars):
--   lambda = -(work of the weights) / (work of the weights turned to the side)
local function ring(n, t, embrace)
  local joints = {}
  for i = 0, n do
    local a = (math.pi + embrace) / 2 - embrace * i / n
    joints[i] = { { (1 - t / 2) * math.cos(a), (1 - t / 2) * math.sin(a) }, { (1 + t / 2) * math.cos(a), (1 + t / 2) * math.sin(a) } }
  end
  local area, x, z = { [0] = 0 }, { [0] = 0 }, { [0] = 0 }  -- sums from the left: W, W x, W z
  for i = 1, n do
    local a, b = joints[i - 1], joints[i]
    local c, A, X, Z = { a[1], a[2], b[2], b[1] }, 0, 0, 0
    for s = 1, 4 do
      local p, q = c[s], c[s % 4 + 1]
      local cross = p[1] * q[2] - q[1] * p[2]
      A, X, Z = A + cross / 2, X + (p[1] + q[1]) * cross / 6, Z + (p[2] + q[2]) * cross / 6
    end
    local sign = A < 0 and -1 or 1
    area[i], x[i], z[i] = area[i - 1] + sign * A, x[i - 1] + sign * X, z[i - 1] + sign * Z
  end
  return joints, area, x, z
end

local function multiplier(n, t, embrace)
  local joints, W, X, Z = ring(n, t, embrace)
  local best = math.huge
  -- Work of the weights (down) and of the weights turned to +x, for the part from joint i to j that rotates by w (counter-clockwise) about
  -- (cx, cz): displacement (-(z - cz) w, (x - cx) w).
  local function works(i, j, cx, cz, w)
    local weight, mx, mz = W[j] - W[i], X[j] - X[i], Z[j] - Z[i]
    return -w * (mx - cx * weight), -w * (mz - cz * weight)
  end
  local function try(i, j, k, l, first)  -- `first`: side of the hinge at i, then alternating
    local A, B, C, D = joints[i][first], joints[j][3 - first], joints[k][first], joints[l][3 - first]
    local dx, dz, ex, ez = B[1] - A[1], B[2] - A[2], C[1] - D[1], C[2] - D[2]
    local det = dx * ez - dz * ex
    if math.abs(det) < 1e-12 then return end
    local s = ((D[1] - A[1]) * ez - (D[2] - A[2]) * ex) / det
    local cx, cz = A[1] + s * dx, A[2] + s * dz  -- centre of rotation of the middle part
    -- the first part rotates by 1; at B both parts have the same displacement: 1 (B - A) = w2 (B - centre); likewise at C for the last part
    local w2 = 1 / (1 - s)
    local u = (ex ^ 2 + ez ^ 2)
    local w3 = w2 * ((C[1] - cx) * ex + (C[2] - cz) * ez) / u
    -- About an inner edge a joint opens if the part on its right rotates clockwise relative to the left one; about an outer edge the other
    -- way.
    local function opens(left, right, side) return side == 1 and left - right or right - left end
    local sign = opens(0, 1, first) > 0 and 1 or -1
    if not (opens(1, w2, 3 - first) * sign > 0 and opens(w2, w3, first) * sign > 0 and opens(w3, 0, 3 - first) * sign > 0) then return end
    local g1, h1 = works(i, j, A[1], A[2], 1)
    local g2, h2 = works(j, k, cx, cz, w2)
    local g3, h3 = works(k, l, D[1], D[2], w3)
    local down, side = sign * (g1 + g2 + g3), sign * (h1 + h2 + h3)
    if side > 1e-12 and -down / side > 0 then best = math.min(best, -down / side) end
  end
  for i = 0, n - 3 do
    for j = i + 1, n - 2 do
      for k = j + 1, n - 1 do
        for l = k + 1, n do
          try(i, j, k, l, 1)
          try(i, j, k, l, 2)
        end
      end
    end
  end
  return best
end

return { multiplier = multiplier }
