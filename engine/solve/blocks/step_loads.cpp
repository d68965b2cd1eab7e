#include "engine/solve/blocks/step_loads.h"

#include <algorithm>
#include <cmath>

#include "engine/base/count.h"

namespace erbs {
StepLoads::StepLoads(const Model& model, State& state) : model_(model), state_(state) {
  if (!model.force_loads.empty()) load_.assign(block_groups(model.nblock) * pack_size, 0.0);
  for (const auto& p : model.force_loads)
    if (model.kind[z(p.block)] == Kind::moving) loaded_.push_back({p.block, Mat3::Zero()});
  std::ranges::sort(loaded_, {}, &LoadedBlock::block);
  const auto same = [](const LoadedBlock& a, const LoadedBlock& b) { return a.block == b.block; };
  loaded_.erase(std::unique(loaded_.begin(), loaded_.end(), same), loaded_.end());
}

void StepLoads::evaluate() {
  const Model& m = model_;
  const TimeStep& time = state_.time;
  const double t0 = time.t - 0.5 * time.last_dt, t1 = time.t + 0.5 * time.dt;
  now_.kick = 0.5 * (time.last_dt + time.dt);
  now_.ground = Vec3::Zero();
  for (const auto& g : m.grounds) now_.ground += mean(g.wave, t0, t1) * g.direction;
  now_.gravity = m.gravity;
  for (const auto& tilt : m.tilts) now_.gravity = rotation(mean(tilt.wave, t0, t1) * tilt.axis) * now_.gravity;
  if (!m.tilts.empty()) tilt();
  for (const auto& p : m.force_loads) std::fill_n(&load_[8 * z(p.block)], 8, 0.0);
  for (const auto& p : m.force_loads) {
    const Vec3 f = mean(p.wave, t0, t1) * p.direction;
    const Vec3 moment = p.moment ? f : Vec3((state_.pose.q[z(p.block)] * p.arm).cross(f));
    for (int k = 0; k < 3; ++k) {
      if (!p.moment) load_[8 * z(p.block) + z(k)] += f[k];
      load_[8 * z(p.block) + 3 + z(k)] += moment[k];
    }
  }
}

// U_g = -sum m g.u changes with g; that change is the work of tilting.
void StepLoads::tilt() {
  State& s = state_;
  Vec3 moment = Vec3::Zero();
  for (int b = 0; b < model_.nblock; ++b)
    if (model_.kind[z(b)] == Kind::moving) moment += model_.mass[z(b)] * weight_share(model_, b) * s.pose.u[z(b)];
  const double work = s.time.step > 0 ? -(now_.gravity - s.tilt.gravity_before).dot(0.5 * (moment + s.tilt.moment_before)) : 0;
  s.energy.tilt_work += work;
  s.energy.absolute_work += std::fabs(work);
  s.tilt.gravity_before = now_.gravity;
  s.tilt.moment_before = moment;
}

Vec6 StepLoads::wrench(int b) const { return load_.empty() ? Vec6(Vec6::Zero()) : Vec6(Eigen::Map<const Vec6>(&load_[8 * z(b)])); }

}  // namespace erbs
