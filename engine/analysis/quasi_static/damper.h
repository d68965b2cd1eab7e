// What brakes a relaxation on its way to equilibrium.
#pragma once
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "engine/base/count.h"
#include "engine/base/units.h"
#include "engine/model/model.h"
#include "engine/model/state.h"
#include "engine/solve/step.h"

namespace erbs::analysis {

inline constexpr double local_share = 0.8;
// Of critical damping: least shares of that of the elastic structure, since next to its capacity a stack on hinges swings thousands of
// times as slowly, and while it cracks; share of the way to it, in a reading.
inline constexpr double least_share = 1e-4, cracking_share = 0.01, follows = 0.3;
// Beside kinetic and critical damping, with a coarse inertia or once a relaxation takes longer than this many periods. Cracks leave short
// waves that fill the whole structure at random phases: its kinetic energy has no peaks then, and they would never be braked. The step is
// short enough for it: 0.9 sqrt(1.1) < 1.
inline constexpr double local_share_beside = 0.1, patience = 10;

// Damping on the way to equilibrium, by name.
// critical: mass damping of twice the circular frequency w; while the load grows, that of the elastic structure with its loading machine,
//   then that of the present motion. Rayleigh's quotient of what moved since the last reading gives it (Underwood 1983, Dynamic
//   relaxation): w^2 = -du . M da / du . M du, a the accelerations of the unbalanced forces and of the coarse inertia. The coefficient goes
//   a third of the way there, on a scale of ratios. Where cracks release more than the motion stores, w^2 is negative, and the coefficient
//   falls to the share of cracking; what still moves after `patience` periods is slower than they are long, and it falls on as 1 / t.
// kinetic: velocities vanish at each peak of the kinetic energy (Cundall 1976; Barnes 1988).
// Beside both acts a local force of a tenth, with a coarse inertia or where the rest does not lead to equilibrium soon.
// adaptive: mass damping whose power is held near half the rate of change of the kinetic energy (Cundall 1982, "adaptive global damping").
//   Here the coefficient changes by a tenth where the ratio is off.
// local: a force of 0.8 times the unbalanced one against the motion (Cundall 1987), with a shorter step.
class Damper {
 public:
  // `faster`: by how much the loading machine raises the frequency. `swing`: 1/s, of the structure on the machine alone.
  Damper(const std::string& name, double period, double faster, double swing, bool at_once, const std::vector<std::uint8_t>& fell,
         Model& model)
      : model_(model),
        fell_(fell),
        period_(period),
        most_(4 * pi / period * faster),
        least_(std::min(std::max(least_share * most_, 2 * swing), most_)),
        patience_(at_once ? 0 : patience * period),
        adaptive_(name == "adaptive"),
        kinetic_(name == "kinetic"),
        critical_(name == "critical") {
    model.damping_all = true, model.damping_explicit = false;
    model.damping.mass = critical_ ? most_ : adaptive_ ? 0.3 * most_ : 0;
    model.local_damping = name == "local" ? local_share : 0;
  }

  void read(State& s) {
    const double kinetic = s.energy.kinetic, lost = s.energy.damping;
    if (adaptive_) {
      const bool strong = lost - lost_ > 0.5 * std::fabs(kinetic - kinetic_before_);
      double& a = model_.damping.mass;
      a = std::clamp(strong ? a / 1.1 : a * 1.1, 1e-4 * most_, most_);
    }
    brakes_ = kinetic_ && kinetic < kinetic_before_ && !brakes_;
    if (kinetic_) model_.damping.mass = brakes_ ? braking(s) : 0;
    if ((kinetic_ || critical_) && s.time.t > patience_) model_.local_damping = local_share_beside;
    kinetic_before_ = brakes_ ? 0 : kinetic;
    lost_ = s.energy.damping;
  }
  // At a sample. `unbalanced`: N, of each block, with the share of a coarse inertia. `ramp`: the load is changing, which the quotient would
  // take for a negative stiffness.
  void read(const State& s, const std::vector<Vec3>& unbalanced, bool ramp) {
    if (!critical_) return;
    double power = 0, size = 0;
    for (int b = 0; b < model_.nblock && !force_.empty() && !ramp; ++b) {
      if (model_.kind[z(b)] != Kind::moving || fell_[z(b)] != 0) continue;
      const Vec3 moved = s.pose.u[z(b)] - u_[z(b)];
      power += (force_[z(b)] - unbalanced[z(b)]).dot(moved);
      size += model_.mass[z(b)] * moved.squaredNorm();
    }
    if (size > 0) {
      const double cracking = std::max(std::min(patience * period_ / s.time.t, 1.0) * cracking_share * most_, least_);
      const double to = power > 0 ? std::clamp(2 * std::sqrt(power / size), least_, most_) : cracking;
      model_.damping.mass *= std::pow(to / model_.damping.mass, follows);
    }
    u_ = s.pose.u;
    force_ = unbalanced;
  }
  bool one_step() const { return brakes_; }  // until the next reading

  // Before motion is taken away: the ledger of a step that leaves next to none closes, whatever forces acted.
  void last_step(State& s, Solver& solver) {
    model_.damping.mass = braking(s);
    solver.advance({.next = s.time.t});
  }
  // Takes the motion away; its energy counts as damping.
  static void stop(State& s, const Model& m) {
    for (int b = 0; b < m.nblock; ++b) {
      const Vec3 v = s.motion.v[z(b)];
      if (m.kind[z(b)] == Kind::moving)
        s.energy.damping += 0.5 * (m.mass[z(b)] * v.squaredNorm() + s.motion.w[z(b)].dot(Vec3(s.motion.spin_momentum[z(b)])));
    }
    s.motion.v.assign(s.motion.v.size(), Vec3::Zero());
    s.motion.spin_momentum.assign(s.motion.spin_momentum.size(), Vec3::Zero());
    s.motion.w.assign(s.motion.w.size(), Vec3::Zero());
  }

 private:
  static double braking(const State& s) { return 2 / s.time.dt; }  // 1/s, leaves no velocity after one step

  Model& model_;
  const std::vector<std::uint8_t>& fell_;
  const double period_;    // s
  const double most_;      // 1/s, critical damping of the lowest mode
  const double least_;     // 1/s; with a machine, what breaks loose does not swing beyond where friction holds it
  const double patience_;  // s, until short waves are braked as well
  const bool adaptive_, kinetic_, critical_;
  bool brakes_ = false;
  double kinetic_before_ = 0, lost_ = 0;
  BlockVec3 u_;              // m, at the last reading
  std::vector<Vec3> force_;  // N, then
};

}  // namespace erbs::analysis
