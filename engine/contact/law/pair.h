// Force between two parts of blocks: elastic inner-distance pressure, impact damping, friction of the patch.
#pragma once
#include "engine/contact/overlap/overlap.h"
#include "engine/model/contact_pair.h"

namespace erbs {

struct PairFrame;     // `frame.h`
struct PairSettings;  // `pair_lanes.h`

inline constexpr double saturated_contacts = 3;  // from this number of contacts on, dashpots have their lowest cap
inline constexpr double flat_face = 2;           // area over the squared least radius of inertia, from which on a patch is a flat face
inline constexpr double slender = 30;            // rotation over translation in a rate, from which on rotation counts by the inertia tensor
inline constexpr double look_ahead = 5;          // steps within which an approach of bodies counts

// Result of one evaluation. Losses belong to the step that ends at the present pose: each is the work of its own wrench by the trapezoidal
// rule of leapfrog, (F_n + F_n+1) / 2 . v_n+1/2 dt.
struct PairResult {
  PairWrench wrench;
  double tangential = 0;  // J, stored by the friction springs
  // J, withdrawn from the bodies by friction and not stored: by slip, and by the transport of its springs to another patch
  double friction = 0;
  double damping = 0;      // J, lost in dashpots
  double slip_omega2 = 0;  // 1/s2, omega^2 of a slipping patch along its normal; 0 if it sticks
  double depth = 0;        // m, greatest depth of overlap
  // 1/s2, upper bounds of the pair's share in the largest eigenvalue of M^-1/2 K M^-1/2 of each block. The step is stable, dashpots
  // included, while dt^2 <= 2 / (sum over the pairs and joints of a block) for every block.
  double omega2_a = 0, omega2_b = 0;
  double elastic = 0;  // J, stored by the normal pressure, on request
  // 1/s2, the rates of a face that may strike within the next steps, for bodies that are apart and approach.
  double impact_omega2_a = 0, impact_omega2_b = 0;
  double apart = -1;      // m, lower bound of the distance; negative if the bodies touch or it is unknown
  double event_rate = 0;  // 1/s, event rate: one over the step that the next opening or closing allows (`foresee()`)
  bool touching = false;
};

// Time since the last evaluation of a pair. With one level it is the last step.
struct PairInterval {
  double since;         // s, 0 at the start of a run
  double drift;         // s, of the last drift: velocities lag half of it behind poses
  double horizon;       // s: what strikes within `look_ahead` times this counts
  bool booked = false;  // the work of the last wrenches after their kick is booked already (model/levels.h)

  PairInterval(double dt) : since(dt), drift(dt), horizon(dt) {}
  PairInterval(double from, double last_drift, double ahead, bool is_booked)
      : since(from), drift(last_drift), horizon(ahead), booked(is_booked) {}
};

// Evaluates `pair` at the present pose and updates its memory. Returns false if
// the bodies are apart and the pair stored nothing before; the result is then zero except for the prediction of impacts. `contact_count`:
// number of contacts on either body, at least 1; it limits the dashpots (`dashpot()` of `pair_law.h`).
bool pair_force(ContactPair& pair, const ContactShapes& shapes, const ContactBlock& a, const ContactBlock& b,
                const ContactSettings& settings, const PairInterval& interval, bool want_energy, OverlapRoom& room, PairResult& result,
                double contact_count = saturated_contacts);

// A new pair; its reference body never changes. `impact`: `impact_factor()` of its restitution.
ContactPair new_pair(int a, int part_a, int b, int part_b, const PairLaw& law, double impact, const ContactShapes& shapes);

// Starts `pair` at this pose from the action between its faces before: `before` (N, N m; world axes, on block b, moment about its centroid)
// and the energy `stored` (J). The faces are offset by the least lift (`ContactPair::lift`) with which they press as before; the friction
// springs pull as before. If the stored energy then differs by more than `most` (J), energy is conserved instead, with forces in the same
// ratio as far as friction allows. Returns the energy stored from now on (J): less if the bodies do not overlap.
double release_to_contact(ContactPair& pair, const ContactShapes& shapes, const ContactBlock& a, const ContactBlock& b, const Vec6& before,
                          double stored, double most, OverlapRoom& room);

// Solution X of X - ln(1 + X) = -e X - ln(1 - e X). A pressure kn phi (1 + X v / v_i) returns e times the speed of approach v_i (Hunt and
// Crossley 1975).
double impact_factor(double restitution);

// m, distance at which the faces of a pair interlock no more (laws/interlock.h).
double interlocks_to(const ContactSettings& settings, const ContactPair& pair);

PairSettings pair_settings(const ContactSettings& settings, const PairInterval& interval);

// Power of a pair's wrench (W): at the velocities of `a` and `b`, or at the speed of b relative to a (m/s) and their spins (rad/s).
double power(const PairWrench& wrench, const ContactBlock& a, const ContactBlock& b);
double power(const PairWrench& wrench, const Vec3& speed, const Vec3& spin_a, const Vec3& spin_b);

}  // namespace erbs
