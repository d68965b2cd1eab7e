#include "engine/analysis/quasi_static/relaxation.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/analysis/quasi_static/damper.h"
#include "engine/analysis/start/elastic_push.h"
#include "engine/base/count.h"
#include "engine/base/error.h"
#include "engine/base/units.h"
#include "engine/solve/blocks/integrate.h"

namespace erbs::analysis {
namespace {

constexpr double checks = 20;       // of the balance, in a period, ...
constexpr double least_check = 8;   // ... but no sooner than after so many steps
constexpr int balanced_checks = 3;  // in balance, one after the other
// Periods until a structure that still moves is said to creep, and at least this many times sqrt(height / g), the time scale of rocking.
// Walls whose joints slide in turn come to rest after up to 60.
constexpr double longest = 600, longest_fall = 100;
// Shorter steps where the ledger misses too much: by this factor again and again, down to this part of the first.
constexpr double finer = 3, finest = 27;
// Of a block's smallest edge: any block that has moved so far falls.
constexpr double far_away = 0.5;
// A block that moves by so many times the displacement of the monitored point hangs on no lever that a loading machine holds.
constexpr double longest_lever = 30;
// Of the limit of the step, with local damping: forces count 1 + local_share times against the motion. That leaves 4 / 1.8 for springs and
// for the dashpots of contacts, which at their cap take 4 / 3 of the 4 (time_step_bound.cpp).
constexpr double local_step = 0.47;
// Joined neighbours that meet along an edge: thousands of strips of a micron's slip would each cost as much as a joint.
constexpr double edge_force = 0.1;
constexpr int release_rarely = 128;  // steps, where thousands of joints open one by one: an open one may wait
// A coarse inertia: period of its pieces in steps; where it is used, the structure's over that; blocks of a piece, and pieces, so that
// their factors stay small beside a step.
constexpr double quick_steps = 40, slow = 10;
constexpr int least_piece = 40, most_pieces = 200;
constexpr double least_along = 1e-6;                     // of the way of a monitored point that a machine controls: what is along the push
constexpr int control_every = 4;                         // steps between two readings of the displacement that controls the load
constexpr double controlled_steps = 40 * control_every;  // at least, in a period of the pieces with the loading machine
constexpr double longest_lag = 0.5;                      // rad, of the swing on the loading machine, between two readings
constexpr double default_step_count = 50;                // steps in a period where the structure has no elastic one

double smooth(double x) { return x >= 1 ? 1 : x * x * (3 - 2 * x); }

}  // namespace

double height_of(const Model& m) {
  const Vec3 up = m.gravity.norm() > 0 ? Vec3(-m.gravity.normalized()) : Vec3::UnitZ();
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (int b = 0; b < m.nblock; ++b) {
    if (m.kind[z(b)] != Kind::moving) continue;
    for (const Polyhedron& part : m.parts[z(b)])
      for (const Vec3& v : part.vertices) low = std::min(low, up.dot(v)), high = std::max(high, up.dot(v));
  }
  return high > low ? high - low : 1;
}

void refuse_floating(const Prepared& run, const Place& place) {
  std::vector<std::string> names;
  for (int b = 0; b < run.model.nblock; ++b)
    if (run.model.kind[z(b)] == Kind::moving && !run.state.topology.grounded[z(b)]) names.push_back(run.model.block_name[z(b)]);
  if (names.empty()) return;
  const std::size_t shown = std::min<std::size_t>(names.size(), 5);
  const std::vector<std::string> first(names.begin(), names.begin() + std::ptrdiff_t(shown));
  throw Error(fmt::format("no joint leads from {}{} to a fixed block; a push needs one: add a joint rule, a support, or remove {}",
                          fmt::join(first, ", "), names.size() > shown ? fmt::format(" and {} more", names.size() - shown) : "",
                          names.size() > 1 ? "them" : "it"),
              place);
}

Relaxation::Relaxation(const PushSettings& push, const std::vector<std::string>& groups, const Prepared& run,
                       std::vector<std::uint8_t> fell, int threads)
    : push_(push),
      run_(run),
      fell_(std::move(fell)),
      crew_(threads),
      model_(run.model),
      loads_(push, groups, model_),
      monitor_(push, run.model, fell_) {
  true_dt_ = dt_ = run.state.time.dt;
  // Nothing hops on the way to equilibrium. The mean pressure of the interlock would hold unloading beds for seconds, thousands of steps.
  model_.settles.clear();
  model_.edge_force = edge_force;
  model_.crushed_beds_remain = true;
  // Nor do dashpots act at rest. A step bounded by them would make motions of the coarse inertia, which knows springs only, unstable.
  for (Joint& joint : model_.joint) joint.viscous = joint.viscous_cracked = 0, joint.hop = {};
  model_.dashpots = model_.dashpots_cracked = false;
  range_ = run.range;
  if (std::isfinite(run.bounds.critical)) {
    if (push.inertia == "scaled") scale_inertia(model_, run.state);
    const StepBounds bounds = step_bounds(model_, run.state);
    range_.critical = bounds.cracked;
    const double smaller = std::min(1.0, model_.analysis.dt_fraction / Analysis{}.dt_fraction);  // where the scene says so
    range_.longest = dt_ = smaller * (push.relaxation == "local" ? local_step : 0.9) * bounds.cracked;
  }
  free_dt_ = dt_;
  soften_inertia();
  const double g = run.model.gravity.norm() > 0 ? run.model.gravity.norm() : standard_g;
  longest_ = std::max(longest * period_, longest_fall * std::sqrt(height_of(run.model) / g));
}

// Waits for no slow elastic motion: that of a structure of a hundred metres takes thousands of steps.
void Relaxation::soften_inertia() {
  std::vector<Vec3> along(z(model_.nblock));  // N, of 1 m/s2 on the masses of the relaxation
  for (int b = 0; b < model_.nblock; ++b) along[z(b)] = model_.mass[z(b)] * push_.direction;
  const ElasticPush elastic = elastic_push(model_, run_.state, along);
  elastic_rate_ = elastic.frequency * elastic.frequency;
  const Freedom freedom = grounded_freedoms(model_, run_.state);
  const bool machine = push_.control == "displacement" && elastic_rate_ > 0;
  if (machine) take_machine(freedom);
  const double stiffness = machine ? loading_machine().stiffness : 0;
  hold_by_machine(stiffness);
  if (elastic_rate_ > 0 && push_.inertia == "scaled" && model_.analysis.solver == "leapfrog") {
    if (elastic_rate_ * slow * slow < quick_rate())
      inertia_.emplace(model_, run_.state, freedom, std::max(least_piece, freedom.count / 6 / most_pieces));
    if (inertia_ && !inertia_->definite()) inertia_.reset();
    if (inertia_) {
      model_.release_every = release_rarely;
      share_ = inertia_->share(elastic.force, elastic.motion);
      hold_by_machine(stiffness);
    }
  }
}

double Relaxation::quick_rate() const {
  const double steps = push_.control == "displacement" ? controlled_steps : quick_steps;
  return std::pow(2 * pi / (steps * dt_), 2) / machine_;
}

// What a loading machine feels of the intact structure.
void Relaxation::take_machine(const Freedom& freedom) {
  const int b = monitor_.block(), i = freedom.first[z(b)];
  if (i < 0) return;
  const std::vector<Vec3> load = loads_.slope();
  const ElasticPush elastic = elastic_push(model_, run_.state, load);
  if (elastic.motion.size() == 0) return;
  constexpr double small = 1e-6;  // of the load: rotations are small
  BlockPoses pose = run_.state.pose;
  const double before = monitor_.along(pose);
  const Vec3 start = monitor_.displacement(pose);
  pose.u[z(b)] += small * elastic.motion.segment<3>(i);
  pose.q[z(b)] = rotation(small * Vec3(elastic.motion.segment<3>(i + 3))) * Quat(pose.q[z(b)]);
  const double moved = monitor_.along(pose) - before, least = least_along * (monitor_.displacement(pose) - start).norm();
  if (moved <= least)
    throw Error(
        fmt::format("analysis: control = \"displacement\": the push moves the monitored point of block \"{}\" {}; turn direction to the "
                    "side that it pushes to, or take another point with monitor",
                    model_.block_name[z(b)], moved < -least ? "against its direction" : "in no way along its direction"),
        push_.place);
  elastic_slope_ = small / moved;
  loaded_rate_ = elastic.frequency * elastic.frequency;
  on_block_ = std::fabs(model_.inverse_mass[z(b)] * load[z(b)].dot(push_.direction));
}

// The loading machine stiffens what it controls: pieces of the structure swing faster by the root of 1 + its stiffness over that of the
// structure. Its force lags behind the displacement by up to `control_every` steps, which must be short beside the swing on the machine
// alone, of the monitored block and of the whole structure: the lag feeds that swing.
void Relaxation::hold_by_machine(double stiffness) {
  dt_ = free_dt_;
  machine_ = 1 + stiffness / elastic_slope_;
  const double swing = std::sqrt(std::max(stiffness * on_block_, (machine_ - 1) * loaded_rate_));  // 1/s
  if (swing > 0) dt_ = std::min(dt_, longest_lag / (control_every * swing));
  double rate = elastic_rate_;
  if (inertia_) {
    inertia_->set_rate(quick_ = quick_rate());
    rate += quick_ * share_;
    dt_ /= std::sqrt(1 + 0.25 * quick_ * dt_ * dt_);
  }
  if (swing > 0 || inertia_) range_.longest = dt_;
  period_ = std::max(rate > 0 ? 2 * pi / std::sqrt(rate) : 0, default_step_count * dt_);
}

void Relaxation::start(State& s, double dt) const {
  s.time = TimeStep{};
  s.time.dt = s.time.dt_target = dt;
  s.contacts.list.bound_updated_at = std::numeric_limits<int>::min();  // at once: the steps begin anew, and the masses may be others
}

void Relaxation::end(State& s) const {
  Damper::stop(s, model_);
  start(s, dt_);
}

std::array<double, 2> Relaxation::mean_forces(const Solver& solver) {
  const SampleState& now = solver.sample();
  double unbalanced = 0, applied = 0;
  unbalanced_.resize(z(model_.nblock));
  for (int b = 0; b < model_.nblock; ++b) {
    unbalanced_[z(b)].setZero();
    if (!counts(b)) continue;
    const Vec3 weight = loads_.weight(b), load = weight + now.load_wrench[z(b)].head<3>(), all = load + now.block_wrench[z(b)].head<3>();
    unbalanced += all.norm();
    applied += std::max(load.norm(), weight.norm());  // a push against gravity may leave no load
    unbalanced_[z(b)] = inertia_ ? all + inertia_->force(b) : all;
  }
  return {unbalanced, applied};
}

double Relaxation::kinetic(const State& s) const {
  double sum = 0;
  for (int b = 0; b < model_.nblock; ++b)
    if (counts(b)) sum += 0.5 * (model_.mass[z(b)] * s.motion.v[z(b)].squaredNorm() + s.motion.w[z(b)].dot(s.motion.spin_momentum[z(b)]));
  return sum;
}

Vec3 Relaxation::reaction(const Solver& solver) const {
  Vec3 sum = Vec3::Zero();
  for (int b = 0; b < model_.nblock; ++b) {
    if (model_.kind[z(b)] == Kind::moving) sum -= model_.mass[z(b)] * weight_share(model_, b) * model_.gravity;
    else sum += solver.sample().block_wrench[z(b)].head<3>();
  }
  return sum;
}

bool Relaxation::far(const State& s, const BlockVec3& from, double share, double least, Relaxed& out) const {
  out.moved = 0;
  bool far = false;
  for (int b = 0; b < model_.nblock; ++b) {
    if (!counts(b)) continue;
    const double moved = (s.pose.u[z(b)] - from[z(b)]).norm();
    far = far || moved > std::max(share * model_.thickness[z(b)], least);
    if (moved > out.moved) out.moved = moved, out.furthest = b;
  }
  return far;
}

Relaxed Relaxation::relax(State& s, const LoadCourse& course, const Seen& seen, Way way) {
  if (way == Way::falling) return relax(s, course, seen, way, 1, true);
  const State before = s;
  Relaxed r;
  long steps = 0;
  for (double part = 1;; part *= finer) {
    r = relax(s, course, seen, way, part, part >= finest || before.energy.residual_worst > ledger_tolerance);
    r.steps = steps += r.steps;
    if (!r.found()) s = before;
    if (r.ending != Ending::inexact) return r;
  }
}

Relaxed Relaxation::relax(State& s, const LoadCourse& course, const Seen& seen, Way way, double finer, bool exact) {
  const bool machine = way == Way::with_machine;
  Relaxed out;
  StepRange range = range_;
  range.longest /= finer;
  start(s, dt_ / finer);
  const BlockVec3 from = s.pose.u;
  const double monitored = monitor_.along(s.pose);
  const double held = machine ? machine_ : 1;
  Damper damper(push_.relaxation, period_, std::sqrt(held), std::sqrt((held - 1) * loaded_rate_), inertia_.has_value(), fell_, model_);
  std::optional<Solver> solver;
  engage(solver, model_, s, range);
  const double check = std::max(period_ / checks, least_check * dt_);
  double next_check = 0, fastest = 0;  // s; J, largest kinetic energy
  int balanced = 0;
  while (true) {
    if (crew_.should_change(steps_ + s.time.step)) engage(solver, model_, s, range);
    const double t = s.time.t, done = t / period_;
    loads_.set(course(smooth(done), monitor_.along(s.pose)));
    const double next = damper.one_step() ? t : machine ? std::min(next_check, t + control_every * s.time.dt) : next_check;
    const Solver::Stop at = solver->advance({.next = next, .wrenches = true});
    out.steps = s.time.step;
    if (solver->broken()) {
      out.ending = Ending::broken;
      break;
    }
    damper.read(s);
    if (at != Solver::Stop::sample || solver->sample().t < next_check) continue;
    next_check += check;
    const auto [unbalanced, applied] = mean_forces(*solver);
    damper.read(s, unbalanced_, done < 1);
    out.unbalanced = applied > 0 ? unbalanced / applied : 0;
    balanced = done > 1 && out.unbalanced <= push_.unbalanced ? balanced + 1 : 0;
    const double energy = kinetic(s);
    const bool speeds_up = energy >= fastest;
    fastest = std::max(fastest, energy);
    const double least = machine ? longest_lever * std::fabs(monitor_.along(s.pose) - monitored) : 0;  // m
    if (far(s, from, speeds_up && way == Way::to_rest ? gone : far_away, least, out)) out.ending = Ending::collapse;
    else if (balanced >= balanced_checks)
      out.ending = exact || s.energy.residual_worst <= ledger_tolerance ? Ending::equilibrium : Ending::inexact;
    else if (t > longest_) out.ending = Ending::creep;
    if (out.ending == Ending::inexact || !seen(*solver, out) || out.ending != Ending::stopped) break;
  }
  if (inertia_) inertia_->set_rate(0);  // the half of its work that follows a step would be left out of the ledger
  if (!solver->broken()) damper.last_step(s, *solver);
  if (inertia_) inertia_->set_rate(quick_);
  take_times(*solver);
  steps_ += s.time.step;
  end(s);
  return out;
}

// A solver with as many threads as the crew has now. The coarse inertia acts on the model of the relaxations alone.
void Relaxation::engage(std::optional<Solver>& solver, const Model& model, State& s, const StepRange& range) {
  const double began = seconds();
  const bool changes = solver.has_value();
  if (changes) take_times(*solver);
  solver.emplace(model, s, range, crew_.threads());
  if (inertia_ && &model == &model_) solver->use(*inertia_);
  if (changes) crew_.took(seconds() - began);
}

void Relaxation::take_times(const Solver& solver) {
  profile_ += solver.profile();
  searched_ += solver.contacts().searched();
}

void Relaxation::release(State& s, double duration, double interval, const Seen& seen) {
  Model falling = run_.model;
  falling.kind = model_.kind;
  falling.edge_force = edge_force;
  falling.grounds = model_.grounds, falling.tilts = model_.tilts, falling.force_loads = model_.force_loads;
  start(s, true_dt_);
  std::optional<Solver> solver;
  engage(solver, falling, s, run_.range);
  for (double next = interval; next <= duration && !solver->broken();) {
    if (crew_.should_change(steps_ + s.time.step)) engage(solver, falling, s, run_.range);
    if (solver->advance({.next = next, .wrenches = true}) != Solver::Stop::sample) continue;
    next += interval;
    if (!seen(*solver, {})) break;
  }
  take_times(*solver);
  steps_ += s.time.step;
  end(s);
}

}  // namespace erbs::analysis
