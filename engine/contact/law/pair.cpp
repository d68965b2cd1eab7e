#include "engine/contact/law/pair.h"

#include <algorithm>
#include <cmath>

#include "engine/base/units.h"
#include "engine/contact/law/frame.h"
#include "engine/contact/law/impact_bound.h"
#include "engine/contact/law/pair_law.h"
#include "engine/contact/law/point_friction.h"

namespace erbs {
namespace {

Vec3 vec(const double (*x)[1]) { return {x[0][0], x[1][0], x[2][0]}; }
void set(double (*to)[1], const Vec3& x) {
  for (int i = 0; i < 3; ++i) to[i][0] = x[i];
}

// The rows of a pair with a patch, up to the pose.
void fill(OnePair& w, ContactPair& pair, const PairFrame& s, const Patch& patch, double contact_count) {
  set_lane(w, 0, pair, *s.reference_block, *s.other_block, contact_count);
  scalar::gather_pairs<double>(w);
  w.total[0] = patch.total, w.area[0] = patch.area, w.size[0] = patch.force.norm(), w.gyration[0] = patch.gyration;
  w.max_depth[0] = patch.max_depth;
  set(w.force, patch.force), set(w.moment, patch.moment), set(w.normal, patch.normal);
  set(w.pressure_centre, patch.pressure_centre), set(w.centroid, patch.centroid);
  const Mat3& m = patch.second;
  set(w.second, m.diagonal()), set(w.second + 3, {m(0, 1), m(1, 2), m(2, 0)});
}

// Unstretched springs at this patch and pose.
void start_springs(ContactPair& pair, const PairFrame& s, const Patch& patch) {
  pair.n = patch.normal;
  pair.c = patch.centroid + s.pose.shift;
  pair.area = patch.area;
  pair.gyration = patch.gyration;
  pair.u.setZero();
  pair.psi = 0;
  pair.touching = 1;
  pair.rotation = s.pose.rotation;
  pair.shift = s.pose.shift;
}

// Friction of a pair that has slipped since its last step, or that is `new_here`. The slip of the latter would be round-off, which is much
// against the first depths.
void limit_friction(OnePair& w, const PairSettings& settings, bool new_here) {
  scalar::stretch_springs<double>(w);
  if (new_here) {
    for (int i = 0; i < 3; ++i) w.u1[i][0] = w.u0[i][0];
    w.psi1[0] = w.psi0[0];
  }
  scalar::trial_forces<double>(w, settings);
  scalar::return_map<double>(w);
  if (!(w.holds[0] > 0)) return_point(w);
}

// The force and the history of a pair that touches.
void press(ContactPair& pair, const PairFrame& s, Patch& patch, const PairSettings& settings, double contact_count, OverlapRoom& room,
           PairResult& result) {
  const bool new_here = !pair.touching;
  if (new_here) start_springs(pair, s, patch);
  OnePair w;
  fill(w, pair, s, patch, contact_count);
  scalar::relative_motion<double>(w, settings);
  closing_speeds(room, vec(w.linear), vec(w.angular), patch);
  w.closing_speed[0] = patch.closing_speed;
  scalar::dashpot<double>(w, settings);
  Vec3 first;
  w.damping[0][0] = damping(room, patch.normal, w.chi[0], w.limit[0], first);
  set(w.damping + 1, first);
  scalar::lagging<double>(w);
  limit_friction(w, settings, new_here);
  scalar::finish<double>(w, settings);
  scalar::write(w.p, pair_rows, &pair.law.kn);
  pair.lag = w.lag[0], pair.blow_age = w.blow_age[0];
  scalar::write(w.result, result_rows, result.wrench.force.data());
  result.touching = true;
}

void forget_contact(ContactPair& pair) {
  pair.touching = 0;
  pair.u.setZero();
  pair.psi = pair.area = pair.gyration = pair.tangential = pair.lag = 0;
}

// The bodies have separated: half a step of the last wrenches is still to be booked, and the springs lose their energy.
void let_go(ContactPair& pair, const ContactBlock& a, const ContactBlock& b, const PairInterval& interval, PairResult& result) {
  const double dt = interval.booked ? 0 : interval.since;
  result.friction = pair.tangential - 0.5 * dt * power(pair.friction, a, b);
  result.damping = -0.5 * dt * power(pair.damping, a, b);
  pair.friction = pair.damping = {};
  pair.peak_closing_speed = 0;
  forget_contact(pair);
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
void take_shear(ContactPair& pair, const PairFrame& s, const Patch& patch, const Vec3& force, const Vec3& moment, double pressed) {
  start_springs(pair, s, patch);
  const double kt = pair.law.ks * pair.area, kr = kt * pair.gyration * pair.gyration;
  if (kt > 0) pair.u = -(force - force.dot(pair.n) * pair.n) / kt;
  if (kr > 0) pair.psi = -(moment - patch.centroid.cross(force)).dot(pair.n) / kr;
  pair.mean_normal_force = pressed, pair.lent = 0;
  OnePair w;
  fill(w, pair, s, patch, saturated_contacts);
  w.size[0] = pressed / pair.law.kn;
  set(w.damping, Vec3::Zero()), w.damping[3][0] = w.chi[0] = 0;
  set(w.linear, Vec3::Zero()), set(w.angular, Vec3::Zero());
  limit_friction(w, PairSettings{}, false);
  const scalar::Springs<double> springs = scalar::springs_after<double>(w);
  pair.u = {springs.u.x, springs.u.y, springs.u.z};
  pair.psi = springs.psi;
  pair.tangential = springs.stored;
}

// Wrench on the other body in pair axes, as force on b and moments on a and b in world axes.
PairWrench to_world(const ContactPair& pair, const PairFrame& s, const Vec3& force, const Vec3& moment) {
  const Mat3& rotation = s.reference_block->rotation;
  const Vec3 f = rotation * force, m_other = rotation * moment, m_reference = -(rotation * (moment + s.pose.shift.cross(force)));
  return pair.b_is_reference ? PairWrench{-f, m_other, m_reference} : PairWrench{f, m_reference, m_other};
}

// Strength of a blow, over what the step bears, from which a part lags (`begin_lag()`): each blow counts where there are few, those of
// equal blocks too. In a rain of bricks that would cost a fifth of the steps.
double lag_from(const ContactSettings& s) { return std::isfinite(s.blow_share) ? 2 : 6; }

}  // namespace

PairSettings pair_settings(const ContactSettings& s, const PairInterval& interval) {
  return {interval.since,
          interval.drift,
          interval.booked ? 1.0 : 0.0,
          lag_from(s),
          s.falling_mass,
          s.memory,
          s.reference_speed,
          s.settling,
          s.settling_tangential,
          {s.gravity, 1, interval.since, interval.since},
          flat_face,
          slender};
}

double interlocks_to(const ContactSettings& s, const ContactPair& pair) {
  return interlock_gap * s.gravity * pair.law.hop.time * pair.law.hop.time;
}

double power(const PairWrench& w, const ContactBlock& a, const ContactBlock& b) { return power(w, b.v - a.v, a.w, b.w); }
double power(const PairWrench& w, const Vec3& speed, const Vec3& spin_a, const Vec3& spin_b) {
  return w.force.dot(speed) + w.moment_a.dot(spin_a) + w.moment_b.dot(spin_b);
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
                const ContactSettings& settings, const PairInterval& interval, bool want_energy, OverlapRoom& room, PairResult& result,
                double contact_count) {
  result = PairResult{};
  const PairFrame s = pair_frame(pair, shapes, a, b);
  Patch patch = find_overlap(*s.reference, *s.other, lifted(pair, s.pose), pair.separating_axis, room);
  if (patch.total > 0) {
    press(pair, s, patch, pair_settings(settings, interval), contact_count, room, result);
    if (settings.first_fall > 0) impact_bound(pair, s, settings, 0, interval.horizon, result);  // it may only just touch
    if (want_energy) result.elastic = pair.law.kn * overlap_energy(*s.reference, *s.other, lifted(pair, s.pose), room);
    return true;
  }
  come_apart(pair, room.apart);
  impact_bound(pair, s, settings, room.apart, interval.horizon, result);
  if (room.apart >= 0) result.apart = room.apart;
  if (room.apart > interlocks_to(settings, pair)) pair.mean_normal_force = 0;
  if (!pair.touching) return false;
  let_go(pair, a, b, interval, result);
  pair.rotation = s.pose.rotation;
  pair.shift = s.pose.shift;
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
    take_shear(pair, s, patch, force, moment, pressed);
    const double sheared = pair.tangential;
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
