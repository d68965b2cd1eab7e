// Resultants of one joint from its contact points: what a joint does once its elastic bound is passed.
#pragma once
#include "engine/laws/interlock.h"
#include "engine/model/model.h"
#include "engine/model/state.h"

namespace erbs {

// What one evaluation dissipated, and what is stored after it (J).
struct JointEnergy {
  double friction = 0, fracture = 0, crushing = 0, elastic = 0;
  double damping = 0;  // of dashpots, which are no part of the response
};

// What joint j remembers.
struct JointPast {
  JointPast(PointHistory* of_points, CrushedFace* of_face = nullptr) : point(of_points), crushed(of_face) {}
  PointHistory* point;   // [points]
  CrushedFace* crushed;  // null where no law has a plateau in compression
  Interlock interlock;   // none where nothing moves
};
JointPast past_of(const Model& model, State& state, int j);

Interlock interlock_now(const Model& model, const State& state);  // of the step that has led to the present pose
Interlock contact_interlock(const Model& model, const State& state);  // the same as contacts take it, in every step: `slow` in m2/s2

// The face of joint j as its compression sees it.
Bed bed_of(const Model& model, const Joint& joint);

// Relative displacement q of a joint in its frame: (s, t, n) in m, then the rotation vector about (s, t, n) in rad.
// Resultant f on block a (N, N m, about the joint's centre), tension positive; block b receives -f.
// Returns true while the joint is sound: no point has any history and none passes its limit, so that f = stiffness * q exactly.
// Otherwise the history of its points is carried on from q_before to q, and every joule booked by the point laws' own work:
// over a step a spring's work is the mean of its two tractions times the change of its gap. Of a joint that is not sound,
// `shear_limit` gets the shear (N) that each point can bear now.
bool respond(const Model& model, int j, bool sound, const double* q_before, const double* q, JointPast past, double* f, JointEnergy& energy,
             double* shear_limit = nullptr);

// The share x <= 1 of (ds, dt) that (s, t) + x (ds, dt) can take within the limit.
double share_within(double s, double t, double ds, double dt, double limit);

// Dashpots of a joint that has cracked, from q_before to q: the springs' own change over the step, what slid or gave way in it left
// out, times `rate` (b over the step, 1/s s). What is closed does not pull by them, and no point is sheared beyond its limit (N, from
// respond). Resultant f as above.
void viscous_response(const Model& model, int j, const double* q_before, const double* q, const PointHistory* before, JointPast after,
                      const double* shear_limit, double rate, double* f);

}  // namespace erbs
