-- The Valens aqueduct: two tiers of arches, pushed out of their plane
--
-- What happens   The aqueduct stands in equilibrium under its own weight. Then an acceleration across it grows in steps of .01 g, each in
--                equilibrium, until there is none. Joints open at the foot of the piers on the windward side, cracks climb towards the
--                toe, and the piers overturn between the end walls.
-- Source         The Valens (Bozdogan) aqueduct by discrete elements: full model of 29,695 blocks over 195 m, partial one of 16,920
--                over 102 m; capacity .22 and .21 g. Given: width 5.25 m, height 28 to 29 m, spans 2.4 to 6.15 m, two tiers, E = 5 GPa,
--                joints every .5 m that bear at their vertices, kn = E / h = 10 GPa/m, ks = kn / (2 (1 + nu)), ft = .25 MPa, blocks half
--                as high as long, fixed base. Not given, and assumed here, each a param: heights of the tiers, piers, rings, end walls,
--                rows of blocks across the width, density, cohesion, friction, nu. A geophysical survey of 2009 found the
--                foundations 5.4 to 6 m below the surface (Wikipedia, Aqueduct of Valens); the height is taken from there, and the ground
--                holds what is in it. The ground rises evenly from the middle. Both models then have about as many blocks as the
--                source's, 16,506 and 28,740.
-- How to run     erbs check scenes/valens_aqueduct.lua                     the partial model; -D model=2: the full one
--                erbs run scenes/valens_aqueduct.lua -D up_to=0            equilibrium under gravity only
--                erbs run scenes/valens_aqueduct.lua -D bays=1             a pier with half an arch on either side; erbs render with
--                                                                          --hide plane leaves its planes of symmetry out
--                erbs run scenes/valens_aqueduct.lua -D dynamic=1 --video  the acceleration grows in time
-- What is found  The partial model bears .2075 g, none at .21, the full one .215, none at .2175; piers overturn out of plane on a stepped
--                crack (.21 and .22 g in the source). On beds of 2 GPa/m (-D E=1e9) the partial one bears .1825 g (.19), of 30 GPa/m .21
--                (.21); with ft of .05 MPa .2025, of .5 MPa .2075. One pier (-D bays=1) bears .1925 g; its trends, in the order of
--                studies/valens_trends.lua: .1725, .1875, .1925, .195, .195 g; .19, .19, .1925, .1975; .1925 throughout; .1775, then
--                .1925 from fc = 10 MPa on. Gamma phi_top is 1.43 (1.51). With all of its height above the ground (-D buried=0 -D valley=10.5
--                -D length=1) the partial model bears .17 g, .1875 in two rows, and .2375 of blocks as wide as the aqueduct (-D rows=2,
--                rows=1); one pier of those .23, of which bond is .06 (.1725 with ft and c of 1 kPa), as of one piece.
-- What to look at  curve.svg: acceleration over the displacement of the top above the middle pier; capacity.multiplier, .21 g (partial) and
--                .22 g (full) in the source; capacity.mechanism; cracks on the windward side, down to the toe.

local model = param("model", 1, "1: partial, 102 m; 2: full, 195 m")
local bays = param("bays", 0, "piers of a cut-out from the middle, between planes of symmetry; 0: the model")
local step = param("step", 0.01, "of the acceleration [g]")
local up_to = math.max(1e-6, param("up_to", 0.5, "largest acceleration [g]"))
local bracket = param("bracket", 0.02, "of the capacity, relative")
local fall = param("fall", 2, "time of the fall drawn after a push [s]")
local dynamic = param("dynamic", 0, "1: the acceleration grows in time, for films")
local peak = param("peak", 0.3 * g, "dynamic: acceleration across the aqueduct at the end [m/s2]")
local ramp = param("ramp", 8, "dynamic: time in which it grows to that, slow beside the period of .6 s [s]")

