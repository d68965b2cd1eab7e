-- Limit analysis of the dry wall of Ferris and Tin-Loi under a horizontal load in its plane.
--
-- What happens   Blocks of 0.4 x 0.175 m, five wide and six courses high; a force of lambda times its weight pushes each. A corner turns off
--                along a stepped crack. With -D halves=0, five whole blocks lie at the base, and the wall slides at lambda = mu.
-- Source         Ferris and Tin-Loi 2001 (Int. J. Mech. Sci. 43, 209): 0.6429 with dilatant friction, about 0.640 without dilatancy.
-- How to run     erbs limit scenes/limit/ferris_wall.lua -o runs/ferris_limit [-D courses=16] [-D mu=0.5] [--direction y]
-- What to look at  associated and non-associated lambda, the tilting angle; limit.png: thrusts and mechanism. Out of plane: width / height.
local mu = param("mu", 0.65, "friction of all joints")
local wide, courses = param("wide", 5, "blocks in a course"), param("courses", 6, "")
local halves = param("halves", 1, "1: half blocks at the ends of the lowest course, 0: whole ones")
local kn = 1e11

material { name = "stone", density = 2000, friction = mu }
box { name = "floor", size = { 0.4 * wide + 2, 2, 0.3 }, at = { -0.2 * wide - 1, -1, -0.3 }, fixed = true, material = "stone" }
wall { brick = { length = 0.4, width = 0.2, height = 0.175 }, length = 0.4 * wide, courses = courses, joint = 0, shift = 1 - halves, closer = 0.1,
  at = { -0.2 * wide, -0.1, 0 }, material = "stone", quiet = true }
joint { law = dry { kn = kn, ks = 0.4 * kn, mu = mu } }
analysis { duration = 1 }
