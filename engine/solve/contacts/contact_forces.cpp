#include "engine/solve/contacts/contact_forces.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/base/count.h"
#include "engine/contact/law/frame.h"
#include "engine/contact/law/impact_bound.h"
#include "engine/joints/event_bound.h"
#include "engine/model/levels.h"

namespace erbs {
namespace {

// Times the event budget: least energy m v^2 of two blocks relative to each other for which events are predicted.
constexpr double foresee_threshold = 2;
using Clock = std::chrono::steady_clock;

// m, that a body at rest falls in the first steps, or until it is fast enough for its blows to be foreseen.
double first_fall(const ContactSettings& settings, double dt) {
  const double time = std::max(look_ahead * dt, settings.gravity > 0 ? settings.reference_speed / settings.gravity : 0);
  return 0.5 * settings.gravity * time * time;
}

PairFrame frame_of(const PairBodies& bodies, const ContactBlock& a, const ContactBlock& b) {
  return {bodies.reference, bodies.other, bodies.swapped ? &b : &a, bodies.swapped ? &a : &b, {}};
}

}  // namespace

ContactForces::ContactForces(const Model& model, State& state, const ContactBodies& bodies, MotionBounds& motion, int threads)
    : state_(state),
      bodies_(bodies),
      motion_(motion),
      first_pair_(z(threads) + 1, 0),
      first_fast_(first_pair_),
      thread_pairs_(z(threads)),
      room_(z(threads)) {
  settings_.blow_share = blow_share(model);
  settings_.gravity = model.gravity.norm();
  for (int b = 0; b < model.nblock; ++b)
    if (model.kind[z(b)] == Kind::moving) settings_.falling_mass += model.mass[z(b)];
  first_pair_.back() = first_fast_.back() = std::numeric_limits<int>::max();
}

void ContactForces::list_pairs() {
  changed_ = true;
  edge_known_.assign(state_.contacts.list.pair.size(), 0);
  edge_.resize(state_.contacts.list.pair.size());
  slow_.clear();
  while (batch_.size() < room_.size()) batch_.push_back(std::make_unique<PairBatch>());
  for (const ContactPair& p : state_.contacts.list.pair) slow_.push_back(p.slow);
}

void ContactForces::prepare() {
  if (std::exchange(changed_, false)) cache_.assign(state_.contacts.list.pair.size(), {});
}

void ContactForces::set(double budget) {
  settings_.event_budget = budget;
  settings_.first_fall = state_.time.step == 0 ? first_fall(settings_, state_.time.dt) : 0;
  settings_.horizon = has_levels(state_.time) ? 3 * macro_dt(state_.time) : 0;  // this macro step and the next, twice as long at most
}

PairInterval ContactForces::interval(bool slow) const {
  const TimeStep& time = state_.time;
  return {interval_before(time, slow), time.last_dt, has_levels(time) ? macro_dt(time) : time.last_dt, slow && time.last_substeps > 1};
}

void ContactForces::book_after_kick(std::span<const int> live) {
  const TimeStep& time = state_.time;
  if (time.substep != 1) return;
  const double half = 0.5 * interval_after(time, true);
  for (const int i : live) {
    if (!slow(i)) continue;
    const ContactPair& pair = state_.contacts.list.pair[z(i)];
    if (!pair.touching) continue;
    const BlockVec3 &v = state_.motion.v, &w = state_.motion.w;
    const Vec3 speed = Vec3(v[z(pair.b)]) - Vec3(v[z(pair.a)]), spin_a = w[z(pair.a)], spin_b = w[z(pair.b)];
    state_.energy.friction -= half * power(pair.friction, speed, spin_a, spin_b);
    state_.energy.contact_damping -= half * power(pair.damping, speed, spin_a, spin_b);
  }
}

// m, further travel during which a pair needs no evaluation, although it may overlap along an edge; zero or less: evaluate it.
double ContactForces::idle(int i) {
  const ContactPair& pair = state_.contacts.list.pair[z(i)];
  if (pair.touching) return 0;
  if (!std::exchange(edge_known_[z(i)], 1)) edge_[z(i)] = bodies_.edge_of(pair);
  if (!edge_[z(i)].touches) return 0;
  const PairFrame now = pair_frame(pair, bodies_.shapes, bodies_.block[z(pair.a)], bodies_.block[z(pair.b)]);
  return idle_way(edge_[z(i)], now.pose);
}

double ContactForces::contact_count(int a, int b) const {
  const std::vector<int>& contacts = state_.contacts.list.contact_count;
  return std::clamp(double(std::max(contacts[z(a)], contacts[z(b)])), 1.0, saturated_contacts);
}

void ContactForces::find_due(ThreadPairs& found, std::span<const int> mine) {
  found.at.clear(), found.forces.clear(), found.separated.clear();
  found.at.resize(mine.size());
  std::size_t due = 0, stay = 0;
  for (const int i : mine) {  // without a branch: the sequence of due pairs has no pattern
    found.at[due] = i;
    due += unsigned(!motion_.waits(i));
  }
  for (std::size_t k = 0; k < due; ++k) {
    const int i = found.at[k];
    found.at[stay] = i;
    stay += cache_[z(i)].fits || !motion_.surely_separated(i);
  }
  found.at.resize(stay);
  found.forces.reserve(stay);  // results must stay in place
}

bool ContactForces::evaluate_one(int i, bool sample, OverlapRoom& room, PairResult& r) {
  ContactPair& pair = state_.contacts.list.pair[z(i)];
  const MotionBounds::PairBound& known = motion_.pair(i);
  const ContactBlock &a = bodies_.block[z(known.a)], &b = bodies_.block[z(known.b)];
  const PairInterval interval = this->interval(slow(i));
  PairCache& cache = cache_[z(i)];
  if (const double way = idle(i); way > 0) {
    motion_.note_separation(i, r.apart = way);
    return false;
  }
  const PairBodies& bodies = cache.bodies;
  if (still_separated(cache.axis, pair, frame_of(bodies, a, b), settings_, interval.horizon, r)) {
    motion_.note_separation(i, r.apart);
    if (r.apart > interlocks_to(settings_, pair)) pair.mean_normal_force = 0;
    return false;
  }
  const bool counts = pair_force(pair, bodies_.shapes, a, b, settings_, interval, sample, room, r, contact_count(known.a, known.b));
  cache.fits = fits_pack(pair, bodies);
  cache.axis = cached_axis(pair, *bodies.reference, *bodies.other);
  motion_.note_separation(i, counts ? 0 : r.apart);
  return counts;
}

void ContactForces::evaluate(int thread, std::span<const int> live, bool sample) {
  const std::vector<int>& first = at_macro_step(state_.time) ? first_pair_ : first_fast_;
  const auto from = [&](int t) { return std::lower_bound(live.begin(), live.end(), first[z(t)]); };
  ThreadPairs& found = thread_pairs_[z(thread)];
  const Clock::time_point began = Clock::now();
  find_due(found, std::span<const int>(from(thread), from(thread + 1)));
  OverlapRoom& room = room_[z(thread)];
  PairBatch& batch = *batch_[z(thread)];
  struct Collected {
    PairTask task[pairs_per_batch];
    int at[pairs_per_batch], count = 0;
  };
  Collected of_pace[2];  // fast and slow pairs: those of one kind have one interval
  const auto evaluate_batch = [&](bool slow) {
    Collected& w = of_pace[slow];
    const unsigned left_out = pair_forces(w.task, w.count, settings_, interval(slow), sample, batch);
    for (int l = 0; l < w.count; ++l)
      if ((left_out >> l & 1u) != 0) evaluate_one(w.at[l], sample, room, *w.task[l].result);
    w.count = 0;
  };
  for (const int i : found.at) {
    ContactPair& pair = state_.contacts.list.pair[z(i)];
    const MotionBounds::PairBound& known = motion_.pair(i);
    PairCache& cache = cache_[z(i)];
    if (!cache.known) {
      cache.bodies = bodies_of(pair, bodies_.shapes);
      cache = {cache.bodies, true, fits_pack(pair, cache.bodies), cached_axis(pair, *cache.bodies.reference, *cache.bodies.other)};
    }
    if (cache.fits) {
      found.forces.push_back({i, {}});
      const ContactBlock &a = bodies_.block[z(known.a)], &b = bodies_.block[z(known.b)];
      Collected& w = of_pace[slow(i)];
      w.task[w.count] = {&pair, cache.bodies, &a, &b, &found.forces.back().result, contact_count(known.a, known.b)};
      w.at[w.count++] = i;
      if (w.count == pairs_per_batch) evaluate_batch(slow(i));
      continue;
    }
    PairResult r;
    if (evaluate_one(i, sample, room, r)) found.forces.push_back({i, r});
    else found.separated.push_back({i, r.apart, r.impact_omega2_a, r.impact_omega2_b, r.event_rate});
  }
  for (const bool slow : {false, true})
    if (of_pace[slow].count > 0) evaluate_batch(slow);
  if (!at_macro_step(state_.time)) return;
  foresee_touching(found);
  note_cost(found, std::chrono::duration<double>(Clock::now() - began).count());
}

// Mean over the last steps. A step in which the thread waited for its core counts little.
void ContactForces::note_cost(ThreadPairs& found, double seconds) {
  constexpr double newest = 0.02, most = 4;  // share of this step in the mean; times the mean
  const double cost = seconds / std::max(1.0, double(found.at.size()));
  found.cost = found.cost > 0 ? found.cost + newest * (std::min(cost, most * found.cost) - found.cost) : cost;
}

// Predicts events of touching pairs with enough kinetic energy, or among few blocks with speed enough for their own blow to matter. With
// less, an event stays within the budget at any step.
void ContactForces::foresee_touching(ThreadPairs& found) {
  if (!(settings_.event_budget > 0)) return;
  const double soon = 1.5 * std::max(macro_dt(state_.time), state_.time.last_dt), slow = settings_.reference_speed;
  for (Force& one : found.forces) {
    const MotionBounds::PairBound& pair = motion_.pair(one.pair);
    const ContactBlock &a = bodies_.block[z(pair.a)], &b = bodies_.block[z(pair.b)];
    const double spin_a = motion_.spin(pair.a), spin_b = motion_.spin(pair.b);
    const double square = (b.v - a.v).squaredNorm() + spin_a * spin_a + spin_b * spin_b;
    const double least = foresee_threshold * settings_.event_budget * std::max(a.inverse_mass, b.inverse_mass);
    if (!(square > (std::isfinite(settings_.blow_share) ? std::min(least, slow * slow) : least))) continue;
    foresee(state_.contacts.list.pair[z(one.pair)], frame_of(cache_[z(one.pair)].bodies, a, b), settings_, soon, one.result);
  }
}

// Equal times: pairs that slip cost more than pairs that stick, and the first thread may have a slower core.
void ContactForces::balance_threads() {
  double all = 0, before = 0;  // s
  for (const ThreadPairs& found : thread_pairs_) all += found.cost * double(found.at.size());
  const double share = all / double(thread_pairs_.size());
  std::size_t next = 1;
  for (const ThreadPairs& found : thread_pairs_) {
    const std::size_t count = found.at.size();
    const double until = before + found.cost * double(count);
    for (; next < thread_pairs_.size() && double(next) * share < until; ++next)
      first_pair_[next] = found.at[std::min(count - 1, std::size_t((double(next) * share - before) / found.cost))];
    before = until;
  }
}

// Fast pairs often belong to one fragment, and would all be of one thread.
void ContactForces::share_fast(std::span<const int> fast) {
  const std::size_t threads = thread_pairs_.size();
  for (std::size_t t = 1; t < threads; ++t) first_fast_[t] = fast.empty() ? 0 : fast[t * fast.size() / threads];
}

}  // namespace erbs
