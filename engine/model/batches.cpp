#include "engine/model/batches.h"

#include <limits>
#include <numeric>

namespace erbs {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
std::size_t z(int i) { return std::size_t(i); }

}  // namespace

// An empty lane answers nothing: no stiffness, limits out of reach, the block at rest, a wrench row that nobody reads.
void clear_lane(const Model& m, JointBatch& batch, int l) {
  for (auto& k : batch.stiffness) k[l] = 0;
  for (auto& q : batch.q) q[l] = 0;
  batch.open_limit[l] = batch.slip_limit[l] = batch.close_limit[l] = infinite;
  batch.slip_slope[l] = 0;
  batch.a[l] = batch.b[l] = m.nblock;
  batch.row_a[l] = batch.row_b[l] = 2 * m.njoint;
}

void set_constants(const Model& m, int j, JointBatch& batch, int l) {
  const Joint& joint = m.joint[z(j)];
  const PointLaw& law = m.laws[z(joint.type->law)];
  for (int i = 0; i < 6; ++i) batch.stiffness[i][l] = joint.type->stiffness[i];
  // Couplings that reach zero shear at ft have no straight bound: any tension is looked at point by point.
  batch.open_limit[l] = law.coupling == PointLaw::Coupling::coulomb ? law.ft / law.kn : 0;
  batch.slip_limit[l] = law.ks > 0 ? law.c / law.ks : infinite;
  batch.slip_slope[l] = law.ks > 0 ? law.mu * law.kn / law.ks : 0;
  batch.close_limit[l] = law.fc > 0 ? law.fc / law.kn : infinite;
  batch.half_s[l] = joint.type->half_s;
  batch.half_t[l] = joint.type->half_t;
  batch.radius[l] = joint.type->radius;
  batch.a[l] = joint.a;
  batch.b[l] = joint.b;
  batch.row_a[l] = m.row_a[z(j)];
  batch.row_b[l] = m.row_b[z(j)];
}

int add_empty_batch(const Model& m, State& s) {
  s.batch.push_back(JointBatch{});
  for (int l = 0; l < lanes; ++l) clear_lane(m, s.batch.back(), l);
  return int(s.batch.size()) - 1;
}

void set_places(const Model& m, State& s) {
  s.batch.clear();
  s.place.resize(z(m.njoint));
  std::iota(s.place.begin(), s.place.end(), 0);
}

}  // namespace erbs
