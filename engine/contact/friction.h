// Coulomb friction of a patch: two slips and a torsion at its area centroid, limit about the centre of pressure.
#pragma once
#include "engine/contact/narrow.h"
#include "engine/model/pair.h"

namespace erbs {

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
Friction patch_friction(Pair& pair, const Patch& patch, const PairPose& pose, const Motion& motion, double normal_force,
                        double inverse_mass, double settling);

}  // namespace erbs
