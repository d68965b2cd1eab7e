-- Random numbers of a scene from its seed: splitmix64 (Steele, Lea and Flood 2014), so that neighbouring seeds are independent.
return function(seed)
  local state, draw = seed * 0x632be59bd9b4e019, {}
  function draw.uniform(lo, hi)
    state = state + 0x9e3779b97f4a7c15
    local z = state
    z = (z ~ (z >> 30)) * 0xbf58476d1ce4e5b9
    z = (z ~ (z >> 27)) * 0x94d049bb133111eb
    z = z ~ (z >> 31)
    return lo + (hi - lo) * ((z >> 11) * 2.0 ^ -53)
  end
  function draw.log_uniform(lo, hi) return math.exp(draw.uniform(math.log(lo), math.log(hi))) end
  function draw.whole(lo, hi) return lo + math.floor(draw.uniform(0, 1) * (hi - lo + 1)) end
  function draw.chance(p) return draw.uniform(0, 1) < p end
  return draw
end
