// The joints of a structure as one linear operator on the motions of its blocks, without an assembled matrix: 128 bytes per joint, where
// the assembled K takes some 1,700.
#pragma once
#include <array>
#include <vector>

#include "engine/base/sparse.h"
#include "engine/model/model.h"
#include "engine/model/state.h"

namespace erbs {

// Degrees of freedom: 6 per moving block (displacement, rotation; world axes); -1 for fixed and driven blocks and the dummy block.
struct Freedom {
  std::vector<int> first;  // [nblock + 1]
  int count = 0;
};
Freedom freedoms(const Model& model);
Freedom grounded_freedoms(const Model& model, const State& state);  // without blocks that no joints connect to the ground

// Stiffness of a joint in its own frame: diagonal, except for the coupling of its two bending terms.
struct JointForm {
  std::array<double, 6> diagonal{};  // N/m (s, t, n), N m (about s, t, n)
  double coupling = 0;               // N m
};
inline JointForm elastic_form(const Joint& joint) {
  const double* k = joint.type->stiffness;
  return {{k[0], k[1], k[2], k[3], k[4], k[5]}, 0};
}

class JointOperator {
 public:
  // Takes the joints not yet released to contact, at the present poses.
  JointOperator(const Model& model, const State& state, const Freedom& freedom);
  // y = sum over joints of B^T form(joint) B x. B gives the relative displacement, in the joint frame, per motion of the blocks.
  template <class Form>
  void apply(const Form& form, const VecX& x, VecX& y) const {
    y.setZero(x.size());
    for (const End& e : ends_) add(e, form(model_.joint[std::size_t(e.joint)]), x, y);
  }

 private:
  struct End {
    Mat3 frame;         // world, columns s, t, n
    Vec3 arm_a, arm_b;  // m, world
    int joint, a, b;    // first degrees of freedom of its blocks; -1: not free
  };
  static void add(const End& e, const JointForm& form, const VecX& x, VecX& y);

  const Model& model_;
  std::vector<End> ends_;
};

// M^-1/2 of each moving block, from its mass and its inertia in world axes at the present pose.
class RootMass {
 public:
  RootMass(const Model& model, const State& state, const Freedom& freedom);
  void apply(VecX& x) const;  // x = M^-1/2 x
  Mat6 of(int block) const;

 private:
  struct Part {
    int first;  // degree of freedom
    double translation;
    Mat3 rotation;
  };
  std::vector<Part> part_;
  std::vector<int> of_block_;
};

}  // namespace erbs
