// Force between two parts: elastic inner-distance pressure, impact damping, friction of the patch.
#pragma once
#include "engine/contact/overlap.h"
#include "engine/model/pair.h"

namespace erbs {

struct View;  // view.h

inline constexpr double full_crowd = 3;  // from so many contacts on dashpots take least
inline constexpr double flat_face = 2;   // of the square of the least radius of inertia, from which on an area is a face
inline constexpr double slender = 30;    // times what a shift of the block adds to a rate: past that rotations are counted by their tensor
inline constexpr double look_ahead = 5;  // steps within which bodies that approach each other are reckoned with

// What one evaluation gives besides the wrench. Losses belong to the step that ends at the pose given: each is the work of its
// own wrench by the trapezoid of the leapfrog, (F_n + F_n+1) / 2 . v_n+1/2 dt.
struct PairResult {
  PairWrench wrench;
  double tangential = 0;  // J, stored by the friction springs
  double friction =
      0;  // J, that friction took of the bodies and does not store: in slip, and where its springs are carried to another patch
  double damping = 0;  // J, lost in dashpots
  double rubbing = 0;  // 1/s2, omega^2 of a patch that slips, along its normal; 0 where it holds
  double depth = 0;    // m, deepest overlap
  // Upper bounds of the pair's share in the greatest eigenvalue of M^-1/2 K M^-1/2 of each block, dashpots included (1/s2):
  // stable while dt^2 <= 2 / (sum over the pairs and joints of a block), for every block.
  double rate_a = 0, rate_b = 0;
  double elastic = 0;  // J, normal, stored (only where asked for)
  // The rates of a face that may land within the next steps, where the bodies are apart still but approach.
  double landing_a = 0, landing_b = 0;
  double apart = -1;  // m, distance of the bodies, at least; below zero where they touch or it is not known
  double haste = 0;   // 1/s, over the step that what opens and closes next allows (foresee())
  bool touching = false;
};

// Evaluates `pair` at the current pose and updates its memory; dt (s) is the step that led here, 0 at the start of a run. Returns false if
// the bodies are apart and nothing was or is stored (the result is then zero but for `landing`).
// `crowd`: how many contacts touch either body, at least 1; what dashpots may take depends on it (dashpot() of contact.cpp).
bool pair_force(Pair& pair, const ContactShapes& shapes, const ContactBlock& a, const ContactBlock& b, const ContactSettings& settings,
                double dt, bool want_energy, OverlapRoom& room, PairResult& result, double crowd = full_crowd);

// A new pair; fixes its reference body for good. `impact`: impact_factor() of its restitution.
Pair new_pair(int a, int part_a, int b, int part_b, const PairLaw& law, double impact, const ContactShapes& shapes);

// Starts `pair` at this pose with what acted between the faces before: `before` (N, N m; world axes, on block b, moment about its
// centroid), which stored `stored` (J). The faces are seen lifted off each other by as little (Pair::lift) as makes them press as before,
// and the springs of friction pull as before. Where both then store other than before by more than `most` (J), energy is kept instead,
// forces in the ratio of before where friction bears it. Returns what is stored from now on (J): less where the bodies do not overlap.
double hand_over(Pair& pair, const ContactShapes& shapes, const ContactBlock& a, const ContactBlock& b, const Vec6& before, double stored,
                 double most, OverlapRoom& room);

// X with X - ln(1 + X) = -e X - ln(1 - e X): a pressure kn phi (1 + X v / v_i) returns e of the approach speed v_i (Hunt and Crossley
// 1975).
double impact_factor(double restitution);

// Radius r of the torsion limit mu N r of a patch of this area and polar radius of gyration; within 0.4 % for rectangles
// (.866 gyration for a line, .937 for a square; Int |x| dA / A in closed form).
double torsion_radius(double area, double gyration);

// Power of a pair's wrench at the given velocities (W).
double power(const PairWrench& wrench, const ContactBlock& a, const ContactBlock& b);

}  // namespace erbs
