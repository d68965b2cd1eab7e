#include "engine/solve/jolts.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/base/count.h"
#include "engine/joints/event_bound.h"
#include "engine/joints/kinematics.h"
#include "engine/laws/yield.h"
#include "engine/model/levels.h"

namespace erbs {
namespace {

constexpr int ahead = foresee_every + 2;  // steps: one that is about to be planned and those until the next prediction
constexpr int first_steps = 2 * ahead;    // in which blocks at rest need not touch yet what bears them
// A leap of a motion is a jump of its place: its speed grows as the step shrinks, which would have no end. A blow that errs by a thousandth
// of its own energy asks for a tenth of the step at rest, one of many blocks for less.
constexpr double most_shortened = 64;

// Force of a joint under a jump of speed over that of one block on it alone: what stands on that block pushes as well.
constexpr double amplified = 2;

using Gains = std::array<double, ahead + 1>;  // of speed, as a load gives it in each step from the last one on

// Greatest gain within two steps beyond what the load gives all the time.
double jump_of(const Gains& gain) {
  double most = 0;
  for (std::size_t i = 0; i + 1 < gain.size(); ++i) most = std::max(most, std::fabs(gain[i] + gain[i + 1] - 2 * gain[0]));
  return most;
}

// Of a wave that is an acceleration or a force: its mean in each step from before `t` on, times the step.
double jump_of_impulse(const Wave& wave, double t, double dt) {
  Gains gain;
  for (std::size_t i = 0; i < gain.size(); ++i) gain[i] = dt * mean(wave, t + (double(i) - 1) * dt, t + double(i) * dt);
  return jump_of(gain);
}

// Of a wave that is a displacement or an angle.
double jump_of_path(const Wave& wave, double t, double dt) {
  std::array<double, ahead + 3> x;
  for (std::size_t i = 0; i < x.size(); ++i) x[i] = value(wave, t + (double(i) - 2) * dt);
  Gains gain;
  for (std::size_t i = 0; i < gain.size(); ++i) gain[i] = (x[i + 2] - 2 * x[i + 1] + x[i]) / dt;
  return jump_of(gain);
}

// m, of the farthest point of a block from its centroid.
double reach_of(const Model& m, int b) {
  double reach = 0;
  for (const Polyhedron& part : m.parts[z(b)])
    for (const Vec3& corner : part.vertices) reach = std::max(reach, (corner - m.rest[z(b)]).norm());
  return reach;
}

// m2, of a face about as large as any of a block.
double face_of(const Model& m, int b) {
  const double thin = m.smallest_edge[z(b)], mass = m.mass[z(b)];
  return m.kind[z(b)] == Kind::moving ? mass / (m.materials[z(m.material[z(b)])].density * thin) : 1e300;
}

// 1/kg, the sum of two inverse masses; a driven block has no mass.
double lightness(const Model& m, int a, int b) { return m.inverse_mass[z(a)] + m.inverse_mass[z(b)]; }

// False if the bond of an intact joint bears a jump (m/s) of its blocks against each other. It then stays elastic, and a change of the step
// would err by more than it saves.
bool may_open(const Model& m, const State& s, int j, double jump) {
  const JointType& type = *m.joint[z(j)].type;
  const PointLaw& law = m.laws[z(type.law)];
  const double light = lightness(m, m.joint[z(j)].a, m.joint[z(j)].b);
  if (s.joints.stage[z(j)] != JointStage::intact || !law.has_bond() || !(light > 0)) return light > 0;
  double gap[6];
  joint_gap(m, s, j, gap);
  const double bend = std::fabs(gap[3]) * type.half_t + std::fabs(gap[4]) * type.half_s;
  const double swing = amplified * jump / std::sqrt(light);  // m sqrt(N/m)
  const double opens = swing / std::sqrt(type.stiffness[2]), slips = swing / std::sqrt(type.stiffness[0]);
  return scalar::yield_bound(scalar::yield_limits(law), gap[2] + bend + opens, bend - gap[2] + opens, gap[0] * gap[0] + gap[1] * gap[1],
                             std::fabs(gap[5]) * type.radius + slips) > 0;
}

}  // namespace

double jolt_rate(const Model& m, const State& s, double budget, double share) {
  if (m.prescribed_motions.empty() && m.grounds.empty() && m.force_loads.empty()) return 0;
  constexpr double least = 1e-6;  // m/s
  const double t = s.time.t, dt = std::max(macro_dt(s.time), s.time.last_dt), slow = ContactSettings{}.reference_speed;
  double shaken = 0;
  std::vector<double> jolted;  // m/s [nblock]; empty: none is
  const auto note = [&](int b, double jump) {
    if (!(jump > least)) return;
    jolted.resize(z(m.nblock));
    jolted[z(b)] += jump;
  };
  for (const auto& ground : m.grounds) shaken += jump_of_impulse(ground.wave, t, dt);
  for (const auto& motion : m.prescribed_motions)
    if (const double jump = jump_of_path(motion.wave, t, dt); jump > 0)
      note(motion.block, motion.rotates ? jump * (motion.arm.norm() + reach_of(m, motion.block)) : jump);
  for (const auto& load : m.force_loads) {
    const double impulse = jump_of_impulse(load.wave, t, dt), by_mass = m.inverse_mass[z(load.block)];
    note(load.block, impulse * (load.moment ? std::sqrt(m.inverse_inertia[z(load.block)].trace() * by_mass) : by_mass));
  }
  if (!(shaken > least) && jolted.empty()) return 0;
  double rate = 0;
  const auto speed = [&](int a, int b) {
    const double shakes = (m.kind[z(a)] == Kind::moving) != (m.kind[z(b)] == Kind::moving) ? shaken : 0;
    return shakes + (jolted.empty() ? 0 : jolted[z(a)] + jolted[z(b)]);
  };
  const auto count = [&](int a, int b, double k) {
    const double light = lightness(m, a, b), jump = speed(a, b);
    if (!(jump > least) || !(light > 0)) return;
    const double errs = jump > slow ? std::min(budget, share * 0.5 * jump * jump / light) : budget;
    rate = std::max(rate, jump * std::sqrt(event_share * k / errs));
  };
  for (const ContactPair& p : s.contacts.list.pair)
    if (p.touching) count(p.a, p.b, p.law.kn * p.area);
    else if (s.time.step < first_steps) count(p.a, p.b, p.law.kn * std::min(face_of(m, p.a), face_of(m, p.b)));
  for (int j = 0; j < m.njoint; ++j)
    if (const Joint& joint = m.joint[z(j)]; s.joints.stage[z(j)] != JointStage::contact) {
      const double jump = speed(joint.a, joint.b);
      if (jump > least && may_open(m, s, j, jump)) count(joint.a, joint.b, joint.type->stiffness[2]);
    }
  return std::min(rate, most_shortened / std::max(s.time.dt_target, s.time.dt));
}

}  // namespace erbs
