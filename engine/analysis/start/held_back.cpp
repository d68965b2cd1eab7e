#include "engine/analysis/start/held_back.h"

#include <cmath>

#include "engine/base/count.h"

namespace erbs::analysis {

HeldBack::HeldBack(const Model& model, State& state, const std::vector<int>& blocks)
    : model_(model), state_(state), block_(blocks), left_(blocks.size()), next_(z(model.nblock)) {
  for (const Joint& joint : model.joint) next_[z(joint.a)].push_back(joint.b), next_[z(joint.b)].push_back(joint.a);
}

Vec3 HeldBack::rotation(int b, const Vec3& spin) const {
  const Mat3 axes = state_.pose.q[z(b)].toRotationMatrix();
  return axes * (model_.inverse_inertia[z(b)] * (axes.transpose() * spin));
}

namespace {

Vec3 limited(const Vec3& x, double size, double most) { return size > most ? Vec3(most / size * x) : x; }

}  // namespace

void HeldBack::bound(double share) {
  const BlockVec3 v = state_.motion.v;
  for (std::size_t i = 0; i < block_.size(); ++i) {
    const int b = block_[i];
    Motion now{v[z(b)], state_.motion.spin_momentum[z(b)]};
    const double fall = model_.gravity.norm() * state_.time.dt;  // m/s, at most; joints swing with larger gains
    const Vec3 spun = now.spin - left_[i].spin;
    const double rotated = std::sqrt(spun.dot(rotation(b, spun)) / model_.mass[z(b)]);
    const Motion gain{limited(now.v - left_[i].v, (now.v - left_[i].v).norm(), fall), limited(spun, rotated, fall)};
    Vec3 beside = Vec3::Zero();
    for (const int other : next_[z(b)]) beside += v[z(other)] / double(next_[z(b)].size());
    const Vec3 next = now.v + gain.v - beside, spin = now.spin + gain.spin;  // if it gains as much again
    const double speed = std::sqrt(next.squaredNorm() + spin.dot(rotation(b, spin)) / model_.mass[z(b)]);
    if (const double allowed = share * model_.thickness[z(b)]; speed > allowed) {
      const double part = allowed / speed;
      now = {beside + part * next - gain.v, part * spin - gain.spin};
      state_.motion.v[z(b)] = now.v;
      state_.motion.spin_momentum[z(b)] = now.spin;
      state_.motion.w[z(b)] = rotation(b, now.spin);
    }
    left_[i] = now;
  }
}

}  // namespace erbs::analysis
