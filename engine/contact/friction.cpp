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
  const double use =
      limit > 0 ? std::hypot(trial.norm() / limit, r > 0 ? about / (limit * r) : 0.0) : std::numeric_limits<double>::infinity();
  if (use > 1 || (r <= 0 && about != 0)) {
    const double scale = use > 1 ? 1 / use : 1;
    t = scale * trial;
    m = (r > 0 ? scale * about : 0.0) - off.cross(t).dot(n);
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
