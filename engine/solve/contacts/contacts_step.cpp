// Part of `Contacts` that runs every step: poses, contact forces, their sum, and the time step that they allow.
#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "engine/base/system/team.h"
#include "engine/contact/law/frame.h"
#include "engine/contact/law/impact_bound.h"
#include "engine/solve/contacts/contacts.h"

namespace erbs {
namespace {

constexpr int update_every = 16;  // steps between two updates of all poses, unless some block travels far in that time
std::size_t z(int i) { return std::size_t(i); }

}  // namespace

// Only blocks of live pairs need a pose in every step; all others wait for `update()`.
void Contacts::track(int thread, int first, int last) {
  fastest_[z(thread)] = {};
  const auto before = [](const BlockGroup& blocks, int group) { return blocks.group < group; };
  const auto of = [&](const std::vector<BlockGroup>& groups) {
    const auto end = std::lower_bound(groups.begin(), groups.end(), (last + pack_size - 1) / pack_size, before);
    return std::span<const BlockGroup>(std::lower_bound(groups.begin(), end, first / pack_size, before), end);
  };
  double fastest[pack_size] = {};
  for (const BlockGroup& blocks : of(awake_)) {
    const auto& v = state_.v.data()[blocks.group].x;
    for (int l = 0; l < pack_size; ++l) {
      const double square = v[0][l] * v[0][l] + v[1][l] * v[1][l] + v[2][l] * v[2][l];
      fastest[l] = std::max(fastest[l], blocks.is_in[l] * square);
    }
  }
  fastest_loose_[z(thread)] = *std::ranges::max_element(fastest);
  for (const BlockGroup& blocks : of(placed_)) update_poses(blocks, fastest_[z(thread)]);
}

void Contacts::prepare() {
  double fastest = *std::ranges::max_element(fastest_loose_);
  MaxSpeed late;
  if (unsorted_) {
    std::vector<BlockGroup> involved;
    for (const int b : involved_) add_to_group(involved, b);
    for (const BlockGroup& blocks : involved) update_poses(blocks, late);
    for (const int b : involved_) fastest = std::max(fastest, blocks_[z(b)].v.squaredNorm());
  } else {
    for (const BlockGroup& blocks : driven_) update_poses(blocks, late);  // no drift moves them
  }
  const bool far = std::sqrt(fastest) * state_.dt * update_every > 0.25 * state_.contacts.margin;
  if (!state_.contacts.valid || far || state_.step % update_every == 0) update();
  if (unsorted_) sort();
  if (std::exchange(cache_outdated_, false)) cache_.assign(state_.contacts.pair.size(), {});
  double speed = *std::ranges::max_element(late.speed);
  for (const MaxSpeed& one : fastest_) speed = std::max(speed, *std::ranges::max_element(one.speed));
  fastest_pair_ = 2 * speed;
}

// Pairs of two sleepers, or of a sleeper and a fixed block, are evaluated once more, without dashpots, and then skipped.
void Contacts::sort() {
  sleep_.sort(involved_, [this](int i) {
    ContactPair& pair = state_.contacts.pair[z(i)];
    pair.damping = PairWrench{};
    ContactPair copy = pair;
    PairResult r;
    pair_force(copy, shapes_, blocks_[z(pair.a)], blocks_[z(pair.b)], settings_, 0.0, true, room_.front(), r);
    return r;
  });
  placed_.clear();
  driven_.clear();
  awake_.clear();
  for (const int b : sleep_.awake()) add_to_group(awake_, b);
  std::vector<int> in_live_pairs = sleep_.in_live_pairs();
  std::ranges::sort(in_live_pairs);
  for (const int b : in_live_pairs) {
    if (model_.kind[z(b)] == Kind::fixed || sleep_.asleep(b)) continue;
    add_to_group(placed_, b);
    if (model_.kind[z(b)] == Kind::driven) add_to_group(driven_, b);
  }
  find_still();
  bound_elsewhere();
  unsorted_ = false;
  relisted_ = true;
}

bool Contacts::sleep(const Excitation& now, const double* contact_wrench) {
  const bool changed = sleep_.update(now, contact_wrench, shapes_, blocks_);
  unsorted_ = unsorted_ || changed;
  return changed;
}

// Updates the poses of all blocks, since `track()` leaves out blocks without a live pair, and searches for pairs if necessary.
void Contacts::update() {
  update_all_poses(false);
  forget_former_joints();
  if (unsorted_) find_still();
  if (state_.contacts.valid && !needs_search(state_.contacts, shapes_, blocks_, still_)) return;
  const bool came_loose = !state_.contacts.valid && state_.step > 0;  // overlaps at the start of a run are meant to press
  std::vector<int> fresh;
  state_.energy.reset += search(
      state_.contacts, shapes_, blocks_, state_.loose, jointed_, [this](int a, int b) { return law(a, b); }, still_, &fresh);
  if (came_loose) state_.energy.reset -= start_fresh(fresh);
  rebuild_lists();
  find_still();
}

// Finds sleepers with the pose of the last search: the list has all their neighbours.
void Contacts::find_still() {
  const PairList& list = state_.contacts;
  still_.clear();
  if (state_.sleep.count == 0 || list.u.size() != blocks_.size()) return;
  still_.assign(blocks_.size(), 0);
  for (int b = 0; b < model_.nblock; ++b)
    still_[z(b)] = sleep_.asleep(b) && blocks_[z(b)].u == list.u[z(b)] && blocks_[z(b)].rotation == list.rotation[z(b)];
}

// True if a separated pair needs no evaluation: the travel of its two blocks since the last one cannot have closed the gap.
bool Contacts::surely_separated(int i) {
  const PairSeparation& known = state_.separation.pair[z(i)];
  if (!(known.distance > 0)) return false;
  PairBound& pair = pair_bounds_[z(i)];
  const ContactBlock &a = blocks_[z(pair.a)], &b = blocks_[z(pair.b)];
  const std::vector<double>& rotation_travel = state_.separation.rotation_travel;
  const double soon = look_ahead * 1.5 * std::max(state_.dt, state_.last_dt);  // the next step may be 1.5 times as long
  const double left = known.distance - ((b.u - a.u) - known.relative_u).norm() -
                      (rotation_travel[z(pair.a)] + rotation_travel[z(pair.b)] - known.rotation_travel) -
                      round_off * state_.contacts.margin;
  if (!(soon * ((b.v - a.v).norm() + spin_[z(pair.a)] + spin_[z(pair.b)]) < left)) return false;
  pair.until = (travel_[z(pair.a)] + travel_[z(pair.b)] + left) * (1 - round_off);
  return true;
}

// Records the distance of a pair after its evaluation.
void Contacts::note_separation(int i, double distance) {
  PairSeparation& known = state_.separation.pair[z(i)];
  PairBound& pair = pair_bounds_[z(i)];
  const int a = pair.a, b = pair.b;
  known.distance = pair.until = 0;
  if (!(distance > 0)) return;
  known = {distance, state_.separation.rotation_travel[z(a)] + state_.separation.rotation_travel[z(b)], blocks_[z(b)].u - blocks_[z(a)].u};
  pair.until = (travel_[z(a)] + travel_[z(b)] + distance - round_off * state_.contacts.margin) * (1 - round_off);
}

// Edge along which two blocks touch at rest, both joined to a common third. Other bodies seldom touch along an edge, and never for long.
EdgeAtRest Contacts::edge_of(const ContactPair& pair) const {
  const auto joined = [this](int a, int b) {
    return std::binary_search(pair_keys_.begin(), pair_keys_.end(), a < b ? pair_key(a, b) : pair_key(b, a));
  };
  const std::vector<int>& neighbours = neighbours_[z(pair.a)];
  if (joined(pair.a, pair.b) || std::ranges::none_of(neighbours, [&](int c) { return joined(c, pair.b); })) return {};
  ContactBlock a = blocks_[z(pair.a)], b = blocks_[z(pair.b)];
  a.u = b.u = Vec3::Zero();
  a.rotation = axes_of(pair.a), b.rotation = axes_of(pair.b);
  return edge_at_rest(pair, pair_frame(pair, shapes_, a, b));
}

// m, further travel during which a pair needs no evaluation, although it may overlap along an edge; zero or less: evaluate it.
double Contacts::idle(int i) const {
  const ContactPair& pair = state_.contacts.pair[z(i)];
  if (edge_of_pair_[z(i)] < 0 || pair.touching) return 0;
  return idle_way(edges_[z(edge_of_pair_[z(i)])], pair_frame(pair, shapes_, blocks_[z(pair.a)], blocks_[z(pair.b)]).pose);
}

double Contacts::contact_count(int a, int b) const {
  const std::vector<int>& contacts = state_.contacts.contact_count;
  return std::clamp(double(std::max(contacts[z(a)], contacts[z(b)])), 1.0, saturated_contacts);
}

void Contacts::forces(int thread, bool sample) {
  const std::vector<int>& live = sleep_.live();
  const auto from = [&](int t) { return std::lower_bound(live.begin(), live.end(), first_pair_[z(t)]); };
  const std::span<const int> mine(from(thread), from(thread + 1));
  ThreadPairs& found = thread_pairs_[z(thread)];
  found.at.clear(), found.forces.clear(), found.separated.clear();
  found.at.resize(std::size_t(mine.size()));
  std::size_t due = 0, stay = 0;
  for (const int i : mine) {  // without a branch: the sequence of due pairs has no pattern
    const PairBound& pair = pair_bounds_[z(i)];
    found.at[due] = i;
    due += !(travel_ahead_[z(pair.a)] + travel_ahead_[z(pair.b)] < pair.until);
  }
  for (std::size_t k = 0; k < due; ++k) {
    const int i = found.at[k];
    found.at[stay] = i;
    stay += cache_[z(i)].fits || !surely_separated(i);
  }
  found.at.resize(stay);
  const int n = int(stay);
  found.forces.reserve(z(n));  // results must stay in place
  OverlapRoom& room = room_[z(thread)];
  PairBatch& batch = *batch_[z(thread)];
  const double dt = state_.last_dt;
  const auto alone = [&](int i, PairResult& r) {
    ContactPair& pair = state_.contacts.pair[z(i)];
    const ContactBlock &a = blocks_[z(pair_bounds_[z(i)].a)], &b = blocks_[z(pair_bounds_[z(i)].b)];
    PairCache& cache = cache_[z(i)];
    if (const double way = idle(i); way > 0) {
      note_separation(i, r.apart = way);
      return false;
    }
    const PairBodies& bodies = cache.bodies;
    const PairFrame frame{bodies.reference, bodies.other, bodies.swapped ? &b : &a, bodies.swapped ? &a : &b, {}};
    if (still_separated(cache.axis, pair, frame, settings_, dt, r)) {
      note_separation(i, r.apart);
      if (r.apart > settings_.interlock.gap) pair.mean_normal_force = 0;
      return false;
    }
    const bool counts =
        pair_force(pair, shapes_, a, b, settings_, dt, sample, room, r, contact_count(pair_bounds_[z(i)].a, pair_bounds_[z(i)].b));
    cache.fits = fits_pack(pair, bodies);
    cache.axis = cached_axis(pair, *bodies.reference, *bodies.other);
    note_separation(i, counts ? 0 : r.apart);
    return counts;
  };
  PairTask task[pairs_per_batch];
  int at[pairs_per_batch], count = 0;
  const auto evaluate_batch = [&] {
    const unsigned left_out = pair_forces(task, count, settings_, dt, sample, batch);
    for (int l = 0; l < count; ++l)
      if ((left_out >> l & 1u) != 0) alone(at[l], *task[l].result);
    count = 0;
  };
  for (int k = 0; k < n; ++k) {
    const int i = found.at[z(k)];
    ContactPair& pair = state_.contacts.pair[z(i)];
    const PairBound& known = pair_bounds_[z(i)];
    PairCache& cache = cache_[z(i)];
    if (!cache.known) {
      cache.bodies = bodies_of(pair, shapes_);
      cache = {cache.bodies, true, fits_pack(pair, cache.bodies), cached_axis(pair, *cache.bodies.reference, *cache.bodies.other)};
    }
    if (cache.fits) {
      found.forces.push_back({i, {}});
      task[count] = {
          &pair, cache.bodies, &blocks_[z(known.a)], &blocks_[z(known.b)], &found.forces.back().result, contact_count(known.a, known.b)};
      at[count++] = i;
      if (count == pairs_per_batch) evaluate_batch();
      continue;
    }
    PairResult r;
    if (alone(i, r)) found.forces.push_back({i, r});
    else found.separated.push_back({i, r.apart, r.impact_omega2_a, r.impact_omega2_b, r.event_rate});
  }
  if (count > 0) evaluate_batch();
  foresee_touching(thread);
}

// Balances the threads for the next step. The share of a thread does not change results, since pairs are summed in their order.
void Contacts::balance_threads() {
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

// Returns the greatest `PairResult::slip_omega2`.
double Contacts::add_up(std::span<const ContactForce> forces, double* contact_wrench, bool sample) {
  static_assert(sizeof(PairWrench) == 9 * sizeof(double));
  static const Vec6 from_a = (Vec6() << -1, -1, -1, 1, 1, 1).finished();
  const double* const edge = model_.smallest_edge.data();
  double *const omega2 = omega2_.data(), slip_omega2 = 0, friction = state_.energy.friction, damping = state_.energy.contact_damping,
                reset = state_.energy.reset, penetration = state_.max_penetration_relative;
  int *const contacts = state_.contacts.contact_count.data(), touching = 0;
  for (const ContactForce& one : forces) {
    const std::size_t i = z(one.pair);
    const PairBound& pair = pair_bounds_[i];
    const FormerJoint& former = former_joints_[i];
    const PairResult& r = one.result;
    const double* w = r.wrench.force.data();
    const std::size_t a = z(pair.a), b = z(pair.b);
    Vec6::Map(contact_wrench + 8 * a) += from_a.cwiseProduct(Vec6::Map(w));
    Vec3::Map(contact_wrench + 8 * b) += Vec3::Map(w);
    Vec3::Map(contact_wrench + 8 * b + 3) += Vec3::Map(w + 6);
    friction += r.friction;
    slip_omega2 = std::max(slip_omega2, r.slip_omega2);
    damping += r.damping;
    if (sample) elastic_ += r.elastic + r.tangential;
    omega2[a] += std::max(0.0, r.omega2_a - former.omega2_a);
    omega2[b] += std::max(0.0, r.omega2_b - former.omega2_b);
    touching += r.touching;
    contacts[a] += r.touching;
    contacts[b] += r.touching;
    add_impact_bound(one.pair, r.impact_omega2_a, r.impact_omega2_b, r.touching);
    event_rate_ = std::max(event_rate_, r.event_rate);
    const double thin = std::min(edge[a], edge[b]);
    if (r.depth > penetration * thin) penetration = std::max(penetration, r.depth / thin);
  }
  state_.energy.friction = friction, state_.energy.contact_damping = damping, state_.energy.reset = reset;
  state_.max_penetration_relative = penetration;
  touching_ += touching;
  touched_ += touching;
  return slip_omega2;
}

void Contacts::gather(double* contact_wrench, bool sample) {
  State& s = state_;
  const bool rested = sleep_.has_resting();
  if (std::exchange(relisted_, false)) {
    if (rested) std::copy_n(sleep_.resting_wrench(0), 8 * z(model_.nblock), contact_wrench);
    else std::fill_n(contact_wrench, 8 * z(model_.nblock), 0.0);
  }
  for (const int b : sleep_.in_live_pairs()) {
    if (rested) std::copy_n(sleep_.resting_wrench(b), 8, contact_wrench + 8 * b);
    else std::fill_n(contact_wrench + 8 * b, 8, 0.0);
    omega2_[z(b)] = rested ? sleep_.omega2(b) : 0;
    impact_omega2_[z(b)] = 0;
    s.contacts.contact_count[z(b)] = rested ? sleep_.contacts(b) : 0;
  }
  touching_ = sleep_.touching();
  allowed_ = model_.dt_max;
  event_rate_ = 0;
  if (sample) elastic_ = sleep_.elastic();
  slip_omega2_ = 0;
  for (const ThreadPairs& found : thread_pairs_) {
    slip_omega2_ = std::max(slip_omega2_, add_up(found.forces, contact_wrench, sample));
    for (const SeparatedPair& one : found.separated)
      add_impact_bound(one.pair, one.impact_omega2_a, one.impact_omega2_b, false), event_rate_ = std::max(event_rate_, one.event_rate);
  }
  for (const int b : sleep_.in_live_pairs())
    if (model_.kind[z(b)] != Kind::moving) s.contacts.contact_count[z(b)] = 0;           // no limit for dashpots on a fixed or driven block
    else if (s.joined[z(b)]) s.contacts.contact_count[z(b)] += int(saturated_contacts);  // joints use up this block's share
  balance_threads();
  double bears = limit();
  if (limit_.due(bears)) {
    update_bound();
    bears = limit();
  }
  allowed_ = std::min(allowed_, bears);
  allowed_ = limited_by_slip(allowed_);
  limit_passing();
}

}  // namespace erbs
