// Pairs that touch, eight at a time: the same as pair_force, to round-off, in lanes (pair_lanes.h).
#pragma once
#include <memory>

#include "engine/contact/contact.h"
#include "engine/contact/pair_lanes.h"

namespace erbs {

inline constexpr int most_together = 16;  // pairs worked on together, in two batches of eight

struct Batch {
  PairLanes lanes[most_together / 8];
  Triangles triangles[8];
};

// What does not change from step to step.
struct PairBodies {
  const ContactShape *reference = nullptr, *other = nullptr;
  bool swapped = false;  // block b is the reference
};
PairBodies bodies_of(const Pair& pair, const ContactShapes& shapes);

// One pair to work on.
struct PairJob {
  Pair* pair;
  PairBodies bodies;
  const ContactBlock *a, *b;
  PairResult* result;         // as constructed
  double crowd = full_crowd;  // as in pair_force()
};

// True for a pair of small bodies that touched when it was looked at last and has nothing left of an old joint.
bool goes_in_lanes(const Pair& pair, const PairBodies& bodies);

// Evaluates up to `most_together` pairs and updates their memory. Those of the bits returned have been left as they were, for pair_force:
// bodies that have parted, or whose overlap has more pieces than there is room for. Pairs as goes_in_lanes() takes them.
unsigned pair_forces(const PairJob* job, int count, const ContactSettings& settings, double dt, bool want_energy, Batch& batch);

}  // namespace erbs
