-- Four mitred walls under a ring of reinforced concrete, on ground that shakes as a sine: how much does the ring help?
--
-- What happens   Four walls without bond stand on a base, mitred at the corners. The ground moves as a sine that begins at the phase at which a
--                wall lifts off. The front wall leans outwards and takes the ring along. The ring rubs on the walls along the motion, and the
--                wall at the back, wedged between them, holds it too.
-- Source         P. J. S. Gomes, Modelling of masonry structures by means of the discrete element method (IST Lisbon): geometry, cases, contacts
--                between walls (50 MPa/m, frictionless) and under the ring (1 GPa/m, 30 degrees), phase and both criteria. Density of the ring
--                with its share of the roof from its Table 2. The calibrated contact of wall and base is not printed:
--                ours is what erbs calibrate finds with scenes/studies/calibrate_wall.lua and calibrate_wall_pena.lua (on feet).
-- How to run     erbs run scenes/box_lintel.lua [-D case=3] [-D method=2] [-D omega=1] [-D amplitude=2.3] [-D 'direction="y"']
--                [-D side_friction=0] [-D mitre_kn=1e3] [-D mitre_angle=15] [-D 'criterion="alpha"']
--                Figs. 9 and 10: erbs sweep scenes/studies/box_collapse_relation.lua
-- What to look at  metrics.collapse (1: the criterion is met), turn_at_zero, turn_front, turn_back, turn_side, all over alpha
local keys = {
  beds = include "verify/parts/calibrated_beds.lua",
  case = param("case", 2, "1 no ring, 2 ring, 3 ring with the roof, 4 ring with three times the roof"),
  method = param("method", 1, "calibration of the contact of wall and base: 1 stiffness and friction, 2 stiffness and damping"),
  omega = param("omega", 1, "circular frequency of the ground over p of a wall [-]"),
  amplitude = param("amplitude", 2.3, "of the ground over g alpha [-]"),
  direction = param("direction", "x", "of the ground: x or y"),
  side_friction = param("side_friction", 1, "1: the ring rubs on the walls along the motion; 0: it does not"),
  criterion = param("criterion", "alpha_at_zero", "alpha_at_zero: theta = alpha when the acceleration first vanishes; alpha: at any time of the run"),
  cycles = param("cycles", 3, "of the sine, for the criterion alpha"),
  angle = param("angle", 30, "of friction under the ring [deg]"),
  mitre_angle = param("mitre_angle", 0, "of friction in the mitres [deg]"),
  mitre_kn = param("mitre_kn", 50e6, "stiffness of the mitres; at 1e3 the walls along hold no other: with side_friction=0 a rocking frame [Pa/m]"),
}
local box = (include "verify/parts/box_of_walls.lua")(keys)
metric("collapse", "", function(run) return box.collapsed(run) and 1 or 0 end)
metric("turn_at_zero", "", box.turn_at_zero)
for _, which in ipairs { "front", "back", "side" } do metric("turn_" .. which, "", function(run) return box.turn(run, which) end) end
metric("zero_s", "s", box.zero)
camera { name = "box", eye = { 11, -11, 7 }, target = { 0, 0, 1.5 } }
