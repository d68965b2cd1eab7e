#include "engine/contact/law/friction.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/contact/law/pair.h"

namespace erbs {
namespace {

// Rotates v as the normal rotates from n to m, then by `spin` about m.
Vec3 carried(const Vec3& v, const Vec3& n, const Vec3& m, double spin) {
  const Vec3 axis = n.cross(m);
  const double cosine = n.dot(m);
  Vec3 r = v;
  if (cosine > -0.5) r = v * cosine + axis.cross(v) + axis * (axis.dot(v) / (1 + cosine));
  else r.setZero();  // reversed normal: a new contact
  r -= r.dot(m) * m;
  return r * std::cos(spin) + m.cross(r) * std::sin(spin);
}

// Slip of the other body's material at x (pair axes, from its centroid) and its rotation about n since the last step. Both follow from the
// two poses, exactly under any common rigid motion.
void slip_increment(const ContactPair& pair, const PairPose& pose, const Vec3& x, const Vec3& n, Vec3& slip, double& spin) {
  const Mat3 change = pair.rotation * pose.rotation.transpose();  // from present to previous pair axes
  slip = x + pose.shift - change * x - pair.shift;
  slip -= slip.dot(n) * n;
  spin = -0.5 * (n.x() * (change(2, 1) - change(1, 2)) + n.y() * (change(0, 2) - change(2, 0)) + n.z() * (change(1, 0) - change(0, 1)));
}

// Transports the springs to the present patch: normal, centre, stiffness.
void carry(ContactPair& pair, const Patch& patch, const Vec3& centre, double spin) {
  pair.u = carried(pair.u, pair.n, patch.normal, spin / 2);
  pair.n = patch.normal;
  pair.u -= pair.psi * pair.n.cross(pair.c - centre);  // the slip field stays; its reference point moves
  pair.u -= pair.u.dot(pair.n) * pair.n;
  pair.c = centre;
  // Growth conserves force and torsion: stiffer springs store less. Shrinking changes nothing, so a patch of varying size is no ratchet.
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

// Limit surface of a patch under uniform pressure, with force t and torsion m as shares of the limit of each alone:
//   f(t, m) = t^2 + m^2 + bulge t^2 m^2 = 1.
// Coulomb friction over the face gives the surface point by point (Goyal, Ruina and Papadopoulos 1991, Wear 143, 307). The ellipse,
// bulge 0, is too strong where both act. A disc that spins fast slides under t = (2/3) v / (r w); a disc that slides fast rotates under
// m = (9/16) r w / v. The ellipse has 1 in place of 2/3 and 9/16; f has 1 / (1 + bulge).
struct Share {
  double t, m;
};

// Distance of the surface inside the ellipse, from `along`, the patch's second moment along the slip over r^2. Source: Coulomb friction at
// v = r w over the disc, and over rectangles 1:1 to 3:1 along, across and at 45 degrees. 1.29 - 1.25 x agrees with all of them within .05.
double shape_factor_of(double along) { return std::clamp(1.29 - 1.25 * along, -0.4, 1.3); }
static_assert(surely_within + 1.3 * surely_within * surely_within / 4 < 1);  // below this t^2 + m^2 no bulge reaches the surface

// Factor a that scales s onto the surface: a^2 (t^2 + m^2) + bulge a^4 t^2 m^2 = 1.
double scale_to_surface(const Share& s, double shape_factor) {
  const double p = s.t * s.t + s.m * s.m, q = shape_factor * s.t * s.t * s.m * s.m;
  return p > 0 ? std::sqrt(2 / (p + std::sqrt(p * p + 4 * q))) : std::numeric_limits<double>::infinity();
}

Share share_of(const PatchLimit& b, const Vec3& force, double about) {
  return {force.norm() / b.limit, b.r > 0 ? std::fabs(about) / (b.limit * b.r) : 0.0};
}

struct TrialState {
  Vec3 force = Vec3::Zero();
  double torsion = 0, about = 0;  // N m, about the centroid; about the centre of pressure
};

// Result of a slip normal to the surface at its end point, as Coulomb's law over the face requires. The slip is x p t / kt at the centre of
// pressure, with a rotation of x q M / (kt r^2); p and q are the slopes of f over 2 t and 2 m. From `trial` and `torsion` then
//   t (1 + x p) + x q M lever / r^2 = trial,   M (1 + x q gyration^2 / r^2) = torsion + lever . t.
// This slip never generates energy, however far the two centres are apart; separate returns of t and M do. Here for r = 0, a point.
TrialState slipped(const PatchLimit& b, const Vec3& trial, double torsion, double x) {
  const double soft = 1 + x, stiff = b.gyration2 + b.lever.squaredNorm() / soft;
  const double rotation = stiff > 0 ? (torsion + b.lever.dot(trial) / soft) / stiff : 0;  // leaves no torsion
  TrialState out;
  out.force = (trial - rotation * b.lever) / soft;
  return out;
}

// The same for a patch, and ending on the surface: Newton's method for A = x p and B = x q, with A q = B p and f = 1. Slopes and f are
// those of the point scaled onto the surface; F is the square of the scale. F = 1 is written in the form that is exact in one step if force
// acts alone. So the method converges from any trial in some five steps. A secant method with p and q of the last step may cycle.
TrialState returned_to_patch(const PatchLimit& b, const Vec3& trial, double torsion) {
  const double pulled = b.lever.dot(trial), size2 = trial.squaredNorm(), lever2 = b.lever.squaredNorm(), per_r2 = 1 / (b.r * b.r);
  const double per_t = 1 / (b.limit * b.limit), per_m = per_t * per_r2;
  double A = 0, B = 0;
  TrialState out;
  for (int i = 0; i < 12; ++i) {
    const double S = 1 / (1 + A), weight = B * per_r2, stiff = b.gyration2 + lever2 * S, per_n = 1 / (1 + weight * stiff);
    const double M = (torsion + pulled * S) * per_n, rotation = weight * M, across = pulled - rotation * lever2;
    const double t2 = S * S * (size2 - rotation * (pulled + across)) * per_t, m2 = M * M * per_m;
    const double root = std::sqrt((t2 + m2) * (t2 + m2) + 4 * b.shape_factor * t2 * m2), F = (t2 + m2 + root) / 2;
    const double t = t2 / F, m = m2 / F, p = 1 + b.shape_factor * m, q = 1 + b.shape_factor * t, miss = 2 * F * (std::sqrt(F) - 1),
                 g = A * q - B * p;
    out.force = S * (trial - rotation * b.lever);
    out.about = M;
    if (std::fabs(miss) < 2e-11 && std::fabs(g) <= 1e-9 * (A + B)) break;
    const double M_A = -S * S * across * per_n, M_B = -M * stiff * per_r2 * per_n;
    const double t_A = -2 * (S * t2 + S * S * across * weight * M_A * per_t), m_A = 2 * M * M_A * per_m;
    const double t_B = -2 * S * S * across * (M * per_r2 + weight * M_B) * per_t, m_B = 2 * M * M_B * per_m;
    const double F_A = F * (t_A * p + m_A * q) / root, F_B = F * (t_B * p + m_B * q) / root;
    const double g_A = q + b.shape_factor * (A * (t_A - t * F_A) - B * (m_A - m * F_A)) / F;
    const double g_B = b.shape_factor * (A * (t_B - t * F_B) - B * (m_B - m * F_B)) / F - p;
    const double whole = F_A * g_B - F_B * g_A;
    if (whole == 0) break;
    A = std::max(0.0, A - (miss * g_B - g * F_B) / whole);
    B = std::max(0.0, B - (F_A * g - g_A * miss) / whole);
  }
  return out;
}

// The same for a point, which transmits no torsion: secant method for 1 / sqrt(f) - 1, which is linear in x if the lever is zero.
TrialState returned_to_point(const PatchLimit& b, const Vec3& trial, double torsion) {
  double low = 0, high = std::numeric_limits<double>::infinity(), x = 0, x_before = 0, h_before = 0;
  TrialState out;
  for (int i = 0; i < 60; ++i) {
    out = slipped(b, trial, torsion, x);
    const double t = out.force.norm() / b.limit, h = t > 0 ? 1 / t - 1 : 1;
    if (std::fabs(h) < 1e-10 || (x == 0 && h >= 0)) break;
    (h < 0 ? low : high) = x;
    double next = i == 0 ? t - 1 : x - h * (x - x_before) / (h - h_before);
    if (!(next > low && next < high)) next = std::isinf(high) ? 2 * x + 1 : (low + high) / 2;
    x_before = x, h_before = h, x = next;
  }
  return out;
}

TrialState returned(const PatchLimit& b, const Vec3& trial, double torsion) {
  TrialState out = b.r > 0 ? returned_to_patch(b, trial, torsion) : returned_to_point(b, trial, torsion);
  const double left =
      std::min(1.0, scale_to_surface(share_of(b, out.force, out.about), b.shape_factor));  // remaining error of the iteration
  out.force *= left;
  out.about *= left;
  out.torsion = out.about - b.lever.dot(out.force);
  return out;
}

void set_shape_factor(PatchLimit& b, const Patch& patch, const Vec3& force) {
  const double pull = force.norm();
  if (!(pull > 0) || !(b.r > 0)) return;
  const Vec3 e = force / pull;
  const double middle = patch.centroid.dot(e);
  b.shape_factor = shape_factor_of((e.dot(patch.second * e) / patch.area - middle * middle) / (b.r * b.r));
}

// True if the springs stick; sets the bulge if it matters.
bool holds(PatchLimit& b, const Patch& patch, const Vec3& force, double about) {
  if (!(b.limit > 0) || (!(b.r > 0) && about != 0)) return false;
  const Share s = share_of(b, force, about);
  if (s.t * s.t + s.m * s.m <= surely_within) return true;
  set_shape_factor(b, patch, force);
  return scale_to_surface(s, b.shape_factor) >= 1;
}

// Share of the dashpots that the patch can transmit besides springs that stick.
double bearable(PatchLimit& b, const Patch& patch, const Vec3& force, double about, const Vec3& viscous, double viscous_about) {
  const Share all = share_of(b, force + viscous, about + viscous_about);
  if (all.t * all.t + all.m * all.m <= surely_within) return 1;
  set_shape_factor(b, patch, force);
  if (scale_to_surface(all, b.shape_factor) >= 1) return 1;
  double low = 0, high = 1;
  for (int i = 0; i < 30; ++i) {
    const double middle = (low + high) / 2;
    (scale_to_surface(share_of(b, force + middle * viscous, about + middle * viscous_about), b.shape_factor) >= 1 ? low : high) = middle;
  }
  return low;
}

}  // namespace

ReturnResult return_map(PatchLimit b, const Patch& patch, const Pull& springs, const Pull& dashpots) {
  const double about = springs.torsion + b.lever.dot(springs.force);
  if (!holds(b, patch, springs.force, about)) {
    if (!(b.limit > 0)) return {{}, 0, true};
    const TrialState left = returned(b, springs.force, springs.torsion);
    return {{left.force, left.torsion}, 0, true};
  }
  if (!(b.limit > 0)) return {springs, 0, false};
  // Dashpots use the part of the limit that the springs leave, and the springs alone decide on slip. If slip began where both together
  // reach the limit, springs would be stretched without motion. A contact that trembles near its limit would then gain energy.
  return {springs, bearable(b, patch, springs.force, about, dashpots.force, dashpots.torsion + b.lever.dot(dashpots.force)), false};
}

Friction patch_friction(ContactPair& pair, const Patch& patch, const PairPose& pose, const Motion& motion, double normal_force,
                        double inverse_mass, double settling, const Interlock& interlock) {
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
  const double spin_rate = motion.angular.dot(n);
  pair.mean_normal_force =
      pair.mean_normal_force > 0 ? pair.mean_normal_force + (normal_force - pair.mean_normal_force) * interlock.rate : normal_force;
  if (pair.mean_normal_force > normal_force && at_centre.squaredNorm() < interlock.slow) normal_force = pair.mean_normal_force;
  const Pull springs{-kt * pair.u, -kr * pair.psi}, dashpots{-ct * at_centre, -ct * pair.gyration * pair.gyration * spin_rate};
  const PatchLimit patch_limit{pair.law.mu * normal_force, torsion_radius(patch.area, patch.gyration), 0, pair.gyration * pair.gyration,
                               n.cross(patch.centroid - patch.pressure_centre)};
  const ReturnResult result = return_map(patch_limit, patch, springs, dashpots);
  const Vec3 t = result.springs.force;
  const double m = kr > 0 ? result.springs.torsion : 0.0;
  if (result.slips) {
    pair.u = kt > 0 ? Vec3(-t / kt) : Vec3(Vec3::Zero());
    pair.psi = kr > 0 ? -m / kr : 0.0;
  }
  out.viscous_force = result.share * dashpots.force;
  out.viscous_moment = patch.centroid.cross(out.viscous_force) + result.share * dashpots.torsion * n;
  out.slipped = 0.5 * kt * (u0 + pair.u).dot(u1 - pair.u) + 0.5 * kr * (psi0 + pair.psi) * (psi1 - pair.psi);
  out.stored = 0.5 * kt * pair.u.squaredNorm() + 0.5 * kr * pair.psi * pair.psi;
  out.force = t;
  out.moment = patch.centroid.cross(t) + m * n;
  return out;
}

}  // namespace erbs
