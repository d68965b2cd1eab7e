#include "engine/analysis/start/elastic_push.h"

#include <algorithm>
#include <cmath>

#include "engine/analysis/start/newton.h"
#include "engine/base/count.h"

namespace erbs::analysis {
namespace {

double mass_of(const Model& m, const std::vector<double>& borne, int b) { return m.mass[z(b)] + (borne.empty() ? 0 : borne[z(b)]); }

ElasticPush push(NewtonSteps& steps, const Model& m, const Freedom& f, const std::vector<Vec3>& force, const std::vector<double>& borne) {
  VecX load = VecX::Zero(f.count), x;
  for (int b = 0; b < m.nblock; ++b)
    if (f.first[z(b)] >= 0) load.segment<3>(f.first[z(b)]) = force[z(b)];
  if (!steps.intact(load, x) || !(x.dot(load) > 0)) return {};
  double kinetic = 0;
  for (int b = 0; b < m.nblock; ++b) {
    if (f.first[z(b)] < 0) continue;
    const Vec3 u = x.segment<3>(f.first[z(b)]), r = x.segment<3>(f.first[z(b)] + 3);
    kinetic += mass_of(m, borne, b) * u.squaredNorm() + r.dot(m.inertia[z(b)] * r);
  }
  return {std::sqrt(x.dot(load) / kinetic), load, x};
}

}  // namespace

ElasticPush elastic_push(const Model& m, const State& s, const std::vector<Vec3>& force) {
  const Freedom f = grounded_freedoms(m, s);
  if (f.count == 0) return {};
  NewtonSteps steps(m, s, f, Linear::by_size);
  return push(steps, m, f, force, {});
}

double lowest_frequency(const Model& m, const State& s, const std::vector<std::uint8_t>& still, const std::vector<double>& borne) {
  const Freedom f = grounded_freedoms(m, s);
  if (f.count == 0) return 0;
  NewtonSteps steps(m, s, f, Linear::by_size);
  double lowest = 0;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<Vec3> force(z(m.nblock), Vec3::Zero());
    for (int b = 0; b < m.nblock; ++b)
      if (still.empty() || still[z(b)] == 0) force[z(b)][axis] = mass_of(m, borne, b);
    const double frequency = push(steps, m, f, force, borne).frequency;
    if (frequency > 0) lowest = lowest > 0 ? std::min(lowest, frequency) : frequency;
  }
  return lowest;
}

}  // namespace erbs::analysis
