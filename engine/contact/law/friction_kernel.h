// The friction of eight patches side by side: friction.cpp, term by term.
#pragma once
#include <math.h>

#include "engine/contact/law/pair_lanes.h"
#include "engine/contact/law/pair_rows.h"
#include "engine/simd/vec3.h"

namespace erbs::ERBS_TARGET {

static void sine_and_cosine(Pack x, Pack& sine, Pack& cosine) {
  const Pack y = x * x;
  sine = x * (1 - (1.0 / 6) * y * (1 - (1.0 / 20) * y * (1 - (1.0 / 42) * y * (1 - (1.0 / 72) * y))));
  cosine = 1 - 0.5 * y * (1 - (1.0 / 12) * y * (1 - (1.0 / 30) * y * (1 - (1.0 / 56) * y)));
  if (!any(y > 0.0025)) return;
  double s[8], c[8];
  store(s, sine), store(c, cosine);
  for (int l = 0; l < 8; ++l)
    if (y[l] > 0.0025) s[l] = sin(x[l]), c[l] = cos(x[l]);  // where the series does not reach round-off
  sine = load(s), cosine = load(c);
}

// The number whose exponent and mantissa, as one integer, are a third of those of x > 0.
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

// Of x > 0, by Halley's rule from a third of the exponent.
static Pack cube_root(Pack x) {
  Pack y = third_of_exponent(x);  // to 5 %
  for (int i = 0; i < 3; ++i) {
    const Pack cube = y * y * y;
    y = y * (cube + 2 * x) / (2 * cube + x);
  }
  return y;
}

// As torsion_radius().
static Pack torsion_radius(Pack area, Pack gyration) {
  const Pack fill = max(min(area / (6 * nonzero(gyration) * nonzero(gyration)), Pack(1.1)), 1e-30);
  return select(gyration > 0, gyration * (0.866 + 0.0711 * fill * cube_root(fill)), Pack(0));
}

// v turned as the normal turns from n to m, and by an angle of this sine and cosine about m.
static Pack3 carried(Pack3 v, Pack3 n, Pack3 m, Pack sine, Pack cosine) {
  const Pack3 axis = cross(n, m);
  const Pack between = dot(n, m);
  const Mask over = between > -0.5;  // else turned over: a new contact
  Pack3 r = between * v + cross(axis, v) + (dot(axis, v) / select(over, 1 + between, Pack(1))) * axis;
  r = select(over, r, Pack3{});
  r = r - dot(r, m) * m;
  return cosine * r + sine * cross(m, r);
}

static void springs(PairPack& w, const PairSettings& set) {
  const Pack3 n = load3(w.normal), x = load3(w.centroid), shift = load3(w.shift), centre = x + shift;
  // slip and turn about n since the last step, from the two poses
  const Mat3<Pack> now = relative_rotation(w), last = columns(w.p + p_rotation);
  Mat3<Pack> change;  // takes pair axes of now to those of before
  for (int i = 0; i < 3; ++i) change.row[i] = {dot(last.row[i], now.row[0]), dot(last.row[i], now.row[1]), dot(last.row[i], now.row[2])};
  Pack3 slip = centre - change * x - load3(w.p + p_shift);
  slip = slip - dot(slip, n) * n;
  const Pack3 twist{change.row[2].y - change.row[1].z, change.row[0].z - change.row[2].x, change.row[1].x - change.row[0].y};
  const Pack spin = -0.5 * dot(n, twist);
  Pack sine, cosine;
  sine_and_cosine(spin / 2, sine, cosine);
  // carried to the patch of now
  Pack psi = load(w.p[p_psi]), area = load(w.p[p_area]), gyration = load(w.p[p_gyration]);
  Pack3 u = carried(load3(w.p + p_u), load3(w.p + p_n), n, sine, cosine);
  u = u - psi * cross(n, load3(w.p + p_c) - centre);
  u = u - dot(u, n) * n;
  const Pack wide = load(w.area), gyration_now = load(w.gyration);
  const Pack ratio = select(wide > area, area / nonzero(wide), Pack(1));
  u = ratio * u;
  const Pack narrower = select(gyration_now > gyration, gyration * gyration / nonzero(gyration_now * gyration_now), Pack(1));
  psi = psi * ratio * narrower;
  area = max(area, wide);
  gyration = max(gyration, gyration_now);
  store3(w.u0, u);
  store(w.psi0, psi);
  u = u + slip;
  psi += spin;
  const Pack kt = load(w.p[p_ks]) * area, kr = kt * gyration * gyration;
  const Pack inverse_mass =
      load(w.r[b_mass]) + load(w.o[b_mass]) + dot(centre, centre) * load(w.r[b_inertia]) + dot(x, x) * load(w.o[b_inertia]);
  const Pack ct = select(inverse_mass > 0, 2 * set.settling_tangential * sqrt(kt / nonzero(inverse_mass)), Pack(0));
  const Pack3 angular = load3(w.angular), there = load3(w.linear) + cross(angular, x), across = there - dot(there, n) * n;
  const Pack3 pull = -(kt * u), dashpots = -(ct * across);
  const Pack torsion = -kr * psi, dashpot_torsion = -ct * gyration * gyration * dot(angular, n);
  const Pack3 lever = cross(n, x - load3(w.pressure_centre));
  // interlock.h; lies_flat() of pair.cpp
  const Mask flat = wide * (load(w.r[b_inertia]) + load(w.o[b_inertia])) > set.flat_face * (load(w.r[b_mass]) + load(w.o[b_mass]));
  const Pack rate = select(flat, Pack(set.rate), Pack(0)), slow = select(flat, Pack(set.slow), Pack(0));
  const Pack now_pressed = load(w.p[p_kn]) * load(w.size), before = load(w.p[p_mean_normal_force]),
             mean = select(before > 0, before + (now_pressed - before) * rate, now_pressed);
  const Mask holds_on = (mean > now_pressed) & (dot(across, across) < slow);
  const Pack most_force = load(w.p[p_mu]) * select(holds_on, mean, now_pressed), radius = torsion_radius(wide, gyration_now),
             most_torsion = most_force * radius;
  // borne surely: springs alone, and with the dashpots
  const Mask able = (most_force > 0) & (radius > 0);
  const auto within = [&](Pack3 t, Pack m) -> Mask {
    const Pack about = m + dot(lever, t), a = dot(t, t) / nonzero(most_force * most_force), b = about / nonzero(most_torsion);
    return a + b * b <= set.surely_within;
  };
  const Mask sure = able & within(pull, torsion) & within(pull + dashpots, torsion + dashpot_torsion);
  store3(w.u1, u);
  store(w.psi1, psi);
  store(w.p[p_area], area);
  store(w.p[p_mean_normal_force], mean);
  store(w.p[p_gyration], gyration);
  store3(w.p + p_n, n);
  store3(w.p + p_c, centre);
  store(w.kt, kt);
  store(w.kr, kr);
  store3(w.springs, pull);
  store(w.torsion, torsion);
  store3(w.dashpots, dashpots);
  store(w.dashpot_torsion, dashpot_torsion);
  store3(w.lever, lever);
  store(w.most, most_force);
  store(w.radius, radius);
  store(w.share, Pack(1));
  store(w.slips, Pack(0));
  store(w.holds, select(sure, Pack(1), Pack(0)));
}

// The law of friction.cpp, term by term, where springs and dashpots may reach the limit.
struct Limits {
  Pack per_force2, per_torsion2;  // 1 / limit^2, 1 / (limit r)^2
  Pack shape_factor, gyration2, across, per_r2;
  Pack3 lever;
};
struct Shares {
  Pack t2, m2;
};
static inline Shares shares_of(const Limits& b, Pack3 force, Pack about) {
  return {dot(force, force) * b.per_force2, about * about * b.per_torsion2};
}
// f, as far as the surface reaches (t^2 + m^2 is below 1.13 on it): with a bulge below zero f falls again far outside.
static inline Pack surface(const Limits& b, const Shares& s) {
  const Pack p = s.t2 + s.m2;
  return select(p > 2, p, p + b.shape_factor * s.t2 * s.m2);
}

struct TrialPack {
  Pack3 force;
  Pack about;
};

// As returned_to_patch(): what is on the way, where it begins, and a round of it.
struct Returning {
  Limits b;
  Pack3 trial;
  Pack torsion, pulled, size2;
  Mask wanted;
  Pack A = 0, B = 0, scale = 1;  // out is this times as far as the surface
  TrialPack out;
};
// From where the way straight back to nothing meets the surface: half as dear as the round it saves.
static void start(Returning& r) {
  const Limits& b = r.b;
  const Shares s = shares_of(b, r.trial, r.torsion + r.pulled);
  const Pack sum = s.t2 + s.m2, F = nonzero((sum + sqrt(sum * sum + 4 * b.shape_factor * s.t2 * s.m2)) / 2), per_F = 1 / F;
  const Pack p = 1 + b.shape_factor * s.m2 * per_F, q = 1 + b.shape_factor * s.t2 * per_F, stiff = (b.gyration2 + b.across) * b.per_r2;
  const Pack x = max(sqrt(F) - 1, 0) * sum / nonzero(s.t2 * p + s.m2 * q * stiff);
  r.A = select(r.wanted, x * p, Pack(0));
  r.B = select(r.wanted, x * q, Pack(0));
}
static void return_once(Returning& r) {
  const Limits& b = r.b;
  const Pack A = r.A, B = r.B, pulled = r.pulled, per_t = b.per_force2, per_m = b.per_torsion2;
  Mask wanted = r.wanted;
  // S = 1 / (1 + A) and 1 / (1 + weight * stiff) by one quotient: eight take as long as a dozen products
  const Pack soft = 1 + A, weight = B * b.per_r2, whole_n = soft + weight * (soft * b.gyration2 + b.across),
             per_both = 1 / (soft * whole_n);
  const Pack S = per_both * whole_n, stiff = b.gyration2 + b.across * S, per_n = per_both * (soft * soft);
  const Pack M = (r.torsion + pulled * S) * per_n, rotation = weight * M, across = pulled - rotation * b.across;
  const Pack t2 = S * S * (r.size2 - rotation * (pulled + across)) * per_t, m2 = M * M * per_m;
  const Pack squared = nonzero(sqrt((t2 + m2) * (t2 + m2) + 4 * b.shape_factor * t2 * m2)), F = (t2 + m2 + squared) / 2,
             per_F_squared = 1 / (F * squared), per_F = per_F_squared * squared;
  const Pack t = t2 * per_F, m = m2 * per_F, p = 1 + b.shape_factor * m, q = 1 + b.shape_factor * t, scale = sqrt(F),
             miss = 2 * F * (scale - 1);
  const Pack g = A * q - B * p;
  r.out = {select(wanted, S * (r.trial - rotation * b.lever), r.out.force), select(wanted, M, r.out.about)};
  r.scale = select(wanted, scale, r.scale);
  wanted &= !((abs(miss) < 2e-11) & (abs(g) <= 1e-9 * (A + B)));
  const Pack M_A = -S * S * across * per_n, M_B = -M * stiff * b.per_r2 * per_n;
  const Pack t_A = -2 * (S * t2 + S * S * across * weight * M_A * per_t), m_A = 2 * M * M_A * per_m;
  const Pack t_B = -2 * S * S * across * (M * b.per_r2 + weight * M_B) * per_t, m_B = 2 * M * M_B * per_m;
  const Pack steep = F * F * per_F_squared, F_A = steep * (t_A * p + m_A * q), F_B = steep * (t_B * p + m_B * q);
  const Pack g_A = q + b.shape_factor * (A * (t_A - t * F_A) - B * (m_A - m * F_A)) * per_F;
  const Pack g_B = b.shape_factor * (A * (t_B - t * F_B) - B * (m_B - m * F_B)) * per_F - p;
  const Pack whole = F_A * g_B - F_B * g_A, per = 1 / select(whole == 0, Pack(1), whole);
  r.wanted = wanted & (whole != 0);
  r.A = max(A - (miss * g_B - g * F_B) * per, 0);
  r.B = max(B - (F_A * g - g_A * miss) * per, 0);
}

// A round is one long chain of operations: those of two batches overlap.
static void return_both(Returning& one, Returning& other) {
  bool again = any(one.wanted), other_again = any(other.wanted);
  for (int i = 0; i < 12 && (again || other_again); ++i) {
    if (again && other_again) {
      return_once(one);
      return_once(other);
    } else {
      return_once(again ? one : other);
    }
    again = any(one.wanted);
    other_again = any(other.wanted);
  }
}

// The share x of the dashpots with which the limit is just reached, in lanes marked, whose springs alone are within it: Newton's rule
// from the far side, kept between bounds.
static Pack bearable(const Limits& b, Pack3 force, Pack about, Pack3 viscous, Pack viscous_about, Mask wanted) {
  const Pack t1 = 2 * dot(force, viscous) * b.per_force2, t2 = dot(viscous, viscous) * b.per_force2;
  const Pack m1 = 2 * about * viscous_about * b.per_torsion2, m2 = viscous_about * viscous_about * b.per_torsion2;
  const Shares at = shares_of(b, force, about);
  Pack low{}, high = Pack(1), x = Pack(1);
  wanted &= surface(b, {at.t2 + t1 + t2, at.m2 + m1 + m2}) > 1;
  for (int i = 0; i < 40 && any(wanted); ++i) {
    const Shares s{at.t2 + x * (t1 + x * t2), at.m2 + x * (m1 + x * m2)};
    const Pack f = surface(b, s) - 1, dt = t1 + 2 * x * t2, dm = m1 + 2 * x * m2;
    const Pack slope = select(s.t2 + s.m2 > 2, Pack(0), dt + dm + b.shape_factor * (dt * s.m2 + s.t2 * dm));
    wanted &= abs(f) > 1e-12;
    low = select(f <= 0, x, low);
    high = select(f <= 0, high, x);
    const Pack then = x - f / nonzero(slope);
    x = select(wanted, select((slope > 0) & (then > low) & (then < high), then, (low + high) / 2), x);
  }
  return x;
}

// Of the lanes that springs() was not sure about, those whose patch has a size and a limit; the others are left to the caller.
struct ReturnMapPack {
  Mask wanted, slips;
  Pack share;
  Returning r;
};
static void begin_return(const PairPack& w, ReturnMapPack& to) {
  const Pack force_limit = load(w.most), r = load(w.radius), area = load(w.area), gyration = load(w.p[p_gyration]);
  const Mask wanted = (load(w.holds) == 0) & (force_limit > 0) & (r > 0) & (load(w.total) > 0);
  to.wanted = to.slips = to.r.wanted = wanted;
  if (!any(wanted)) return;
  const Pack3 t = load3(w.springs), v = load3(w.dashpots), lever = load3(w.lever);
  const Pack per_limit = 1 / nonzero(force_limit), per_r = 1 / nonzero(r), pull = sqrt(dot(t, t)), torsion = load(w.torsion);
  const Pack3 e = (1 / nonzero(pull)) * t;
  const Pack xx = load(w.second[0]), yy = load(w.second[1]), zz = load(w.second[2]), xy = load(w.second[3]), yz = load(w.second[4]),
             zx = load(w.second[5]);
  const Pack3 second_e{xx * e.x + xy * e.y + zx * e.z, xy * e.x + yy * e.y + yz * e.z, zx * e.x + yz * e.y + zz * e.z};
  const Pack middle = dot(load3(w.centroid), e), spread = dot(e, second_e) / nonzero(area) - middle * middle;
  const Pack shape_factor = min(max(1.29 - 1.25 * (spread * per_r * per_r), -0.4), 1.3);  // shape_factor_of
  const Limits b{per_limit * per_limit,
                 per_limit * per_limit * per_r * per_r,
                 select(pull > 0, shape_factor, Pack(0)),
                 gyration * gyration,
                 dot(lever, lever),
                 per_r * per_r,
                 lever};
  const Pack pulled = dot(lever, t), about = torsion + pulled, viscous_about = load(w.dashpot_torsion) + dot(lever, v);
  const Mask slips = wanted & (surface(b, shares_of(b, t, about)) > 1), sticks = wanted & !slips;
  to.slips = slips;
  to.share = select(sticks, bearable(b, t, about, v, viscous_about, sticks), select(slips, Pack(0), load(w.share)));
  to.r.b = b;
  to.r.trial = t, to.r.torsion = torsion, to.r.pulled = pulled, to.r.size2 = dot(t, t);
  to.r.wanted = slips;
  to.r.out = {t, about};
  start(to.r);
}

static void end_return(const ReturnMapPack& from, PairPack& w) {
  const Mask wanted = from.wanted, slips = from.slips;
  if (!any(wanted)) return;
  const Pack left = min(1, 1 / from.r.scale);  // what the iteration missed
  const Pack3 t = load3(w.springs), lever = load3(w.lever), force = left * from.r.out.force;
  const Pack about = left * from.r.out.about;
  store3(w.springs, select(slips, force, t));
  store(w.torsion, select(slips, about - dot(lever, force), load(w.torsion)));
  store(w.share, from.share);
  store(w.slips, select(slips, Pack(1), load(w.slips)));
  store(w.holds, select(wanted, Pack(1), load(w.holds)));
}

static void return_map(PairPack& w, PairPack& other) {
  ReturnMapPack one, two;
  begin_return(w, one);
  begin_return(other, two);
  return_both(one.r, two.r);
  end_return(one, w);
  end_return(two, other);
}

}  // namespace erbs::ERBS_TARGET
