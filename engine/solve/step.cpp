#include "engine/solve/step.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/base/count.h"
#include "engine/joints/event_bound.h"
#include "engine/joints/kinematics.h"
#include "engine/model/joint_packs.h"
#include "engine/model/levels.h"
#include "engine/solve/blocks/islands.h"
#include "engine/solve/blocks/prescribed.h"
#include "engine/solve/jolts.h"

namespace erbs {
namespace {

constexpr int find_soft_every = 64;  // steps between two searches for former joints that must soften, ...
constexpr int soften_every = 8;      // ... and between two steps of their softening, of beds that fade: `Fading::every()`
constexpr int balance_every = 32;    // steps between two changes of the shares of threads, ...
constexpr int timed_every = 5;       // ... and between two whose time is taken for them: no multiple of the steps in a macro step
constexpr int regroup_every = 256;   // steps between two orderings of cracked joints in their packs
constexpr int watch_every = 64;      // steps between two looks for blocks that may meet, ...
constexpr int watch_few_every = 4;   // ... of few blocks: they take longer steps
constexpr int few_blocks = 100;
constexpr int columns_every = 64;  // steps between two searches for the columns of blocks in contact

// s, between two calls that are due `every()` so many steps.
double interval(int steps, const TimeStep& time) { return std::max(steps, time.last_substeps) * time.last_dt; }

// True once in `steps` steps, at the start of a macro step.
bool every(int steps, const TimeStep& time) { return at_macro_step(time) && time.macro % std::max(1, steps / time.substeps) == 0; }

}  // namespace

Solver::Solver(const Model& model, State& state, const StepRange& range, int threads)
    : model_(model),
      state_(state),
      loads_(model, state),
      joints_(model, state),
      fading_(model, state),
      contacts_(model, state, range, threads),
      ledger_(model, state),
      may_have_levels_(may_have_levels(model)),
      joint_shares_(threads),
      contact_shares_(threads),
      block_shares_(threads),
      team_(threads, [this](int thread) { work(thread); }) {
  if (state.time.dt_target == 0) state.time.dt_target = state.time.dt;
  if (state.cache.lazy_rotation == 0) state.cache.lazy_rotation = model.analysis.lazy_rotation;
  note_sleep();
  block_sums_.resize((constants_.size() + block_grain - 1) / block_grain);
  if (model.analysis.solver == "sequential") {
    sequential_.emplace(model, state);
    block_sums_.resize(1 + loads_.loaded_blocks().size());
  }
  // A stopped run may resume just after a block rotated too far, so the first step checks again. Without such a block nothing changes.
  block_sums_.front().outdated = true;
}

Solver::Stop Solver::advance(const SamplePlan& plan) {
  do {
    if (profile_.begin(state_.time)) searched_ = contacts_.searched();
    prepare_step(plan);
    team_.run();
    close_step(plan);
  } while (stop_ == Stop::none && !broken_);
  return stop_;
}

bool Solver::timed() const { return !sampling() && state_.time.step % timed_every == 0; }

void Solver::work(int thread) {
  forces(thread);
  if (has_contacts_ && at_macro_step(state_.time)) {
    team_.barrier().wait(thread);
    contact_shares_.run(thread, timed(), [&] { add_up_contacts(thread); });
  }
  if (!has_transitions_) team_.barrier().wait(thread);
  else if (!team_.barrier().wait(thread, [this] { transitions(); })) return;
  if (thread == 0) lap(has_transitions_ ? Phase::contact : Phase::joints);
  const int groups = int(constants_.size()), grain = sequential_ ? groups : block_grain;  // a sweep runs on one thread
  const Range mine = block_shares_.slice(groups, grain, thread);
  if (inertia_ != nullptr) soften_inertia(thread, mine);
  block_shares_.run(thread, timed(), [&] { integrate(thread, mine); });
}

// Searches have an account of their own.
void Solver::lap(Phase phase) {
  if (profile_.measured()) profile_.lap(phase, contacts_.searched() - std::exchange(searched_, contacts_.searched()));
}

void Solver::prepare_step(const SamplePlan& plan) {
  const TimeStep& time = state_.time;
  if (time.step % balance_every == 0) joint_shares_.balance(), contact_shares_.balance(), block_shares_.balance();
  const bool together = at_macro_step(time), due = ledger_.due(contacts_.active());
  stop_ = !together ? Stop::none : plan.due(time.t, time.dt) ? Stop::sample : due ? Stop::ledger : Stop::none;
  if (std::ranges::any_of(block_sums_, &BlockSums::outdated)) update_outdated();
  const bool debris = model_.analysis.debris, cracked = joints_.any_cracked();
  if (cracked && !joints_.reference() && every(regroup_every, time)) joints_.regroup();
  if (const int steps = Fading::every(time.last_dt); cracked && !state_.joints.share.empty() && every(steps, time))
    fading_.fade(joints_.cracked(), interval(steps, time));
  const int look_every = model_.nblock > few_blocks ? watch_every : watch_few_every;
  // Past the limit of the step on purpose, joints alone fly apart: contact would shorten the step.
  const double ahead = model_.analysis.unstable ? 0 : 2 * look_every * time.dt;
  if (debris && every(look_every, time)) contacts_.activate_loose_blocks(ahead);
  has_contacts_ = contacts_.active();
  budget_ = together && has_levels(time) ? event_allowance(model_, state_) : event_budget(model_, state_);
  has_transitions_ = has_contacts_ || time.step == 0 || (debris && cracked && every(model_.release_every, time));
  if (has_contacts_ && together) contacts_.prepare(budget_);
  else if (has_contacts_) contacts_.prepare_substep();
  if (has_contacts_ && every(columns_every, time)) contacts_.find_columns();
  if (has_contacts_ && contact_wrench_.empty()) {
    contact_wrench_.assign(constants_.size() * pack_size, 0.0);
    if (may_have_levels_) contact_kick_ = contact_wrench_;
  }
  loads_.evaluate();
  if (stop_ == Stop::sample) begin_sample();
}

void Solver::update_outdated() {
  for (BlockSums& sums : block_sums_) sums.outdated = false;
  if (!take_outdated_poses(model_, state_, outdated_)) return;
  if (sequential_) return sequential_->update_reference(outdated_);
  joints_.update_reference(outdated_);
}

void Solver::forces(int thread) {
  if (has_contacts_) contacts_.forces(thread, sampling());
  if (thread == 0) lap(Phase::contact);
  joint_shares_.run(thread, timed(), [&] { joints_.forces(thread, joint_shares_, sampling(), budget_); });
  if (thread == 0) lap(Phase::joints);
}

void Solver::add_up_contacts(int thread) {
  const Range groups = contact_shares_.slice(int(constants_.size()), block_grain, thread);
  const Range blocks{std::min(groups.first * pack_size, model_.nblock), std::min(groups.last * pack_size, model_.nblock)};
  ContactSums& sums = contacts_.sums();
  sums.add_up(blocks, loads_, contact_wrench_.data(), has_levels(state_.time) ? contact_kick_.data() : nullptr);
  if (thread == 0) sums.add_totals(has_levels(state_.time), sampling());
}

// Between forces and drift, on one thread: joints beyond their range are released to contact.
void Solver::transitions() {
  TimeStep& time = state_.time;
  if (!at_macro_step(time)) {
    if (has_contacts_) contacts_.add_up_substep(contact_kick_.data());
    return;
  }
  const bool may_release = model_.analysis.debris && joints_.any_cracked() && every(model_.release_every, time);
  if (has_contacts_) contacts_.end_sums(has_levels(time), loads_);
  if (time.step == 0) {  // contacts present at the start, blows soon after it and joints that yield at once limit the first drift
    const double blows = has_contacts_ ? contacts_.bound().event_rate() : 0,
                 jolts = budget_ > 0 ? jolt_rate(model_, state_, budget_, blow_share(model_)) : 0,
                 rate = std::max({blows, event_rate_at_start(), jolts});
    if (rate > 0) time.event_dt = 1 / rate;
    if (const double dt = next_dt_of_all(); dt < time.dt) {
      set_dt(dt);
      loads_.evaluate();
    }
  }
  const double softened = event_tolerance * state_.energy.reference;
  const int steps = state_.joints.share.empty() ? soften_every : Fading::every(time.last_dt);
  if (has_contacts_ && every(steps, time)) contacts_.soften_former_joints(softened, every(find_soft_every, time), interval(steps, time));
  if (has_contacts_ && contacts_.sleep(loads_.now(), contact_wrench_.data())) note_sleep();
  if (!may_release) return;
  fading_.book(joints_.cracked());  // before a release clears the memory of its joints
  const std::vector<int> released = contacts_.release_joints(joints_.cracked());
  if (released.empty()) return;
  released_.insert(released_.end(), released.begin(), released.end());
  joints_.leave(released);
  find_islands(model_, state_);
  note_sleep();
  contacts_.activate_loose_blocks();
}

// Updates the block constants (sleeping blocks do not move) and the groups of blocks that a step may skip.
void Solver::note_sleep() {
  constants_ = block_constants(model_, state_);
  idle_ = idle_groups(model_, state_);
}

void Solver::use(CoarseInertia& inertia) {
  inertia_ = &inertia;
  force_.resize(constants_.size());
}

void Solver::soften_inertia(int thread, Range mine) {
  sum_forces(model_, state_, constants_, loads_.now(), {has_contacts_ ? contact_wrench_.data() : nullptr, loads_.rows()}, mine,
             force_.data());
  inertia_->gather(force_.data(), mine);
  if (team_.barrier().wait(thread, [this] { inertia_->solve(); })) inertia_->scatter(state_, mine, block_sums_);
}

void Solver::integrate(int thread, Range mine) {
  const double* contacts = !has_contacts_ ? nullptr : has_levels(state_.time) ? contact_kick_.data() : contact_wrench_.data();
  const BlockLevels& levels = contacts_.block_levels();
  const bool apart = has_levels(state_.time);
  const ExternalForces external{contacts,
                                loads_.rows(),
                                loads_.loaded_blocks(),
                                apart ? levels.since() : nullptr,
                                apart ? levels.next() : nullptr,
                                inertia_ != nullptr ? inertia_->rows() : nullptr};
  if (!sequential_)
    erbs::advance(model_, state_, constants_, loads_.now(), external, mine, sampling(), block_sums_, idle_, joints_.cracked().poses());
  else if (mine.first < mine.last) sequential_->sweep(loads_.now(), external, constants_, sampling(), joints_.sums().front(), block_sums_);
  if (has_contacts_) contacts_.track(thread, mine.first * pack_size, mine.last * pack_size);
}

// Blocks with prescribed motion. The reaction that moves them does external work on the system.
void Solver::apply_prescribed_motions() {
  const Model& m = model_;
  State& s = state_;
  if (m.prescribed_motions.empty()) return;
  Energy& e = s.energy;
  e.external_work += e.external_next;
  e.external_next = 0;
  for (int b = 0; b < m.nblock; ++b) {
    if (m.kind[z(b)] != Kind::driven) continue;
    const auto [to, at] = prescribed_pose(m, b, s.time.t + s.time.dt, s.pose.q[z(b)]);
    const Vec3 v = (to - s.pose.u[z(b)]) / s.time.dt, w = rotation_vector(at * s.pose.q[z(b)].conjugate()) / s.time.dt;
    const Vec6 wrench = kick_wrench(b);
    const Vec3 force = wrench.head<3>(), moment = wrench.tail<3>();
    const double before = -0.5 * s.time.last_dt * (force.dot(s.motion.v[z(b)]) + moment.dot(s.motion.w[z(b)])),
                 after = -0.5 * s.time.dt * (force.dot(v) + moment.dot(w));
    e.external_work += before;
    e.external_next += after;
    e.absolute_work += std::fabs(before) + std::fabs(after);
    s.motion.v[z(b)] = v;
    s.pose.u[z(b)] = to;
    s.motion.w[z(b)] = w;
    s.pose.q[z(b)] = at;
    set_pose_row(s, b);
    joints_.cracked().copy_pose(b);
    if (rotation_since(at, s.cache.ref_q[z(b)]).norm() > s.cache.lazy_rotation) block_sums_.front().outdated = true;
  }
}

// The expansion of intact joints about their reference poses errs in its third order, by the force of a joint. That is nothing beside what
// has moved, unless a structure sways little under a large load: then an elastic ledger asks for closer poses. Once something may open
// or close, its tolerance is a thousand times as large.
void Solver::refine_references() {
  constexpr double coarsest = 1e-4, finest = 1e-7;  // rad: beyond the first it is coarse on purpose
  constexpr double visible = 3e-8;                  // residual; an elastic ledger may have 1e-6, and half a wave later it would
  double& rotation = state_.cache.lazy_rotation;
  const double asked = model_.analysis.lazy_rotation, before = rotation;
  if (!closely_ || !ledger_.is_due() || asked > coarsest) return;
  if (joints_.any_cracked() || has_contacts_) rotation = asked;
  else if (state_.energy.residual_relative > visible) rotation = std::min(rotation, finest);
  if (rotation != before) note_sleep();
}

void Solver::close_step(const SamplePlan& plan) {
  State& s = state_;
  apply_prescribed_motions();
  lap(Phase::integrate);
  double& residual = s.observed.momentum_residual;
  if (sequential_) residual = std::max(residual, sequential_->momentum_residual());
  broken_ = broken_ || std::ranges::any_of(block_sums_, &BlockSums::broken);
  fading_.book(joints_.cracked());
  joints_.move_cracked(constants_);
  foresee_events();
  lap(Phase::joints);
  if (sampling()) {
    const double elastic = has_contacts_ ? contacts_.sums().elastic() : 0,
                 kinetic = has_contacts_ ? contacts_.sums().kinetic_correction() : 0;
    ledger_.close(joints_.sums(), joints_.cracked_sums(), block_sums_, elastic, kinetic, joints_.any_cracked() || has_contacts_);
    refine_references();
    joints_.store();
  }
  contacts_.former_joints().book_release();
  if (stop_ == Stop::sample) end_sample(plan.wrenches);
  joints_.drop_released();
  lap(Phase::ledger);
  s.time.t = s.time.start_t + double(s.time.step + 1 - s.time.start_step) * s.time.dt;
  ++s.time.step;
  s.time.last_dt = s.time.dt;
  if (at_macro_step(s.time)) {
    judge_step();
    plan_macro_step(plan);
    if (profile_.measured()) {
      const ContactBound& bound = contacts_.bound();
      profile_.note(limit(), s.time, bound.pairs(false), bound.pairs(true));
    }
    lap(Phase::contact);
  }
  if (++s.time.substep < s.time.substeps) return;
  ++s.time.macro;
  s.time.substep = 0;
  s.time.last_substeps = s.time.substeps;
  s.time.substeps = s.time.next_substeps;
  set_dt(s.time.next_dt);
}

void Solver::begin_sample() {
  sample_.t = state_.time.t;
  sample_.dt = state_.time.dt;
  sample_.last_dt = state_.time.last_dt;
  sample_.excitation = loads_.now();
  sample_.pose = state_.pose;
  sample_.before = state_.motion;
}

// While the wrenches of the sampled instant are still complete.
void Solver::end_sample(bool wrenches) {
  if (sequential_) std::swap(sequential_->wrench_before(), state_.cache.wrench);
  else check_momentum();
  sample_.block_wrench.clear(), sample_.load_wrench.clear(), sample_.kick_excess.clear(), sample_.since.clear();
  for (int b = 0; has_levels(state_.time) && b < model_.nblock; ++b) note_excess(b);
  for (int b = 0; wrenches && b < model_.nblock; ++b)
    sample_.block_wrench.push_back(block_wrench(b)), sample_.load_wrench.push_back(load_wrench(b));
  if (sequential_) std::swap(sequential_->wrench_before(), state_.cache.wrench);
}

// The impulses on block b in the kick of a sample with levels, beyond its forces times the kick; and the interval before them. Driven
// blocks and sleepers take no impulse.
void Solver::note_excess(int b) {
  if (model_.kind[z(b)] != Kind::moving || (state_.sleep.count > 0 && state_.sleep.asleep[z(b)] != 0)) {
    sample_.kick_excess.push_back(Vec6::Zero());
    sample_.since.push_back(state_.time.last_dt);
    return;
  }
  const BlockLevels& levels = contacts_.block_levels();
  Vec6 load = loads_.wrench(b);
  load.head<3>() += model_.mass[z(b)] * (loads_.now().gravity - loads_.now().ground);
  const double share = (levels.since()[b] + levels.next()[b]) / (2 * loads_.now().kick);
  sample_.kick_excess.push_back(kick_wrench(b) - block_wrench(b) + (share - 1) * load);
  sample_.since.push_back(levels.since()[b]);
}

// Joints and contacts conserve the momentum of all blocks, supports included: their forces and moments must sum to zero. Forces that do
// not change more than the last digits of any momentum, as a contact has them that just ends, are round-off and prove nothing. The measure
// of a moment is that of each force with its whole arm: of a force through the centre of the first block only round-off is left.
void Solver::check_momentum() {
  Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
  double forces = 0, moments = 0, momentum = 0, angular = 0;
  for (int b = 0; b < model_.nblock; ++b) {
    const Vec6 w = block_wrench(b);
    const Vec3 f = w.head<3>(), arm = model_.rest[z(b)] - model_.rest.front() + sample_.pose.u[z(b)], m = arm.cross(f) + w.tail<3>();
    force += f;
    moment += m;
    forces += f.norm();
    moments += arm.norm() * f.norm() + w.tail<3>().norm();
    if (model_.kind[z(b)] != Kind::moving) continue;
    const double moves = model_.mass[z(b)] * Vec3(state_.motion.v[z(b)]).norm();
    momentum += moves;
    angular += arm.norm() * moves + Vec3(state_.motion.spin_momentum[z(b)]).norm();
  }
  constexpr double digit = 1e3 * std::numeric_limits<double>::epsilon();
  const double kick = loads_.now().kick;
  double& worst = state_.observed.momentum_residual;
  if (forces * kick > digit * momentum) worst = std::max(worst, force.norm() / forces);
  if (moments * kick > digit * angular) worst = std::max(worst, moment.norm() / moments);
}

Vec6 Solver::block_wrench(int b) const {
  const Vec6 joints = joint_wrench(model_, state_, b);
  return contact_wrench_.empty() ? joints : Vec6(joints + Eigen::Map<const Vec6>(&contact_wrench_[8 * z(b)]));
}

Vec6 Solver::kick_wrench(int b) const {
  if (!has_levels(state_.time)) return block_wrench(b);
  const Vec6 joints = joint_wrench(model_, state_, b);
  return has_contacts_ ? Vec6(joints + Eigen::Map<const Vec6>(&contact_kick_[8 * z(b)])) : joints;
}

Vec6 Solver::load_wrench(int b) const { return model_.kind[z(b)] == Kind::driven ? Vec6(-block_wrench(b)) : loads_.wrench(b); }

}  // namespace erbs
