// Broad phase: a list of the pairs of parts that may touch, with a margin; searched again only after bodies have moved far enough.
#pragma once
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "engine/contact/law/pair.h"
#include "engine/scene/scene.h"

namespace erbs {

inline std::uint64_t pair_key(int a, int b) { return static_cast<std::uint64_t>(a) << 32 | static_cast<std::uint64_t>(b); }

// Two parts of two blocks, a < b.
struct PartPair {
  int a, b, part_a, part_b;
};

// A tenth of the median thickness of the parts (m).
double suggested_margin(std::vector<double> thickness);

// True if two bodies may have come closer than the list allows: half the margin together, beyond half of what each may travel
// (`PairList::travel`). `still`: 1 for each block with the pose of the last search; empty: unknown.
bool needs_search(const PairList& list, const ContactShapes& shapes, std::span<const ContactBlock> blocks,
                  std::span<const std::uint8_t> still = {});

// All pairs of parts whose boxes are closer than `margin` (m), or that come so close on the `travel` (m) of each block, of which at least
// one block is `looking`; sorted. Empty `travel`: none. Pairs of blocks with a `pair_key()` in `excluded` (sorted) and pairs that cannot
// move are left out.
std::vector<PartPair> close_parts(double margin, std::span<const double> travel, const ContactShapes& shapes,
                                  std::span<const ContactBlock> blocks, std::span<const std::uint8_t> looking,
                                  std::span<const std::uint64_t> excluded);
// Whether the boxes of one pair are.
bool boxes_within(double margin, const ContactShapes& shapes, std::span<const ContactBlock> blocks, const PartPair& pair);

// Lists every pair of parts closer than the margin, or that may be so within the time `ahead` (s) at their speed, of which at least one
// block is loose. Blocks that travel two margins at most count six times as long, so that a few that fall fast do not make each search
// outdated at once.
// Pairs of blocks with a `pair_key()` in `excluded` (sorted) and pairs that cannot move are left out. Listed pairs that remain keep their
// memory. Returns the energy in the friction springs of dropped pairs (J, to be booked as reset). Blocks that are `still` do not search but
// can be found; pairs among them, or of one with a block that is not loose, stay listed, and their motion counts from their own last
// search. `fresh` receives the indices of new pairs.
double search(PairList& list, const ContactShapes& shapes, std::span<const ContactBlock> blocks, std::span<const std::uint8_t> loose,
              std::span<const std::uint64_t> excluded, const std::function<PairLaw(int a, int b)>& law, double ahead = 0,
              std::span<const std::uint8_t> still = {}, std::vector<int>* fresh = nullptr);

// Law of two materials in contact: springs in series, scaled so that equal ones stay as they are; the lower friction and restitution.
PairLaw pair_law(const Material& a, const Material& b);

// Index of the pair in the sorted list; -1: not listed.
int find_pair(const PairList& list, int a, int part_a, int b, int part_b);

}  // namespace erbs
