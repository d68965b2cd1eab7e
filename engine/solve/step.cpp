#include "engine/solve/step.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/joints/event_bound.h"
#include "engine/joints/kinematics.h"
#include "engine/joints/reference.h"
#include "engine/model/joint_packs.h"
#include "engine/solve/blocks/islands.h"
#include "engine/solve/energy.h"

namespace erbs {
namespace {

constexpr int ledger_every = 32;     // steps between two closings of the ledger, ...
constexpr int ledger_slowly = 128;   // ... with contacts, whose energy costs as much as their forces, ...
constexpr int ledger_seldom = 4096;  // ... in a scene without a ledger
constexpr int release_every = 8;     // steps between two searches for joints to release to contact
constexpr int find_soft_every = 64;  // steps between two searches for former joints that must soften, ...
constexpr int soften_every = 8;      // ... and between two steps of their softening
constexpr int activate_every = 256;  // steps between two searches for blocks that have moved far
std::size_t z(int i) { return std::size_t(i); }

int chunks(int n, int grain) { return std::max(1, (n + grain - 1) / grain); }

}  // namespace

Solver::Solver(const Model& model, State& state, int threads)
    : model_(model),
      state_(state),
      threads_(threads),
      reference_(model.analysis.kernel == "reference" || model.analysis.solver == "sequential"),
      joint_items_(model.analysis.solver == "sequential" ? 0
                   : reference_                          ? model.njoint
                   : owner_computes(model)               ? int(block_groups(model.nblock))
                                                         : intact_packs(model)),
      joint_grain_(owner_computes(model) ? IntactJoints::grain : pack_grain),
      cracked_(model, state),
      intact_(model, state),
      contacts_(model, state, threads) {
  if (state.dt_target == 0) state.dt_target = state.dt;
  forget_other_kernel(model, state);
  any_cracked_ = std::any_of(state.stage.begin(), state.stage.end(), [](JointStage t) { return t == JointStage::cracked; });
  note_sleep();
  if (!model.force_loads.empty()) load_.assign(constants_.size() * pack_size, 0.0);
  for (const auto& p : model.force_loads)
    if (model.kind[z(p.block)] == Kind::moving) loaded_.push_back({p.block, Mat3::Zero()});
  std::sort(loaded_.begin(), loaded_.end(), [](const LoadedBlock& a, const LoadedBlock& b) { return a.block < b.block; });
  loaded_.erase(std::unique(loaded_.begin(), loaded_.end(), [](const LoadedBlock& a, const LoadedBlock& b) { return a.block == b.block; }),
                loaded_.end());
  joint_sums_.resize(z(chunks(joint_items_, joint_grain_)));
  cracked_sums_.resize(z(chunks(cracked_.groups(), Cracked::grain)));
  block_sums_.resize(z(chunks(int(constants_.size()), block_grain)));
  if (model.analysis.solver == "sequential") {
    sequential_.emplace(model, state);
    block_sums_.resize(1 + loaded_.size());
  }
  // A stopped run may resume just after a block rotated too far, so the first step checks again. Without such a block nothing changes.
  block_sums_.front().outdated = true;
  stage_before_ = state.stage;
  double weight = 0, low = 1e300, high = -1e300;
  const Vec3 up = model.gravity.norm() > 0 ? Vec3(-model.gravity.normalized()) : Vec3::UnitZ();
  for (int b = 0; b < model.nblock; ++b) {
    if (model.kind[z(b)] != Kind::moving) continue;
    low = std::min(low, up.dot(model.rest[z(b)]) - 0.5 * model.smallest_edge[z(b)]);
    high = std::max(high, up.dot(model.rest[z(b)]) + 0.5 * model.smallest_edge[z(b)]);
    mass_ += model.mass[z(b)];
  }
  weight = mass_ * model.gravity.norm();
  high = std::max(high, low);
  floor_ = std::max(1e-300, 1e-12 * weight * (high - low));
  lift_ = 1e-3 * weight * (high - low);
  state.energy.reference = std::max(state.energy.reference, lift_);
}

void Solver::run(const Hooks& hooks) {
  Barrier barrier(threads_);
  stop_ = false;
  run_team(threads_, [&](int thread) {
    if (!barrier.wait(thread, [&] { prepare_step(hooks); })) return;
    while (!stop_) {
      forces(thread);
      if (!has_transitions_) barrier.wait(thread);
      else if (!barrier.wait(thread, [this] { transitions(); })) return;
      integrate(thread);
      const auto close_and_prepare = [&] {
        close_step(hooks);
        stop_ = broken_ || (sample_ != Sample::none && hooks.stop());
        if (!stop_) prepare_step(hooks);
      };
      if (!barrier.wait(thread, close_and_prepare)) return;
    }
  });
}

void Solver::prepare_step(const Hooks& hooks) {
  const Analysis& how = model_.analysis;
  ledger_steps_ = !how.ledger ? ledger_seldom : contacts_.active() ? ledger_slowly : ledger_every;
  sample_ = hooks.wanted(state_.t) ? Sample::full : state_.step % ledger_steps_ == 0 ? Sample::ledger : Sample::none;
  if (std::any_of(block_sums_.begin(), block_sums_.end(), [](const BlockSums& sums) { return sums.outdated; })) update_outdated();
  if (how.debris && state_.step % activate_every == 0 && (any_cracked_ || contacts_.active() || state_.step == 0))
    contacts_.activate_loose_blocks();
  has_contacts_ = contacts_.active();
  budget_ = event_budget(model_, state_);
  has_transitions_ = has_contacts_ || (how.debris && any_cracked_ && state_.step % release_every == 0);
  if (has_contacts_) contacts_.set_step(budget_, contact_interlock(model_, state_)), contacts_.prepare();
  if (has_contacts_ && contact_wrench_.empty()) contact_wrench_.assign(constants_.size() * pack_size, 0.0);
  excite();
  if (sample_ != Sample::full) return;
  sample_state_.t = state_.t;
  sample_state_.excitation = now_;
  sample_state_.v_before = state_.v;
  sample_state_.u = state_.u;
  sample_state_.q = state_.q;
  sample_state_.w_before = state_.w;
  sample_state_.spin_before = state_.spin_momentum;
}

void Solver::update_outdated() {
  for (BlockSums& sums : block_sums_) sums.outdated = false;
  if (!take_outdated_poses(model_, state_, outdated_)) return;
  if (sequential_) return sequential_->update_reference(outdated_);
  intact_.update_reference(outdated_);
}

// Loads over the interval of this kick: the second half of the last drift and the first half of the next.
void Solver::excite() {
  const Model& m = model_;
  State& s = state_;
  const double t0 = s.t - 0.5 * s.last_dt, t1 = s.t + 0.5 * s.dt;
  now_.kick = 0.5 * (s.last_dt + s.dt);
  now_.ground = Vec3::Zero();
  for (const auto& g : m.grounds) now_.ground += mean(g.wave, t0, t1) * g.direction;
  now_.gravity = m.gravity;
  for (const auto& tilt : m.tilts) now_.gravity = rotation(mean(tilt.wave, t0, t1) * tilt.axis) * now_.gravity;
  if (!m.tilts.empty()) {
    // U_g = -sum m g.u changes with g; that change is the work of tilting.
    Vec3 moment = Vec3::Zero();
    for (int b = 0; b < m.nblock; ++b)
      if (m.kind[z(b)] == Kind::moving) moment += m.mass[z(b)] * s.u[z(b)];
    const double work = s.step > 0 ? -(now_.gravity - s.gravity_before).dot(0.5 * (moment + s.moment_before)) : 0;
    s.energy.tilt_work += work;
    s.energy.absolute_work += std::fabs(work);
    s.gravity_before = now_.gravity;
    s.moment_before = moment;
  }
  for (const auto& p : m.force_loads) std::fill_n(&load_[8 * z(p.block)], 8, 0.0);
  for (const auto& p : m.force_loads) {
    const Vec3 f = mean(p.wave, t0, t1) * p.direction;
    const Vec3 moment = p.moment ? f : Vec3((s.q[z(p.block)] * p.arm).cross(f));
    for (int k = 0; k < 3; ++k) {
      if (!p.moment) load_[8 * z(p.block) + z(k)] += f[k];
      load_[8 * z(p.block) + 3 + z(k)] += moment[k];
    }
  }
}

void Solver::forces(int thread) {
  const Range mine = slice(joint_items_, joint_grain_, thread, threads_);
  if (has_contacts_) contacts_.forces(thread, sample_ != Sample::none);
  if (owner_computes(model_)) intact_.forces(mine, sample_ != Sample::none, joint_sums_);
  else
    for (int first = mine.first; first < mine.last; first += pack_grain) {
      const int last = std::min(first + pack_grain, mine.last);
      JointSums& sums = joint_sums_[z(first / pack_grain)];
      if (reference_) reference_forces(model_, state_, first, last, sample_ != Sample::none, sums);
      else damped_joint_forces(model_, state_, intact_.damped(), first, last, sample_ != Sample::none, sums);
    }
  const Range broken = slice(cracked_.groups(), Cracked::grain, thread, threads_);
  for (int first = broken.first; first < broken.last; first += Cracked::grain)
    cracked_.forces(first, std::min(first + Cracked::grain, broken.last), sample_ != Sample::none, budget_,
                    cracked_sums_[z(first / Cracked::grain)]);
}

// Between forces and drift, on one thread: contact forces are gathered, and joints beyond their range are released to contact.
void Solver::transitions() {
  if (has_contacts_) contacts_.gather(contact_wrench_.data(), sample_ != Sample::none);
  if (state_.step == 0 && has_contacts_ && contacts_.allowed_dt() < state_.dt) {  // contacts present at the start limit the first drift
    adapt_time_step();
    excite();
  }
  const double softened = event_tolerance * state_.energy.reference;
  if (has_contacts_ && state_.step % find_soft_every == 0) contacts_.find_softening(softened);
  else if (has_contacts_ && state_.step % soften_every == 0) contacts_.soften_former_joints(softened);
  if (has_contacts_ && contacts_.sleep(now_, contact_wrench_.data())) note_sleep();
  if (!model_.analysis.debris || !any_cracked_ || state_.step % release_every != 0) return;
  const std::vector<int> released = contacts_.release_joints(cracked_);
  if (released.empty()) return;
  released_.insert(released_.end(), released.begin(), released.end());
  leaving_ = released;
  find_islands(model_, state_);
  note_sleep();
  contacts_.activate_loose_blocks();
}

// Updates the block constants (sleeping blocks do not move) and the groups of blocks that a step may skip.
void Solver::note_sleep() {
  constants_ = block_constants(model_, state_);
  idle_ = idle_groups(model_, state_);
}

void Solver::integrate(int thread) {
  const ExternalForces external{has_contacts_ ? contact_wrench_.data() : nullptr, load_.data(), loaded_};
  const int groups = int(constants_.size()), grain = sequential_ ? groups : block_grain;  // a sweep runs on one thread
  const Range mine = slice(groups, grain, thread, threads_);
  if (!sequential_)
    advance(model_, state_, constants_, now_, external, mine, sample_ != Sample::none, block_sums_, idle_, cracked_.poses());
  else if (mine.first < mine.last)
    sequential_->sweep(now_, external, constants_, sample_ != Sample::none, joint_sums_.front(), block_sums_);
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
    Vec3 to = Vec3::Zero();
    Quat at = Quat::Identity();
    bool rotates = false;
    for (const auto& d : m.prescribed_motions) {
      if (d.block != b) continue;
      const double x = value(d.wave, s.t + s.dt);
      if (!d.rotates) {
        to += x * d.direction;
        continue;
      }
      const Quat angle = rotation(x * d.direction);
      to += angle * d.arm - d.arm;
      at = angle * at;
      rotates = true;
    }
    if (!rotates) at = s.q[z(b)];  // no prescribed rotation: the attitude stays
    const Vec3 v = (to - s.u[z(b)]) / s.dt, w = rotation_vector(at * s.q[z(b)].conjugate()) / s.dt;
    const Vec6 wrench = block_wrench(b);
    const Vec3 force = wrench.head<3>(), moment = wrench.tail<3>();
    const double before = -0.5 * s.last_dt * (force.dot(s.v[z(b)]) + moment.dot(s.w[z(b)])),
                 after = -0.5 * s.dt * (force.dot(v) + moment.dot(w));
    e.external_work += before;
    e.external_next += after;
    e.absolute_work += std::fabs(before) + std::fabs(after);
    s.v[z(b)] = v;
    s.u[z(b)] = to;
    s.w[z(b)] = w;
    s.q[z(b)] = at;
    set_pose_row(s, b);
    cracked_.copy_pose(b);
    if (rotation_since(at, s.ref_q[z(b)]).norm() > m.analysis.lazy_rotation) block_sums_.front().outdated = true;
  }
}

