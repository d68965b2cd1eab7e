#include "engine/analysis/start/held_back.h"

#include <algorithm>
#include <cmath>

#include "engine/base/count.h"

namespace erbs::analysis {

namespace {

constexpr double follows = 0.05;  // of a change of gain, in a step

}  // namespace

HeldBack::HeldBack(const Model& model, State& state, const std::vector<int>& blocks)
    : model_(model), state_(state), block_(blocks), left_(blocks.size()), gain_(blocks.size()) {
  std::vector<std::vector<int>> next(z(model.nblock));
  for (const Joint& joint : model.joint) next[z(joint.a)].push_back(joint.b), next[z(joint.b)].push_back(joint.a);
  std::vector<int> nearest(z(model.nblock), -1), reached;
  for (int b = 0; b < model.nblock; ++b)
    if (!std::ranges::binary_search(blocks, b)) nearest[z(b)] = b, reached.push_back(b);
  for (std::size_t i = 0; i < reached.size(); ++i)
    for (const int b : next[z(reached[i])])
      if (nearest[z(b)] < 0) nearest[z(b)] = nearest[z(reached[i])], reached.push_back(b);
  for (const int b : blocks) bearer_.push_back(nearest[z(b)]);
}

Vec3 HeldBack::rotation(int b, const Vec3& spin) const {
  const Mat3 axes = state_.pose.q[z(b)].toRotationMatrix();
  return axes * (model_.inverse_inertia[z(b)] * (axes.transpose() * spin));
}

void HeldBack::bound(double share) {
  for (std::size_t i = 0; i < block_.size(); ++i) {
    const int b = block_[i];
    Motion now{state_.motion.v[z(b)], state_.motion.spin_momentum[z(b)]};
    Motion& gain = gain_[i];
    gain.v += follows * (now.v - left_[i].v - gain.v), gain.spin += follows * (now.spin - left_[i].spin - gain.spin);
    const Vec3 bearer = bearer_[i] < 0 ? Vec3(Vec3::Zero()) : Vec3(state_.motion.v[z(bearer_[i])]);
    const Vec3 next = now.v + gain.v - bearer, spin = now.spin + gain.spin;  // if it gains as much again
    const double speed = std::sqrt(next.squaredNorm() + spin.dot(rotation(b, spin)) / model_.mass[z(b)]);
    if (const double allowed = share * model_.thickness[z(b)]; speed > allowed) {
      const double part = allowed / speed;
      now = {bearer + part * next - gain.v, part * spin - gain.spin};
      state_.motion.v[z(b)] = now.v;
      state_.motion.spin_momentum[z(b)] = now.spin;
      state_.motion.w[z(b)] = rotation(b, now.spin);
    }
    left_[i] = now;
  }
}

}  // namespace erbs::analysis
