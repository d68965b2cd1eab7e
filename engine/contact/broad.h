// Which pairs of parts may touch: a list with a margin, searched again only when bodies have moved far enough to matter.
#pragma once
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "engine/contact/contact.h"
#include "engine/scene/scene.h"

namespace erbs {

inline std::uint64_t pair_key(int a, int b) { return static_cast<std::uint64_t>(a) << 32 | static_cast<std::uint64_t>(b); }

// A tenth of the median of the parts' thickness (m).
double suggested_margin(std::vector<double> thickness);

// True where two bodies may have come closer than the list knows. `still`: of each block, 1 where it lies as at the last search; empty: not
// known of any.
bool needs_search(const PairList& list, const ContactShapes& shapes, std::span<const ContactBlock> blocks,
                  std::span<const std::uint8_t> still = {});

// Lists every pair of parts closer than the margin of which at least one block is loose, except pairs of blocks whose pair_key is
// in `excluded` (sorted) and pairs that cannot move. Pairs that stay keep their memory; what a dropped pair stored in its friction
// springs is returned (J, to be booked as reset). Blocks that are `still` look for nobody, but are found: what is listed between them, or
// with such as are not loose, stays. `fresh` gets the places of pairs that were not listed before.
double search(PairList& list, const ContactShapes& shapes, std::span<const ContactBlock> blocks, std::span<const std::uint8_t> loose,
              std::span<const std::uint64_t> excluded, const std::function<PairLaw(int a, int b)>& law,
              std::span<const std::uint8_t> still = {}, std::vector<int>* fresh = nullptr);

// Two materials in contact: springs in series (the mean of equal ones is that one), the lesser friction and restitution.
PairLaw pair_law(const Material& a, const Material& b);

// Index of the pair in the sorted list, -1 if it is not listed.
int find_pair(const PairList& list, int a, int part_a, int b, int part_b);

}  // namespace erbs
