#include "engine/solve/coarse_inertia.h"

#include <algorithm>

#include "engine/base/count.h"
#include "engine/solve/linear/stiffness.h"

namespace erbs {
namespace {

constexpr int chunk = block_grain * pack_size;  // blocks

RigidPieces::Form stiffest_form(const Model& m) {
  return [&m](int j) {
    const Vec6 k = stiffest(m.joint[z(j)]).diagonal();
    return std::array<double, 6>{k[0], k[1], k[2], k[3], k[4], k[5]};
  };
}

}  // namespace

CoarseInertia::CoarseInertia(const Model& m, const State& s, const Freedom& f, int size)
    : pieces_(m, s, f, size), system_(pieces_.stiffness(m, s, f, stiffest_form(m), {})), block_(z(m.nblock)), first_slot_(1, 0) {
  std::vector<int> last_slot(z(pieces_.count()), -1);
  for (int b = 0; b < m.nblock; ++b) {
    if (b % chunk == 0 && b > 0) first_slot_.push_back(int(slot_piece_.size()));
    if (f.first[z(b)] < 0) continue;
    const int i = f.first[z(b)] / 6, piece = pieces_.of(i);
    if (last_slot[z(piece)] < first_slot_.back()) {
      last_slot[z(piece)] = int(slot_piece_.size());
      slot_piece_.push_back(piece);
    }
    const Mat3 r = s.pose.q[z(b)].toRotationMatrix();
    block_[z(b)] = {piece, last_slot[z(piece)], pieces_.arm(i), m.mass[z(b)], r * m.inertia[z(b)] * r.transpose()};
  }
  first_slot_.push_back(int(slot_piece_.size()));
  slot_.resize(slot_piece_.size());
  motion_.resize(6 * pieces_.count());
  row_.assign(block_groups(m.nblock) * pack_size, 0.0);
}

double CoarseInertia::share(const VecX& force, const VecX& x) const {
  VecX wrench = VecX::Zero(6 * pieces_.count());
  for (int i = 0; 6 * i < int(force.size()); ++i)
    wrench.segment<6>(6 * pieces_.of(i)) += pieces_.gathered(i, force.segment<6>(6 * Eigen::Index(i)));
  VecX motion = wrench;
  system_.solve(motion);
  return wrench.dot(motion) / force.dot(x);
}

void CoarseInertia::gather(const VectorPack<6>* force, Range groups) {
  for (int first = groups.first * pack_size; first < std::min(groups.last * pack_size, int(block_.size())); first += chunk) {
    const int slots = first / chunk;
    for (int k = first_slot_[z(slots)]; k < first_slot_[z(slots) + 1]; ++k) slot_[z(k)].setZero();
    for (int b = first; b < std::min(first + chunk, int(block_.size())); ++b) {
      const Block& c = block_[z(b)];
      if (c.slot < 0) continue;
      const auto& x = force[b / pack_size].x;
      const int l = b % pack_size;
      const Vec3 f(x[0][l], x[1][l], x[2][l]);
      slot_[z(c.slot)].head<3>() += f;
      slot_[z(c.slot)].tail<3>() += Vec3(x[3][l], x[4][l], x[5][l]) + c.arm.cross(f);
    }
  }
}

void CoarseInertia::solve() {
  motion_.setZero();
  for (std::size_t k = 0; k < slot_.size(); ++k) motion_.segment<6>(6 * slot_piece_[k]) += rate_ * slot_[k];
  system_.solve(motion_);
}

// At the positions of a step half the last drift with the force before it counts, and half with the force after it, both with the velocity
// of that drift (`energy.h`).
void CoarseInertia::scatter(const State& s, Range groups, std::vector<BlockSums>& sums) {
  for (int b = groups.first * pack_size; b < std::min(groups.last * pack_size, int(block_.size())); ++b) {
    const Block& c = block_[z(b)];
    if (c.piece < 0) continue;
    const auto of_piece = motion_.segment<6>(6 * c.piece);
    const Vec3 rotation = of_piece.tail<3>(), force = c.mass * (Vec3(of_piece.head<3>()) + rotation.cross(c.arm)),
               moment = c.inertia * rotation;
    double* const row = &row_[8 * z(b)];
    const Vec3 forces = Vec3(row[0], row[1], row[2]) + force, moments = Vec3(row[3], row[4], row[5]) + moment;
    sums[z(b / chunk)].work.damping[b % pack_size] -=
        0.5 * s.time.last_dt * (forces.dot(Vec3(s.motion.v[z(b)])) + moments.dot(Vec3(s.motion.w[z(b)])));
    for (int i = 0; i < 3; ++i) row[i] = force[i], row[3 + i] = moment[i];
  }
}

}  // namespace erbs
