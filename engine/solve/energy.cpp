#include "engine/solve/energy.h"

#include <algorithm>
#include <cmath>

#include "engine/joints/event_bound.h"
#include "engine/model/levels.h"
#include "engine/solve/blocks/prescribed.h"

namespace erbs {
namespace {

constexpr int ledger_every = 32;     // steps between two closings of the ledger, ...
constexpr int ledger_slowly = 128;   // ... with contacts, ...
constexpr int ledger_seldom = 4096;  // ... in a scene without a ledger
constexpr double lift = 1e-3;        // of its height, by which a structure is lifted for its own measure of energy
constexpr int samples = 1000;        // of a load over the duration

// J, of all moving blocks at the greatest speed of a point that moves with a driven block, as far from it as the farthest of them: the
// measure of a structure without weight, which driven blocks set in motion.
double driven_energy(const Model& model, double mass) {
  const double h = model.analysis.duration / samples;
  double fastest = 0;
  for (const Model::PrescribedMotion& motion : model.prescribed_motions) {
    double arm = 0;
    for (std::size_t b = 0; b < model.kind.size(); ++b)
      if (model.kind[b] == Kind::moving) arm = std::max(arm, (model.rest[b] - model.rest[std::size_t(motion.block)]).norm());
    PrescribedPose from = prescribed_pose(model, motion.block, 0, Quat::Identity());
    for (int i = 1; i <= samples; ++i) {
      const PrescribedPose to = prescribed_pose(model, motion.block, i * h, Quat::Identity());
      fastest = std::max(fastest, ((to.u - from.u).norm() + arm * from.q.angularDistance(to.q)) / h);
      from = to;
    }
  }
  return 0.5 * mass * fastest * fastest;
}

// J, of the forces on a structure without weight at their greatest, over `height` (m), as of a weight. A moment counts as it is.
double loaded_energy(const Model& model, double height) {
  double sum = 0;
  for (const Model::ForceLoad& load : model.force_loads) {
    double most = 0;
    for (int i = 0; i <= samples; ++i) most = std::max(most, std::fabs(value(load.wave, i * model.analysis.duration / samples)));
    sum += most * (load.moment ? 1 : height);
  }
  return lift * sum;
}

}  // namespace

double dissipated(const Energy& e) { return e.friction + e.fracture + e.crushing + e.damping + e.contact_damping + e.reset + e.sleep; }

double worked(const Energy& e) { return e.base_work + e.external_work + e.tilt_work; }

void settle(Energy& e, double floor, double t, int worst_joint) {
  const double stored = e.kinetic + e.gravity + e.elastic;
  if (!e.started) {
    e.started = true;
    e.start = stored - worked(e) + dissipated(e);
    e.elastic_at_start = e.elastic;
  }
  const double before = e.residual;
  e.residual = stored - e.start + dissipated(e) - worked(e);
  e.largest_moving = std::max(e.largest_moving, std::fabs(e.kinetic) + std::fabs(e.elastic - e.elastic_at_start));
  const double loss = std::fabs(e.friction) + std::fabs(e.fracture) + std::fabs(e.crushing) + std::fabs(e.damping) +
                      std::fabs(e.contact_damping) + std::fabs(e.reset) + std::fabs(e.sleep);
  // Elastic energy at the start is the only scale of a stressed structure at rest without gravity. Its round-off is some 1e-16 of it, a few
  // times that in sums over many joints; a floor of 1e-8 puts this below the elastic tolerance of 1e-6. Kinetic energy at the start is
  // already part of `largest_moving`.
  floor = std::max(floor, 1e-8 * std::fabs(e.elastic_at_start));
  const double scale = std::max(floor, e.largest_moving + e.absolute_work + loss + 0.5 * e.height_flux);
  e.residual_relative = std::fabs(e.residual) / scale;
  e.residual_worst = std::max(e.residual_worst, e.residual_relative);
  const double jump = std::fabs(e.residual - before);
  if (jump > e.largest_jump) {
    e.largest_jump = jump;
    e.largest_jump_time = t;
    e.largest_jump_joint = worst_joint;
  }
}

Ledger::Ledger(const Model& model, State& state) : model_(model), state_(state) {
  double low = 1e300, high = -1e300, kinetic = 0;  // J, of the blocks that a scene throws
  const Vec3 up = model.gravity.norm() > 0 ? Vec3(-model.gravity.normalized()) : Vec3::UnitZ();
  for (std::size_t b = 0; b < model.kind.size(); ++b) {
    if (model.kind[b] != Kind::moving) continue;
    low = std::min(low, up.dot(model.rest[b]) - 0.5 * model.smallest_edge[b]);
    high = std::max(high, up.dot(model.rest[b]) + 0.5 * model.smallest_edge[b]);
    mass_ += model.mass[b];
    kinetic += 0.5 * model.mass[b] * Vec3(state.motion.v[b]).squaredNorm();
  }
  const double weight = mass_ * model.gravity.norm();
  high = std::max(high, low);
  floor_ = std::max(1e-300, 1e-12 * weight * (high - low));
  lift_ = weight > 0 ? lift * weight * (high - low) : std::max(driven_energy(model, mass_), loaded_energy(model, high - low));
  state.energy.reference = std::max({state.energy.reference, lift_, state.time.step == 0 ? kinetic : 0});
}

bool Ledger::due(bool contacts) {
  const int every = !model_.analysis.ledger ? ledger_seldom : contacts ? ledger_slowly : ledger_every;
  const TimeStep& time = state_.time;
  return due_ = at_macro_step(time) && time.macro % std::max(1, every / time.substeps) == 0;
}

void Ledger::add(const BlockSums& sums) {
  Energy& e = state_.energy;
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
}

void Ledger::close(std::span<JointSums> joints, std::span<JointSums> cracked, std::span<BlockSums> blocks, double elastic, double kinetic,
                   bool events) {
  Energy& e = state_.energy;
  const double gravity_before = e.gravity;
  e.kinetic = e.gravity = e.elastic = 0;
  int worst = -1;
  double error = 0;
  for (const std::span<JointSums> all : {joints, cracked})
    for (JointSums& sums : all) {
      e.elastic += sums.energy.elastic;
      e.friction += sums.energy.friction;
      e.fracture += sums.energy.fracture;
      e.crushing += sums.energy.crushing;
      e.damping += sums.energy.damping;
      if (sums.largest_error > error) error = sums.largest_error, worst = sums.worst_joint;
      sums = JointSums{};
    }
  e.base_work += e.base_next;
  e.damping += e.damping_next;
  e.absolute_work += e.absolute_next;
  e.base_next = e.damping_next = e.absolute_next = 0;
  if (model_.prescribed_motions.empty()) {
    e.external_work += e.external_next;
    e.external_next = 0;
  }
  for (BlockSums& sums : blocks) {
    add(sums);
    const bool outdated = sums.outdated, broken = sums.broken;
    sums = BlockSums{};
    sums.outdated = outdated;
    sums.broken = broken;
  }
  e.elastic += elastic;
  e.kinetic += kinetic;
  if (e.started) e.height_flux += std::fabs(e.gravity - gravity_before);
  // The structure's own measure counts once something may open or close, or has changed the step: until then all is exact.
  const double residual_before = e.residual;
  settle(e, events || state_.time.start_step > 0 ? std::max(floor_, lift_) : floor_, state_.time.t, worst);
  // Closings at the rows of a run add up to the same.
  const bool many = has_many_events(model_, state_);
  if (many) e.event_residual = (due_ ? recent_share : 1) * (e.event_residual + (e.residual - residual_before));
  if (!due_) return;
  const double loss = e.friction + e.fracture + e.crushing + e.damping + e.contact_damping;
  e.reference = std::max(e.reference, std::fabs(e.kinetic) + std::fabs(e.elastic - e.elastic_at_start) + std::max(0.0, loss));
  if (!many) e.event_residual = e.residual;
}

}  // namespace erbs
