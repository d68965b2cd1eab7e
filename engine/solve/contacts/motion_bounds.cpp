#include "engine/solve/contacts/motion_bounds.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

#include "engine/base/count.h"
#include "engine/contact/law/impact_bound.h"
#include "engine/contact/law/pair_lanes.h"
#include "engine/model/levels.h"

namespace erbs {
MotionBounds::MotionBounds(const Model& model, State& state, ContactBodies& bodies, int threads)
    : model_(model), state_(state), bodies_(bodies), fastest_loose_(z(threads)), fastest_(z(threads)) {}

void MotionBounds::initialise() {
  const std::size_t groups = block_groups(model_.nblock);
  last_u_.resize(groups);
  for (std::size_t g = 0; g < groups; ++g) last_u_[g] = state_.pose.u.data()[g];
  SeparationState& separation = state_.contacts.separation;
  if (separation.q.size() == 0) separation.q = state_.pose.q;
  for (std::vector<double>* x : {&spin_, &travel_, &travel_ahead_}) x->assign(groups * pack_size, 0.0);
  separation.rotation_travel.resize(groups * pack_size, 0.0);
  std::vector<int> all(z(model_.nblock));
  std::iota(all.begin(), all.end(), 0);
  if (at_macro_step(state_.time)) update_all(nullptr);
  else place(all);
}

void MotionBounds::list_pairs() {
  pair_bounds_.clear();
  for (const ContactPair& p : state_.contacts.list.pair) pair_bounds_.push_back({p.a, p.b});
  state_.contacts.separation.pair.resize(pair_bounds_.size());
}

void MotionBounds::select(const Sleep& sleep) {
  placed_.clear();
  driven_.clear();
  awake_.clear();
  for (const int b : sleep.awake())
    if (model_.kind[z(b)] != Kind::driven) add_to_group(awake_, b);
  std::vector<int> in_live_pairs = sleep.in_live_pairs();
  std::ranges::sort(in_live_pairs);
  for (const int b : in_live_pairs) {
    if (model_.kind[z(b)] == Kind::fixed || sleep.asleep(b)) continue;
    add_to_group(placed_, b);
    if (model_.kind[z(b)] == Kind::driven) add_to_group(driven_, b);
  }
}

void MotionBounds::select_fast(const std::vector<int>& fast) {
  fast_.clear();
  std::vector<std::uint8_t> in(z(model_.nblock), 0);
  for (const int i : fast) in[z(pair(i).a)] = in[z(pair(i).b)] = 1;
  for (const BlockGroup& blocks : placed_)
    for (int l = 0; l < pack_size; ++l)
      if ((blocks.which >> l & 1u) != 0 && in[z(blocks.group * pack_size + l)]) add_to_group(fast_, blocks.group * pack_size + l);
}

void MotionBounds::add_to_group(std::vector<BlockGroup>& groups, int b) {
  if (groups.empty() || groups.back().group != b / pack_size) groups.push_back({b / pack_size, 0, {}});
  groups.back().which |= 1u << b % pack_size;
  groups.back().is_in[b % pack_size] = 1;
}

void MotionBounds::update(BlockGroup blocks, MaxSpeed& fastest) {
  const std::size_t g = z(blocks.group), first = g * pack_size;
  SeparationState& separation = state_.contacts.separation;
  BlockPosePack at{};
  at.u = state_.pose.u.data()[g].x, at.q = state_.pose.q.data()[g].x, at.v = state_.motion.v.data()[g].x,
  at.w = state_.motion.w.data()[g].x;
  at.last_u = last_u_[g].x, at.last_q = separation.q.data()[g].x;
  at.reach = &bodies_.reach[first], at.rotation_travel = &separation.rotation_travel[first], at.spin = &spin_[first];
  at.travel = &travel_[first], at.travel_ahead = &travel_ahead_[first];
  const ContactBodies::Axes* axes = bodies_.axes_of_group(g);
  at.axes = axes ? axes->row.x : nullptr;
  for (int l = 0; l < pack_size; ++l) at.row[l] = (blocks.which >> l & 1u) != 0 ? bodies_.block[first + z(l)].u.data() : nullptr;
  pair_kernels().track(at, blocks.which, look_ahead * 1.5 * std::max(macro_dt(state_.time), state_.time.last_dt), fastest.speed);
}

void MotionBounds::update_all(const Sleep* sleep) {
  MaxSpeed any;  // unused: `track()` and `prepare()` find the greatest speed
  std::vector<BlockGroup> all;
  for (int b = 0; b < model_.nblock; ++b)
    if (!sleep || !sleep->asleep(b)) add_to_group(all, b);
  for (const BlockGroup& blocks : all) update(blocks, any);
}

// Only blocks of live pairs need a pose in every step; all others wait for `update_all()`.
void MotionBounds::track(int thread, int first, int last, bool within) {
  const auto before = [](const BlockGroup& blocks, int group) { return blocks.group < group; };
  const auto of = [&](const std::vector<BlockGroup>& groups) {
    const auto end = std::lower_bound(groups.begin(), groups.end(), (last + pack_size - 1) / pack_size, before);
    return std::span<const BlockGroup>(std::lower_bound(groups.begin(), end, first / pack_size, before), end);
  };
  if (within) {
    MaxSpeed any;  // unused until the next macro step
    for (const BlockGroup& blocks : of(fast_)) update(blocks, any);
    return;
  }
  fastest_[z(thread)] = {};
  double fastest[pack_size] = {};
  for (const BlockGroup& blocks : of(awake_)) {
    const auto& v = state_.motion.v.data()[blocks.group].x;
    for (int l = 0; l < pack_size; ++l) {
      const double square = v[0][l] * v[0][l] + v[1][l] * v[1][l] + v[2][l] * v[2][l];
      fastest[l] = std::max(fastest[l], blocks.is_in[l] * square);
    }
  }
  fastest_loose_[z(thread)] = *std::ranges::max_element(fastest);
  for (const BlockGroup& blocks : of(placed_)) update(blocks, fastest_[z(thread)]);
}

bool MotionBounds::prepare(const std::vector<int>& involved, bool unsorted) {
  double fastest = *std::ranges::max_element(fastest_loose_);
  MaxSpeed late;
  if (unsorted) {
    std::vector<BlockGroup> all;
    for (const int b : involved) add_to_group(all, b);
    for (const BlockGroup& blocks : all) update(blocks, late);
    for (const int b : involved) fastest = std::max(fastest, bodies_.block[z(b)].v.squaredNorm());
  } else {
    for (const BlockGroup& blocks : driven_) update(blocks, late);  // no drift moves them
    for (const int b : involved)                                    // at the speed of the step to come, as after a resumption
      if (model_.kind[z(b)] == Kind::driven) fastest = std::max(fastest, Vec3(state_.motion.v[z(b)]).squaredNorm());
  }
  double speed = *std::ranges::max_element(late.speed);
  for (const MaxSpeed& one : fastest_) speed = std::max(speed, *std::ranges::max_element(one.speed));
  fastest_pair_ = 2 * speed;
  return state_.time.macro % update_every == 0 ||
         std::sqrt(fastest) * macro_dt(state_.time) * update_every > 0.25 * state_.contacts.list.margin;
}

void MotionBounds::prepare_substep() {
  MaxSpeed any;
  for (const BlockGroup& blocks : driven_) update(blocks, any);
}

void MotionBounds::place(const std::vector<int>& blocks) {
  const BlockQuat q = state_.contacts.separation.q;
  const std::vector<double> rotation_travel = state_.contacts.separation.rotation_travel;
  MaxSpeed any;
  std::vector<BlockGroup> groups;
  for (const int b : blocks) add_to_group(groups, b);
  for (const BlockGroup& one : groups) update(one, any);
  state_.contacts.separation.q = q;
  state_.contacts.separation.rotation_travel = rotation_travel;
}

bool MotionBounds::surely_separated(int i) {
  const PairSeparation& known = state_.contacts.separation.pair[z(i)];
  if (!(known.distance > 0)) return false;
  PairBound& pair = pair_bounds_[z(i)];
  const ContactBlock &a = bodies_.block[z(pair.a)], &b = bodies_.block[z(pair.b)];
  const std::vector<double>& rotation_travel = state_.contacts.separation.rotation_travel;
  const double soon = look_ahead * 1.5 * std::max(macro_dt(state_.time), state_.time.last_dt);  // the next step may be 1.5 times as long
  const double left = known.distance - ((b.u - a.u) - known.relative_u).norm() -
                      (rotation_travel[z(pair.a)] + rotation_travel[z(pair.b)] - known.rotation_travel) -
                      round_off * state_.contacts.list.margin;
  if (!(soon * ((b.v - a.v).norm() + spin_[z(pair.a)] + spin_[z(pair.b)]) < left)) return false;
  pair.until = (travel_[z(pair.a)] + travel_[z(pair.b)] + left) * (1 - round_off);
  return true;
}

void MotionBounds::note_separation(int i, double distance) {
  SeparationState& separation = state_.contacts.separation;
  PairSeparation& known = separation.pair[z(i)];
  PairBound& pair = pair_bounds_[z(i)];
  const int a = pair.a, b = pair.b;
  known.distance = pair.until = 0;
  if (!(distance > 0)) return;
  known = {distance, separation.rotation_travel[z(a)] + separation.rotation_travel[z(b)], bodies_.block[z(b)].u - bodies_.block[z(a)].u};
  pair.until = (travel_[z(a)] + travel_[z(b)] + distance - round_off * state_.contacts.list.margin) * (1 - round_off);
}

}  // namespace erbs
