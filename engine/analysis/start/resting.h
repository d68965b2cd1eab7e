// Blocks that lie on a structure at rest and that no joint ties to it: a slab on two mortared piers, rubble on a vault, a lintel.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "engine/model/model.h"
#include "engine/model/state.h"

namespace erbs::analysis {

// As the blocks are built; none if contacts or gravity are off. What moves already is not at rest.
class Resting {
 public:
  Resting(const Model& model, const State& state);
  // These do not count any more, nor does what only they bear, nor what lies on an island of one of them.
  void drop(const std::vector<int>& blocks);
  bool any() const { return !blocks().empty(); }
  std::vector<int> blocks() const;
  // Lies on the structure, or on or against what lies on it [nblock].
  const std::vector<std::uint8_t>& lies() const { return lies_; }
  // Belongs to an island of joined blocks that bears them, or that they touch [nblock].
  const std::vector<std::uint8_t>& bears() const { return bears_; }
  bool touches_structure() const { return !touch_.empty(); }
  // Loose blocks that touch an island without equilibrium, and all that hangs together with it by loose blocks, but not what only joints
  // connect [nblock]. `found`: as in `Equilibrium`.
  std::vector<std::uint8_t> tied_to_unfound(const std::vector<std::uint8_t>& found) const;
  // Moves what lies on the structure with the mean motion of what bears it since it was built, but not into it.
  void carry(const Model& model, State& state) const;
  // kg, of what lies on each block of the structure, in equal parts of each heap [nblock].
  std::vector<double> borne(const Model& model) const;
  // Those that have left their place on what they lie on, by a twentieth of their thickness.
  std::vector<int> displaced(const Model& model, const State& state) const;

 private:
  // Two blocks that touch, at least one of them loose.
  struct Touch {
    int upper, lower;  // the loose one, where one is joined
    double down;       // of the common normal, which points from upper to lower
    Vec3 at;           // m, of the upper in axes of the lower
  };
  class Heaps;
  std::vector<Touch> touches(const Model& model, const State& state) const;
  bool on_joined(const Touch& touch) const { return loose_[std::size_t(touch.upper)] != 0 && joined_[std::size_t(touch.lower)] != 0; }
  bool lies_on_structure(const Touch& touch) const;
  Heaps heaps_of() const;
  void sort();

  std::vector<std::uint8_t> loose_, joined_;  // at rest [nblock]
  std::vector<std::uint8_t> lies_, bears_;    // [nblock]
  std::vector<std::uint8_t> gives_way_;       // by island [nblock]
  std::vector<int> island_;
  BlockPoses built_;
  std::vector<Touch> touch_;
};

// "a, b, c, d, e and 3 more"
std::string names_of(const Model& model, const std::vector<int>& blocks);

}  // namespace erbs::analysis
