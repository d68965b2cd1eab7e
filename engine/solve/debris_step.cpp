// Part of `Debris` that runs every step: poses, contact forces, their sum, and the time step that they allow.
#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "engine/base/parallel.h"
#include "engine/contact/landing.h"
#include "engine/contact/view.h"
#include "engine/solve/debris.h"

namespace erbs {
namespace {

constexpr int look_every = 16;  // steps between two updates of all poses, unless some block travels far in that time
std::size_t z(int i) { return std::size_t(i); }

}  // namespace

// Only blocks of live pairs need a pose in every step; all others wait for `look()`.
void Debris::follow(int thread, int first, int last) {
  fastest_[z(thread)] = {};
  const auto before = [](const Eight& blocks, int group) { return blocks.group < group; };
  const auto of = [&](const std::vector<Eight>& groups) {
    const auto end = std::lower_bound(groups.begin(), groups.end(), (last + lanes - 1) / lanes, before);
    return std::span<const Eight>(std::lower_bound(groups.begin(), end, first / lanes, before), end);
  };
  double fastest[lanes] = {};
  for (const Eight& blocks : of(awake_)) {
    const auto& v = state_.v.data()[blocks.group].x;
    for (int l = 0; l < lanes; ++l) {
      const double square = v[0][l] * v[0][l] + v[1][l] * v[1][l] + v[2][l] * v[2][l];
      fastest[l] = std::max(fastest[l], blocks.is_in[l] * square);
    }
  }
  fastest_loose_[z(thread)] = *std::ranges::max_element(fastest);
  for (const Eight& blocks : of(placed_)) place(blocks, fastest_[z(thread)]);
}

void Debris::prepare() {
  double fastest = *std::ranges::max_element(fastest_loose_);
  Fastest late;
  if (unsorted_) {
    std::vector<Eight> involved;
    for (const int b : involved_) mark(involved, b);
    for (const Eight& blocks : involved) place(blocks, late);
    for (const int b : involved_) fastest = std::max(fastest, blocks_[z(b)].v.squaredNorm());
  } else {
    for (const Eight& blocks : driven_) place(blocks, late);  // no drift moves them
  }
  const bool far = std::sqrt(fastest) * state_.dt * look_every > 0.25 * state_.debris.margin;
  if (!state_.debris.valid || far || state_.step % look_every == 0) look();
  if (unsorted_) sort();
  if (std::exchange(lanes_changed_, false)) lane_.assign(state_.debris.pair.size(), {});
  double speed = *std::ranges::max_element(late.speed);
  for (const Fastest& one : fastest_) speed = std::max(speed, *std::ranges::max_element(one.speed));
  fastest_pair_ = 2 * speed;
}

// Pairs of two sleepers, or of a sleeper and a fixed block, are evaluated once more, without dashpots, and then skipped.
void Debris::sort() {
  sleep_.sort(involved_, [this](int i) {
    Pair& pair = state_.debris.pair[z(i)];
    pair.damping = PairWrench{};
    Pair copy = pair;
    PairResult r;
    pair_force(copy, shapes_, blocks_[z(pair.a)], blocks_[z(pair.b)], settings_, 0.0, true, room_.front(), r);
    return r;
  });
  placed_.clear();
  driven_.clear();
  awake_.clear();
  for (const int b : sleep_.awake()) mark(awake_, b);
  std::vector<int> pushed = sleep_.pushed();
  std::ranges::sort(pushed);
  for (const int b : pushed) {
    if (model_.kind[z(b)] == Kind::fixed || sleep_.asleep(b)) continue;
    mark(placed_, b);
    if (model_.kind[z(b)] == Kind::driven) mark(driven_, b);
  }
  find_still();
  ask_elsewhere();
  unsorted_ = false;
  relisted_ = true;
}

bool Debris::sleep(const Excitation& now, const double* push) {
  const bool changed = sleep_.turn(now, push, shapes_, blocks_);
  unsorted_ = unsorted_ || changed;
  return changed;
}

// Updates the poses of all blocks, since `follow()` leaves out blocks without a live pair, and searches for pairs if necessary.
void Debris::look() {
  place_all(false);
  part_beds();
  if (unsorted_) find_still();
  if (state_.debris.valid && !needs_search(state_.debris, shapes_, blocks_, still_)) return;
  const bool came_loose = !state_.debris.valid && state_.step > 0;  // overlaps at the start of a run are meant to press
  std::vector<int> fresh;
  state_.energy.reset += search(
      state_.debris, shapes_, blocks_, state_.loose, jointed_, [this](int a, int b) { return law(a, b); }, still_, &fresh);
  if (came_loose) state_.energy.reset -= start_fresh(fresh);
  list_anew();
  find_still();
}

// Finds sleepers with the pose of the last search: the list has all their neighbours.
void Debris::find_still() {
  const PairList& list = state_.debris;
  still_.clear();
  if (state_.rest.count == 0 || list.u.size() != blocks_.size()) return;
  still_.assign(blocks_.size(), 0);
  for (int b = 0; b < model_.nblock; ++b)
    still_[z(b)] = sleep_.asleep(b) && blocks_[z(b)].u == list.u[z(b)] && blocks_[z(b)].turn == list.turn[z(b)];
}

// True if a separated pair needs no evaluation: the travel of its two blocks since the last one cannot have closed the gap.
bool Debris::keeps_apart(int i) {
  const Apart& known = state_.parting.pair[z(i)];
  if (!(known.distance > 0)) return false;
  Waiting& pair = waiting_[z(i)];
  const ContactBlock &a = blocks_[z(pair.a)], &b = blocks_[z(pair.b)];
  const std::vector<double>& spun = state_.parting.spun;
  const double soon = look_ahead * 1.5 * std::max(state_.dt, state_.last_dt);  // the next step may be 1.5 times as long
  const double left = known.distance - ((b.u - a.u) - known.between).norm() - (spun[z(pair.a)] + spun[z(pair.b)] - known.spun) -
                      round_off * state_.debris.margin;
  if (!(soon * ((b.v - a.v).norm() + spin_[z(pair.a)] + spin_[z(pair.b)]) < left)) return false;
  pair.until = (way_[z(pair.a)] + way_[z(pair.b)] + left) * (1 - round_off);
  return true;
}

// Records the distance of a pair after its evaluation.
void Debris::note_apart(int i, double distance) {
  Apart& known = state_.parting.pair[z(i)];
  Waiting& pair = waiting_[z(i)];
  const int a = pair.a, b = pair.b;
  known.distance = pair.until = 0;
  if (!(distance > 0)) return;
  known = {distance, state_.parting.spun[z(a)] + state_.parting.spun[z(b)], blocks_[z(b)].u - blocks_[z(a)].u};
  pair.until = (way_[z(a)] + way_[z(b)] + distance - round_off * state_.debris.margin) * (1 - round_off);
}

// Edge along which two blocks touch at rest, both joined to a common third. Other bodies seldom touch along an edge, and never for long.
EdgeAtRest Debris::edge_of(const Pair& pair) const {
  const auto joined = [this](int a, int b) {
    return std::binary_search(pair_keys_.begin(), pair_keys_.end(), a < b ? pair_key(a, b) : pair_key(b, a));
  };
  const std::vector<int>& near = neighbours_[z(pair.a)];
  if (joined(pair.a, pair.b) || std::ranges::none_of(near, [&](int c) { return joined(c, pair.b); })) return {};
  ContactBlock a = blocks_[z(pair.a)], b = blocks_[z(pair.b)];
  a.u = b.u = Vec3::Zero();
  a.turn = axes_of(pair.a), b.turn = axes_of(pair.b);
  return edge_at_rest(pair, view_of(pair, shapes_, a, b));
}

// m, further travel during which a pair needs no evaluation, although it may overlap along an edge; zero or less: evaluate it.
double Debris::idle(int i) const {
  const Pair& pair = state_.debris.pair[z(i)];
  if (edge_[z(i)] < 0 || pair.touching) return 0;
  return idle_way(edges_[z(edge_[z(i)])], view_of(pair, shapes_, blocks_[z(pair.a)], blocks_[z(pair.b)]).pose);
}

double Debris::crowd(int a, int b) const {
  const std::vector<int>& contacts = state_.debris.contacts;
  return std::clamp(double(std::max(contacts[z(a)], contacts[z(b)])), 1.0, full_crowd);
}

void Debris::forces(int thread, bool sample) {
  const std::vector<int>& live = sleep_.live();
  const auto from = [&](int t) { return std::lower_bound(live.begin(), live.end(), first_pair_[z(t)]); };
  const std::span<const int> mine(from(thread), from(thread + 1));
  Looked& looked = looked_[z(thread)];
  looked.at.clear(), looked.active.clear(), looked.near.clear();
  looked.at.resize(std::size_t(mine.size()));
  std::size_t due = 0, stay = 0;
  for (const int i : mine) {  // without a branch: the sequence of due pairs has no pattern
    const Waiting& pair = waiting_[z(i)];
    looked.at[due] = i;
    due += !(way_soon_[z(pair.a)] + way_soon_[z(pair.b)] < pair.until);
  }
  for (std::size_t k = 0; k < due; ++k) {
    const int i = looked.at[k];
    looked.at[stay] = i;
    stay += lane_[z(i)].fits || !keeps_apart(i);
  }
  looked.at.resize(stay);
  const int n = int(stay);
  looked.active.reserve(z(n));  // results must stay in place
  OverlapRoom& room = room_[z(thread)];
  Batch& batch = *batch_[z(thread)];
  const double dt = state_.last_dt;
  const auto alone = [&](int i, PairResult& r) {
    Pair& pair = state_.debris.pair[z(i)];
    const ContactBlock &a = blocks_[z(waiting_[z(i)].a)], &b = blocks_[z(waiting_[z(i)].b)];
    Lane& lane = lane_[z(i)];
    if (const double way = idle(i); way > 0) {
      note_apart(i, r.apart = way);
      return false;
    }
    const PairBodies& bodies = lane.bodies;
    const View view{bodies.reference, bodies.other, bodies.swapped ? &b : &a, bodies.swapped ? &a : &b, {}};
    if (stands_apart(lane.keeper, pair, view, settings_, dt, r)) {
      note_apart(i, r.apart);
      if (r.apart > settings_.interlock.gap) pair.bearing = 0;
      return false;
    }
    const bool counts = pair_force(pair, shapes_, a, b, settings_, dt, sample, room, r, crowd(waiting_[z(i)].a, waiting_[z(i)].b));
    lane.fits = goes_in_lanes(pair, bodies);
    lane.keeper = short_keeper(pair, *bodies.reference, *bodies.other);
    note_apart(i, counts ? 0 : r.apart);
    return counts;
  };
  PairJob job[most_together];
  int at[most_together], count = 0;
  const auto together = [&] {
    const unsigned left_out = pair_forces(job, count, settings_, dt, sample, batch);
    for (int l = 0; l < count; ++l)
      if ((left_out >> l & 1u) != 0) alone(at[l], *job[l].result);
    count = 0;
  };
  for (int k = 0; k < n; ++k) {
    const int i = looked.at[z(k)];
    Pair& pair = state_.debris.pair[z(i)];
    const Waiting& known = waiting_[z(i)];
    Lane& lane = lane_[z(i)];
    if (!lane.known) {
      lane.bodies = bodies_of(pair, shapes_);
      lane = {lane.bodies, true, goes_in_lanes(pair, lane.bodies), short_keeper(pair, *lane.bodies.reference, *lane.bodies.other)};
    }
    if (lane.fits) {
      looked.active.push_back({i, {}});
      job[count] = {&pair, lane.bodies, &blocks_[z(known.a)], &blocks_[z(known.b)], &looked.active.back().result, crowd(known.a, known.b)};
      at[count++] = i;
      if (count == most_together) together();
      continue;
    }
    PairResult r;
    if (alone(i, r)) looked.active.push_back({i, r});
    else looked.near.push_back({i, r.apart, r.landing_a, r.landing_b, r.haste});
  }
  if (count > 0) together();
  foresee_touching(thread);
}

// Balances the threads for the next step. The share of a thread does not change results, since pairs are summed in their order.
void Debris::share_out() {
  std::size_t all = 0, before = 0;
  for (const Looked& looked : looked_) all += looked.at.size();
  const std::size_t threads = looked_.size();
  std::size_t next = 1;
  for (const Looked& looked : looked_) {
    for (; next < threads && all * next < (before + looked.at.size()) * threads; ++next)
      first_pair_[next] = looked.at[all * next / threads - before];
    before += looked.at.size();
  }
}

// Returns the greatest `PairResult::rubbing`.
double Debris::add_up(std::span<const Active> active, double* push, bool sample) {
  static_assert(sizeof(PairWrench) == 9 * sizeof(double));
  static const Vec6 from_a = (Vec6() << -1, -1, -1, 1, 1, 1).finished();
  const double* const edge = model_.smallest_edge.data();
  double *const rate = rate_.data(), rubbing = 0, friction = state_.energy.friction, damping = state_.energy.contact_damping,
                reset = state_.energy.reset, deepest = state_.max_penetration_relative;
  int *const contacts = state_.debris.contacts.data(), touching = 0;
  for (const Active& one : active) {
    const std::size_t i = z(one.pair);
    const Waiting& pair = waiting_[i];
    const Bed& bed = bed_[i];
    const PairResult& r = one.result;
    const double* w = r.wrench.force.data();
    const std::size_t a = z(pair.a), b = z(pair.b);
    Vec6::Map(push + 8 * a) += from_a.cwiseProduct(Vec6::Map(w));
    Vec3::Map(push + 8 * b) += Vec3::Map(w);
    Vec3::Map(push + 8 * b + 3) += Vec3::Map(w + 6);
    friction += r.friction;
    rubbing = std::max(rubbing, r.rubbing);
    damping += r.damping;
    if (sample) elastic_ += r.elastic + r.tangential;
    rate[a] += std::max(0.0, r.rate_a - bed.rate_a);
    rate[b] += std::max(0.0, r.rate_b - bed.rate_b);
    touching += r.touching;
    contacts[a] += r.touching;
    contacts[b] += r.touching;
    land(one.pair, r.landing_a, r.landing_b, r.touching);
    haste_ = std::max(haste_, r.haste);
    const double thin = std::min(edge[a], edge[b]);
    if (r.depth > deepest * thin) deepest = std::max(deepest, r.depth / thin);
  }
  state_.energy.friction = friction, state_.energy.contact_damping = damping, state_.energy.reset = reset;
  state_.max_penetration_relative = deepest;
  touching_ += touching;
  touched_ += touching;
  return rubbing;
}

void Debris::gather(double* push, bool sample) {
  State& s = state_;
  const bool rested = sleep_.holds();
  if (std::exchange(relisted_, false)) {
    if (rested) std::copy_n(sleep_.push(0), 8 * z(model_.nblock), push);
    else std::fill_n(push, 8 * z(model_.nblock), 0.0);
  }
  for (const int b : sleep_.pushed()) {
    if (rested) std::copy_n(sleep_.push(b), 8, push + 8 * b);
    else std::fill_n(push + 8 * b, 8, 0.0);
    rate_[z(b)] = rested ? sleep_.rate(b) : 0;
    landing_[z(b)] = 0;
    s.debris.contacts[z(b)] = rested ? sleep_.contacts(b) : 0;
  }
  touching_ = sleep_.touching();
  allowed_ = model_.dt_most;
  haste_ = 0;
  if (sample) elastic_ = sleep_.elastic();
  rubbing_ = 0;
  for (const Looked& looked : looked_) {
    rubbing_ = std::max(rubbing_, add_up(looked.active, push, sample));
    for (const Near& one : looked.near) land(one.pair, one.landing_a, one.landing_b, false), haste_ = std::max(haste_, one.haste);
  }
  for (const int b : sleep_.pushed())
    if (model_.kind[z(b)] != Kind::moving) s.debris.contacts[z(b)] = 0;   // no limit for dashpots on a fixed or driven block
    else if (s.joined[z(b)]) s.debris.contacts[z(b)] += int(full_crowd);  // joints use up this block's share
  share_out();
  double bears = limit();
  if (limit_.due(bears)) {
    count();
    bears = limit();
  }
  allowed_ = std::min(allowed_, bears);
  allowed_ = unless_it_rubs(allowed_);
  limit_passing();
}

}  // namespace erbs
