// Bodies that at rest touch along an edge or in a corner: neighbours across the crossing of two joints. Two planes keep them apart there,
// so that a small motion m of one against the other lets them overlap by a strip of m x m at most; until that could bear something they
// need no look.
#pragma once
#include "engine/contact/view.h"

namespace erbs {

struct EdgeAtRest {
  bool touches = false;  // along an edge or in a corner; nothing else is known where it does not
  PairPose pose;
  Vec3 at = Vec3::Zero();          // m, a corner of the other body there, pair axes
  double lever = 0, movement = 0;  // m, to the farthest point of both; the motion up to which the pair bears next to nothing
  double slowest = 1;              // of the motion, against the way by which pairs wait (Debris::keeps_apart)
};

inline constexpr double next_to_nothing = 1e-4;  // of the weight of the lighter block

// `rest`: the pair as it is at rest.
EdgeAtRest edge_at_rest(const Pair& pair, const View& rest);
// How far both may come yet (m), by the measure of keeps_apart(); zero or less where the pair has to be looked at.
double idle_way(const EdgeAtRest& edge, const PairPose& now);

}  // namespace erbs
