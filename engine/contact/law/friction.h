// Coulomb friction of a patch: two slips and a torsion at its area centroid, limit about the centre of pressure.
#pragma once
#include "engine/contact/overlap/general.h"
#include "engine/model/contact_pair.h"

namespace erbs {

// Friction limit of a patch at an instant. Its springs act at its centroid. The limit is about its centre of pressure, where the torsion is
// m + lever . t.
struct PatchLimit {
  double limit = 0, r = 0;  // N, m: limit of force alone; limit r is that of torsion alone
  // shape factor of the limit surface (`friction.cpp`)
  double shape_factor = 0;
  double gyration2 = 0;       // m2, of the springs: kr / kt
  Vec3 lever = Vec3::Zero();  // m, n x (centroid - centre of pressure)
};

struct Pull {
  Vec3 force = Vec3::Zero();  // N, tangential
  double torsion = 0;         // N m, about the centroid
};

struct ReturnResult {
  Pull springs;      // forces of the springs after the return
  double share = 0;  // share of the dashpots within the limit
  bool slips = false;
};

// Springs stick, whatever the shape of the patch, while the squares of force and torsion over their limits add up to no more than this.
inline constexpr double surely_within = 0.79;
// The friction law as a return map: limits the trial forces of the `springs`, then the `dashpots` to the remaining part of the limit.
ReturnResult return_map(PatchLimit patch_limit, const Patch& patch, const Pull& springs, const Pull& dashpots);

struct Friction {
  Vec3 force = Vec3::Zero();                                         // N, on the body that is not the reference, pair axes
  Vec3 moment = Vec3::Zero();                                        // N m, about its centroid
  Vec3 viscous_force = Vec3::Zero(), viscous_moment = Vec3::Zero();  // dashpots of the sticking contact, within the limit
  double stored = 0;                                                 // J
  double slipped = 0;                                                // J, lost in plastic slip this step
};

// Motion of the other body relative to the reference, as of a body with its centroid at the origin of the pair axes.
struct Motion {
  Vec3 linear, angular;  // m/s, rad/s
};

// Advances the friction memory of `pair` from its last pose to `pose`. `inverse_mass` (1/kg): of both bodies at the patch, in its plane.
// `interlock`: that of `ContactSettings`.
Friction patch_friction(ContactPair& pair, const Patch& patch, const PairPose& pose, const Motion& motion, double normal_force,
                        double inverse_mass, double settling, const Interlock& interlock = {});

}  // namespace erbs