local width = param("width", 5.25, "of the whole aqueduct [m]")
local height = param("height", 28.5, "in the middle, where it is highest: 28 to 29 m, taken from the foundations [m]")
local buried = param("buried", 5.5, "of it in the ground, which holds it; a survey found the foundations 5.4 to 6 m deep [m]")
local valley = param("valley", 5, "rise of the ground over 120 m from the middle, where the two tiers end, assumed; 0: level [m]")
local span = param("span", 4, "of the arches, but for three [m]")
local span_least = param("span_least", 2.4, "of the first and the last arch, the least of the source; place assumed [m]")
local span_most = param("span_most", 6.15, "of the arch in the middle, the greatest of the source; place assumed [m]")
local pier = param("pier", 3.7, "width of the piers along the aqueduct [m]")
local springing1 = param("springing1", 10.5, "springing line of the lower tier above the foundations, assumed [m]")
local top1 = param("top1", 15, "top of the lower tier, where the upper piers begin, assumed [m]")
local springing2 = param("springing2", 24, "of the upper tier, assumed: as much masonry over its crowns as over the lower ones [m]")
local ring = param("ring", 0.55, "least thickness of the arches, assumed; they end in the middle of a course [m]")
local length = param("length", 1.03, "of a whole block [m]")
local rows = param("rows", 4, "blocks across the width, assumed: both models then have about as many blocks as the source's")
local density = param("density", 2200, "assumed [kg/m3]")
local E = param("E", 5 * GPa, "of the masonry [Pa]")
local spacing = param("spacing", 0.5, "of the bed joints, the height of a course [m]")
local nu = param("nu", 0.2, "assumed")
local corners = param("corners", 1, "1: the corners of a bed bear, as the point contacts of the source; 0: its whole face")
local ft = param("ft", 0.25 * MPa, "tensile strength of the joints [Pa]")
local c = param("c", 0.4 * MPa, "cohesion, assumed: 1.6 ft; lost with the first slip [Pa]")
local mu = param("mu", 0.7, "friction, assumed: 35 degrees")
local fc = param("fc", 0, "compressive strength of the joints; 0: unlimited, as in the source's first model [Pa]")
local Gc = param("Gc", 0, "compressive fracture energy; 0: a plateau at fc; usual: 1.6 mm fc [J/m2]")
local SDS = param("SDS", 0.975, "DD-2 on ground ZB: 2.5 times the design PGA of the source, .39 g [share of g]")
local SD1 = param("SD1", 0.22, "the same, at 1 s; not given, assumed: .8 times an S1 of .27 [share of g]")

-- The widest arch in the middle, the narrowest at the ends. The walls beyond take what remains of the length.
local function spans_of(count)
  local spans = {}
  for i = 1, count do spans[i] = (i == 1 or i == count) and span_least or 2 * i == count + 1 and span_most or span end
  return spans
