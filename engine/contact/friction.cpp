#include "engine/contact/friction.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/contact/contact.h"

namespace erbs {
namespace {

// Turns v as the normal turns from n to m, and by `spin` about m.
Vec3 carried(const Vec3& v, const Vec3& n, const Vec3& m, double spin) {
  const Vec3 axis = n.cross(m);
  const double cosine = n.dot(m);
  Vec3 r = v;
  if (cosine > -0.5) r = v * cosine + axis.cross(v) + axis * (axis.dot(v) / (1 + cosine));
  else r.setZero();  // turned over: a new contact
  r -= r.dot(m) * m;
  return r * std::cos(spin) + m.cross(r) * std::sin(spin);
}

// Slip of the other body's material at x (pair axes, relative to its centroid) and its turn about n since the last step, from the
// two poses: exact under any common rigid motion.
void slip_increment(const Pair& pair, const PairPose& pose, const Vec3& x, const Vec3& n, Vec3& slip, double& spin) {
  const Mat3 change = pair.turn * pose.turn.transpose();  // takes pair axes of now to those of before
  slip = x + pose.shift - change * x - pair.shift;
  slip -= slip.dot(n) * n;
  spin = -0.5 * (n.x() * (change(2, 1) - change(1, 2)) + n.y() * (change(0, 2) - change(2, 0)) + n.z() * (change(1, 0) - change(0, 1)));
}

// Carries the springs to the patch of now: normal, centre, stiffness.
void carry(Pair& pair, const Patch& patch, const Vec3& centre, double spin) {
  pair.u = carried(pair.u, pair.n, patch.normal, spin / 2);
  pair.n = patch.normal;
  pair.u -= pair.psi * pair.n.cross(pair.c - centre);  // the slip field stays, its reference point moves
  pair.u -= pair.u.dot(pair.n) * pair.n;
  pair.c = centre;
  // Growth keeps force and torsion: the stiffer springs store less. Shrinking changes nothing, so a patch that breathes is no ratchet.
  if (patch.area > pair.area) {
    const double ratio = pair.area / patch.area;
    pair.u *= ratio;
    pair.psi *= ratio;
    pair.area = patch.area;
  }
  if (patch.gyration > pair.gyration) {
    pair.psi *= pair.gyration * pair.gyration / (patch.gyration * patch.gyration);
    pair.gyration = patch.gyration;
  }
}

// Limit surface of an evenly pressed patch, force and torsion as shares of what either bears alone:
//   f(t, m) = t^2 + m^2 + bulge t^2 m^2 = 1.
// Coulomb friction over the face gives it point by point (Goyal, Ruina and Papadopoulos 1991, Wear 143, 307). The ellipse, bulge 0, is too
// strong where both act: a disc that spins fast slides under t = (2/3) v / (r w), one that slides fast turns under m = (9/16) r w / v, and
// the ellipse has 1 in place of 2/3 and 9/16; f has 1 / (1 + bulge).
struct Share {
  double t, m;
};

// How far the surface lies inside the ellipse, from the patch's second moment along the slip over r^2. From Coulomb friction over
// rectangles 1:1 to 3:1 along, across and at 45 degrees, and the disc, where v = r w: 1.29 - 1.25 x meets all of them within .05.
double bulge_of(double along) { return std::clamp(1.29 - 1.25 * along, -0.4, 1.3); }
constexpr double surely_within = 0.79;  // t^2 + m^2 where no bulge reaches the surface: x + 1.3 x^2 / 4 < 1

// Where the surface is met on the way from nothing to s: a^2 (t^2 + m^2) + bulge a^4 t^2 m^2 = 1.
double reach(const Share& s, double bulge) {
  const double p = s.t * s.t + s.m * s.m, q = bulge * s.t * s.t * s.m * s.m;
  return p > 0 ? std::sqrt(2 / (p + std::sqrt(p * p + 4 * q))) : std::numeric_limits<double>::infinity();
}

Share scaled(const Share& s, double bulge) {
  const double a = reach(s, bulge);
  return {a * s.t, a * s.m};
}

// The point of the surface from which plastic slip, normal to it, leads to `trial` (t, m >= 0, outside): springs of the patch stretch by
// t and by ratio m, ratio = (gyration / r)^2, for the same part of the limits. Newton along the surface from the radial point, kept
// between the points known to lie on either side.
Share returned(const Share& trial, double ratio, double bulge) {
  Share s = scaled(trial, bulge);
  double low = 0, high = 1;  // of m / (t + m)
  for (int i = 0; i < 60; ++i) {
    const double et = trial.t - s.t, em = trial.m - s.m;
    const double nt = s.t * (1 + bulge * s.m * s.m), nm = s.m * (1 + bulge * s.t * s.t) * ratio;
    const double miss = et * nm - em * nt;  // 0 where the way back is normal; grows along the surface towards m
    const double size = trial.t * nm + trial.m * nt;
    if (std::fabs(miss) <= 1e-12 * size) break;
    (miss < 0 ? low : high) = s.m / (s.t + s.m);
    const double dt = -nm / ratio, dm = nt, cross = 2 * bulge * s.t * s.m;
    const double slope =
        dm * nt - dt * nm + et * ratio * (dm * (1 + bulge * s.t * s.t) + cross * dt) - em * (dt * (1 + bulge * s.m * s.m) + cross * dm);
    const double t = s.t - miss / slope * dt, m = s.m - miss / slope * dm;
    const bool between = slope > 0 && t >= 0 && m > low * (t + m) && m < high * (t + m);
    s = scaled(between ? Share{t, m} : Share{1 - (low + high) / 2, (low + high) / 2}, bulge);
    if (between && std::fabs(miss) <= 1e-5 * size) break;  // the square of that is left
  }
  return s;
}

struct Held {
  bool slips = false;
  Vec3 force = Vec3::Zero();
  double torsion = 0;  // about the centre of pressure
};

// What of `trial` and its torsion `about` the patch bears that resists with `limit` (N) and limit r (N m).
Held hold(const Patch& patch, const Vec3& trial, double about, double limit, double r, double gyration) {
  Held out;
  if (!(limit > 0)) {
    out.slips = true;
    return out;
  }
  const double pull = trial.norm();
  const Share share{pull / limit, r > 0 ? std::fabs(about) / (limit * r) : 0.0};
  if (share.t * share.t + share.m * share.m <= surely_within && (r > 0 || about == 0)) return out;
  double bulge = 0, ratio = 1;
  if (pull > 0 && r > 0) {
    const Vec3 e = trial / pull;
    const double middle = patch.centroid.dot(e);
    bulge = bulge_of((e.dot(patch.second * e) / patch.area - middle * middle) / (r * r));
    ratio = gyration * gyration / (r * r);
  }
  const bool over = reach(share, bulge) < 1;
  if (!over && (r > 0 || about == 0)) return out;
  const Share left = over ? returned(share, ratio, bulge) : share;
  out.slips = true;
  if (pull > 0) out.force = left.t * limit / pull * trial;
  out.torsion = std::copysign(left.m * limit * r, about);
  return out;
}

}  // namespace

Friction patch_friction(Pair& pair, const Patch& patch, const PairPose& pose, const Motion& motion, double normal_force,
                        double inverse_mass, double settling) {
  Friction out;
  const Vec3 centre = patch.centroid + pose.shift, n = patch.normal;
  Vec3 slip = Vec3::Zero();
  double spin = 0;
  if (!pair.touching) {
    pair.n = n;
    pair.c = centre;
    pair.u.setZero();
    pair.psi = pair.area = pair.gyration = 0;
  } else {
    slip_increment(pair, pose, patch.centroid, n, slip, spin);
  }
  carry(pair, patch, centre, spin);
  const double kt = pair.law.ks * pair.area, kr = kt * pair.gyration * pair.gyration;
  const Vec3 u0 = pair.u;
  const double psi0 = pair.psi;
  pair.u += slip;
  pair.psi += spin;
  const Vec3 u1 = pair.u;
  const double psi1 = pair.psi;
  const double ct = inverse_mass > 0 ? 2 * settling * std::sqrt(kt / inverse_mass) : 0;
  Vec3 at_centre = motion.linear + motion.angular.cross(patch.centroid);
  at_centre -= at_centre.dot(n) * n;
  Vec3 viscous = -ct * at_centre;
  double viscous_torsion = -ct * pair.gyration * pair.gyration * motion.angular.dot(n);
  Vec3 t = -kt * pair.u;
  double m = -kr * pair.psi;
  const Vec3 off = patch.centroid - patch.pressure_centre;
  const double limit = pair.law.mu * normal_force, r = torsion_radius(patch.area, patch.gyration);
  const Vec3 trial = t + viscous;
  const double trial_torsion = m + viscous_torsion;
  const double about = trial_torsion + off.cross(trial).dot(n);
  const Held held = hold(patch, trial, about, limit, r, pair.gyration);
  if (held.slips) {
    t = held.force;
    m = held.torsion - off.cross(t).dot(n);
    viscous.setZero();
    viscous_torsion = 0;
    pair.u = kt > 0 ? Vec3(-t / kt) : Vec3(Vec3::Zero());
    pair.psi = kr > 0 ? -m / kr : 0.0;
    if (!(kr > 0)) m = 0;
  }
  out.slipped = 0.5 * kt * (u0 + pair.u).dot(u1 - pair.u) + 0.5 * kr * (psi0 + pair.psi) * (psi1 - pair.psi);
  out.stored = 0.5 * kt * pair.u.squaredNorm() + 0.5 * kr * pair.psi * pair.psi;
  out.force = t;
  out.moment = patch.centroid.cross(t) + m * n;
  out.viscous_force = viscous;
  out.viscous_moment = patch.centroid.cross(viscous) + viscous_torsion * n;
  return out;
}

}  // namespace erbs
