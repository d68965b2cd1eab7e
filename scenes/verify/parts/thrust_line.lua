-- Statics of symmetric arches under their own weight, without tension, crushing or sliding (Heyman 1966): does a thrust line lie inside the
-- arch?
--
-- Half the arch, from the crown to the springing. The crown carries a horizontal thrust H at height z0. Consider the joint below k
-- voussoirs of weight W, whose centroid is at distance xw from the middle. The moment about a point (x, z) of this joint is H (z0 - z) - W
-- (x - xw). It must not turn the part about the inner end one way, nor about the outer end the other way. In the plane of H and M = H z0
-- these conditions are half planes; they cut a polygon, which becomes empty if the arch cannot stand.
local function clip(polygon, a, b, c)  -- keeps a u + b v <= c
  local out = {}
  for i, p in ipairs(polygon) do
    local q = polygon[i % #polygon + 1]
    local dp, dq = a * p[1] + b * p[2] - c, a * q[1] + b * q[2] - c
    if dp <= 0 then out[#out + 1] = p end
    if (dp < 0 and dq > 0) or (dp > 0 and dq < 0) then
      local s = dp / (dp - dq)
      out[#out + 1] = { p[1] + s * (q[1] - p[1]), p[2] + s * (q[2] - p[2]) }
    end
  end
  return out
end

-- Area and centroid of the polygon of corners { x, z }.
local function centroid(corners)
  local area, sx = 0, 0
  for i, p in ipairs(corners) do
    local q = corners[i % #corners + 1]
    local cross = p[1] * q[2] - q[1] * p[2]
    area, sx = area + cross / 2, sx + (p[1] + q[1]) * cross / 6
  end
  return math.abs(area), sx / area
end

-- Joints of the right half from the crown down, inner and outer ends { x, z }, radius 1. With an odd number the crown is the middle of a
-- voussoir.
local function half_arch(n, embrace, offset, t)
  local joints, inner, outer = {}, 1 - t / 2, 1 + t / 2
  if offset > 0 then
    local top = math.acos(offset)
    joints[1] = { { 0, math.sqrt(inner ^ 2 - offset ^ 2) }, { 0, math.sqrt(outer ^ 2 - offset ^ 2) } }
    for i = n // 2 - 1, 0, -1 do
      local angle, j = top * i / (n // 2), {}
      for side, r in ipairs { inner, outer } do j[side] = { r * math.cos(angle) - offset, r * math.sin(angle) } end
      joints[#joints + 1] = j
    end
    return joints
  end
  local step = embrace / n
  local first = n % 2 == 1 and 0.5 or 1
  local cut = math.cos(step / 2)
  -- with an odd number the cut at the crown halves a straight voussoir; with an even number it is a joint
  joints[1] = n % 2 == 1 and { { 0, inner * cut }, { 0, outer * cut }, no_joint = true } or { { 0, inner }, { 0, outer } }
  for i = 0, n // 2 + n % 2 - 1 do
    local angle = (first + i) * step
    if angle <= embrace / 2 + 1e-9 then joints[#joints + 1] = { { inner * math.sin(angle), inner * math.cos(angle) }, { outer * math.sin(angle), outer * math.cos(angle) } } end
  end
  return joints
end

-- weight_of(corners): area and distance of the centroid of a voussoir (default: of equal width).
local function stands(joints, weight_of)
  local region = { { 0, -1e3 }, { 1e3, -1e3 }, { 1e3, 1e3 }, { 0, 1e3 } }  -- H, M: times density and g
  local weight, moment = 0, 0                                              -- sum W, sum W xw
  for k, joint in ipairs(joints) do
    if k > 1 then
      local above = joints[k - 1]
      local w, x = (weight_of or centroid) { above[1], above[2], joint[2], joint[1] }
      weight, moment = weight + w, moment + w * x
    end
    for side, p in ipairs(joint.no_joint and {} or joint) do
      -- about p: M - H z - (W x - sum W xw): at most zero about the outer end (2), at least zero about the inner end
      local c = weight * p[1] - moment
      local sign = side == 2 and 1 or -1
      region = clip(region, -sign * p[2], sign, sign * c)
      if #region == 0 then return false end
    end
  end
  return true
end

local function least_thickness(n, embrace, offset, weight_of)
  local low, high = 1e-3, 0.8
  for _ = 1, 40 do
    local t = (low + high) / 2
    if stands(half_arch(n, embrace, offset, t), weight_of) then high = t else low = t end
  end
  return high
end

return { least_thickness = least_thickness, stands = stands, half_arch = half_arch }
