// Coulomb friction of a patch: two slips and a torsion at its area centroid, limit about the centre of pressure.
#pragma once
#include "engine/contact/narrow.h"
#include "engine/model/pair.h"

namespace erbs {

// What a patch bears at an instant. Its springs sit at its centroid, the limit is about its centre of pressure, where the torsion
// is m + lever . t.
struct Bearing {
  double limit = 0, r = 0;  // N, m: force alone is borne up to limit, torsion alone up to limit r
  double bulge = 0;
  double gyration2 = 0;       // m2, of the springs: kr / kt
  Vec3 lever = Vec3::Zero();  // m, n x (centroid - centre of pressure)
};

struct Pull {
  Vec3 force = Vec3::Zero();  // N, tangential
  double torsion = 0;         // N m, about the centroid
};

struct Borne {
  Pull springs;      // what they carry
  double share = 0;  // of the dashpots that is borne beside them
  bool slips = false;
};

// Within this share of the limits, force and torsion squared and summed, springs hold whatever the shape of the patch.
inline constexpr double surely_within = 0.79;
// The law of friction: what `springs` would pull with and what dashpots would add, held to the limit.
Borne borne(Bearing bearing, const Patch& patch, const Pull& springs, const Pull& dashpots);

struct Friction {
  Vec3 force = Vec3::Zero();                                         // N, on the body that is not the reference, pair axes
  Vec3 moment = Vec3::Zero();                                        // N m, about its centroid
  Vec3 viscous_force = Vec3::Zero(), viscous_moment = Vec3::Zero();  // dashpot of the sticking contact, part of the limit
  double stored = 0;                                                 // J
  double slipped = 0;                                                // J, lost in plastic slip this step
};

// Motion of the other body relative to the reference, as of a body with its centroid at the origin of the pair axes.
struct Motion {
  Vec3 linear, angular;  // m/s, rad/s
};

// Updates the memory of `pair` from the pose it remembers to `pose`. `inverse_mass` (1/kg) of the patch in its plane.
// `interlock`: that of ContactSettings.
Friction patch_friction(Pair& pair, const Patch& patch, const PairPose& pose, const Motion& motion, double normal_force,
                        double inverse_mass, double settling, const Interlock& interlock = {});

}  // namespace erbs
