-- Courses cut along a line: what arcade{...}, barrel{...} and buttress{...} share. A piece is a convex polygon in the plane of the
-- elevation, { u, z } with u along the builder's axis, extruded across it. Every edge of a polygon lies on a bed, a perpend or a facet of
-- the ring beneath, each computed once, so that faces meet exactly and joints are found.

local parts, eps = masonry_parts, masonry_parts.eps

-- Edges of the blocks across a width, from 0: `rows` equal ones, in odd courses shifted by half a block.
local function row_edges(width, rows, odd)
  local edges, step = { 0 }, width / rows
  for i = 1, rows - 1 + (odd and rows > 1 and 1 or 0) do edges[i + 1] = (i - (odd and 0.5 or 0)) * step end
  edges[#edges + 1] = width
  return edges
end

-- Lays the polygon in all rows of its course: prisms across the axis. place: { at, axis, width, joint }, joint (m) the gap between rows.
-- Returns names and volume (m3).
local function lay_across(place, polygon, edges, block)
  local turned, area, names, length = {}, 0, {}, 0
  for i, c in ipairs(polygon) do
    local d = polygon[i % #polygon + 1]
    area = area + (c[1] * d[2] - d[1] * c[2]) / 2
    turned[i] = place.axis == "x" and { c[2], c[1] } or { c[1], c[2] }  -- the polygon of a prism along y is { z, x }, along x { y, z }
  end
  for j = 1, #edges - 1 do
    local gap = (place.joint or 0) / 2
    local v = edges[j] - place.width / 2 + (j > 1 and gap or 0)
    local height = edges[j + 1] - place.width / 2 - (j < #edges - 1 and gap or 0) - v
    length = length + height
    names[j] = prism {
      name = #edges > 2 and string.format("%s.r%d", block.name, j) or block.name,
      group = block.group, material = block.material, fixed = block.fixed,
      polygon = turned, axis = place.axis == "x" and "y" or "x", height = height,
      at = place.axis == "x" and { place.at[1], place.at[2] + v, place.at[3] } or { place.at[1] + v, place.at[2], place.at[3] },
    }
  end
  return names, math.abs(area) * length
end

-- The stretches of a course that ends at the height `top`. profile: its underside from left to right, { u, z } with z <= top; where it lies
-- at `top` there is no masonry. Returns lists of points; the ends of a list are at `top` or stand for a vertical face.
local function stretches(profile, top)
  local all, one = {}, nil
  for i = 2, #profile do
    local a, b = profile[i - 1], profile[i]
    if a[2] >= top and b[2] >= top then
      one = nil
    elseif b[1] - a[1] > eps then
      if not one then
        one = { a }
        all[#all + 1] = one
      end
      one[#one + 1] = b
    end
  end
  return all
end

-- Points of the underside about which a piece would be concave: its slope falls there. Pieces are split at these.
local function corners_within(points)
  local found = {}
  for i = 2, #points - 1 do
    local a, b, c = points[i - 1], points[i], points[i + 1]
    if (b[2] - a[2]) / (b[1] - a[1]) > (c[2] - b[2]) / (c[1] - b[1]) + eps then found[#found + 1] = b[1] end
  end
  return found
end

-- Perpends of a stretch, in order. wanted: perpends of the bond, of which those go that would leave a piece narrower than `least`.
-- That merges the sliver with its neighbour.
local function perpends_of(points, top, wanted, least)
  local first, last = points[1], points[#points]
  local fixed = corners_within(points)
  local from = first[2] >= top and points[2][1] or first[1]  -- where the lower edge begins
  local to = last[2] >= top and points[#points - 1][1] or last[1]
  local list = {}
  for _, u in ipairs(wanted) do
    local room = math.min(u - from, to - u)
    for _, f in ipairs(fixed) do room = math.min(room, math.abs(u - f)) end
    if room > least - eps then list[#list + 1] = u end
  end
  for _, f in ipairs(fixed) do list[#list + 1] = f end
  table.sort(list)
  return list
end

-- Cuts a stretch at its perpends into polygons, counter-clockwise from the lower left corner.
local function cut(points, top, perpends)
  local pieces, i = {}, 1
  local lower = { points[1] }  -- underside of the piece so far
  local function close(u)
    local polygon, first, last = {}, lower[1], lower[#lower]
    for n, p in ipairs(lower) do
      local before, after = lower[n - 1], lower[n + 1]
      local straight = before and after
        and math.abs((p[2] - before[2]) * (after[1] - p[1]) - (after[2] - p[2]) * (p[1] - before[1])) < 1e-12
      if not straight then polygon[#polygon + 1] = p end
    end
    if last[2] < top - eps then polygon[#polygon + 1] = { u, top } end
    if first[2] < top - eps then polygon[#polygon + 1] = { first[1], top } end
    pieces[#pieces + 1] = polygon
  end
  for _, u in ipairs(perpends) do
    while points[i + 1][1] < u - eps do
      i = i + 1
      lower[#lower + 1] = points[i]
    end
    local a, b = points[i], points[i + 1]
    local at = math.abs(b[1] - u) < eps and b or { u, a[2] + (b[2] - a[2]) * (u - a[1]) / (b[1] - a[1]) }
    lower[#lower + 1] = at
    close(u)
    lower = { at }
    if at == b then i = i + 1 end
  end
  for n = i + 1, #points do lower[#lower + 1] = points[n] end
  close(points[#points][1])
  return pieces
end

-- Wraps a builder so that its mistakes are reported at the line that called it. The script continues without the blocks, so that later
-- mistakes are reported as well.
local note_mistakes = note_mistakes  -- function of the program, hidden from scenes
local function public(body, nothing)
  return function(...)
    local ok, result = pcall(body, ...)
    if ok then return result end
    if type(result) ~= "table" or not result.masonry then error(result, 0) end
    note_mistakes(result.masonry)
    return nothing()
  end
end

parts.row_edges, parts.lay_across, parts.stretches, parts.perpends_of, parts.cut = row_edges, lay_across, stretches, perpends_of, cut
parts.public = public
