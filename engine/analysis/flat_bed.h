// Impact of a block that rocks with its whole face on a bed, beside Housner's block, whose edges alone touch.
#pragma once
#include <string>
#include <vector>

#include "engine/model/model.h"

namespace erbs::analysis {

// Spin after an impact over the spin before, for an impulse that acts `x` (m) from the middle of the base, towards the new edge. Angular
// momentum about that point is conserved; before, the block turns about the old edge, after, about the new one:
//   (c - b x) / (c + b x),   c = I / m + h^2
// with the half width b (m), the centroid's height h (m), and the inertia I about the centroid (kg m2). x = b is Housner 1963, eq. 6.
double spin_kept(double c, double b, double x);

// Where a flat face takes the impulse, as a share of b, by the restitution of its contact. A face that pressed as fast as it is approached
// would take it at 1/3. Measured with blocks .15 x 1, .3 x 1, .6 x 3 and .25 x .5 m on beds of 1e10 and 1e12 Pa/m (v29_flat_bed): .45 to
// .61 at restitution .05, .41 to .53 at .3, .30 to .37 at .6, .12 to .18 at 1. Ratios of the joint's dashpots of .1 to 1 give the same: a
// bed that has opened is a contact.
double impulse_share(double restitution);

// What a bed of springs without tension does to a block that stands on its edge. At the angle theta the compressed length is
//   a = sqrt(2 N / (kn theta)) = 2 sqrt(b d0 / theta),   N the weight per depth, d0 = N / (2 b kn) the settlement under it.
// Its pressure is a triangle, so that the block turns about a line a / 3 inside its edge.
struct BedToe {
  double width = 0;      // m, a at theta = alpha, where the block is balanced
  double inwards = 0;    // m, a / 3
  double alpha = 0;      // rad, static overturning angle atan((b - a / 3) / h)
  double p = 0;          // rad/s, sqrt(g R / (I / m + R^2)) about that line
  double threshold = 0;  // of the static acceleration that overturns the block, over g b / h: 1 - 3 (h d0 / (9 b^2))^(1/3)
};
// b: half width (m), h: height of the centroid (m), radius2: I / m about the centroid (m2), settlement: d0 (m). The threshold is the
// maximum of b - a / 3 - h theta over theta, first order in a / b (V30).
BedToe toe_on_bed(double b, double h, double radius2, double settlement, double gravity);

struct FlatBed {
  int block = 0;
  double width = 0, height = 0;  // m, of the base in the direction of rocking, and twice the centroid's height above it
  double restitution = 0;        // of its contact
  double housner = 0, kept = 0;  // spin after an impact over the spin before: by Housner, and about so on this bed
  double least = 0;              // of any restitution
  double alpha = 0, p = 0;       // rad, rad/s, of Housner's block
  BedToe toe = {};
};

// Free blocks that stand on one dry bed, bear nothing else, and are more than 1.2 times as high as wide in the direction of rocking.
std::vector<FlatBed> flat_beds(const Model& model);

std::string told(const BedToe& toe, double b, double alpha, double p);  // b: half width (m); alpha, p: of Housner's block
std::string told(const Model& model, const FlatBed& bed);

}  // namespace erbs::analysis
