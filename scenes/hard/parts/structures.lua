-- Random structures of up to 75 blocks on a fixed base: a stack on a slope, a pier, an arch, a corbel, a wall, a portal, a barrel in bond, a
-- wall with a buttress, a room with a door. `draw` gives the numbers (draw.lua); blocks are of the material "brick". Returns names, height
-- (m), volume (m3), slope (rad), monitor (a block to look at; nil: the last).
return function(draw, kind, mu)
  local uniform, whole = draw.uniform, draw.whole
  local blocks, height, volume, monitor = {}, 0, 0, nil
  local function lay(name, size, center)
    box { name = name, group = "s", size = size, center = center, material = "brick" }
    blocks[#blocks + 1] = name
    height, volume = math.max(height, center[3] + size[3] / 2), volume + size[1] * size[2] * size[3]
  end
  local function base(lx, ly) box { name = "base", group = "base", size = { lx, ly, 0.2 }, center = { 0, 0, -0.1 }, fixed = true, material = "brick" } end

  local slope = 0
  local builders = {
    function()  -- a stack of plates of random size, on a slope that would hold it
      local n, l, d, h = whole(1, 12), uniform(0.2, 0.8), uniform(0.15, 0.5), uniform(0.05, 0.25)
      slope = math.min(uniform(0, 0.9) * math.atan(mu), math.atan(0.5 * l / (n * h)))
      transform { rotation = { 0, slope, 0 }, function()
        base(4 * l, 4 * d)
        local z = 0
        for i = 1, n do
          local hi = h * uniform(0.8, 1.2)
          lay("b" .. i, { l * uniform(0.85, 1.15), d * uniform(0.85, 1.15), hi }, { l * uniform(-0.05, 0.05), d * uniform(-0.05, 0.05), z + hi / 2 })
          z = z + hi
        end
      end }
    end,
    function()  -- a pier with two bricks per course, at right angles to the course below
      local courses, l, h = whole(2, 9), uniform(0.2, 0.5), uniform(0.06, 0.2)
      base(3 * l, 3 * l)
      for c = 1, courses do
        for side = -1, 1, 2 do
          local along = c % 2 == 0
          local size = along and { l, l / 2, h } or { l / 2, l, h }
          lay(("b%d_%d"):format(c, side), size, { along and 0 or side * l / 4, along and side * l / 4 or 0, (c - 0.5) * h })
        end
      end
    end,
    function()  -- an arch
      local radius = uniform(0.4, 1.5)
      local thick, wide = radius * uniform(0.16, 0.35), uniform(0.2, 0.5)
      local made = arch { name = "a", radius = radius, thickness = thick, width = wide, voussoirs = whole(5, 17),
        embrace = uniform(100, 180) * deg, material = "brick" }
      monitor = made.blocks[(#made.blocks + 1) // 2]
      blocks, height, volume = made.blocks, 1.3 * radius, 2.4 * radius * thick * wide  -- for an embrace of 100 to 180 degrees
    end,
    function()  -- a corbelled stack that leans out by a share of the harmonic series
      local n, l, d, h, share = whole(2, 9), uniform(0.3, 0.8), uniform(0.15, 0.4), uniform(0.06, 0.15), uniform(0.2, 0.8)
      base(4 * l, 2 * d)
      local x = 0
      for i = 1, n do
        lay("b" .. i, { l, d, h }, { x, 0, (i - 0.5) * h })
        x = x + share * l / (2 * (n + 1 - i))
      end
    end,
    function()  -- a wall in running bond
      local l, w, h = uniform(0.2, 0.4), uniform(0.1, 0.25), uniform(0.06, 0.15)
      local courses, bricks = whole(2, 8), whole(2, 6)
      base((bricks + 2) * l, 4 * w)
      for c = 1, courses do
        local from = -bricks / 2 * l
        while from < bricks / 2 * l - 0.01 do
          local to = math.min(from + ((c % 2 == 0 and from < -bricks / 2 * l + 0.01) and l / 2 or l), bricks / 2 * l)
          lay(("b%d_%d"):format(c, #blocks), { to - from, w, h }, { (from + to) / 2, 0, (c - 0.5) * h })
          from = to
        end
      end
    end,
    function()  -- two legs and a lintel
      local n, a, d, h, clear = whole(1, 5), uniform(0.15, 0.4), uniform(0.15, 0.4), uniform(0.1, 0.4), uniform(0.3, 1)
      base(2 * clear + 4 * a, 3 * d)
      for side = -1, 1, 2 do
        for i = 1, n do lay(("leg%d_%d"):format(side, i), { a, d, h }, { side * (clear + a) / 2, 0, (i - 0.5) * h }) end
      end
      local thick = uniform(0.1, 0.3)
      lay("lintel", { clear + uniform(1, 2) * a, d, thick }, { 0, 0, n * h + thick / 2 })
    end,
    function()  -- a barrel in bond
      local radius, rows = uniform(0.5, 1.5), whole(2, 3)
      local made = barrel { name = "v", radius = radius, thickness = radius * uniform(0.16, 0.35), width = uniform(0.4, 1.2), rows = rows,
        voussoirs = whole(5, 13), embrace = uniform(100, 180) * deg, material = "brick" }
      blocks, height, volume, monitor = made.blocks, made.height, made.volume, made.crown[1]
    end,
    function()  -- a wall with a buttress, upright, stepped or battered
      local l, w, h, courses = uniform(0.2, 0.4), uniform(0.1, 0.25), uniform(0.08, 0.15), whole(4, 8)
      base(8 * l, 8 * l)
      local long, depth = whole(3, 5) * l, uniform(0.5, 1) * courses * h
      local made = wall { name = "w", length = long, at = { -long / 2, 0, 0 }, courses = courses, joint = 0, material = "brick", quiet = true,
        brick = { length = l, width = w, height = h } }
      local stands = buttress { at = { 0, w, 0 }, towards = "y", width = l, depth = depth, top_depth = depth * uniform(0.4, 1),
        courses = whole(2, courses), block = { length = 1.2 * l, height = h }, material = "brick" }
      blocks, height, volume = stands.blocks, made.height, made.volume + stands.volume
      table.move(made.blocks, 1, #made.blocks, #blocks + 1, blocks)
    end,
    function()  -- a room of three or four bricks by as many, with a door
      local l, h, courses, bricks = uniform(0.3, 0.5), uniform(0.1, 0.2), whole(3, 5), whole(3, 4)
      base(8 * l, 8 * l)
      local made = building { plan = { bricks * l, whole(3, 4) * l }, at = { -2 * l, -2 * l, 0 }, courses = courses, joint = 0, material = "brick",
        brick = { length = l, width = l / 2, height = h }, quiet = true,
        openings = { { wall = "south", kind = "door", centre = bricks * l / 2, width = 0.7 * l, height = (courses - 1) * h } } }
      blocks, height, volume = made.blocks, made.height, made.volume
    end,
  }
  builders[kind]()
  return { blocks = blocks, height = height, volume = volume, slope = slope, monitor = monitor }
end
