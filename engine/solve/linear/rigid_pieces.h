// A structure as few rigid pieces of many blocks: what bends and sways as a whole, in a system small enough to factor (rigid motions as a
// coarse space for elasticity: Vanek, Mandel and Brezina 1996, Computing 56, 179).
#pragma once
#include <array>
#include <functional>
#include <memory>
#include <vector>

#include "engine/base/sparse.h"
#include "engine/solve/linear/joint_operator.h"

namespace erbs {

// Groups of neighbouring free blocks. A piece moves by six numbers: displacement (m) and rotation (rad) of its centre.
class RigidPieces {
 public:
  // Diagonal stiffness of joint j in its frame.
  using Form = std::function<std::array<double, 6>(int j)>;
  RigidPieces(const Model& model, const State& state, const Freedom& freedom, int size);  // size: blocks in a piece
  int count() const { return count_; }
  int of(int i) const { return piece_[std::size_t(i)]; }         // of the i-th free block
  const Vec3& arm(int i) const { return arm_[std::size_t(i)]; }  // m, from the centre of its piece
  Vec6 gathered(int i, const Vec6& wrench) const {               // on the piece
    Vec6 out = wrench;
    out.tail<3>() += arm(i).cross(Vec3(wrench.head<3>()));
    return out;
  }
  Vec6 carried(int i, const Vec6& motion) const {  // of the block
    Vec6 out = motion;
    out.head<3>() += Vec3(motion.tail<3>()).cross(arm(i));
    return out;
  }
  // Lower half of R^T K R, R the rigid motions of the pieces. `more`: diagonal stiffness besides that of the joints [freedom.count], or
  // empty.
  Sparse stiffness(const Model& model, const State& state, const Freedom& freedom, const Form& form, const VecX& more) const;

 private:
  std::vector<int> piece_;  // [freedom.count / 6]
  std::vector<Vec3> arm_;   // [freedom.count / 6]
  int count_ = 0;
};

// The factored coarse matrix.
class CoarseSystem {
 public:
  explicit CoarseSystem(const Sparse& lower_half);
  bool definite() const { return definite_; }  // false: some piece is free to move
  void solve(VecX& x) const;                   // without allocation, except for the permuted copy kept here

 private:
  std::unique_ptr<SparseLdlt> factors_;
  mutable VecX permuted_;
  bool definite_;
};

}  // namespace erbs
