#include "engine/model/batches.h"

#include <limits>

namespace erbs {
namespace {

std::size_t z(int i) { return std::size_t(i); }

// An empty lane answers nothing: no stiffness, limits out of reach, the block at rest, a wrench row that nobody reads.
void clear(const Model& m, JointBatch& batch, int l) {
  for (auto& k : batch.stiffness) k[l] = 0;
  for (auto& q : batch.q) q[l] = 0;
  batch.open_limit[l] = batch.slip_limit[l] = batch.close_limit[l] = std::numeric_limits<double>::infinity();
  batch.slip_slope[l] = 0;
  batch.a[l] = batch.b[l] = m.nblock;
  batch.row_a[l] = batch.row_b[l] = 2 * m.njoint;
}

void fill(const Model& m, JointBatch& batch, int l, int j) {
  const Joint& joint = m.joint[z(j)];
  const PointLaw& law = m.laws[z(joint.type->law)];
  for (int i = 0; i < 6; ++i) batch.stiffness[i][l] = joint.type->stiffness[i];
  // Couplings that reach zero shear at ft have no straight bound: any tension is looked at point by point.
  batch.open_limit[l] = law.coupling == PointLaw::Coupling::coulomb ? law.ft / law.kn : 0;
  batch.slip_limit[l] = law.ks > 0 ? law.c / law.ks : std::numeric_limits<double>::infinity();
  batch.slip_slope[l] = law.ks > 0 ? law.mu * law.kn / law.ks : 0;
  if (law.fc > 0) batch.close_limit[l] = law.fc / law.kn;
  batch.half_s[l] = joint.type->half_s;
  batch.half_t[l] = joint.type->half_t;
  batch.radius[l] = joint.type->radius;
  batch.a[l] = joint.a;
  batch.b[l] = joint.b;
  batch.row_a[l] = m.row_a[z(j)];
  batch.row_b[l] = m.row_b[z(j)];
}

}  // namespace

int add_empty_batch(const Model& m, State& s) {
  s.batch.push_back(JointBatch{});
  for (int l = 0; l < lanes; ++l) clear(m, s.batch.back(), l);
  return int(s.batch.size()) - 1;
}

void set_batches(const Model& m, State& s) {
  s.batch.clear();
  s.place.resize(z(m.njoint));
  for (int k = 0; k < sound_batches(m); ++k) add_empty_batch(m, s);
  for (int j = 0; j < m.njoint; ++j) {
    s.place[z(j)] = j;
    fill(m, s.batch[z(j / lanes)], j % lanes, j);
  }
}

void move_joint(const Model& m, State& s, int j, int lane) {
  const int from = s.place[z(j)];
  JointBatch& old = s.batch[z(from / lanes)];
  if (lane >= 0) {
    JointBatch& batch = s.batch[z(lane / lanes)];
    fill(m, batch, lane % lanes, j);
    for (int i = 0; i < 9; ++i) batch.frame[i][lane % lanes] = old.frame[i][from % lanes];
    for (int i = 0; i < 3; ++i) {
      batch.sum[i][lane % lanes] = old.sum[i][from % lanes];
      batch.apart[i][lane % lanes] = old.apart[i][from % lanes];
    }
    for (int i = 0; i < 6; ++i) batch.q[i][lane % lanes] = old.q[i][from % lanes];
  }
  clear(m, old, from % lanes);
  s.place[z(j)] = lane;
}

}  // namespace erbs
