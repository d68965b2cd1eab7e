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
  // Belongs to an island of joined blocks that bears them [nblock].
  const std::vector<std::uint8_t>& bears() const { return bears_; }

 private:
  // Two blocks that touch, at least one of them loose.
  struct Touch {
    int a, b;
    double down;  // of the common normal, which points from a to b
  };
  std::vector<Touch> touches(const Model& model, const State& state) const;
  void sort();

  std::vector<std::uint8_t> loose_, joined_;  // at rest [nblock]
  std::vector<std::uint8_t> lies_, bears_;    // [nblock]
  std::vector<std::uint8_t> gives_way_;       // by island [nblock]
  std::vector<int> island_;
  std::vector<Touch> touch_;
};

// "a, b, c, d, e and 3 more"
std::string names_of(const Model& model, const std::vector<int>& blocks);

}  // namespace erbs::analysis
