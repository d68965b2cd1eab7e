-- Contact of a wall of .6 x 3 m and its base by two methods: what `erbs calibrate` finds with scenes/studies/calibrate_wall.lua, and with
-- calibrate_wall_pena.lua -D foot=0.008. Of method 2 that is now xi = .298 +- .012, a restitution exp(-pi xi / sqrt(1 - xi^2)) of .375; the boxes
-- were run with .362 and .295, as an earlier fit gave them. Method 1 has no damping.
return {
  { kn = 6.0e10, ks = 1.22e9, mu = 0.58, restitution = 1, damping = 0 },
  { kn = 1.06e11, ks = 1.06e11, mu = math.tan(30 * deg), restitution = 0.295, damping = 0.362 },
}
