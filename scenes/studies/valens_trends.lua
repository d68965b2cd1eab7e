-- Trends of the aqueduct of Valens: what the stiffness, the strengths and the friction of its joints change
--
-- What happens   Each run pushes a pier of valens_aqueduct.lua with half an arch on either side to its capacity, with one property of the joints
--                changed. What the source found for its partial model stands beside it.
-- Source         The Valens (Bozdogan) aqueduct by discrete elements, parametric study: .19 g at 2 GPa/m, rising to .21 g at 30; ft of .05 to
--                .5 MPa changes the displacement, not the capacity; friction is weak; fc is critical at 20 MPa, above it at most 5 % more.
-- How to run     for t in stiffness tension friction compression; do erbs sweep scenes/studies/valens_trends.lua -D trend=$t -o runs/$t; done
--                -D rows=1 takes blocks as wide as the aqueduct, a tenth of the time; -D bays=0 the partial model, ten times of it
-- What to look at  results.svg and results.csv in each folder: capacity over the property; metrics.capacity.displacement_m over ft.
local trend = param("trend", "stiffness", "stiffness, tension, friction or compression")
local rows = param("rows", 4, "blocks across the width")
local bays = param("bays", 1, "piers of the cut-out; 0: the partial model")

local trends = {
  stiffness = { key = "E", values = { 1 * GPa, 2.5 * GPa, 5 * GPa, 10 * GPa, 15 * GPa }, x = "E of the masonry [Pa]; kn = E / 0.5 m",
    published = { { 1 * GPa, 0.19 }, { 5 * GPa, 0.21 }, { 15 * GPa, 0.21 } } },
  tension = { key = "ft", values = { 0.05 * MPa, 0.1 * MPa, 0.25 * MPa, 0.5 * MPa }, x = "ft of the joints [Pa]",
    published = { { 0.05 * MPa, 0.21 }, { 0.5 * MPa, 0.21 } } },
  friction = { key = "mu", values = { 0.5, 0.6, 0.7, 0.85, 1 }, x = "friction of the joints [-]", published = { { 0.5, 0.21 }, { 1, 0.21 } } },
  compression = { key = "fc", values = { 5 * MPa, 10 * MPa, 20 * MPa, 40 * MPa, 80 * MPa }, x = "fc of the joints [Pa]",
    published = { { 20 * MPa, 0.21 }, { 80 * MPa, 0.22 } } },
}
local t = trends[trend] or error("trend is stiffness, tension, friction or compression, not " .. trend)
local x, y = {}, {}
for i, point in ipairs(t.published) do x[i], y[i] = point[1], point[2] end

study {
  title = "Valens aqueduct: capacity over " .. t.x,
  scene = "../valens_aqueduct.lua",
  vary = { grid { [t.key] = t.values }, grid { rows = { rows } }, grid { bays = { bays } } },
  collect = { "capacity.multiplier", "capacity.upper", "capacity.displacement_m", "capacity.joints_opened", "capacity.joints_slid",
    "capacity.mechanism", "capacity.relaxation_steps" },
  keep = "metrics",
  x = t.x, y = "acceleration [g]",
  max_wall = "2h",
  curves = { { label = "published", x = x, y = y } },
}
