#include "engine/analysis/quasi_static/scaled_inertia.h"

#include <algorithm>

#include "engine/base/count.h"
#include "engine/base/symmetric.h"
#include "engine/solve/linear/stiffness.h"

namespace erbs::analysis {
namespace {

// 1/s2, the largest eigenvalue of M^-1/2 K_ii M^-1/2 of each moving block; 0 for a block without joints.
std::vector<double> block_rates(const Model& m, const State& s) {
  std::vector<Mat6> own(z(m.nblock), Mat6::Zero());
  for (int j = 0; j < m.njoint; ++j) {
    if (s.joints.stage[z(j)] == JointStage::contact) continue;
    const JointMap map = joint_map(m, s, j);
    const Mat6 k = stiffest(m.joint[z(j)]);
    own[z(m.joint[z(j)].a)] += map.a.transpose() * k * map.a;
    own[z(m.joint[z(j)].b)] += map.b.transpose() * k * map.b;
  }
  const RootMass roots(m, s, freedoms(m));
  std::vector<double> out(z(m.nblock), 0.0);
  for (int b = 0; b < m.nblock; ++b) {
    if (m.kind[z(b)] != Kind::moving) continue;
    const Mat6 root = roots.of(b);
    out[z(b)] = std::max(0.0, largest_eigenvalue(root * own[z(b)] * root));
  }
  return out;
}

}  // namespace

void scale_inertia(Model& m, const State& s) {
  const std::vector<double> rate = block_rates(m, s);
  double mass = 0, scaled = 0;
  for (int b = 0; b < m.nblock; ++b)
    if (rate[z(b)] > 0) mass += m.mass[z(b)], scaled += m.mass[z(b)] * rate[z(b)];
  m.gravity_factor.assign(z(m.nblock), 1.0);
  for (int b = 0; b < m.nblock; ++b) {
    if (!(rate[z(b)] > 0)) continue;
    const double factor = rate[z(b)] * mass / scaled;
    m.mass[z(b)] *= factor, m.inverse_mass[z(b)] /= factor;
    m.inertia[z(b)] *= factor, m.inverse_inertia[z(b)] /= factor;
    m.gravity_factor[z(b)] = 1 / factor;
  }
}

}  // namespace erbs::analysis
