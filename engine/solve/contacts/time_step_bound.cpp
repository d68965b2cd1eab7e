#include "engine/solve/contacts/time_step_bound.h"

#include <algorithm>
#include <cmath>

#include "engine/base/count.h"
#include "engine/base/sparse.h"
#include "engine/base/symmetric.h"
#include "engine/contact/broad/search.h"
#include "engine/contact/law/patch_stiffness.h"
#include "engine/solve/linear/stiffness.h"

namespace erbs {
namespace {

constexpr double safe_share = 0.9;  // of the bound of a block, for joints and for bounds by scalars
// Share of the bound by matrices, which is close: a long row of blocks, each pressed against the next, attains it. Springs then use
// 4 share^2 of the 4 that a step allows (dt^2 k / m + 2 c dt / m < 4, dashpots with the velocity of half a step before). Dashpots at their
// cap between two blocks (`pair.cpp`) use up to 4/3 with two contacts on each block, 1 in a heap. Any share below .81 is therefore safe;
// .7 leaves a margin of a sixth.
constexpr double contact_share = 0.7;
// Share of the bound of a face that may strike: that with which it counts as a contact in the next step. What an impact errs, by up to
// (omega dt)^2 / 4 of its energy, is bounded by events (`event_bound.h`).
constexpr double impact_share = safe_share;
constexpr int update_every = 256;  // steps between two updates while the step could be longer, ...
constexpr int update_soon = 32;    // ... and before the step becomes shorter
constexpr int joints_every = 8;    // updates between two trials of the bound by blocks
constexpr double little = 0.05;    // of the bound of joints: contacts that add no more need no closer bound

// 1 / dt^2 for an upper bound of the total stiffness on a block.
double inverse_square(double on_a_block, double share) { return on_a_block * (1 / (2 * share * share)); }

}  // namespace

// Against the motion forces count more by the local damping, so that steps are shorter by the root of it.
double ContactLimit::shorter() const { return std::sqrt(1 + model_.local_damping); }

// 1 / dt^2 of the joints, at the share of the bound that the run requested, at least 0.9.
double ContactLimit::intact() const {
  const double share = std::clamp(shorter() * state_.time.dt_target / range_.critical, safe_share, 1.0) * range_.critical;
  return 1 / (share * share);
}

bool ContactLimit::due(double allowed) const {
  const PairList& list = state_.contacts.list;
  if (list.pair.empty() || allowed >= range_.longest) return false;
  return state_.time.step - list.bound_updated_at >= (allowed < state_.time.dt ? update_soon : update_every);
}

void ContactLimit::update_bound(const ContactShapes& shapes, std::span<const ContactBlock> blocks, const std::vector<double>& scalars,
                                OverlapRoom& room) {
  PairList& list = state_.contacts.list;
  springs_.clear();
  for (ContactPair& p : list.pair) {
    PatchStiffness patch;
    if (!p.touching || p.former_joint || !patch_stiffness(p, shapes, blocks[z(p.a)], blocks[z(p.b)], room, patch)) continue;
    springs_.push_back({p.a, p.b, patch.on_a, patch.on_b});
  }
  list.bound_at_last_update = intact();
  const double longest = 1 / (range_.longest * range_.longest);
  list.block_bounds = by_weights(blocks, scalars, std::max(longest, little * list.bound_at_last_update));
  if (list.bound_updates % joints_every == 0 || list.by_blocks) {
    add_joints();
    std::vector<double> of = by_weights(blocks, {}, longest);
    list.by_blocks = *std::ranges::max_element(of) < list.bound_at_last_update + *std::ranges::max_element(list.block_bounds);
    if (list.by_blocks) list.bound_at_last_update = 0, list.block_bounds = std::move(of);
  }
  ++list.bound_updates;
  list.bound_updated_at = state_.time.step;
}

// Adds to the springs remaining joints and former joints with the greatest stiffness that they may reach, and with their dashpots
// (`stiffness.cpp`).
void ContactLimit::add_joints() {
  for (int j = 0; j < model_.njoint; ++j) {
    const Joint& joint = model_.joint[z(j)];
    if (state_.joints.stage[z(j)] == JointStage::contact) {
      const int pair = find_pair(state_.contacts.list, joint.a, joint.part_a, joint.b, joint.part_b);
      if (pair < 0 || !state_.contacts.list.pair[z(pair)].former_joint) continue;
    }
    const StiffnessShare share = stiffness_share(state_, j);
    const JointMap map = joint_map(model_, state_, j);
    constexpr double other_share = contact_share * contact_share / (safe_share * safe_share);
    const Mat6 k = std::max(share.n, share.s) * other_share * (1 + 2 * std::max(joint.viscous, joint.viscous_cracked) / state_.time.dt) *
                   stiffest(joint);
    springs_.push_back({joint.a, joint.b, map.a.transpose() * k * map.a, map.b.transpose() * k * map.b});
  }
}

// A spring between x and y has the energy (x - y) K (x - y) <= (1 + t) x K x + (1 + 1/t) y K y for any t > 0; t = weight of y over weight
// of x, 0 for the ground. Weights of 1 give twice the stiffness on each block. Blocks that ask for more than `enough` (1/s2) become
// heavier, round by round: up to half of their bound goes over to their neighbours, and all of that to the ground. The best round counts.
std::vector<double> ContactLimit::by_weights(std::span<const ContactBlock> blocks, std::span<const double> scalars, double enough) {
  constexpr int rounds = 8;
  constexpr double reachable = 0.52, near = 1.06;  // of the bound of a block with weights of 1; of that
  std::vector<Mat6> k(blocks.size(), Mat6::Zero());
  for (const Spring& s : springs_) k[z(s.a)] += s.on_a, k[z(s.b)] += s.on_b;
  std::vector<double> best = by_matrices(blocks, k);
  // Scalars stand for weights of 1: a block that is weighed anew, or beside one, loses them.
  for (std::size_t b = 0; b < scalars.size(); ++b) best[b] = std::min(best[b], inverse_square(scalars[b], safe_share));
  const std::vector<double> equal = best;
  std::vector<int> heavy;
  const auto find_heavy = [&](const std::vector<double>& bound) {
    heavy.clear();
    for (int b = 0; b < model_.nblock; ++b)
      if (bound[z(b)] > std::max(enough, near * reachable * equal[z(b)])) heavy.push_back(b);
  };
  find_heavy(best);
  if (heavy.empty()) return best;
  std::vector<std::vector<int>> springs_of(blocks.size());
  for (int i = 0; i < int(springs_.size()); ++i) springs_of[z(springs_[z(i)].a)].push_back(i), springs_of[z(springs_[z(i)].b)].push_back(i);
  const auto weigh = [&](int b, const std::vector<double>& weight) {  // share of block b in 1 / dt^2
    Mat6 sum = Mat6::Zero();
    for (const int i : springs_of[z(b)]) {
      const Spring& s = springs_[z(i)];
      const int other = s.a == b ? s.b : s.a;
      const double t = model_.kind[z(other)] == Kind::moving ? weight[z(other)] / weight[z(b)] : 0;
      sum += 0.5 * (1 + t) * (s.a == b ? s.on_a : s.on_b);
    }
    return share_of(blocks[z(b)], sum, 0.7 * enough);
  };
  std::vector<double> weight(blocks.size(), 1.0), bound = best;
  for (int round = 0; round < rounds && !heavy.empty(); ++round) {
    std::vector<int> changed = heavy;
    for (const int b : heavy) {
      weight[z(b)] *= bound[z(b)] / std::max(enough, reachable * equal[z(b)]);
      for (const int i : springs_of[z(b)]) changed.push_back(springs_[z(i)].a == b ? springs_[z(i)].b : springs_[z(i)].a);
    }
    std::ranges::sort(changed);
    changed.erase(std::unique(changed.begin(), changed.end()), changed.end());
    for (const int b : changed)
      if (model_.kind[z(b)] == Kind::moving) bound[z(b)] = weigh(b, weight);
    if (*std::ranges::max_element(bound) < *std::ranges::max_element(best)) best = bound;
    find_heavy(bound);
  }
  return best;
}

// 1 / dt^2 for the largest eigenvalue of M^-1/2 K M^-1/2 of a block, or for its trace if that is at most `fine` (1/s2).
double ContactLimit::share_of(const ContactBlock& block, const Mat6& k, double fine) {
  // the trace of root^T k root, an upper bound
  const Mat3 tensor = block.rotation * block.inverse_tensor * block.rotation.transpose();
  const double trace = block.inverse_mass * (k(0, 0) + k(1, 1) + k(2, 2)) + (tensor.array() * k.bottomRightCorner<3, 3>().array()).sum();
  if (const double share = inverse_square(trace, contact_share); !(share > fine)) return share;
  Mat6 root = Mat6::Zero();  // root root^T = M^-1
  root.topLeftCorner<3, 3>() = std::sqrt(block.inverse_mass) * Mat3::Identity();
  root.bottomRightCorner<3, 3>() = block.rotation * Mat3(block.inverse_tensor.llt().matrixL());
  return inverse_square(largest_eigenvalue(root.transpose() * k * root), contact_share);
}

// `share_of` each moving block: by its trace only where that is below .35 of the largest so far.
std::vector<double> ContactLimit::by_matrices(std::span<const ContactBlock> blocks, std::span<const Mat6> stiffness) const {
  std::vector<double> out(blocks.size(), 0.0);
  double most = 0;
  for (int b = 0; b < model_.nblock; ++b) {
    const Mat6& k = stiffness[z(b)];
    if (model_.kind[z(b)] != Kind::moving || k(0, 0) + k(1, 1) + k(2, 2) == 0) continue;
    out[z(b)] = share_of(blocks[z(b)], k, 0.35 * most);
    most = std::max(most, out[z(b)]);
  }
  return out;
}

double ContactLimit::on_block(int b, double omega2, double impact_omega2) const {
  const PairList& list = state_.contacts.list;
  return (list.bound_updates > 0 ? list.block_bounds[z(b)] : 0) + inverse_square(omega2, safe_share) +
         inverse_square(impact_omega2, impact_share);
}

double ContactLimit::on_most(std::span<const int> blocks, std::span<const double> omega2, std::span<const double> impact_omega2) const {
  double most = 0;
  for (const int b : blocks)
    if (model_.kind[z(b)] == Kind::moving) most = std::max(most, on_block(b, omega2[z(b)], impact_omega2[z(b)]));
  return most;
}

double ContactLimit::common() const {
  const PairList& list = state_.contacts.list;
  return list.bound_updates > 0 ? list.bound_at_last_update : intact();
}

double ContactLimit::allowed(double most, bool common) const {
  const double bound = 1 / (shorter() * std::sqrt((common ? this->common() : 0) + most));
  // Beyond the step that the run requested, its requested share of the limit still applies.
  const double share =
      std::isfinite(range_.critical) ? std::min(1.0, shorter() * state_.time.dt_target / range_.critical / safe_share) : 1.0;
  return std::max(std::min(state_.time.dt_target, bound), std::min(range_.longest, share * bound));
}

}  // namespace erbs
