#include "engine/contact/law/pair.h"

#include <algorithm>
#include <cmath>

#include "engine/base/units.h"
#include "engine/contact/law/frame.h"
#include "engine/contact/law/friction.h"
#include "engine/contact/law/impact_bound.h"

namespace erbs {
namespace {

// Velocities belong to half a step before the pose, so the vector between the bodies is that of the same instant. Otherwise a pair in rigid
// rotation would seem to separate at dt / 2 w x (w x r).
Motion motion_of(const PairFrame& s, double dt) {
  const ContactBlock &r = *s.reference_block, &o = *s.other_block;
  const Vec3 away = o.v - r.v, apart = r.rotation * s.pose.shift - 0.5 * dt * away;
  return {r.rotation.transpose() * (away - r.w.cross(apart)), r.rotation.transpose() * (o.w - r.w)};
}

// Wrench on the other body in pair axes, as force on b and moments on a and b in world axes.
PairWrench to_world(const ContactPair& pair, const PairFrame& s, const Vec3& force, const Vec3& moment) {
  const Mat3& rotation = s.reference_block->rotation;
  const Vec3 f = rotation * force, m_other = rotation * moment, m_reference = -(rotation * (moment + s.pose.shift.cross(force)));
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

// Inverse effective mass of both bodies at x (pair axes, from the centroid of the other) along the unit vector n (1/kg).
double inverse_mass_along(const PairFrame& s, const Vec3& x, const Vec3& n) {
  const Vec3 r = (x + s.pose.shift).cross(n), o = s.pose.rotation.transpose() * x.cross(n);
  return s.reference_block->inverse_mass + s.other_block->inverse_mass + r.dot(s.reference_block->inverse_tensor * r) +
         o.dot(s.other_block->inverse_tensor * o);
}

// Interlock acts where faces lie flat on each other, not at edges and corners: with interlock there, bodies of a heap tremble for ever.
bool lies_flat(const PairFrame& s, const Patch& patch) {
  const ContactBlock &r = *s.reference_block, &o = *s.other_block;
  return patch.area * (r.inverse_inertia + o.inverse_inertia) > flat_face * (r.inverse_mass + o.inverse_mass);
}

// Its upper bound for any direction.
double inverse_mass_at(const PairFrame& s, const Vec3& x) {
  return s.reference_block->inverse_mass + s.other_block->inverse_mass +
         (x + s.pose.shift).squaredNorm() * s.reference_block->inverse_inertia + x.squaredNorm() * s.other_block->inverse_inertia;
}

struct Dashpot {
  double chi = 0;    // s/m
  double limit = 1;  // of the factor 1 + chi closing
};

// Hunt and Crossley's factor for the present impact, plus a small linear one for the settled contact. The linear one is written in the same
// form; its coefficient is 2 settling sqrt(kn A m). The explicit step caps the sum, with x = dt^2 kn A / m:
//   one contact with the velocity of half a step before: x + 2 c dt / m < 4;
//   n equal contacts on each block count n-fold in the worst mode: c dt / m < (4 / n - x) / 2, of which 0.9 is used;
//   at least a quarter, which a heap allows (`time_step_bound.cpp`), and at most 1 / (1 + n), since others may close in the same step.
// A capped dashpot misses the requested restitution. Bricks that fall flat rebound with at least 0.43 at a cap of a quarter, and with
// 0.19 to 0.33 at a half (V22).
Dashpot dashpot(ContactPair& pair, const Patch& patch, double inverse_mass, const ContactSettings& settings, double dt,
                double contact_count) {
  Dashpot d;
  // Slow decay against the duration of a soft impact (about 3 depth / speed on a corner).
  const double memory =
      pair.peak_closing_speed > 0 ? std::max(settings.memory, 30 * patch.max_depth / pair.peak_closing_speed) : settings.memory;
  pair.peak_closing_speed =
      std::max({pair.peak_closing_speed * (1 - std::min(1.0, dt / memory)), patch.closing_speed, settings.reference_speed});
  if (!(inverse_mass > 0)) return d;
  const double kn = pair.law.kn, x = pair.impact;
  const double slow = settings.reference_speed / pair.peak_closing_speed,
               share = settings.settling * slow * slow;  // fades with speed: restitution governs an impact
  d.chi = x / pair.peak_closing_speed + 2 * share * std::sqrt(kn * patch.area / inverse_mass) / (kn * patch.total);
  const double square = kn * patch.area * inverse_mass * (dt * dt);
  const double bears = std::max(0.25, std::min(1 / (1 + contact_count), 0.45 * (4 / contact_count - square)));
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

void forget_contact(ContactPair& pair) {
  pair.touching = 0;
  pair.u.setZero();
  pair.psi = pair.area = pair.gyration = pair.tangential = 0;
}

PairPose lifted(const ContactPair& pair, PairPose pose) {
  pose.shift += pair.lift;
  return pose;
}

// Faces farther apart than their lift lose it: they next touch at their true pose. `apart` (m) becomes the distance of the true poses.
void come_apart(ContactPair& pair, double& apart) {
  if (pair.lift.isZero(0) || apart < 0) return;
  apart = std::max(0.0, apart - pair.lift.norm());
  if (apart > 0) pair.lift.setZero();
}

// Offsets the other body along the normal until the faces store `wanted` (J); returns the stored energy (J). Newton's method within a
// bracket, for the root of the energy: where a whole face presses it is linear in the offset.
double lift(ContactPair& pair, const PairFrame& s, double wanted, const Patch& patch, OverlapRoom& room) {
  const Vec3 n = patch.force.normalized(), from = pair.lift;
  const double kn = pair.law.kn, infinite = std::numeric_limits<double>::infinity();
  double way = 0, low = -infinite, high = infinite, stored = 0, near = 1e-9 * wanted;
  for (int i = 0; i < 60; ++i) {
    pair.lift = from + way * n;
    const PairPose pose = lifted(pair, s.pose);
    int separating_axis = -1;
    const Patch now = find_overlap(*s.reference, *s.other, pose, separating_axis, room);
    stored = now.total > 0 ? kn * overlap_energy(*s.reference, *s.other, pose, room) : 0;
    if (i == 0) near = 1e-9 * std::max(stored, wanted);
    if (std::fabs(stored - wanted) <= near) break;
    (stored > wanted ? low : high) = way;
    const double force = kn * now.force.dot(n);
    double next = force > 0 ? way + 2 * (stored - std::sqrt(stored * wanted)) / force : infinite;
    if (!(next > low && next < high)) next = (low + high) / 2;
    if (!std::isfinite(next) || next == way) break;
    way = next;
  }
  return stored;
}

// Gives the friction springs the force and torsion that acted along the face, as far as friction allows.
Friction take_shear(ContactPair& pair, const PairFrame& s, const Patch& patch, const Vec3& force, const Vec3& moment, double pressed) {
  const Motion rest{Vec3::Zero(), Vec3::Zero()};
  pair.touching = 0;
  patch_friction(pair, patch, s.pose, rest, pressed, 0, 0);  // first touch at this pose
  const double kt = pair.law.ks * pair.area, kr = kt * pair.gyration * pair.gyration;
  if (kt > 0) pair.u = -(force - force.dot(pair.n) * pair.n) / kt;
  pair.psi = kr > 0 ? -(moment - patch.centroid.cross(force)).dot(pair.n) / kr : 0.0;
  pair.touching = 1;
  pair.rotation = s.pose.rotation;
  pair.shift = s.pose.shift;
  pair.mean_normal_force = pressed;
  const Friction f = patch_friction(pair, patch, s.pose, rest, pressed, 0, 0);
  pair.tangential = f.stored;
  return f;
}

// The patch resists with at most kn A along its normal and kt across; its spread about the centroid adds the gyration to the arms.
//
// Dashpots are not in the sum, since they act on the velocity of half a step before. `dashpot()` and the cap of the tangential dashpot
// limit each to a quarter of m / dt. An explicit step allows this beside springs at this bound (dt^2 k / m + 2 c dt / m < 4).
//
// Rotations first count with the greatest inverse inertia J. For a slender body this is far too much; then the tensor A (pair axes) counts:
// tr(A N S N^T) for a pressure of second moment S about an axis across n, n.A n gyration^2 about n, tr(A) r^2 - r.A r for a force at r.
void stability(const ContactPair& pair, const PairFrame& s, const Patch& patch, PairResult& result) {
  const double normal = pair.law.kn * patch.area, tangential = pair.law.ks * pair.area, spread = pair.gyration * pair.gyration;
  const Vec3 n = patch.normal;
  const auto rate = [&](const ContactBlock& block, const Vec3& arm, const Vec3& lever, bool with_tensor) {
    const double mass = block.inverse_mass, inertia = block.inverse_inertia, square = arm.squaredNorm();
    double bend = spread * inertia, twist = bend, sway = square * inertia;
    if (bend + sway > slender * mass) {
      const Mat3 A = with_tensor ? Mat3(s.pose.rotation * block.inverse_tensor * s.pose.rotation.transpose()) : block.inverse_tensor,
                 N = cross_matrix(n);
      const Mat3 second = patch.second - patch.area * patch.centroid * patch.centroid.transpose();
      bend = std::min(bend, (A * (N * second * N.transpose())).trace() / patch.area);
      twist = std::min(twist, spread * n.dot(A * n));
      sway = std::min(sway, A.trace() * square - arm.dot(A * arm));
    }
    return normal * (mass + lever.dot(block.inverse_tensor * lever) + bend) + tangential * (mass + sway + twist);
  };
  const Vec3 arm = patch.centroid + s.pose.shift;
  const double other = rate(*s.other_block, patch.centroid, s.pose.rotation.transpose() * patch.centroid.cross(n), true);
  const double reference = rate(*s.reference_block, arm, arm.cross(n), false);
  result.omega2_a = pair.b_is_reference ? other : reference;
  result.omega2_b = pair.b_is_reference ? reference : other;
}

}  // namespace

double power(const PairWrench& w, const ContactBlock& a, const ContactBlock& b) {
  return w.force.dot(b.v - a.v) + w.moment_a.dot(a.w) + w.moment_b.dot(b.w);
}

double torsion_radius(double area, double gyration) {
  if (!(gyration > 0)) return 0;
  // Interpolation between line and square by area / gyration^2 (6 for a square).
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

ContactPair new_pair(int a, int part_a, int b, int part_b, const PairLaw& law, double impact, const ContactShapes& shapes) {
  ContactPair p;
  p.a = a;
  p.b = b;
  p.part_a = part_a;
  p.part_b = part_b;
  p.law = law;
  p.impact = impact;
  // Equal volumes up to round-off: the lower block is the reference.
  p.b_is_reference = shape_of(shapes, b, part_b).volume > shape_of(shapes, a, part_a).volume * (1 + 1e-9);
  return p;
}

bool pair_force(ContactPair& pair, const ContactShapes& shapes, const ContactBlock& a, const ContactBlock& b,
                const ContactSettings& settings, double dt, bool want_energy, OverlapRoom& room, PairResult& result, double contact_count) {
  result = PairResult{};
  const PairFrame s = pair_frame(pair, shapes, a, b);
  Patch patch = find_overlap(*s.reference, *s.other, lifted(pair, s.pose), pair.separating_axis, room);
  const bool touches = patch.total > 0;
  if (!touches) {
    come_apart(pair, room.apart);
    impact_bound(pair, s, settings, room.apart, dt, result);
    if (room.apart >= 0) result.apart = room.apart;
    if (room.apart > settings.interlock.gap) pair.mean_normal_force = 0;
    if (!pair.touching) return false;
  }

  PairWrench elastic, damping, friction;
  const double stored_before = pair.tangential;
  if (touches) {
    const Motion motion = motion_of(s, dt);
    closing_speeds(room, motion.linear, motion.angular, patch);
    const double kn = pair.law.kn;
    const double along = inverse_mass_along(s, patch.pressure_centre, patch.normal);
    elastic = to_world(pair, s, kn * patch.force, kn * patch.moment);
    const Dashpot d = dashpot(pair, patch, along, settings, dt, contact_count);
    Vec3 damping_force, damping_moment;
    damping_wrench(room, patch.normal, d.chi, d.limit, damping_force, damping_moment);
    const double inverse_mass = inverse_mass_at(s, patch.centroid);
    const Friction f = patch_friction(pair, patch, s.pose, motion, kn * patch.force.norm(), inverse_mass, settings.settling_tangential,
                                      lies_flat(s, patch) ? settings.interlock : Interlock{});
    damping = to_world(pair, s, kn * damping_force + f.viscous_force, kn * damping_moment + f.viscous_moment);
    friction = to_world(pair, s, f.force, f.moment);
    if (f.slipped > 0) result.slip_omega2 = kn * patch.area * along;
    pair.tangential = f.stored;
    pair.touching = 1;
    result.touching = true;
    result.depth = patch.max_depth;
    stability(pair, s, patch, result);
    if (want_energy) result.elastic = kn * overlap_energy(*s.reference, *s.other, lifted(pair, s.pose), room);
  } else if (pair.touching) {
    forget_contact(pair);
    pair.peak_closing_speed = 0;
  }
  pair.rotation = s.pose.rotation;
  pair.shift = s.pose.shift;

  result.friction = -trapezoid(pair.friction, friction, a, b, dt) - (pair.tangential - stored_before);
  result.damping = -trapezoid(pair.damping, damping, a, b, dt);
  result.tangential = pair.tangential;
  result.wrench = elastic;
  add(result.wrench, damping);
  add(result.wrench, friction);
  return true;
}

double release_to_contact(ContactPair& pair, const ContactShapes& shapes, const ContactBlock& a, const ContactBlock& b, const Vec6& before,
                          double stored, double most, OverlapRoom& room) {
  const PairFrame s = pair_frame(pair, shapes, a, b);
  const Mat3 back = s.reference_block->rotation.transpose();
  // The wrench before, on the body that is not the reference, in pair axes.
  Vec3 force = back * before.head<3>(), moment = back * before.tail<3>();
  if (pair.b_is_reference) {
    moment = -(moment - s.pose.shift.cross(force));  // about the centroid of a, which is at +shift from that of b
    force = -force;
  }
  const double kn = pair.law.kn;
  const auto overlap = [&] { return find_overlap(*s.reference, *s.other, lifted(pair, s.pose), pair.separating_axis, room); };
  forget_contact(pair);
  Patch patch = overlap();
  double kept = 0;
  if (patch.total > 0) {
    const double pressed = std::max(0.0, force.dot(patch.force.normalized())), of_now = pressed / (kn * patch.force.norm());
    const double squeezed = kn * overlap_energy(*s.reference, *s.other, lifted(pair, s.pose), room) * of_now * of_now;
    const double sheared = take_shear(pair, s, patch, force, moment, pressed).stored;
    kept = lift(pair, s, squeezed, patch, room) + sheared;
    if (std::fabs(stored - kept) > most) {
      const double share = squeezed + sheared > 0 ? stored / (squeezed + sheared) : 0;
      const double faces = lift(pair, s, share * squeezed, patch, room), left = std::max(0.0, stored - faces);
      if (const Patch now = overlap(); now.total > 0) take_shear(pair, s, now, force, moment, kn * now.force.norm());
      else forget_contact(pair);
      if (const double less = left / pair.tangential; less < 1)
        pair.u *= std::sqrt(less), pair.psi *= std::sqrt(less), pair.tangential *= less;
      kept = lift(pair, s, stored - pair.tangential, patch, room) + pair.tangential;  // the faces store the part that friction cannot
    }
    patch = overlap();
    pair.mean_normal_force = kn * patch.force.norm();
  }
  pair.rotation = s.pose.rotation;
  pair.shift = s.pose.shift;
  if (!before.isZero(0)) pair.touching = 1;
  // The part of the former wrench that is no pressure still does half a step of work on the way to the next pose.
  pair.friction = to_world(pair, s, force - kn * patch.force, moment - kn * patch.moment);
  return kept;
}

}  // namespace erbs