end
local arches, long = model == 2 and 23 or 11, model == 2 and 195 or 102
local spans, piers = spans_of(arches), {}
if bays > 0 then
  local all = spans
  spans = {}
  for i = 0, bays do spans[i + 1] = all[math.max(1, math.min(#all, (#all + 1) // 2 + i - bays // 2))] end
  for i = 1, bays do piers[i] = pier end
else
  local rest = long
  for i, span in ipairs(spans) do rest = rest - span - (i > 1 and pier or 0) end
  for i = 1, arches + 1 do piers[i] = (i == 1 or i > arches) and rest / 2 or pier end
end

local total = 0
for i, span in ipairs(spans) do total = total + (bays > 0 and (i == 1 or i == #spans) and span / 2 or span) end
for _, wide in ipairs(piers) do total = total + wide end

local joints = masonry_stiffness { E = E, nu = nu, spacing = spacing }
local kn, ks = joints.kn, joints.ks
material { name = "stone", density = density, friction = mu, restitution = 0.1, kn = kn, ks = ks, color = { 0.74, 0.68, 0.58 } }
material { name = "ring", density = density, friction = mu, restitution = 0.1, kn = kn, ks = ks, color = { 0.63, 0.47, 0.37 } }
local law = mortar { kn = kn, ks = ks, ft = ft, c = c, mu = mu, fc = fc, Gc = fc > 0 and Gc or 0 }
if corners == 1 then joint { law = law, tolerance = 1 * mm, rule = "trapezoid", points = 4, pressure = "points" }
else joint { law = law, tolerance = 1 * mm } end

-- The valley: the ground rises evenly from the two piers in the middle, in steps from one pier to the next.
local feet, steps, u = {}, {}, -total / 2
for i, wide in ipairs(piers) do
  local left, right = spans[bays > 0 and i or i - 1] or 0, spans[bays > 0 and i + 1 or i] or 0
  if bays > 0 and i == 1 then u = u + left / 2 end
  local beyond = math.max(0, math.abs(u + wide / 2) - (span_most + pier) / 2)
  feet[i] = bays > 0 and 0 or spacing * math.floor(valley * beyond / 120 / spacing + 0.5)
  steps[i] = { from = u - left / 2, to = u + wide + right / 2, top = feet[i] }
  u = u + wide + right
end
ground { size = total + 120, friction = mu }
if valley > 0 and bays == 0 then
  for i, s in ipairs(steps) do
    local from, to = i > 1 and s.from or s.from - 8, i < #steps and s.to or s.to + 8
    if s.top > 0 then
      box { name = "rock" .. i, group = "rock", material = "stone", fixed = true, size = { to - from, width + 40, s.top },
        at = { from, -width / 2 - 20, 0 } }
    end
  end
end
local built = arcade {
  name = "valens", at = { -total / 2, 0, -buried }, spans = spans, piers = piers, feet = feet,
  ends = bays > 0 and "half" or "pier", width = width, rows = rows, block = { length = length, height = spacing }, fixed_courses = math.max(1, math.floor(buried / spacing + 0.5)),
  material = "stone", ring_material = "ring",
  tiers = { { springing = springing1, top = top1, thickness = ring }, { springing = springing2, top = height, thickness = ring } },
}
if bays > 0 then  -- planes of symmetry: plates without friction, along which the ends of the half arches slide
  material { name = "plane", density = density, friction = 0, restitution = 0, kn = kn, ks = ks, color = { 0.8, 0.8, 0.8 } }
  -- Without friction ks bears nothing; a stiff one would make the push seem quicker than it is, and its relaxation slow.
  joint { between = { "plane", "" }, law = dry { kn = kn, ks = 1e-4 * kn, mu = 0 }, tolerance = 1 * mm }
  for side = 0, 1 do
    box { name = "plane" .. side, group = "plane", material = "plane", fixed = true, size = { 0.5, 3 * width, 1.1 * height },
      at = { side == 0 and -total / 2 - 0.5 or total / 2, -width, 0 } }
  end
end

gravity(g)
local middle = built.piers[(#built.piers + 1) // 2]
local top, nodes = middle.courses[#middle.courses], {}
for _, course in ipairs(middle.courses) do table.move(course, 1, #course, #nodes + 1, nodes) end
if dynamic == 1 then
  -- The ground accelerates towards -y, which pushes the aqueduct towards +y.
  ground_motion { wave = table_wave { times = { 0, ramp }, values = { 0, peak }, hold = true }, direction = { 0, -1, 0 } }
  damping { mass = 1 }
  analysis { duration = ramp + 2, stop_after_collapse = 2, output_dt = 0.02, frame_dt = 0.1 }
else
  analysis { kind = "pushover", direction = "y", step = math.min(step, up_to), up_to = up_to, bracket = bracket, fall = fall,
    monitor = { block = top[(#top + 1) // 2] } }
  if up_to > step then spectrum { kind = "TBSC 2018", SDS = SDS, SD1 = SD1, shape = "elastic", nodes = 8, blocks = nodes } end
end
recorder { name = "top", quantity = "displacement", blocks = top, axis = "y" }
metric("blocks_per_metre", "1/m", (#built.blocks + #built.base) / total)

local seen = height - buried
local far = math.max(0.9 * total, 1.9 * seen)
camera { name = "windward", eye = { -0.35 * far, -far, 0.55 * seen }, target = { 0, 0, 0.46 * seen }, fov = 38 * deg }
camera { name = "leeward", eye = { 0.35 * far, far, 0.55 * seen }, target = { 0, 0, 0.46 * seen }, fov = 38 * deg }
camera { name = "along", eye = { -0.5 * total - 1.6 * seen, -0.5 * seen, 0.6 * seen }, target = { 0, 0, 12 }, fov = 40 * deg }
