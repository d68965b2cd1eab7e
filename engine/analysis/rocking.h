// Rocking of a rigid block on its two lower edges, as reference for scenes with one block (Housner 1963, Bull. Seism. Soc. Am. 53, 403;
// exact form as in Zhang and Makris 2001, J. Eng. Mech. 127, 473). No sliding, no bouncing.
//   theta'' = -p^2 [ sin(s alpha - theta) + (a/g) cos(s alpha - theta) ],   s = sign theta          (exact)
//   theta'' = -p^2 [ s alpha - theta + a/g ]                                                       (linear)
// An impact (theta through zero) multiplies the angular velocity by mu. From rest the block lifts off if |a| > g tan alpha (linear: g
// alpha).
#pragma once
#include <optional>
#include <vector>

#include "engine/loads/loads.h"

namespace erbs::analysis {

struct RockingBlock {
  double alpha = 0;    // rad, slenderness angle atan(b / h)
  double p = 0;        // rad/s, sqrt(m g R / I0)
  double mu = 1;       // ratio of angular velocities after and before an impact
  double gravity = 0;  // m/s2
  bool linear = false;
};

// A homogeneous block of base `width` and `height` (m): p = sqrt(3 g / (4 R)), mu = 1 - 3/2 sin^2 alpha. Impact conserves angular momentum
// about the new edge (Housner 1963, eq. 6, whose r is mu^2).
RockingBlock homogeneous_block(double width, double height, double gravity);

struct RockingLoad {
  const Wave* wave = nullptr;  // ground acceleration (m/s2); none: free rocking
  double factor = 1;           // on the wave
};

struct RockingStart {
  double theta = 0;  // rad
  double spin = 0;   // rad/s
};

struct RockingRun {
  std::vector<double> t, theta, spin;  // s, rad, rad/s: every step taken
  std::vector<double> impact;          // s, times of impacts
  std::vector<double> amplitude;       // rad, largest |theta| before the first impact, between the first and the second, ...
  bool overturned = false;             // |theta| beyond a right angle (linear: 30 alpha, from which no motion returns)
  double overturned_at = 0;            // s
};

// Integrates to `duration` (s), or until the block has overturned. With `verdict_only` it stores no steps. It then stops once the load has
// ended and the energy shows whether the block passes over its edge.
RockingRun rock(const RockingBlock& block, const RockingLoad& load, const RockingStart& start, double duration, bool verdict_only = false);

// Definition of overturning under a pulse.
enum class Criterion {
  overturning,   // the block falls (Shao and Tung 1999; Zhang and Makris 2001)
  alpha_at_end,  // |theta| has reached alpha by the end of the wave, whatever follows
};

struct OverturningBand {
  double from = 0, to = 0;  // factors on the wave; `to` is the end of the search if the band extends beyond
  int impacts = 0;          // before overturning
};

// Bands of factors on the wave, between low and high, that overturn the block from rest, each with a constant number of impacts. The search
// samples `points` factors and bisects the ends of each band. Safe islands are the gaps between bands. A band or gap narrower than (high -
// low) / points may be missed. With alpha_at_end, a wave without an end never overturns.
std::vector<OverturningBand> overturning_bands(const RockingBlock& block, const Wave& wave, Criterion criterion, double low, double high,
                                               int points, double duration);

}  // namespace erbs::analysis
