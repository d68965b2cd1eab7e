-- A wall of strong mortar on a bed without bond, its lowest joint: bricks of .3 x .2 x .1 m in stack bond, along x turned by `angle`.
--
-- wall: the keys below. Recorded are displacement (`wall`) and velocity (`speed`) of the wall in the mean of its bricks. Returned is how far
-- and how fast it has moved along its length, backwards: functions of a run and a time (m, m/s).
return function(wall)
  local size, turn, mu = { 0.3, 0.2, 0.1 }, wall.angle * deg, wall.mu
  local along, turned = { math.cos(turn), math.sin(turn) }, { 0, 0, turn }
  material { name = "brick", density = 1800, friction = mu, restitution = 0.2, kn = 5e10, ks = 2e10 }
  box { name = "base", group = "base", material = "brick", size = { 2 * wall.cols * size[1] + 2, 1, 0.2 }, center = { 0, 0, -0.1 }, rotation = turned, fixed = true }
  for i = 1, wall.cols do
    local x = (i - (wall.cols + 1) / 2) * size[1]
    for k = 0, wall.rows - 1 do
      box { group = "wall", material = "brick", size = size, center = { x * along[1], x * along[2], (k + 0.5) * size[3] }, rotation = turned }
    end
  end
  joint { law = mortar { kn = wall.mortar_kn, ks = 0.4 * wall.mortar_kn, mu = mu, ft = 20 * MPa, c = 30 * MPa } }
  joint { between = { "base", "wall" }, law = mortar { kn = wall.kn, ks = 0.4 * wall.kn, mu = mu, ft = 0, c = 0, damping = wall.damping } }
  recorder { name = "wall", quantity = "displacement", group = "wall" }
  recorder { name = "speed", quantity = "velocity", group = "wall" }
  local function backwards(name, unit)
    return function(run, t) return -(along[1] * run.at(name .. "x" .. unit, t) + along[2] * run.at(name .. "y" .. unit, t)) end
  end
  return { moved = backwards("wall_u", "_rel_m"), speed = backwards("speed_v", "_rel_m_s"), along = along, size = size }
end
