#include "engine/solve/jolts.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/base/count.h"
#include "engine/joints/event_bound.h"
#include "engine/model/levels.h"
#include "engine/solve/blocks/prescribed.h"

namespace erbs {
namespace {

constexpr int ahead = foresee_every + 2;  // steps: one that is about to be planned and those until the next prediction

// Change of speed within two steps, as a load gives it in each step from the last one on.
using Gains = std::array<Vec3, ahead + 1>;  // m/s

// Greatest speed within two steps beyond what the load gives all the time.
double jump_of(const Gains& gain) {
  double most = 0;
  for (std::size_t i = 0; i + 1 < gain.size(); ++i) most = std::max(most, (gain[i] + gain[i + 1] - 2 * gain[0]).norm());
  return most;
}

// A wave that acts from `t` on in steps of `dt`: its mean in each, times `dt`.
Gains gains_of(const Wave& wave, const Vec3& direction, double t, double dt) {
  Gains out;
  for (std::size_t i = 0; i < out.size(); ++i) {
    const double from = t + (double(i) - 1) * dt;
    out[i] = dt * mean(wave, from, from + dt) * direction;
  }
  return out;
}

// m/s, by which a driven block jolts what touches it: its own way in each step, with that of its farthest point by rotation.
double jump_of_motion(const Model& m, int b, double t, double dt) {
  std::array<PrescribedPose, ahead + 4> pose;
  for (std::size_t i = 0; i < pose.size(); ++i) pose[i] = prescribed_pose(m, b, t + (double(i) - 2) * dt, Quat::Identity());
  double reach = 0;
  for (const Polyhedron& part : m.parts[z(b)])
    for (const Vec3& corner : part.vertices) reach = std::max(reach, corner.norm());
  Gains way, angle;
  const auto rotated = [&](std::size_t i) {  // rad, small
    const Quat q = pose[i + 1].q * pose[i].q.conjugate();
    return Vec3((q.w() < 0 ? -2 : 2) * q.vec());
  };
  for (std::size_t i = 0; i < way.size(); ++i) {
    way[i] = (pose[i + 2].u - 2 * pose[i + 1].u + pose[i].u) / dt;
    angle[i] = reach / dt * (rotated(i + 1) - rotated(i));
  }
  return jump_of(way) + jump_of(angle);
}

}  // namespace

double jolt_rate(const Model& m, const State& s, double budget, double share) {
  if (m.prescribed_motions.empty() && m.grounds.empty() && m.force_loads.empty()) return 0;
  constexpr double least = 1e-6;  // m/s
  const double t = s.time.t, dt = std::max(macro_dt(s.time), s.time.last_dt), slow = ContactSettings{}.reference_speed;
  double shaken = 0;
  std::vector<std::pair<int, double>> jolted;  // blocks and their jumps
  const auto note = [&](int b, double jump) {
    if (jump > least) jolted.emplace_back(b, jump);
  };
  for (const auto& ground : m.grounds) shaken += jump_of(gains_of(ground.wave, ground.direction, t, dt));
  for (const auto& motion : m.prescribed_motions) note(motion.block, jump_of_motion(m, motion.block, t, dt));
  for (const auto& load : m.force_loads) {
    const double force = jump_of(gains_of(load.wave, load.direction, t, dt)), by_mass = m.inverse_mass[z(load.block)],
                 spread = m.inverse_inertia[z(load.block)].trace();
    note(load.block, load.moment ? force * std::sqrt(spread * by_mass) : force * by_mass);
  }
  if (!(shaken > least) && jolted.empty()) return 0;
  double rate = 0;
  const auto bear = [&](int a, int b, double k) {
    const double light = m.inverse_mass[z(a)] + m.inverse_mass[z(b)];  // 1/kg; a driven block has no mass
    double speed = (m.kind[z(a)] == Kind::moving) != (m.kind[z(b)] == Kind::moving) ? shaken : 0;
    for (const auto& [block, jump] : jolted) speed += block == a || block == b ? jump : 0;
    if (!(speed > least) || !(light > 0)) return;
    const double errs = speed > slow ? std::min(budget, share * 0.5 * speed * speed / light) : budget;
    rate = std::max(rate, speed * std::sqrt(event_share * k / errs));
  };
  for (const ContactPair& p : s.contacts.list.pair)
    if (p.touching) bear(p.a, p.b, p.law.kn * p.area);
  for (int j = 0; j < m.njoint && m.njoint <= few_joints; ++j) {
    const Joint& joint = m.joint[z(j)];
    const bool bond = s.joints.stage[z(j)] == JointStage::intact && m.laws[z(joint.type->law)].has_bond();
    if (s.joints.stage[z(j)] != JointStage::contact && !bond) bear(joint.a, joint.b, joint.type->stiffness[2]);
  }
  return rate;
}

}  // namespace erbs