void Solver::close_step(const Hooks& hooks) {
  State& s = state_;
  apply_prescribed_motions();
  if (sequential_) s.momentum_residual = std::max(s.momentum_residual, sequential_->momentum_residual());
  for (const BlockSums& sums : block_sums_) broken_ = broken_ || sums.broken;
  note_cracks();
  foresee_events();
  if (sample_ != Sample::none) {
    settle_ledger();
    cracked_.store();
  }
  contacts_.book_release();
  if (sample_ == Sample::full) {
    std::swap(sample_state_.u, s.u);
    std::swap(sample_state_.q, s.q);
    if (sequential_) std::swap(sequential_->wrench_before(), s.wrench);
    else check_momentum();
    hooks.sampled();
    if (sequential_) std::swap(sequential_->wrench_before(), s.wrench);
    std::swap(sample_state_.u, s.u);
    std::swap(sample_state_.q, s.q);
  }
  for (const int j : leaving_) cracked_.drop(j);  // not earlier: the sample needs their forces
  leaving_.clear();
  s.t = s.start_t + double(s.step + 1 - s.start_step) * s.dt;
  ++s.step;
  s.last_dt = s.dt;
  judge_step();
  adapt_time_step();
}

// Joints and contacts conserve the momentum of all blocks, supports included: their forces and moments must sum to zero.
void Solver::check_momentum() {
  Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
  double forces = 0, moments = 0;
  for (int b = 0; b < model_.nblock; ++b) {
    const Vec6 w = block_wrench(b);
    const Vec3 f = w.head<3>(), arm = model_.rest[z(b)] - model_.rest.front() + state_.u[z(b)], m = arm.cross(f) + w.tail<3>();
    force += f;
    moment += m;
    forces += f.norm();
    moments += m.norm();
  }
  double& worst = state_.momentum_residual;
  if (forces > 0) worst = std::max(worst, force.norm() / forces);
  if (moments > 0) worst = std::max(worst, moment.norm() / moments);
}

