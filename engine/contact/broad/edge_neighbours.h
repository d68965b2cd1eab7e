// Bodies that touch at rest along an edge or at a corner: neighbours across the crossing of two joints. Two planes separate them there. A
// small relative motion m therefore lets them overlap by a strip of at most m x m. The pair needs no evaluation until this strip could
// carry a force.
#pragma once
#include "engine/contact/law/frame.h"

namespace erbs {

struct EdgeAtRest {
  bool touches = false;  // along an edge or at a corner; if not, nothing else is set
  PairPose pose;
  Vec3 at = Vec3::Zero();          // m, a corner of the other body there, pair axes
  double lever = 0, movement = 0;  // m, to the farthest point of both; relative motion up to which the pair carries almost no force
  double slowest = 1;              // greatest ratio of this motion to the travel in `MotionBounds::surely_separated()`
};

// The gap along the normal of a face of either body.
struct FaceGap {
  Vec3 n;      // from the reference to the other, axes of the reference
  double gap;  // m, negative where they overlap
};
std::vector<FaceGap> face_gaps(const PairFrame& bodies);
double greatest_gap(const PairFrame& bodies);  // m

// `rest`: the pair at rest. `most`: what counts as almost no force, of the weight of the lighter block.
EdgeAtRest edge_at_rest(const ContactPair& pair, const PairFrame& rest, double most);
// m, remaining travel of both blocks, as `surely_separated()` measures it; zero or less: the pair needs an evaluation.
double idle_way(const EdgeAtRest& edge, const PairPose& now);

}  // namespace erbs
