#include "engine/solve/contacts/contact_forces.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/contact/law/frame.h"
#include "engine/contact/law/impact_bound.h"

namespace erbs {
namespace {

// Times the event budget: least energy m v^2 of two blocks relative to each other for which events are predicted.
constexpr double foresee_threshold = 2;
std::size_t z(int i) { return std::size_t(i); }

PairFrame frame_of(const PairBodies& bodies, const ContactBlock& a, const ContactBlock& b) {
  return {bodies.reference, bodies.other, bodies.swapped ? &b : &a, bodies.swapped ? &a : &b, {}};
}

}  // namespace

ContactForces::ContactForces(State& state, const ContactBodies& bodies, MotionBounds& motion, int threads)
    : state_(state), bodies_(bodies), motion_(motion), first_pair_(z(threads) + 1, 0), thread_pairs_(z(threads)), room_(z(threads)) {
  first_pair_.back() = std::numeric_limits<int>::max();
}

void ContactForces::list_pairs() {
  changed_ = true;
  edge_of_pair_.clear();
  edges_.clear();
  while (batch_.size() < room_.size()) batch_.push_back(std::make_unique<PairBatch>());
  for (const ContactPair& p : state_.contacts.list.pair) {
    const EdgeAtRest edge = bodies_.edge_of(p);
    edge_of_pair_.push_back(edge.touches ? int(edges_.size()) : -1);
    if (edge.touches) edges_.push_back(edge);
  }
}

void ContactForces::prepare() {
  if (std::exchange(changed_, false)) cache_.assign(state_.contacts.list.pair.size(), {});
}

// m, further travel during which a pair needs no evaluation, although it may overlap along an edge; zero or less: evaluate it.
double ContactForces::idle(int i) const {
  const ContactPair& pair = state_.contacts.list.pair[z(i)];
  if (edge_of_pair_[z(i)] < 0 || pair.touching) return 0;
  const PairFrame now = pair_frame(pair, bodies_.shapes, bodies_.block[z(pair.a)], bodies_.block[z(pair.b)]);
  return idle_way(edges_[z(edge_of_pair_[z(i)])], now.pose);
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
    due += !motion_.waits(i);
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
  const double dt = state_.time.last_dt;
  PairCache& cache = cache_[z(i)];
  if (const double way = idle(i); way > 0) {
    motion_.note_separation(i, r.apart = way);
    return false;
  }
  const PairBodies& bodies = cache.bodies;
  if (still_separated(cache.axis, pair, frame_of(bodies, a, b), settings_, dt, r)) {
    motion_.note_separation(i, r.apart);
    if (r.apart > settings_.interlock.gap) pair.mean_normal_force = 0;
    return false;
  }
  const bool counts = pair_force(pair, bodies_.shapes, a, b, settings_, dt, sample, room, r, contact_count(known.a, known.b));
  cache.fits = fits_pack(pair, bodies);
  cache.axis = cached_axis(pair, *bodies.reference, *bodies.other);
  motion_.note_separation(i, counts ? 0 : r.apart);
  return counts;
}

void ContactForces::evaluate(int thread, std::span<const int> live, bool sample) {
  const auto from = [&](int t) { return std::lower_bound(live.begin(), live.end(), first_pair_[z(t)]); };
  ThreadPairs& found = thread_pairs_[z(thread)];
  find_due(found, std::span<const int>(from(thread), from(thread + 1)));
  OverlapRoom& room = room_[z(thread)];
  PairBatch& batch = *batch_[z(thread)];
  PairTask task[pairs_per_batch];
  int at[pairs_per_batch], count = 0;
  const auto evaluate_batch = [&] {
    const unsigned left_out = pair_forces(task, count, settings_, state_.time.last_dt, sample, batch);
    for (int l = 0; l < count; ++l)
      if ((left_out >> l & 1u) != 0) evaluate_one(at[l], sample, room, *task[l].result);
    count = 0;
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
      task[count] = {&pair, cache.bodies, &a, &b, &found.forces.back().result, contact_count(known.a, known.b)};
      at[count++] = i;
      if (count == pairs_per_batch) evaluate_batch();
      continue;
    }
    PairResult r;
    if (evaluate_one(i, sample, room, r)) found.forces.push_back({i, r});
    else found.separated.push_back({i, r.apart, r.impact_omega2_a, r.impact_omega2_b, r.event_rate});
  }
  if (count > 0) evaluate_batch();
  foresee_touching(found);
}

// Predicts events of touching pairs with enough kinetic energy. With less, an event stays within the budget at any step.
void ContactForces::foresee_touching(ThreadPairs& found) {
  if (!(settings_.event_budget > 0)) return;
  const double soon = 1.5 * std::max(state_.time.dt, state_.time.last_dt);
  for (Force& one : found.forces) {
    const MotionBounds::PairBound& pair = motion_.pair(one.pair);
    const ContactBlock &a = bodies_.block[z(pair.a)], &b = bodies_.block[z(pair.b)];
    const double spin_a = motion_.spin(pair.a), spin_b = motion_.spin(pair.b);
    const double square = (b.v - a.v).squaredNorm() + spin_a * spin_a + spin_b * spin_b;
    if (!(square > foresee_threshold * settings_.event_budget * std::max(a.inverse_mass, b.inverse_mass))) continue;
    foresee(state_.contacts.list.pair[z(one.pair)], frame_of(cache_[z(one.pair)].bodies, a, b), settings_, soon, one.result);
  }
}

void ContactForces::balance_threads() {
  std::size_t all = 0, before = 0;
  for (const ThreadPairs& found : thread_pairs_) all += found.at.size();
  const std::size_t threads = thread_pairs_.size();
  std::size_t next = 1;
  for (const ThreadPairs& found : thread_pairs_) {
    for (; next < threads && all * next < (before + found.at.size()) * threads; ++next)
      first_pair_[next] = found.at[all * next / threads - before];
    before += found.at.size();
  }
}

}  // namespace erbs
