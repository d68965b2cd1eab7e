// Touching pairs as packs of eight (`pair_lanes.h`), with the result of `pair_force()` to round-off.
#pragma once
#include <memory>

#include "engine/contact/law/pair.h"
#include "engine/contact/law/pair_lanes.h"

namespace erbs {

inline constexpr int pairs_per_batch = 16;  // pairs evaluated together, in two packs of eight

struct PairBatch {
  PairPack packs[pairs_per_batch / 8];
  Triangles triangles[8];
};

// Constants of a pair.
struct PairBodies {
  const ContactShape *reference = nullptr, *other = nullptr;
  bool swapped = false;  // block b is the reference
};
PairBodies bodies_of(const ContactPair& pair, const ContactShapes& shapes);

// One pair to evaluate.
struct PairTask {
  ContactPair* pair;
  PairBodies bodies;
  const ContactBlock *a, *b;
  PairResult* result;                         // default-constructed
  double contact_count = saturated_contacts;  // as in `pair_force()`
};

// True for a pair of small bodies that touched in its last evaluation.
bool fits_pack(const ContactPair& pair, const PairBodies& bodies);

// Evaluates up to `pairs_per_batch` pairs and updates their memory; `fits_pack()` must be true for all. Returns as bits the pairs left
// unchanged for `pair_force()`: bodies that have separated, or overlaps with more pieces than there is room for.
unsigned pair_forces(const PairTask* task, int count, const ContactSettings& settings, const PairInterval& interval, bool want_energy,
                     PairBatch& batch);

}  // namespace erbs
