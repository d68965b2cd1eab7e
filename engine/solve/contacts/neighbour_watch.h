// Watch over blocks that no joint ties to each other: two towers side by side, a block that is pushed against a wall, bricks without mortar
// between them. Contact costs a standing structure nothing until two such blocks may meet.
#pragma once
#include <cstdint>
#include <tuple>
#include <vector>

#include "engine/contact/broad/search.h"
#include "engine/contact/law/frame.h"
#include "engine/model/state.h"
#include "engine/solve/contacts/bodies.h"

namespace erbs {

class NeighbourWatch {
 public:
  // `margin`: m, of the list of contact pairs.
  NeighbourWatch(const Model& model, const State& state, const ContactBodies& bodies, double margin);
  // Marks the blocks in `loose` that may touch another within `time` (s) from now. If one of two blocks is loose already, the search for
  // contacts knows of both. True if any block was marked. Poses and speeds alone decide, so that a resumed run marks the same.
  bool find(double time, std::vector<std::uint8_t>& loose);

 private:
  struct Neighbours {
    PartPair parts;
    double gap;   // m, lower bound of the distance when it was listed
    bool narrow;  // at rest they touch along an edge, at a corner or by a narrow strip, and both are joined to a third block
    PairPose rest;
  };
  bool quiet(double time) const;
  using Motion = std::tuple<Vec3, Vec3>;  // m/s, rad/s
  Motion driven_motion(int b, double time) const;
  void place(double time);
  double closes(double time) const;
  void list(double time, const std::vector<std::uint8_t>& loose);
  Neighbours listed(const PartPair& parts) const;
  bool may_touch(const Neighbours& pair, double time) const;
  bool shifted(const Neighbours& pair) const;
  double shift_bound(const Neighbours& pair) const;
  double ahead(double speed, double time) const;

  const Model& model_;
  const State& state_;
  const ContactBodies& bodies_;
  const double least_margin_;        // m, within which pairs are listed
  const double narrow_;              // m, width of a narrow strip, and the relative motion that it bears
  const double least_distance_;      // m, at which faces count at any speed: a violent force may set a block in motion between two looks
  double margin_ = 0;                // m, of the present list
  double acceleration_ = 0;          // m/s2, of two blocks towards each other, that this look reckons with
  std::vector<ContactBlock> block_;  // present poses; empty until the first call
  std::vector<Vec3> u_;              // m, displacements when the pairs were listed, ...
  std::vector<Mat3> rotation_;       // ... rotations, ...
  std::vector<double> rotated_;      // ... and the path of each block's farthest point by rotation since then, m
  std::vector<Neighbours> pairs_;
  // For a first look at all blocks that needs no pose (`quiet()`).
  BlockVec3 listed_u_;
  BlockQuat listed_q_;
  double reach_ = 0, slack_ = 0;  // m, greatest reach of blocks that move; least way of all pairs, listed or not, before they count
};

}  // namespace erbs