// Joints change their lanes here, when all forces of the step are complete.
void Solver::note_cracks() {
  bool cracked = false;
  for (JointSums& sums : joint_sums_) {
    cracked = cracked || sums.cracked_now > 0;
    sums.cracked_now = 0;
  }
  if (!cracked) return;
  any_cracked_ = true;
  for (int j = 0; j < model_.njoint; ++j) {
    if (stage_before_[z(j)] == state_.stage[z(j)]) continue;
    if (!reference_ && state_.stage[z(j)] == JointStage::cracked) cracked_.take(j), intact_.leave(j);
    if (stage_before_[z(j)] == JointStage::intact) newly_cracked_.push_back(j);
    for (const int b : {model_.joint[z(j)].a, model_.joint[z(j)].b}) use_wrench_rows(model_, state_, b, constants_);
    stage_before_[z(j)] = state_.stage[z(j)];
  }
  set_rotation_limits(model_, state_, constants_);
  cracked_sums_.resize(z(chunks(cracked_.groups(), Cracked::grain)));
}

void Solver::settle_ledger() {
  Energy& e = state_.energy;
  const double gravity_before = e.gravity;
  e.kinetic = e.gravity = e.elastic = 0;
  int worst = -1;
  double error = 0;
  const auto add = [&](JointSums& sums) {
    e.elastic += sums.energy.elastic;
    e.friction += sums.energy.friction;
    e.fracture += sums.energy.fracture;
    e.crushing += sums.energy.crushing;
    e.damping += sums.energy.damping;
    if (sums.largest_error > error) error = sums.largest_error, worst = sums.worst_joint;
    sums = JointSums{};
  };
  for (JointSums& sums : joint_sums_) add(sums);
  for (JointSums& sums : cracked_sums_) add(sums);
  e.base_work += e.base_next;
  e.damping += e.damping_next;
  e.absolute_work += e.absolute_next;
  e.base_next = e.damping_next = e.absolute_next = 0;
  if (model_.prescribed_motions.empty()) {
    e.external_work += e.external_next;
    e.external_next = 0;
  }
  for (BlockSums& sums : block_sums_) {
    const BlockWork& w = sums.work;
    for (int l = 0; l < pack_size; ++l) {
      e.kinetic += w.kinetic[l];
      e.gravity += w.height[l];
      e.base_work += w.base[l];
      e.damping += w.damping[l];
      e.absolute_work += w.absolute[l];
      e.base_next += w.base_after[l];
      e.damping_next += w.damping_after[l];
      e.absolute_next += w.absolute_after[l];
    }
    e.external_work += sums.external_work;
    e.absolute_work += sums.external_absolute;
    e.external_next += sums.external_after;
    e.absolute_next += sums.external_absolute_after;
    const bool outdated = sums.outdated, broken = sums.broken;
    sums = BlockSums{};
    sums.outdated = outdated;
    sums.broken = broken;
  }
  if (has_contacts_) e.elastic += contacts_.elastic();
  if (e.started) e.height_flux += std::fabs(e.gravity - gravity_before);
  // The structure's own measure counts once something may open or close, or has changed the step: until then all is exact.
  settle(e, any_cracked_ || has_contacts_ || state_.start_step > 0 ? std::max(floor_, lift_) : floor_, state_.t, worst);
  if (state_.step % ledger_steps_ != 0) return;
  const double loss = e.friction + e.fracture + e.crushing + e.damping + e.contact_damping;
  e.reference = std::max(e.reference, std::fabs(e.kinetic) + std::fabs(e.elastic - e.elastic_at_start) + std::max(0.0, loss));
  e.event_residual = e.residual;
}

Vec6 Solver::block_wrench(int b) const {
  const Vec6 joints = joint_wrench(model_, state_, b);
  return contact_wrench_.empty() ? joints : Vec6(joints + Eigen::Map<const Vec6>(&contact_wrench_[8 * z(b)]));
}

Vec6 Solver::load_wrench(int b) const {
  if (model_.kind[z(b)] == Kind::driven) return -block_wrench(b);
  return load_.empty() ? Vec6(Vec6::Zero()) : Vec6(Eigen::Map<const Vec6>(&load_[8 * z(b)]));
}

std::vector<int> Solver::take_released() { return std::exchange(released_, {}); }

std::vector<int> Solver::take_cracked() { return std::exchange(newly_cracked_, {}); }

}  // namespace erbs
