#include "engine/solve/contacts/contact_sums.h"

#include <algorithm>
#include <utility>

#include "engine/base/count.h"
#include "engine/model/levels.h"

namespace erbs {
namespace {

// Adds the wrench of a pair, times `share`, to the rows of its block a, or b.
void add_to_a(double* rows, int a, const PairWrench& wrench, double share) {
  static_assert(sizeof(PairWrench) == 9 * sizeof(double));
  static const Vec6 from_a = (Vec6() << -1, -1, -1, 1, 1, 1).finished();
  Vec6::Map(rows + 8 * z(a)) += share * from_a.cwiseProduct(Vec6::Map(wrench.force.data()));
}
void add_to_b(double* rows, int b, const PairWrench& wrench, double share) {
  const double* w = wrench.force.data();
  Vec3::Map(rows + 8 * z(b)) += share * Vec3::Map(w);
  Vec3::Map(rows + 8 * z(b) + 3) += share * Vec3::Map(w + 6);
}

double relative_depth(const Model& m, const MotionBounds::PairBound& pair, const PairResult& r) {
  return r.depth / std::min(m.smallest_edge[z(pair.a)], m.smallest_edge[z(pair.b)]);
}

}  // namespace

void ContactSums::condense(int thread) {
  const ContactForces::ThreadPairs& found = of_.forces.results()[z(thread)];
  Condensed& out = condensed_[z(thread)];
  out.blocks.clear(), out.lost.clear();
  out.parts = {}, out.touching = 0, out.penetration = 0;
  for (const ContactForces::Force& one : found.forces) {
    const MotionBounds::PairBound& pair = of_.motion.pair(one.pair);
    const PairResult& r = one.result;
    out.blocks.push_back({pair.a, pair.b});
    out.lost.push_back({r.friction, r.damping});
    of_.bound.add(pair, r, out.parts);
    out.touching += r.touching;
    out.penetration = std::max(out.penetration, relative_depth(of_.model, pair, r));
  }
  for (const ContactForces::SeparatedPair& one : found.separated) of_.bound.add(of_.motion.pair(one.pair), one, out.parts);
}

void ContactSums::add_up(Range blocks, const StepLoads& loads, double* contact_wrench, double* kick) {
  const auto mine = [blocks](int b) { return b >= blocks.first && b < blocks.last; };
  int* const contacts = of_.state.contacts.list.contact_count.data();
  if (relisted_) start_all_rows(blocks, contact_wrench);
  const std::vector<int>& live = of_.sleep.in_live_pairs();
  const std::span<const int> these(std::ranges::lower_bound(live, blocks.first), std::ranges::lower_bound(live, blocks.last));
  start_rows(these, contact_wrench);
  for (const int b : these) contacts[b] = of_.sleep.has_resting() ? of_.sleep.contacts(b) : 0;
  of_.bound.begin(these);
  const bool split = of_.bound.is_split();
  if (split) of_.bound.begin_slow(these);
  if (kick) std::copy(contact_wrench + 8 * blocks.first, contact_wrench + 8 * blocks.last, kick + 8 * blocks.first);
  for (std::size_t t = 0; t < condensed_.size(); ++t) {
    const ContactForces::ThreadPairs& found = of_.forces.results()[t];
    for (std::size_t k = 0; k < found.forces.size(); ++k) {
      const auto [a, b] = condensed_[t].blocks[k];
      const bool on_a = mine(a), on_b = mine(b);
      if (!on_a && !on_b) continue;
      const auto& [i, r] = found.forces[k];
      const FormerJoints::FormerJoint& former = of_.former.of_pair(i);
      const bool strikes = former.joint < 0 || r.touching;
      const double share = kick ? kick_share(i) : 0;
      const bool slow = split && of_.bound.loose(a, b);
      if (on_a) {
        add_to_a(contact_wrench, a, r.wrench, 1);
        if (kick) add_to_a(kick, a, r.wrench, share);
        if (slow) of_.bound.add_slow_to_a(a, r.wrench);
        contacts[a] += r.touching;
        of_.bound.add(a, r.omega2_a - former.omega2_a, strikes ? r.impact_omega2_a : 0);
      }
      if (on_b) {
        add_to_b(contact_wrench, b, r.wrench, 1);
        if (kick) add_to_b(kick, b, r.wrench, share);
        if (slow) of_.bound.add_slow_to_b(b, r.wrench);
        contacts[b] += r.touching;
        of_.bound.add(b, r.omega2_b - former.omega2_b, strikes ? r.impact_omega2_b : 0);
      }
    }
    for (const ContactForces::SeparatedPair& one : found.separated) {
      const MotionBounds::PairBound& pair = of_.motion.pair(one.pair);
      // A former joint that closes again is no stiffer than its joint was: only while it touches may its blocks fall flat on other faces.
      if (of_.former.of_pair(one.pair).joint >= 0) continue;
      if (mine(pair.a)) of_.bound.add(pair.a, 0, one.impact_omega2_a);
      if (mine(pair.b)) of_.bound.add(pair.b, 0, one.impact_omega2_b);
    }
  }
  if (split) of_.bound.square_slow_forces(these, loads);
}

void ContactSums::add_totals(bool levels, bool sample) {
  Energy& energy = of_.state.energy;
  for (const Condensed& of_thread : condensed_)
    for (const auto& [friction, damping] : of_thread.lost) energy.friction += friction, energy.contact_damping += damping;
  if (!sample) return;
  const TimeStep& time = of_.state.time;
  elastic_ = of_.sleep.elastic(), kinetic_correction_ = 0;
  for (const ContactForces::ThreadPairs& found : of_.forces.results())
    for (const auto& [i, r] : found.forces) {
      elastic_ += r.elastic + r.tangential;
      if (!levels) continue;
      // Kinetic energy belongs to the velocity to which the last interval of each pair would have led (`book()` of `block_kernel.h`).
      const double since = interval_before(time, of_.forces.slow(i)), used = kick_share(i) * time.last_dt;
      const MotionBounds::PairBound& pair = of_.motion.pair(i);
      kinetic_correction_ += 0.5 * (since - used) * power(r.wrench, of_.bodies.block[z(pair.a)], of_.bodies.block[z(pair.b)]);
    }
}

void ContactSums::end() {
  relisted_ = kick_relisted_ = false;
  of_.bound.begin_totals();
  touching_ = of_.sleep.touching();
  double& penetration = of_.state.observed.max_penetration_relative;
  for (const Condensed& one : condensed_) {
    of_.bound.add(one.parts);
    touching_ += one.touching, touched_ += one.touching;
    penetration = std::max(penetration, one.penetration);
  }
  std::vector<int>& count = of_.state.contacts.list.contact_count;
  for (const int b : of_.sleep.in_live_pairs())
    if (of_.model.kind[z(b)] != Kind::moving) count[z(b)] = 0;                         // no limit for dashpots on a fixed or driven block
    else if (of_.state.topology.joined[z(b)]) count[z(b)] += int(saturated_contacts);  // joints use up this block's share
}

void ContactSums::add_up_substep(std::span<const int> blocks, double* kick) {
  const bool relisted = std::exchange(kick_relisted_, false);  // after a resumption within a macro step, or a release at its start
  if (relisted) start_all_rows({0, of_.model.nblock}, kick);
  // The other blocks keep the rows of the first step: none but fast pairs acts.
  start_rows(relisted || of_.state.time.substep == 1 ? std::span<const int>(of_.sleep.in_live_pairs()) : blocks, kick);
  double& penetration = of_.state.observed.max_penetration_relative;
  for (const ContactForces::ThreadPairs& found : of_.forces.results())
    for (const auto& [i, r] : found.forces) {
      const MotionBounds::PairBound& pair = of_.motion.pair(i);
      add_to_a(kick, pair.a, r.wrench, 1), add_to_b(kick, pair.b, r.wrench, 1);
      of_.state.energy.friction += r.friction;
      of_.state.energy.contact_damping += r.damping;
      touched_ += r.touching;
      penetration = std::max(penetration, relative_depth(of_.model, pair, r));
    }
}

// Of sleepers, whose pairs are not evaluated; else nothing.
void ContactSums::start_rows(std::span<const int> blocks, double* rows) const {
  const bool rested = of_.sleep.has_resting();
  for (const int b : blocks) {
    if (rested) std::copy_n(of_.sleep.resting_wrench(b), 8, rows + 8 * z(b));
    else std::fill_n(rows + 8 * z(b), 8, 0.0);
  }
}

void ContactSums::start_all_rows(Range blocks, double* rows) const {
  const std::size_t count = 8 * z(blocks.last - blocks.first);
  if (of_.sleep.has_resting()) std::copy_n(of_.sleep.resting_wrench(blocks.first), count, rows + 8 * z(blocks.first));
  else std::fill_n(rows + 8 * z(blocks.first), count, 0.0);
}

// The kick of a pair over that of a step.
double ContactSums::kick_share(int i) const {
  const TimeStep& time = of_.state.time;
  const bool next_slow = time.substeps > 1 && of_.bound.loose(of_.motion.pair(i).a, of_.motion.pair(i).b);
  return (interval_before(time, of_.forces.slow(i)) + interval_after(time, next_slow)) / (time.last_dt + time.dt);
}

}  // namespace erbs
