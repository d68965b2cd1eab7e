// Coulomb friction of a patch: two slips and a torsion at its area centroid, limit about its centre of pressure. T is a number or a pack.
#pragma once
#include <math.h>

#include "engine/contact/law/friction_limit.h"
#include "engine/contact/law/pair_lanes.h"
#include "engine/contact/law/pair_rows.h"
#include "engine/simd/vec3.h"

namespace erbs::ERBS_TARGET {

template <class T>
static void sine_and_cosine(T x, T& sine, T& cosine) {
  const T y = x * x;
  sine = x * (1 - (1.0 / 6) * y * (1 - (1.0 / 20) * y * (1 - (1.0 / 42) * y * (1 - (1.0 / 72) * y))));
  cosine = 1 - 0.5 * y * (1 - (1.0 / 12) * y * (1 - (1.0 / 30) * y * (1 - (1.0 / 56) * y)));
  if (!any(y > 0.0025)) return;
  Lanes<T> angle, s, c;
  store(angle, x), store(s, sine), store(c, cosine);
  for (int l = 0; l < lanes_of<T>; ++l)
    if (angle[l] * angle[l] > 0.0025) s[l] = sin(angle[l]), c[l] = cos(angle[l]);  // the series does not reach round-off here
  sine = load<T>(s), cosine = load<T>(c);
}

// The number whose exponent and mantissa, as one integer, are a third of those of x > 0.
ERBS_INLINE double third_of_exponent(double x) {
  long long bits;
  __builtin_memcpy(&bits, &x, sizeof bits);
  bits = static_cast<long long>(static_cast<double>(bits) * (1.0 / 3)) + (715094163ll << 32);
  __builtin_memcpy(&x, &bits, sizeof x);
  return x;
}
template <int n>
ERBS_INLINE PackOf<n> third_of_exponent(PackOf<n> x) {
  if constexpr (n > register_size) {
    return {third_of_exponent(x.low), third_of_exponent(x.high)};
  } else {
    typedef long long Bits __attribute__((vector_size(8 * n)));
    using Doubles = typename PackOf<n>::Register;
    const Doubles third = __builtin_convertvector(Bits(x.v), Doubles) * (1.0 / 3);
    return Doubles(__builtin_convertvector(third, Bits) + (715094163ll << 32));
  }
}

// Cube root of x > 0, by Halley's rule from a third of the exponent.
template <class T>
static T cube_root(T x) {
  T y = third_of_exponent(x);  // to 5 %
  for (int i = 0; i < 3; ++i) {
    const T cube = y * y * y;
    y = y * (cube + 2 * x) / (2 * cube + x);
  }
  return y;
}

// Radius r of the torsion limit mu N r of a patch with this area and polar radius of gyration, Int |x| dA / A. It is .866 gyration for a
// line and .937 gyration for a square. An interpolation between both by area / gyration^2 (6 for a square) holds for rectangles within .4
// %.
template <class T>
static T torsion_radius(T area, T gyration) {
  const T fill = max(min(area / (6 * nonzero(gyration) * nonzero(gyration)), T(1.1)), 1e-30);
  return select(gyration > 0, gyration * (0.866 + 0.0711 * fill * cube_root(fill)), T(0));
}

// Rotates v as the normal rotates from n to m, then about m by an angle with this sine and cosine.
template <class T>
ERBS_INLINE Vec3<T> carried(Vec3<T> v, Vec3<T> n, Vec3<T> m, T sine, T cosine) {
  const Vec3<T> axis = cross(n, m);
  const T between = dot(n, m);
  const MaskFor<T> same_side = between > -0.5;  // a reversed normal is a new contact
  Vec3<T> r = between * v + cross(axis, v) + (dot(axis, v) / select(same_side, 1 + between, T(1))) * axis;
  r = select(same_side, r, Vec3<T>{});
  r = r - dot(r, m) * m;
  return cosine * r + sine * cross(m, r);
}

// Slip of the other body's material at x and its rotation about n since the last step. Both follow from the two poses, exactly under any
// common rigid motion.
template <class T>
struct SlipIncrement {
  Vec3<T> slip;  // m, in the plane of the patch
  T spin;        // rad
};
template <class T>
ERBS_INLINE SlipIncrement<T> slip_increment(const PairPackFor<T>& w, Vec3<T> n, Vec3<T> x, Vec3<T> centre) {
  const Mat3<T> now = relative_rotation<T>(w), last = columns<T>(w.p + p_rotation);
  Mat3<T> change;  // from present to previous pair axes
  for (int i = 0; i < 3; ++i) change.row[i] = {dot(last.row[i], now.row[0]), dot(last.row[i], now.row[1]), dot(last.row[i], now.row[2])};
  const Vec3<T> slip = centre - change * x - load3(w.p + p_shift);
  const Vec3<T> twist{change.row[2].y - change.row[1].z, change.row[0].z - change.row[2].x, change.row[1].x - change.row[0].y};
  return {slip - dot(slip, n) * n, -0.5 * dot(n, twist)};
}

// Transports the springs to the present patch and stretches them by the slip since the last step.
template <class T>
ERBS_INLINE void stretch_springs(PairPackFor<T>& w) {
  const Vec3<T> n = load3(w.normal), x = load3(w.centroid), centre = x + load3(w.shift);
  const auto [slip, spin] = slip_increment<T>(w, n, x, centre);
  T sine, cosine;
  sine_and_cosine<T>(spin / 2, sine, cosine);
  T psi = load<T>(w.p[p_psi]);
  Vec3<T> u = carried<T>(load3(w.p + p_u), load3(w.p + p_n), n, sine, cosine);
  u = u - psi * cross(n, load3(w.p + p_c) - centre);  // the slip field stays; its reference point moves
  u = u - dot(u, n) * n;
  // Growth conserves force and torsion: stiffer springs store less. Shrinking changes nothing, so a patch of varying size is no ratchet.
  const T area = load<T>(w.p[p_area]), gyration = load<T>(w.p[p_gyration]), area_now = load<T>(w.area), gyration_now = load<T>(w.gyration);
  const T ratio = select(area_now > area, area / nonzero(area_now), T(1));
  u = ratio * u;
  psi = psi * ratio * select(gyration_now > gyration, gyration * gyration / nonzero(gyration_now * gyration_now), T(1));
  store3(w.u0, u);
  store(w.psi0, psi);
  store3(w.u1, u + slip);
  store(w.psi1, psi + spin);
  store(w.p[p_area], max(area, area_now));
  store(w.p[p_gyration], max(gyration, gyration_now));
  store3(w.p + p_n, n);
  store3(w.p + p_c, centre);
}

// Springs stick, whatever the shape of the patch, while the squares of force and torsion over their limits add up to no more than this.
inline constexpr double surely_within = 0.79;
static_assert(surely_within + 1.3 * surely_within * surely_within / 4 < 1);  // with no shape factor do they reach the surface

// Trial forces of springs and dashpots, their limit, and whether they surely stay within it.
template <class T>
static void trial_forces(PairPackFor<T>& w, const PairSettings& set) {
  const Vec3<T> n = load3(w.normal), x = load3(w.centroid), centre = x + load3(w.shift);
  const T gyration = load<T>(w.p[p_gyration]), kt = load<T>(w.p[p_ks]) * load<T>(w.p[p_area]), kr = kt * gyration * gyration;
  // upper bound for any direction of slip
  const T inverse_mass =
      load<T>(w.r[b_mass]) + load<T>(w.o[b_mass]) + dot(centre, centre) * load<T>(w.r[b_inertia]) + dot(x, x) * load<T>(w.o[b_inertia]);
  // The dashpot of a blow presses before the springs have wound up. One in the same form along the face keeps the ratio of both.
  const T of_blow = load<T>(w.p[p_ks]) * load<T>(w.total) * load<T>(w.chi);
  T ct = 2 * set.settling_tangential * sqrt(kt / nonzero(inverse_mass)) + of_blow;
  if (set.dt > 0) ct = min(ct, 0.25 / (nonzero(inverse_mass) * set.dt));
  ct = select(inverse_mass > 0, ct, T(0));
  const Vec3<T> angular = load3(w.angular), there = load3(w.linear) + cross(angular, x), across = there - dot(there, n) * n;
  const Vec3<T> pull = -(kt * load3(w.u1)), dashpots = -(ct * across);
  const T torsion = -kr * load<T>(w.psi1), dashpot_torsion = -ct * gyration * gyration * dot(angular, n);
  const Vec3<T> lever = cross(n, x - load3(w.pressure_centre));
  const T limit = friction_limit<T>(w, set, across), radius = torsion_radius<T>(load<T>(w.area), load<T>(w.gyration)),
          torsion_limit = limit * radius;
  const auto within = [&](Vec3<T> t, T m) -> MaskFor<T> {
    const T about = m + dot(lever, t), a = dot(t, t) / nonzero(limit * limit), b = about / nonzero(torsion_limit);
    return a + b * b <= surely_within;
  };
  const MaskFor<T> has_limit = limit > 0, has_size = radius > 0, alone = within(pull, torsion),
                   together = within(pull + dashpots, torsion + dashpot_torsion);
  store(w.kt, kt);
  store(w.kr, kr);
  store3(w.springs, pull);
  store(w.torsion, torsion);
  store3(w.dashpots, dashpots);
  store(w.dashpot_torsion, dashpot_torsion);
  store3(w.lever, lever);
  store(w.most, limit);
  store(w.radius, radius);
  store(w.share, T(1));
  store(w.slips, T(0));
  store(w.holds, select(has_limit & has_size & alone & together, T(1), T(0)));
}

template <class T>
static void springs(PairPackFor<T>& w, const PairSettings& set) {
  stretch_springs<T>(w);
  trial_forces<T>(w, set);
}

// Limit surface of a patch under uniform pressure, with force t and torsion m as shares of the limit of each alone:
//   f(t, m) = t^2 + m^2 + shape_factor t^2 m^2 = 1.
// Coulomb friction over the face gives the surface point by point (Goyal, Ruina and Papadopoulos 1991, Wear 143, 307). The ellipse, shape
// factor 0, is too strong where both act. A disc that spins fast slides under t = (2/3) v / (r w); a disc that slides fast rotates under
// m = (9/16) r w / v. The ellipse has 1 in place of 2/3 and 9/16; f has 1 / (1 + shape_factor).
template <class T>
struct LimitSurface {
  T per_force2, per_torsion2;  // 1/N2, 1/(N m)2: 1 / limit^2, 1 / (limit r)^2
  T shape_factor, gyration2, lever2, per_r2;
  Vec3<T> lever;  // m, n x (centroid - centre of pressure)
};
// The shape factor, from `along`, the patch's second moment along the slip over r^2. Source: Coulomb friction at v = r w over the disc, and
// over rectangles 1:1 to 3:1 along, across and at 45 degrees. 1.29 - 1.25 x agrees with all of them within .05.
template <class T>
ERBS_INLINE T shape_factor_of(T along) {
  return min(max(1.29 - 1.25 * along, -0.4), 1.3);
}

template <class T>
struct Shares {
  T t2, m2;
};
template <class T>
ERBS_INLINE Shares<T> shares_of(const LimitSurface<T>& b, Vec3<T> force, T about) {
  return {dot(force, force) * b.per_force2, about * about * b.per_torsion2};
}
// f; on the surface t^2 + m^2 is below 1.13. With a shape factor below zero f falls again far outside, where t^2 + m^2 takes its place.
template <class T>
ERBS_INLINE T surface(const LimitSurface<T>& b, const Shares<T>& s) {
  const T p = s.t2 + s.m2;
  return select(p > 2, p, p + b.shape_factor * s.t2 * s.m2);
}

// Return of trial forces to the surface by a slip normal to it at its end point, as Coulomb's law over the face requires. The slip is
// x p t / kt at the centre of pressure, with a rotation of x q M / (kt r^2); p and q are the slopes of f over 2 t and 2 m. From the trial
// values then
//   t (1 + x p) + x q M lever / r^2 = trial,   M (1 + x q gyration^2 / r^2) = torsion + lever . t.
// This slip never generates energy, however far the two centres are apart; separate returns of t and M do.
template <class T>
struct Return {
  LimitSurface<T> b;
  Vec3<T> trial;
  T torsion, pulled, size2;  // trial torsion; lever . trial; trial . trial
  MaskFor<T> wanted;         // lanes still on their way
  T A = 0, B = 0, scale = 1;
  Vec3<T> force;  // N, so far; it is `scale` times as far as the surface
  T about;        // N m, about the centre of pressure
};
// Starts where the straight way back to zero meets the surface. That costs half of the iteration that it saves.
template <class T>
ERBS_INLINE void start_return(Return<T>& r) {
  const LimitSurface<T>& b = r.b;
  const Shares<T> s = shares_of<T>(b, r.trial, r.torsion + r.pulled);
  const T sum = s.t2 + s.m2, F = nonzero((sum + sqrt(sum * sum + 4 * b.shape_factor * s.t2 * s.m2)) / 2), per_F = 1 / F;
  const T p = 1 + b.shape_factor * s.m2 * per_F, q = 1 + b.shape_factor * s.t2 * per_F, stiff = (b.gyration2 + b.lever2) * b.per_r2;
  const T x = max(sqrt(F) - 1, 0) * sum / nonzero(s.t2 * p + s.m2 * q * stiff);
  r.A = select(r.wanted, x * p, T(0));
  r.B = select(r.wanted, x * q, T(0));
}
// Newton's method for A = x p and B = x q, with A q = B p and f = 1. Slopes and f are those of the point scaled onto the surface; F is the
// square of the scale. F = 1 is written in the form that is exact in one step if force acts alone. So the method converges from any trial
// in some five steps. A secant method with p and q of the last step may cycle.
template <class T>
static void return_once(Return<T>& r) {
  const LimitSurface<T>& b = r.b;
  const T A = r.A, B = r.B, pulled = r.pulled, per_t = b.per_force2, per_m = b.per_torsion2;
  MaskFor<T> wanted = r.wanted;
  // S = 1 / (1 + A) and 1 / (1 + weight * stiff) by one quotient: eight quotients take as long as a dozen products.
  const T soft = 1 + A, weight = B * b.per_r2, whole_n = soft + weight * (soft * b.gyration2 + b.lever2), per_both = 1 / (soft * whole_n);
  const T S = per_both * whole_n, stiff = b.gyration2 + b.lever2 * S, per_n = per_both * (soft * soft);
  const T M = (r.torsion + pulled * S) * per_n, rotation = weight * M, across = pulled - rotation * b.lever2;
  const T t2 = S * S * (r.size2 - rotation * (pulled + across)) * per_t, m2 = M * M * per_m;
  const T root = nonzero(sqrt((t2 + m2) * (t2 + m2) + 4 * b.shape_factor * t2 * m2)), F = (t2 + m2 + root) / 2, per_F_root = 1 / (F * root),
          per_F = per_F_root * root;
  const T t = t2 * per_F, m = m2 * per_F, p = 1 + b.shape_factor * m, q = 1 + b.shape_factor * t, scale = sqrt(F),
          miss = 2 * F * (scale - 1);
  const T g = A * q - B * p;
  r.force = select(wanted, S * (r.trial - rotation * b.lever), r.force);
  r.about = select(wanted, M, r.about);
  r.scale = select(wanted, scale, r.scale);
  const MaskFor<T> is_on = abs(miss) < 2e-11, is_normal = abs(g) <= 1e-9 * (A + B);
  wanted &= !(is_on & is_normal);
  const T M_A = -S * S * across * per_n, M_B = -M * stiff * b.per_r2 * per_n;
  const T t_A = -2 * (S * t2 + S * S * across * weight * M_A * per_t), m_A = 2 * M * M_A * per_m;
  const T t_B = -2 * S * S * across * (M * b.per_r2 + weight * M_B) * per_t, m_B = 2 * M * M_B * per_m;
  const T steep = F * F * per_F_root, F_A = steep * (t_A * p + m_A * q), F_B = steep * (t_B * p + m_B * q);
  const T g_A = q + b.shape_factor * (A * (t_A - t * F_A) - B * (m_A - m * F_A)) * per_F;
  const T g_B = b.shape_factor * (A * (t_B - t * F_B) - B * (m_B - m * F_B)) * per_F - p;
  const T whole = F_A * g_B - F_B * g_A, per = 1 / select(whole == 0, T(1), whole);
  r.wanted = wanted & (whole != 0);
  r.A = max(A - (miss * g_B - g * F_B) * per, 0);
  r.B = max(B - (F_A * g - g_A * miss) * per, 0);
}

inline constexpr int most_iterations = 12;
// An iteration is one long chain of operations, so those of two packs overlap.
template <class T>
static void return_both(Return<T>& one, Return<T>& other) {
  bool again = any(one.wanted), other_again = any(other.wanted);
  for (int i = 0; i < most_iterations && (again || other_again); ++i) {
    if (again && other_again) {
      return_once<T>(one);
      return_once<T>(other);
    } else {
      return_once<T>(again ? one : other);
    }
    again = any(one.wanted);
    other_again = any(other.wanted);
  }
}

// The share x of the dashpots with which the limit is just reached beside springs within it, in the lanes wanted: Newton's method from the
// far side, kept within bounds.
template <class T>
static T bearable(const LimitSurface<T>& b, Vec3<T> force, T about, Vec3<T> viscous, T viscous_about, MaskFor<T> wanted) {
  const T t1 = 2 * dot(force, viscous) * b.per_force2, t2 = dot(viscous, viscous) * b.per_force2;
  const T m1 = 2 * about * viscous_about * b.per_torsion2, m2 = viscous_about * viscous_about * b.per_torsion2;
  const Shares<T> at = shares_of<T>(b, force, about);
  T low{}, high = T(1), x = T(1);
  wanted &= surface<T>(b, {at.t2 + t1 + t2, at.m2 + m1 + m2}) > 1;
  for (int i = 0; i < 40 && any(wanted); ++i) {
    const Shares<T> s{at.t2 + x * (t1 + x * t2), at.m2 + x * (m1 + x * m2)};
    const T f = surface<T>(b, s) - 1, dt = t1 + 2 * x * t2, dm = m1 + 2 * x * m2;
    const T slope = select(s.t2 + s.m2 > 2, T(0), dt + dm + b.shape_factor * (dt * s.m2 + s.t2 * dm));
    wanted &= abs(f) > 1e-12;
    low = select(f <= 0, x, low);
    high = select(f <= 0, high, x);
    const T next = x - f / nonzero(slope);
    const MaskFor<T> rises = slope > 0, is_between = (next > low) & (next < high);
    x = select(wanted, select(rises & is_between, next, (low + high) / 2), x);
  }
  return x;
}

// Limit surface of a pair in whose patch the springs pull with t.
template <class T>
ERBS_INLINE LimitSurface<T> limit_surface(const PairPackFor<T>& w, Vec3<T> t) {
  const T r = load<T>(w.radius), gyration = load<T>(w.p[p_gyration]), per_limit = 1 / nonzero(load<T>(w.most)), per_r = 1 / nonzero(r),
          pull = sqrt(dot(t, t));
  const Vec3<T> e = (1 / nonzero(pull)) * t, lever = load3(w.lever);
  const T xx = load<T>(w.second[0]), yy = load<T>(w.second[1]), zz = load<T>(w.second[2]), xy = load<T>(w.second[3]),
          yz = load<T>(w.second[4]), zx = load<T>(w.second[5]);
  const Vec3<T> second_e{xx * e.x + xy * e.y + zx * e.z, xy * e.x + yy * e.y + yz * e.z, zx * e.x + yz * e.y + zz * e.z};
  const T middle = dot(load3(w.centroid), e), spread = dot(e, second_e) / nonzero(load<T>(w.area)) - middle * middle;
  return {per_limit * per_limit,
          per_limit * per_limit * per_r * per_r,
          select(pull > 0, shape_factor_of<T>(spread * per_r * per_r), T(0)),
          gyration * gyration,
          dot(lever, lever),
          per_r * per_r,
          lever};
}

// Return map of a pack, in the lanes that springs() was not sure about and whose patch has a size and a limit.
template <class T>
struct ReturnMap {
  MaskFor<T> wanted, slips;
  T share;
  Return<T> r;
};
template <class T>
ERBS_INLINE void begin_return(const PairPackFor<T>& w, ReturnMap<T>& to) {
  const MaskFor<T> unsure = load<T>(w.holds) == 0, has_limit = load<T>(w.most) > 0, has_size = load<T>(w.radius) > 0,
                   touches = load<T>(w.total) > 0, wanted = unsure & has_limit & has_size & touches;
  to.wanted = to.slips = to.r.wanted = wanted;
  if (!any(wanted)) return;
  const Vec3<T> t = load3(w.springs), v = load3(w.dashpots), lever = load3(w.lever);
  const LimitSurface<T> b = limit_surface<T>(w, t);
  const T torsion = load<T>(w.torsion), pulled = dot(lever, t), about = torsion + pulled,
          viscous_about = load<T>(w.dashpot_torsion) + dot(lever, v);
  // Dashpots use the part of the limit that the springs leave, and the springs alone decide on slip. If slip began where both together
  // reach the limit, springs would be stretched without motion. A contact that trembles near its limit would then gain energy.
  const MaskFor<T> is_past = surface<T>(b, shares_of<T>(b, t, about)) > 1, slips = wanted & is_past, sticks = wanted & !slips;
  to.slips = slips;
  to.share = select(sticks, bearable<T>(b, t, about, v, viscous_about, sticks), select(slips, T(0), load<T>(w.share)));
  to.r.b = b;
  to.r.trial = t, to.r.torsion = torsion, to.r.pulled = pulled, to.r.size2 = dot(t, t);
  to.r.wanted = slips;
  to.r.force = t, to.r.about = about;
  start_return<T>(to.r);
}

template <class T>
ERBS_INLINE void end_return(const ReturnMap<T>& from, PairPackFor<T>& w) {
  const MaskFor<T> wanted = from.wanted, slips = from.slips;
  if (!any(wanted)) return;
  const T left = min(1, 1 / from.r.scale);  // remaining error of the iteration
  const Vec3<T> t = load3(w.springs), lever = load3(w.lever), force = left * from.r.force;
  const T about = left * from.r.about;
  store3(w.springs, select(slips, force, t));
  store(w.torsion, select(slips, about - dot(lever, force), load<T>(w.torsion)));
  store(w.share, from.share);
  store(w.slips, select(slips, T(1), load<T>(w.slips)));
  store(w.holds, select(wanted, T(1), load<T>(w.holds)));
}

// Limits the trial forces of springs(), then the dashpots to the remaining part of the limit. `holds` stays 0 for a pair that is left to
// `return_point()`.
template <class T>
static void return_map(PairPackFor<T>& w) {
  ReturnMap<T> one{};
  begin_return<T>(w, one);
  for (int i = 0; i < most_iterations && any(one.r.wanted); ++i) return_once<T>(one.r);
  end_return<T>(one, w);
}
template <class T>
static void return_map(PairPackFor<T>& w, PairPackFor<T>& other) {
  ReturnMap<T> one, two;
  begin_return<T>(w, one);
  begin_return<T>(other, two);
  return_both<T>(one.r, two.r);
  end_return<T>(one, w);
  end_return<T>(two, other);
}

}  // namespace erbs::ERBS_TARGET
