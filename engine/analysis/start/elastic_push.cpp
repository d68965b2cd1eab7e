#include "engine/analysis/start/elastic_push.h"

#include <cmath>

#include "engine/analysis/start/newton.h"

namespace erbs::analysis {
namespace {

std::size_t z(int i) { return std::size_t(i); }

}  // namespace

ElasticPush elastic_push(const Model& m, const State& s, const std::vector<Vec3>& force, const std::vector<double>& borne) {
  const Freedom f = grounded_freedoms(m, s);
  if (f.count == 0) return {};
  VecX load = VecX::Zero(f.count), x;
  for (int b = 0; b < m.nblock; ++b)
    if (f.first[z(b)] >= 0) load.segment<3>(f.first[z(b)]) = force[z(b)];
  NewtonSteps steps(m, s, f, Linear::by_size);
  if (!steps.intact(load, x) || !(x.dot(load) > 0)) return {};
  double kinetic = 0;
  for (int b = 0; b < m.nblock; ++b) {
    if (f.first[z(b)] < 0) continue;
    const Vec3 u = x.segment<3>(f.first[z(b)]), r = x.segment<3>(f.first[z(b)] + 3);
    kinetic += (m.mass[z(b)] + (borne.empty() ? 0 : borne[z(b)])) * u.squaredNorm() + r.dot(m.inertia[z(b)] * r);
  }
  return {std::sqrt(x.dot(load) / kinetic), load, x};
}

}  // namespace erbs::analysis
