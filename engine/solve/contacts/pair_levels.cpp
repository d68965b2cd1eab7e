// Intervals and levels of pairs (model/levels.h), chosen at the start of a macro step for the next one.
#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/joints/event_bound.h"
#include "engine/model/levels.h"
#include "engine/solve/contacts/contacts.h"

namespace erbs {
namespace {

std::size_t z(int i) { return std::size_t(i); }

}  // namespace

void Contacts::reset_levels() {
  for (const int i : sleep_.live()) forces_.set_next_level(i, 0);
}

// m/s, upper bound of the speed of any two points of blocks a and b relative to each other.
double Contacts::relative_speed(int a, int b) const {
  return (bodies_.block[z(b)].v - bodies_.block[z(a)].v).norm() + motion_.spin(a) + motion_.spin(b);
}

// s, interval in which a patch that moves at this relative speed errs by the budget of an event (`event_bound.h`).
double Contacts::accurate_dt(int i) const {
  const ContactPair& pair = state_.contacts.list.pair[z(i)];
  const double rate = relative_speed(pair.a, pair.b) * std::sqrt(event_share * pair.law.kn * pair.area / forces_.settings().event_budget);
  return rate > 0 ? 1 / rate : std::numeric_limits<double>::infinity();
}

// True while a touching pair closes or parts as in an impact. Its interval then does not grow: a longer one would cap its dashpot and miss
// the restitution.
bool Contacts::strikes(int i) const {
  const ContactPair& pair = state_.contacts.list.pair[z(i)];
  if (!pair.touching) return false;
  const ContactBlock &r = bodies_.block[z(pair.b_is_reference ? pair.b : pair.a)],
                     &o = bodies_.block[z(pair.b_is_reference ? pair.a : pair.b)];
  const Vec3 apart = (o.rest - r.rest) + (o.u - r.u), at = r.rotation * pair.c;
  const double along = (r.rotation * pair.n).dot(o.v - r.v + o.w.cross(at - apart) - r.w.cross(at));
  return std::fabs(along) > forces_.settings().reference_speed;
}

void Contacts::find_pair_steps() {
  bound_.find_stiff_blocks(former_, sleep_);
  pair_dt_.clear();
  joints_dt_ = bound_.joints_dt();
  least_pair_dt_ = std::numeric_limits<double>::infinity();
  const auto note = [this](double dt, StepLimit::By by, int block) {
    if (dt < least_pair_dt_) least_pair_dt_ = dt, least_limit_ = {by, block};
  };
  for (const ContactForces::ThreadPairs& found : forces_.results()) {
    for (const ContactForces::Force& one : found.forces) {
      const MotionBounds::PairBound& pair = motion_.pair(one.pair);
      const double allowed = bound_.pair_dt(one, pair);
      if (bound_.on_stiff_block(pair)) joints_dt_ = std::min(joints_dt_, bound_.limited_by_slip(one));
      note(allowed, allowed < 0.9 * bound_.steady_dt(one, pair) ? StepLimit::By::event : StepLimit::By::contacts, pair.a);
      const double inverse_mass = bodies_.block[z(pair.a)].inverse_mass + bodies_.block[z(pair.b)].inverse_mass;
      pair_dt_.push_back({one.pair, std::min(allowed, accurate_dt(one.pair)), bound_.steady_dt(one, pair),
                          one.result.wrench.force.squaredNorm() * inverse_mass / 8, false});
    }
    // Separated pairs act in every step. They limit it once they may touch before the end of the next macro step, which is twice as long at
    // most. Pairs farther apart may wait (`MotionBounds::waits`), and must not count for that reason either.
    for (const ContactForces::SeparatedPair& one : found.separated) {
      const MotionBounds::PairBound& pair = motion_.pair(one.pair);
      const double way = std::max(3 * macro_dt(state_.time), 7 * state_.time.dt) * relative_speed(pair.a, pair.b);
      if (one.apart <= way) note(bound_.pair_dt(one, pair), StepLimit::By::impact, pair.a);
    }
  }
  // Pairs at rest do not act, but count as if awake: with sleep and without the steps are the same, and what wakes has its level.
  sleep_.each_resting([&](int i, const PairResult& r) {
    const ContactPair& pair = state_.contacts.list.pair[z(i)];
    const double allowed = bound_.steady_dt(pair.a, pair.b, r);
    note(allowed, StepLimit::By::contacts, pair.a);
    const double inverse_mass = bodies_.block[z(pair.a)].inverse_mass + bodies_.block[z(pair.b)].inverse_mass;
    pair_dt_.push_back({i, allowed, allowed, r.wrench.force.squaredNorm() * inverse_mass / 8, true});
  });
  if (sleep_.has_resting()) std::ranges::sort(pair_dt_, {}, &PairStep::pair);
}

// A pair stays at its level while that is allowed, and rises with the margin of `Solver::next_dt`.
int Contacts::level_of(double allowed, double dt, int most, int now) {
  int level = 0;
  while (level < most && (level < now ? 1 : 0.95) * allowed >= (2 << level) * dt) ++level;
  return level;
}

// s, least steady interval in each group of loose blocks that touch each other, for each of these blocks. Weight acts on a block together
// with its pairs (`BlockLevels`): where pairs of a heap at rest have several levels, its blocks tremble and do not fall asleep. Pairs with
// a stiff block keep a level of their own, and so does what strikes.
std::vector<double> Contacts::steady_dt_of_heaps() const {
  std::vector<int> group(z(model_.nblock));
  for (int b = 0; b < model_.nblock; ++b) group[z(b)] = b;
  const auto root = [&](int b) {
    while (group[z(b)] != b) b = group[z(b)] = group[z(group[z(b)])];
    return b;
  };
  const auto loose = [&](int b) { return model_.kind[z(b)] == Kind::moving && !state_.topology.joined[z(b)]; };
  for (const PairStep& of : pair_dt_) {
    const ContactPair& pair = state_.contacts.list.pair[z(of.pair)];
    if (!loose(pair.a) || !loose(pair.b)) continue;
    const int a = root(pair.a), b = root(pair.b);
    group[z(std::max(a, b))] = std::min(a, b);
  }
  std::vector<double> least(z(model_.nblock), std::numeric_limits<double>::infinity()), out = least;
  for (const PairStep& of : pair_dt_) {
    const ContactPair& pair = state_.contacts.list.pair[z(of.pair)];
    if (state_.topology.joined[z(pair.a)] || state_.topology.joined[z(pair.b)]) continue;
    for (const int b : {pair.a, pair.b})
      if (loose(b)) least[z(root(b))] = std::min(least[z(root(b))], of.steady);
  }
  for (int b = 0; b < model_.nblock; ++b)
    if (loose(b)) out[z(b)] = least[z(root(b))];
  return out;
}

std::array<long, most_levels> Contacts::evaluations_by_level() const {
  std::array<long, most_levels> out{};
  for (const PairStep& of : pair_dt_)
    if (!of.rests) out[z(forces_.level(of.pair))] += std::max(1, state_.time.substeps >> forces_.level(of.pair));
  return out;
}

bool Contacts::may_act_every(double dt) const {
  double errs = 0;  // J
  for (const PairStep& of : pair_dt_) {
    const double now = (1 << forces_.level(of.pair)) * state_.time.dt;
    if (now < dt) errs += of.change * (dt * dt - now * now);
  }
  return !(errs > event_tolerance * state_.energy.reference);
}

int Contacts::choose_levels(double dt, int most) {
  while (most > 0 && motion_.fastest_pair() * (1 << most) * dt > 0.2 * state_.contacts.list.margin) --most;
  for (const int i : sleep_.live())
    if (forces_.level(i) > 0) forces_.set_next_level(i, 0);  // separated pairs that were not evaluated
  int highest = 0;
  double errs = 0;  // J, of all longer intervals (`Solver::may_grow`)
  const double most_error = event_tolerance * state_.energy.reference;
  const std::vector<double> steady = steady_dt_of_heaps();
  for (const PairStep& of : pair_dt_) {
    const int pair = of.pair, now = forces_.level(pair);
    const ContactPair& ends = state_.contacts.list.pair[z(pair)];
    const double allowed = std::min({of.allowed, steady[z(ends.a)], steady[z(ends.b)]});
    int level =
        std::min(level_of(allowed, dt, most, now), strikes(pair) ? now : now + 1);  // the dashpots of this step are limited by its interval
    const double before = (1 << now) * state_.time.dt, next = (1 << level) * dt, error = of.change * (next * next - before * before);
    if (level > now && most_error > 0 && errs + error > most_error) level = now;
    else if (level > now) errs += error;
    if (of.rests) forces_.rest_at_level(pair, level);
    else forces_.set_next_level(pair, level);
    highest = std::max(highest, level);
  }
  return highest;
}

}  // namespace erbs
