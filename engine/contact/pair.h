// A pair of parts that may touch: its law, and all it remembers from step to step.
#pragma once
#include <cstdint>

#include "engine/base/vec.h"

namespace erbs {

struct PairLaw {
  double kn = 0;  // Pa/m
  double ks = 0;  // Pa/m
  double mu = 0;
  double restitution = 0;  // of an impact through the centre
};

// Dashpots and scales that are choices of the numerics, the same for all pairs.
struct ContactSettings {
  double reference_speed = 0.01;      // m/s, restitution is as asked for above it, impacts are softer below
  double memory = 0.05;               // s, over which the greatest approach speed is forgotten
  double settling = 0.2;              // share of critical damping of the settled contact, normal; fades with the speed of impact
  double settling_tangential = 0.05;  // the same of a contact that sticks, tangential
  double handover_periods = 5;        // contact periods over which the difference to the old joint fades
};

// Force and moments on the two bodies of a pair, world axes, each moment about the body's own centroid.
struct PairWrench {
  Vec3 force = Vec3::Zero();                              // N, on b; on a the opposite
  Vec3 moment_a = Vec3::Zero(), moment_b = Vec3::Zero();  // N m
};

struct Pair {
  int a = 0, b = 0;            // blocks, a < b
  int part_a = 0, part_b = 0;  // parts of them
  PairLaw law;
  double impact = 0;                // impact_factor(law.restitution)
  std::uint8_t b_is_reference = 0;  // whose inner distance is the potential: the larger part, then the lower block; never changes
  std::uint8_t touching = 0;
  int separating = -1;  // cache only
  // relative pose at the last step, pair axes
  Mat3 turn = Mat3::Identity();
  Vec3 shift = Vec3::Zero();  // m
  // friction, pair axes: slip field u + psi n x (x - c) of the tangential springs
  Vec3 n = Vec3::Zero();  // unit
  Vec3 c = Vec3::Zero();  // m, where u is taken, relative to the centroid of the reference
  Vec3 u = Vec3::Zero();  // m
  double psi = 0;         // rad
  double area = 0;        // m2, largest seen in this contact: stiffness of the springs
  double gyration = 0;    // m, largest seen
  double approach = 0;    // m/s, greatest recent speed of approach
  // difference to the joint it was handed over from, pair axes
  Vec3 offset_force = Vec3::Zero();         // N, on the body that is not the reference
  Vec3 offset_moment = Vec3::Zero();        // N m, about its centroid
  double offset_left = 0, offset_time = 0;  // s
  // wrenches of the last step, whose half step of work is still to be booked
  PairWrench friction, damping, offset;
  // what the pair stores now
  double tangential = 0;  // J
};

// Every member that a checkpoint or a hash must hold.
template <class F>
void each(PairWrench& w, F&& f) {
  f(w.force), f(w.moment_a), f(w.moment_b);
}
template <class F>
void each(Pair& p, F&& f) {
  f(p.a), f(p.b), f(p.part_a), f(p.part_b);
  f(p.law.kn), f(p.law.ks), f(p.law.mu), f(p.law.restitution), f(p.impact);
  f(p.b_is_reference), f(p.touching), f(p.separating);
  f(p.turn), f(p.shift), f(p.n), f(p.c), f(p.u), f(p.psi), f(p.area), f(p.gyration), f(p.approach);
  f(p.offset_force), f(p.offset_moment), f(p.offset_left), f(p.offset_time);
  each(p.friction, f), each(p.damping, f), each(p.offset, f);
  f(p.tangential);
}

}  // namespace erbs
