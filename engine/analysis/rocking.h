// The rigid block that rocks on its two lower edges: the companion of every scene of one block (Housner 1963, Bull. Seism. Soc. Am.
// 53, 403; exact form as in Zhang and Makris 2001, J. Eng. Mech. 127, 473). No sliding, no bouncing.
//   theta'' = -p^2 [ sin(s alpha - theta) + (a/g) cos(s alpha - theta) ],   s = sign theta          (exact)
//   theta'' = -p^2 [ s alpha - theta + a/g ]                                                       (linear)
// An impact (theta through zero) keeps mu of the spin. At rest the block lifts off where |a| > g tan alpha (linear: g alpha).
#pragma once
#include <optional>
#include <vector>

#include "engine/loads/loads.h"

namespace erbs {

struct RockingBlock {
  double alpha = 0;    // rad, slenderness angle atan(b / h)
  double p = 0;        // rad/s, sqrt(m g R / I0)
  double mu = 1;       // spin after an impact over the spin before
  double gravity = 0;  // m/s2
  bool linear = false;
};

// A homogeneous block of base `width` and `height` (m): p = sqrt(3 g / (4 R)), mu = 1 - 3/2 sin^2 alpha, angular momentum about the
// new edge being kept (Housner 1963, eq. 6, whose r is mu^2).
RockingBlock homogeneous_block(double width, double height, double gravity);

struct RockingLoad {
  const Wave* wave = nullptr;  // acceleration of the ground (m/s2); none: free rocking
  double factor = 1;           // on the wave
};

struct RockingStart {
  double theta = 0;  // rad
  double spin = 0;   // rad/s
};

struct RockingRun {
  std::vector<double> t, theta, spin;  // s, rad, rad/s: each step that was taken
  std::vector<double> impact;          // s, times of impacts
  std::vector<double> amplitude;       // rad, greatest |theta| before the first impact, between the first and the second, ...
  bool overturned = false;             // |theta| past a right angle (linear: 30 alpha, from where nothing returns)
  double overturned_at = 0;            // s
};

// Integrates to `duration` (s), or until the block has overturned; with `verdict_only` also no further than to where the load has
// ended and the energy tells whether the block goes over its edge, and without keeping the steps.
RockingRun rock(const RockingBlock& block, const RockingLoad& load, const RockingStart& start, double duration, bool verdict_only = false);

// Which answer counts as overturning under a pulse.
enum class Criterion {
  overturning,   // the block falls (Shao and Tung 1999; Zhang and Makris 2001)
  alpha_at_end,  // it has come to |theta| = alpha by the end of the wave, whatever happens then
};

struct OverturningBand {
  double from = 0, to = 0;  // factors on the wave; `to` is that of the search where the band goes on
  int impacts = 0;          // before it falls
};

// Bands of factors on the wave, between low and high, that overturn the block from rest after one and the same number of impacts:
// looked for at `points` factors, their ends then bisected. Safe islands are the gaps between bands; none narrower than
// (high - low) / points is seen for certain. With alpha_at_end, a wave without an end never overturns.
std::vector<OverturningBand> overturning_bands(const RockingBlock& block, const Wave& wave, Criterion criterion, double low, double high,
                                               int points, double duration);

}  // namespace erbs
