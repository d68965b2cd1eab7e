#include "engine/joints/cracked/fading.h"

#include <algorithm>

#include "engine/base/count.h"
#include "engine/joints/response.h"

namespace erbs {
Fading::Fading(const Model& model, State& state)
    : model_(model), state_(state), reference_(model.analysis.kernel == "reference" || model.analysis.solver == "sequential") {
  for (int j = 0; j < model.njoint; ++j)
    if (model.laws[z(model.joint[z(j)].type->law)].fades()) joints_.push_back(j);
}

bool Fading::debonded(const Cracked& cracked, int j) const {
  if (!reference_) return cracked.debonded(j);
  const Joint& joint = model_.joint[z(j)];
  const auto first = state_.joints.history.begin() + joint.first_point;
  return std::all_of(first, first + joint.type->points, [](const PointHistory& h) { return h.damage >= 1; });
}

void Fading::fade(Cracked& cracked, double dt) {
  const double left = keeps(dt);
  for (const int j : joints_) {
    const PointLaw& law = model_.laws[z(model_.joint[z(j)].type->law)];
    const StiffnessShare now = state_.joints.share[z(j)], last{law.kn_debonded / law.kn, law.ks_debonded / law.ks};
    if (state_.joints.stage[z(j)] != JointStage::cracked || (now.n <= last.n && now.s <= last.s) || !debonded(cracked, j)) continue;
    if (!reference_) cracked.store(j);
    fade(j, {std::max(last.n, left * now.n), std::max(last.s, left * now.s)});
    if (!reference_) cracked.set_share(j);
  }
}

void Fading::fade(int j, StiffnessShare to) {
  const Joint& joint = model_.joint[z(j)];
  JointMemory& memory = state_.joints.memory[z(j)];
  StiffnessShare& share = state_.joints.share[z(j)];
  const double n = to.n / share.n, s = to.s / share.s;
  const double pressed = stored_in_compression(model_, joint, past_of(model_, state_, j), memory.gap), sheared = memory.elastic - pressed;
  Faded one{j, {}, {}};
  for (int i = 0; i < 6; ++i) {
    const double of = i >= 2 && i < 5 ? n : s;
    one.gap[i] = memory.gap[i];
    one.lost[i] = (1 - of) * memory.resultant[i];
    memory.resultant[i] *= of;
  }
  state_.energy.crushing += (1 - n) * pressed + (1 - s) * sheared;
  memory.elastic = n * pressed + s * sheared;
  share = to;
  faded_.push_back(one);
}

void Fading::book(Cracked& cracked) {
  for (const Faded& one : faded_) {
    if (state_.joints.stage[z(one.joint)] == JointStage::intact) continue;
    if (!reference_) cracked.store(one.joint);
    const JointMemory& memory = state_.joints.memory[z(one.joint)];
    for (int i = 0; i < 6; ++i) state_.energy.crushing += 0.5 * one.lost[i] * (memory.gap[i] - one.gap[i]);
  }
  faded_.clear();
}

}  // namespace erbs
