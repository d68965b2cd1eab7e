// Touching pairs as packs of eight (`pair_lanes.h`), with the result of `pair_force()` to round-off.
#pragma once
#include <memory>

#include "engine/contact/contact.h"
#include "engine/contact/pair_lanes.h"

namespace erbs {

inline constexpr int most_together = 16;  // pairs evaluated together, in two packs of eight

struct Batch {
  PairLanes lanes[most_together / 8];
  Triangles triangles[8];
};

// Constants of a pair.
struct PairBodies {
  const ContactShape *reference = nullptr, *other = nullptr;
  bool swapped = false;  // block b is the reference
};
PairBodies bodies_of(const Pair& pair, const ContactShapes& shapes);

// One pair to evaluate.
struct PairJob {
  Pair* pair;
  PairBodies bodies;
  const ContactBlock *a, *b;
  PairResult* result;         // default-constructed
  double crowd = full_crowd;  // as in `pair_force()`
};

// True for a pair of small bodies that touched in its last evaluation.
bool goes_in_lanes(const Pair& pair, const PairBodies& bodies);

// Evaluates up to `most_together` pairs and updates their memory; `goes_in_lanes()` must be true for all. Returns as bits the pairs left
// unchanged for `pair_force()`: bodies that have separated, or overlaps with more pieces than there is room for.
unsigned pair_forces(const PairJob* job, int count, const ContactSettings& settings, double dt, bool want_energy, Batch& batch);

}  // namespace erbs
