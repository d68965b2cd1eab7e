#include "engine/contact/contact.h"

#include <algorithm>
#include <cmath>

#include "engine/base/units.h"
#include "engine/contact/friction.h"
#include "engine/contact/landing.h"
#include "engine/contact/view.h"

namespace erbs {
namespace {

// Velocities are those of half a step before the pose: so is the way from one body to the other that they are seen over, or a pair that
// turns as one would seem to part with dt / 2 w x (w x r).
Motion motion_of(const View& s, double dt) {
  const ContactBlock &r = *s.reference_block, &o = *s.other_block;
  const Vec3 away = o.v - r.v, apart = r.turn * s.pose.shift - 0.5 * dt * away;
  return {r.turn.transpose() * (away - r.w.cross(apart)), r.turn.transpose() * (o.w - r.w)};
}

// A wrench on the other body in pair axes, as forces and moments on a and b in world axes.
PairWrench to_world(const Pair& pair, const View& s, const Vec3& force, const Vec3& moment) {
  const Mat3& turn = s.reference_block->turn;
  const Vec3 f = turn * force, m_other = turn * moment, m_reference = -(turn * (moment + s.pose.shift.cross(force)));
  PairWrench w;
  w.force = pair.b_is_reference ? Vec3(-f) : f;
  w.moment_a = pair.b_is_reference ? m_other : m_reference;
  w.moment_b = pair.b_is_reference ? m_reference : m_other;
  return w;
}

void add(PairWrench& to, const PairWrench& w) {
  to.force += w.force;
  to.moment_a += w.moment_a;
  to.moment_b += w.moment_b;
}

// Inverse of the mass that both bodies present at x (pair axes, from the centroid of the other) along the unit vector n (1/kg).
double inverse_mass_along(const View& s, const Vec3& x, const Vec3& n) {
  const Vec3 r = (x + s.pose.shift).cross(n), o = s.pose.turn.transpose() * x.cross(n);
  return s.reference_block->inverse_mass + s.other_block->inverse_mass + r.dot(s.reference_block->inverse_tensor * r) +
         o.dot(s.other_block->inverse_tensor * o);
}

// A bound of it for any direction.
double inverse_mass_at(const View& s, const Vec3& x) {
  return s.reference_block->inverse_mass + s.other_block->inverse_mass +
         (x + s.pose.shift).squaredNorm() * s.reference_block->inverse_inertia + x.squaredNorm() * s.other_block->inverse_inertia;
}

struct Dashpot {
  double chi = 0;    // s/m
  double limit = 1;  // of the factor 1 + chi closing
};

// Hunt and Crossley's factor for the impact at hand, a small linear one for the settled contact written in the same form
// (its coefficient is 2 settling sqrt(kn A m)), both kept below what the explicit step bears. A pair alone, x = dt^2 kn A / m: with the
// velocity of half a step before, x + 2 c dt / m < 4. Where n such contacts press on each block n times that in the worst mode: c dt / m <
// (4 / n - x) / 2, of which 0.9 is taken; never less than a quarter, which a heap bears (contact_limit.cpp), and no more than 1 / (1 + n),
// since others may land in the same step. What is missing is missing of the restitution asked for: with a quarter bricks that fall
// flat come back with 0.43 at least, with a half with 0.19 to 0.33 (V22).
Dashpot dashpot(Pair& pair, const Patch& patch, double inverse_mass, const ContactSettings& settings, double dt, double crowd) {
  Dashpot d;
  // Forgotten slowly against the time of a soft impact (about 3 depth / speed on a corner).
  const double memory = pair.approach > 0 ? std::max(settings.memory, 30 * patch.deepest / pair.approach) : settings.memory;
  pair.approach = std::max({pair.approach * (1 - std::min(1.0, dt / memory)), patch.closing, settings.reference_speed});
  if (!(inverse_mass > 0)) return d;
  const double kn = pair.law.kn, x = pair.impact;
  const double slow = settings.reference_speed / pair.approach,
               share = settings.settling * slow * slow;  // an impact is left to its restitution
  d.chi = x / pair.approach + 2 * share * std::sqrt(kn * patch.area / inverse_mass) / (kn * patch.total);
  const double square = kn * patch.area * inverse_mass * (dt * dt);
  const double bears = std::max(0.25, std::min(1 / (1 + crowd), 0.45 * (4 / crowd - square)));
  if (dt > 0) d.chi = std::min(d.chi, bears / (inverse_mass * kn * patch.total * dt));
  d.limit = 1 + std::max(x, 1.0);
  return d;
}

// Books half a step of work of the last wrench and half a step of the present one (J, done on the bodies).
double trapezoid(PairWrench& last, const PairWrench& now, const ContactBlock& a, const ContactBlock& b, double dt) {
  const double work = 0.5 * dt * (power(last, a, b) + power(now, a, b));
  last = now;
  return work;
}

// The fading difference to the joint the pair was handed over from.
PairWrench fading(Pair& pair, const View& s, double dt) {
  if (pair.offset_left <= 0) return {};
  pair.offset_left = std::max(0.0, pair.offset_left - dt);
  const double share = pair.offset_left / pair.offset_time;
  return to_world(pair, s, share * pair.offset_force, share * pair.offset_moment);
}

void forget_contact(Pair& pair) {
  pair.touching = 0;
  pair.u.setZero();
  pair.psi = pair.area = pair.gyration = pair.tangential = 0;
}

// The patch resists with at most kn A along its normal and kt across; its spread about its centroid adds the gyration to the arms.
// Dashpots are not in the sum: they see the velocity of half a step before, and dashpot() and the cap on the tangential one keep
// each below a quarter of m / dt, which an explicit step bears beside springs at this bound (dt^2 k / m + 2 c dt / m < 4).
void stability(const Pair& pair, const View& s, const Patch& patch, PairResult& result) {
  const double normal = pair.law.kn * patch.area, tangential = pair.law.ks * pair.area, spread = pair.gyration * pair.gyration;
  auto rate = [&](const ContactBlock& block, const Vec3& arm, const Vec3& lever) {
    return normal * (block.inverse_mass + lever.dot(block.inverse_tensor * lever) + spread * block.inverse_inertia) +
           tangential * (block.inverse_mass + (arm.squaredNorm() + spread) * block.inverse_inertia);
  };
  const Vec3 arm = patch.centroid + s.pose.shift;
  const double other = rate(*s.other_block, patch.centroid, s.pose.turn.transpose() * patch.centroid.cross(patch.normal));
  const double reference = rate(*s.reference_block, arm, arm.cross(patch.normal));
  result.rate_a = pair.b_is_reference ? other : reference;
  result.rate_b = pair.b_is_reference ? reference : other;
}

}  // namespace

double power(const PairWrench& w, const ContactBlock& a, const ContactBlock& b) {
  return w.force.dot(b.v - a.v) + w.moment_a.dot(a.w) + w.moment_b.dot(b.w);
}

double torsion_radius(double area, double gyration) {
  if (!(gyration > 0)) return 0;
  // Interpolates between the line and the square by the slenderness area / gyration^2 (6 for a square).
  const double fill = std::min(1.1, area / (6 * gyration * gyration));
  return gyration * (0.866 + 0.0711 * fill * std::cbrt(fill));
}

double impact_factor(double restitution) {
  const double e = std::clamp(restitution, 0.02, 1.0);
  if (e > 1 - 1e-9) return 0;
  double low = 0, high = 1 / e;  // the root lies below 1 / e
  for (int i = 0; i < 100; ++i) {
    const double x = (low + high) / 2;
    const double difference = x - std::log1p(x) + e * x + std::log1p(-e * x);
    (difference > 0 ? low : high) = x;
  }
  return (low + high) / 2;
}

Pair new_pair(int a, int part_a, int b, int part_b, const PairLaw& law, double impact, const ContactShapes& shapes) {
  Pair p;
  p.a = a;
  p.b = b;
  p.part_a = part_a;
  p.part_b = part_b;
  p.law = law;
  p.impact = impact;
  // Equal volumes up to round-off: the lower block decides.
  p.b_is_reference = shape_of(shapes, b, part_b).volume > shape_of(shapes, a, part_a).volume * (1 + 1e-9);
  return p;
}

bool pair_force(Pair& pair, const ContactShapes& shapes, const ContactBlock& a, const ContactBlock& b, const ContactSettings& settings,
                double dt, bool want_energy, OverlapRoom& room, PairResult& result, double crowd) {
  result = PairResult{};
  const View s = view_of(pair, shapes, a, b);
  Patch patch = find_overlap(*s.reference, *s.other, s.pose, pair.separating, room);
  const bool touches = patch.total > 0;
  if (!touches) landing(pair, s, settings, room.apart, dt, result);
  if (!touches && room.apart >= 0) result.apart = room.apart;
  if (!touches && !pair.touching && pair.offset_left <= 0) {
    if (room.apart > settings.interlock.gap) pair.bearing = 0;
    return false;
  }

  PairWrench elastic, damping, friction;
  const double stored_before = pair.tangential;
  if (touches) {
    const Motion motion = motion_of(s, dt);
    closing_speeds(room, motion.linear, motion.angular, patch);
    const double kn = pair.law.kn;
    const double along = inverse_mass_along(s, patch.pressure_centre, patch.normal);
    elastic = to_world(pair, s, kn * patch.force, kn * patch.moment);
    const Dashpot d = dashpot(pair, patch, along, settings, dt, crowd);
    Vec3 damping_force, damping_moment;
    damping_wrench(room, patch.normal, d.chi, d.limit, damping_force, damping_moment);
    const double inverse_mass = inverse_mass_at(s, patch.centroid);
    const Friction f = patch_friction(pair, patch, s.pose, motion, kn * patch.force.norm(), inverse_mass, settings.settling_tangential,
                                      settings.interlock);
    damping = to_world(pair, s, kn * damping_force + f.viscous_force, kn * damping_moment + f.viscous_moment);
    friction = to_world(pair, s, f.force, f.moment);
    if (f.slipped > 0) result.rubbing = kn * patch.area * along;
    pair.tangential = f.stored;
    pair.touching = 1;
    result.touching = true;
    result.depth = patch.deepest;
    stability(pair, s, patch, result);
    if (want_energy) result.elastic = kn * overlap_energy(*s.reference, *s.other, s.pose, room);
  } else if (pair.touching) {
    forget_contact(pair);
    pair.approach = 0;
  }
  if (!touches && room.apart > settings.interlock.gap) pair.bearing = 0;
  pair.turn = s.pose.turn;
  pair.shift = s.pose.shift;

  const PairWrench offset = fading(pair, s, dt);
  result.friction = -trapezoid(pair.friction, friction, a, b, dt) - (pair.tangential - stored_before);
  result.damping = -trapezoid(pair.damping, damping, a, b, dt);
  result.handover = -trapezoid(pair.offset, offset, a, b, dt);
  result.tangential = pair.tangential;
  result.wrench = elastic;
  add(result.wrench, damping);
  add(result.wrench, friction);
  add(result.wrench, offset);
  return true;
}

void hand_over(Pair& pair, const ContactShapes& shapes, const ContactBlock& a, const ContactBlock& b, const ContactSettings& settings,
               const Vec3& force_on_b, const Vec3& moment_on_b, double area, OverlapRoom& room) {
  const View s = view_of(pair, shapes, a, b);
  const Mat3 back = s.reference_block->turn.transpose();
  // The old wrench on the body that is not the reference, pair axes.
  Vec3 old_force = back * force_on_b, old_moment = back * moment_on_b;
  if (pair.b_is_reference) {
    old_moment = -(old_moment - s.pose.shift.cross(old_force));  // about the centroid of a, which lies at +shift from that of b
    old_force = -old_force;
  }
  Patch patch = find_overlap(*s.reference, *s.other, s.pose, pair.separating, room);
  Vec3 new_force = Vec3::Zero(), new_moment = Vec3::Zero();
  forget_contact(pair);
  double stiffness = pair.law.kn * area;
  Vec3 middle = -s.pose.shift / 2;
  if (patch.total > 0) {
    const double kn = pair.law.kn;
    // First touch at this pose, then the springs are given the force and torsion of the joint.
    patch_friction(pair, patch, s.pose, {Vec3::Zero(), Vec3::Zero()}, kn * patch.force.norm(), 0, 0);
    const double kt = pair.law.ks * pair.area, kr = kt * pair.gyration * pair.gyration;
    const Vec3 t = old_force - old_force.dot(pair.n) * pair.n;
    pair.u = -t / kt;
    pair.psi = kr > 0 ? -(old_moment - patch.centroid.cross(old_force)).dot(pair.n) / kr : 0.0;
    pair.touching = 1;
    pair.turn = s.pose.turn;
    pair.shift = s.pose.shift;
    const Friction f = patch_friction(pair, patch, s.pose, {Vec3::Zero(), Vec3::Zero()}, kn * patch.force.norm(), 0, 0);
    pair.tangential = f.stored;
    pair.friction = to_world(pair, s, f.force, f.moment);
    new_force = kn * patch.force + f.force;
    new_moment = kn * patch.moment + f.moment;
    stiffness = kn * patch.area;
    middle = patch.centroid;
  }
  pair.offset_force = old_force - new_force;
  pair.offset_moment = old_moment - new_moment;
  const double inverse_mass = inverse_mass_at(s, middle);
  pair.offset_time = inverse_mass > 0 && stiffness > 0 ? settings.handover_periods * 2 * pi / std::sqrt(stiffness * inverse_mass) : 0;
  pair.offset_left = pair.offset_time;
  pair.offset = to_world(pair, s, pair.offset_force, pair.offset_moment);
}

}  // namespace erbs
