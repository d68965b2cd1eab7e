#include "engine/analysis/joint_events.h"

#include <algorithm>
#include <cmath>

#include "engine/base/count.h"
#include "engine/joints/kinematics.h"

namespace erbs::analysis {
namespace {

// One row for the energy lost by softening of former joints and by separation of contacts.
void write_rest(JointEvents& events, double t, const Energy& energy, RunWriter& writer) {
  double rest = energy.reset - events.listed;
  for (const JointRelease& h : events.releases_since) rest -= h.energy;
  if (!(std::fabs(rest) > 1e-15 * energy.reference)) return;
  writer.event(t, "soften", "beds and contacts", rest, "J");
  events.listed += rest;
}

// Rows for the energy freed by release of joints to contact.
void write_releases(JointEvents& events, double t, const Model& model, const Energy& energy, RunWriter& writer) {
  if (!events.releases_since.empty()) write_rest(events, t, energy, writer);
  for (const JointRelease& h : events.releases_since) {
    writer.event(t, "hand over", model.joint_name(h.joint), h.energy, "J");
    events.listed += h.energy;
  }
  events.releases_since.clear();
}

}  // namespace

void take_events(JointEvents& events, Solver& solver) {
  const std::vector<int> cracked = solver.take_cracked(), released = solver.take_released();
  const std::vector<JointRelease> releases = solver.contacts().former_joints().take_releases();
  events.cracked_since.insert(events.cracked_since.end(), cracked.begin(), cracked.end());
  events.released_since.insert(events.released_since.end(), released.begin(), released.end());
  events.releases_since.insert(events.releases_since.end(), releases.begin(), releases.end());
}

void write_events(JointEvents& events, const Snapshot& now, RunWriter& writer) {
  const Model& model = now.model;
  std::sort(events.cracked_since.begin(), events.cracked_since.end());
  for (const int j : events.cracked_since) {
    if (!model.laws[z(model.joint[z(j)].type->law)].has_bond()) continue;
    if (events.first_crack < 0) events.first_crack = now.t;
    writer.event(now.t, "crack", model.joint_name(j), joint_damage(model, now.joints, j), "share");
  }
  for (const int j : events.released_since) {
    ++events.released;
    writer.event(now.t, "open", model.joint_name(j), joint_condition(model, now.joints, now.pose, j).opening, "m");
  }
  events.cracked_since.clear();
  events.released_since.clear();
  write_releases(events, now.t, model, now.energy, writer);
}

void write_last_events(JointEvents& events, double t, const Model& model, const Energy& energy, RunWriter& writer) {
  write_releases(events, t, model, energy, writer);
  write_rest(events, t, energy, writer);
}

}  // namespace erbs::analysis
