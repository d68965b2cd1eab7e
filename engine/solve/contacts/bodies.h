// Bodies of contact: shapes at rest and present poses of all blocks, and which of them were joined at rest.
#pragma once
#include <cstdint>
#include <vector>

#include "engine/contact/broad/edge_neighbours.h"
#include "engine/contact/law/pair.h"
#include "engine/model/model.h"
#include "engine/model/state.h"

namespace erbs {

struct ContactBodies {
  struct Axes {
    VectorPack<9> row{};  // row-major
    bool any = false;     // some differ from the world axes
  };
  const Model& model;
  ContactShapes shapes;
  std::vector<ContactBlock> block;           // [nblock]
  std::vector<Axes> axes;                    // of the shapes at rest, by groups of eight blocks; empty if all are the world axes
  std::vector<double> reach;                 // m, distance of each block's farthest point from its centroid [whole groups]
  std::vector<std::uint64_t> joined;         // pairs of blocks with a joint at rest, sorted, ...
  std::vector<int> first_joint;              // ... and the first of their joints
  std::vector<std::vector<int>> neighbours;  // blocks joined to each block at rest [nblock]

  explicit ContactBodies(const Model& all) : model(all) {}
  void initialise();  // once, before the first use

  Mat3 axes_of(int b) const;
  Mat3 rotation_of(int b) const;  // from rest to the last update of its pose
  const Axes* axes_of_group(std::size_t g) const { return !axes.empty() && axes[g].any ? &axes[g] : nullptr; }
  PairLaw law(int a, int b) const;  // of the materials of two blocks
  bool were_joined(int a, int b) const;
  // First of the joints that a pair of parts had at rest, and the end of its joints.
  int first_joint_of(const ContactPair& pair) const;
  int end_of_same_parts(int first, int end) const;
  // Edge along which two blocks touch at rest, both joined to a common third. Other bodies seldom touch along an edge, and never for long.
  EdgeAtRest edge_of(const ContactPair& pair) const;

 private:
  void set_axes(int b, const Mat3& to);
};

// Pairs of blocks (`pair_key()`) that still have a joint, sorted.
std::vector<std::uint64_t> jointed_pairs(const Model& model, const State& state);

}  // namespace erbs
