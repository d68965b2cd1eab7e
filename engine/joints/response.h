// Resultants of one joint from its contact points, for joints that may be beyond their elastic bound.
#pragma once
#include "engine/laws/slip.h"
#include "engine/model/model.h"
#include "engine/model/state.h"

namespace erbs {

// Energy dissipated in one evaluation, and stored after it (J).
struct JointEnergy {
  double friction = 0, fracture = 0, crushing = 0, elastic = 0;
  double damping = 0;  // of dashpots, which `respond()` does not evaluate
};

// History of joint j.
struct JointPast {
  JointPast(PointHistory* of_points, CrushedFace* of_face = nullptr) : point(of_points), crushed(of_face) {}
  PointHistory* point;                  // [points]
  CrushedFace* crushed;                 // null without a plateau in compression
  scalar::Interlock<double> interlock;  // default: no interlock
  StiffnessShare share;
  double rate = 0;  // b / dt of the dashpots, whose pressure friction follows too
};
JointPast past_of(const Model& model, State& state, int j);

InterlockStep interlock_step(const Model& model, const State& state);  // for joints: of the step that led to the present pose

// The face of a joint with the normal stiffness kn (Pa/m), as its compression law needs it.
CompressionFace compression_face(const Model& model, const Joint& joint, double kn);
double stored_in_compression(const Model& model, const Joint& joint, const JointPast& past, const double* gap);  // J, of a cracked joint

// Relative displacement q of a joint in its frame: (s, t, n) in m, then the rotation vector about (s, t, n) in rad. Resultant f on block a
// (N, N m, about the joint's centre), tension positive; block b receives -f. Returns true while the joint is intact: no point has a history
// and none is beyond its limit, so that f = stiffness * q exactly. Otherwise the history of its points advances from `gap_before` to q. All
// energy is booked by the point laws' own work: the work of a spring over a step is the mean of its two tractions times the change of its
// gap. For a joint that is not intact, `shear_limit` receives the shear (N) that each point can transmit now.
bool respond(const Model& model, int j, bool intact, const double* gap_before, const double* gap, JointPast past, double* resultant,
             JointEnergy& energy, double* shear_limit = nullptr);

// True while no point of an intact joint yields (laws/yield.h).
bool stays_intact(const Model& model, const Joint& joint, const double* gap);

// m, uplift of the slip so far, if the joint's law knows asperities (laws/face.h).
double asperity_lift(const PointLaw& law, const JointMemory& memory);
// Turns the relative displacement of the faces into that of the asperities, as `respond()` and `JointMemory` have it, with the uplift of
// this step's slip. Returns the lift (m).
double lift_by_asperities(const Model& model, const Joint& joint, const JointMemory& memory, double gap[6]);
// Advances their history after `respond()`, once `memory.resultant` is the present one. `across` (N): mean normal force of this step and
// the one before, tension positive. Returns the work of the change of lift (J), a part of the friction.
double advance_asperities(const Model& model, const Joint& joint, const PointHistory* point, double across, double lift,
                          JointMemory& memory);
// True if the law does not mind that the joint goes over to contact.
bool may_release(const Joint& joint, const PointLaw& law, const JointMemory& memory);

// `share_within()` of laws/slip.h for one joint: the largest x <= 1 for which `present` + x `drag` is within the limit.
inline double share_of_drag(scalar::InPlane<double> present, scalar::InPlane<double> drag, double limit) {
  const bool past = square(scalar::InPlane<double>{present.s + drag.s, present.t + drag.t}) > std::max(square(present), limit * limit);
  return share_within(present, drag, limit, past);
}

// Dashpots of a cracked joint from `gap_before` to q: the change of its spring forces over the step, without the points that slipped and
// the stiffness that was lost, times `rate` (b / dt). Dashpots do not pull closed faces, and no point is sheared beyond its limit (N, from
// `respond()`). Resultant f as above.
void viscous_response(const Model& model, int j, const double* gap_before, const double* gap, const PointHistory* before, JointPast after,
                      const double* shear_limit, double rate, double* resultant);

}  // namespace erbs
