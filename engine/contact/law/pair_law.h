// The law of a touching pair: pressure, impact dashpot, friction, energies and bounds of the step. T is a number or a pack.
#pragma once
#include "engine/contact/law/friction_law.h"

namespace erbs::ERBS_TARGET {

// Reads the rows of pairs and blocks and sets the relative pose.
template <class T>
static void gather_pairs(PairPackFor<T>& w) {
  read(w.pair, pair_rows, w.p);
  read(w.reference, block_rows, w.r);
  read(w.other, block_rows, w.o);
  // Relative positions first: a shift of the whole scene by 1e4 m must not cost digits.
  const Vec3<T> apart = (load3(w.o + b_rest) - load3(w.r + b_rest)) + (load3(w.o + b_u) - load3(w.r + b_u));
  const Mat3<T> back = transposed(columns<T>(w.r + b_rotation)), other = transposed(columns<T>(w.o + b_rotation));
  store3(w.shift, back * apart);
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) store(w.rotation[3 * i + k], dot(back.row[i], other.row[k]));
  }
}

// Motion of the other body relative to the reference, as of a body with its centroid at the origin of the pair axes. Velocities belong to
// half a step before the pose, so the vector between the bodies is that of the same instant. Otherwise a pair in rigid rotation would seem
// to separate at dt / 2 w x (w x r).
template <class T>
ERBS_INLINE void relative_motion(PairPackFor<T>& w, const PairSettings& set) {
  const Mat3<T> rotation = columns<T>(w.r + b_rotation), back = transposed(rotation);
  const Vec3<T> away = load3(w.o + b_v) - load3(w.r + b_v), rw = load3(w.r + b_w), n = load3(w.normal);
  const Vec3<T> apart = rotation * load3(w.shift) - 0.5 * set.drift * away;
  const Vec3<T> linear = back * (away - cross(rw, apart)), angular = back * (load3(w.o + b_w) - rw);
  store3(w.linear, linear);
  store3(w.angular, angular);
  store(w.along, -dot(n, linear));
  store3(w.angular_part, cross(angular, n));
}

// The patch from its sums, as `finish_patch()` in `general.h`, and the motion of the bodies.
template <class T>
static void patch(PairPackFor<T>& w, const PairSettings& set) {
  Lanes<T> sums[24];
  const double* from[lanes_of<T>];
  for (int l = 0; l < lanes_of<T>; ++l) from[l] = &w.sums[l].total;
  read(from, 3, sums);
  const Vec3<T> force = load3(sums + 14);
  const T total = load<T>(sums[0]), area = load<T>(sums[4]), size = sqrt(dot(force, force));
  const MaskFor<T> there = (total > 0) & (area > 0) & (size > 0);
  const Vec3<T> pressure = load3(sums + 1), first = load3(sums + 5), centroid = (1 / nonzero(area)) * first,
                n = (1 / nonzero(size)) * force;
  const T spread = (load<T>(sums[8]) + load<T>(sums[9]) + load<T>(sums[10])) / nonzero(area) - dot(centroid, centroid);
  store(w.total, select(there, total, T(0)));
  store(w.area, area);
  store(w.size, size);
  store3(w.force, force);
  store3(w.moment, load3(sums + 17));
  store3(w.normal, n);
  store3(w.centroid, centroid);
  store3(w.pressure_centre, (1 / nonzero(total)) * pressure);
  store(w.gyration, sqrt(max(spread, 0)));
  for (int k = 0; k < 6; ++k) store(w.second[k], load<T>(sums[8 + k]));
  relative_motion<T>(w, set);
}

// What a blow wants of its dashpot beyond the cap. Where a heavy body lands on a light one, the blow lasts as the heavy one swings, but
// the step bears a dashpot of the light one alone: with it .85 of the speed was left where .48 should be (V67). The rest acts in series
// with a spring of `lag_stiffness` kn A (Maxwell's element; beside the spring of the contact Zener's solid). To the trembling of the light
// body it is a spring, which the step bears once it is shorter by the root of 1 + lag_stiffness at most (`slip_omega2` asks for it); until
// then the spring is only as stiff as the step bears. To the blow it is the dashpot. With lag_stiffness = 2 X it follows in half the time,
// depth / v_i, in which the bodies sink in.
//
// Only blows lag: faster than a few times the reference speed, `lag_from` times stronger than the cap, and no deeper than all moving blocks
// as one body would press at their speed: what a motion presses deeper is no blow.
inline constexpr double lag_from_speed = 4, lag_per_impact = 2;
template <class T>
ERBS_INLINE void begin_lag(PairPackFor<T>& w, const PairSettings& set, T wanted, T chi) {
  const T area = load<T>(w.area), depth = load<T>(w.total) / nonzero(area), kn = load<T>(w.p[p_kn]), spring = kn * area;
  const T inverse_mass = load<T>(w.inverse_mass), speed = load<T>(w.p[p_peak_closing_speed]);
  const T slow = lag_from_speed * set.reference_speed / speed, deepest = speed * sqrt(set.falling_mass / nonzero(spring));
  const T blow = wanted * min(1, deepest / nonzero(depth)), strong = min(blow / nonzero(set.lag_from * chi) - 1, 1);
  const T beyond = max(blow - chi, 0) * max(strong, 0) * max(1 - slow * slow, 0);                                     // s/m
  const T whole = beyond * depth / nonzero(set.dt), stiffness = min(whole, lag_per_impact * load<T>(w.p[p_impact]));  // over kn A
  const T allowed = max(1 / nonzero(spring * inverse_mass * (set.dt * set.dt)) - 1, 0), tracks = min(stiffness, allowed) / nonzero(whole);
  store(w.lag_stiffness, select(inverse_mass > 0, stiffness, T(0)));
  store(w.lag_keeps, select(stiffness > 0, 1 - tracks, T(0)));
  store(w.lag_takes, tracks * beyond / nonzero(chi));
}

// Hunt and Crossley's factor chi (s/m) for the present impact, plus a small linear one for the settled contact. The linear one is written
// in the same form; its coefficient is 2 settling sqrt(kn A m). The explicit step caps the sum, with x = dt^2 kn A / m:
//   one contact with the velocity of half a step before: x + 2 c dt / m < 4;
//   n equal contacts on each block count n-fold in the worst mode: c dt / m < (4 / n - x) / 2, of which 0.9 is used;
//   at least a quarter, which a heap allows (`time_step_bound.cpp`), and at most 1 / (1 + n), since others may close in the same step.
// A capped dashpot misses the requested restitution. Bricks that fall flat rebound with at least 0.43 at a cap of a quarter, and with
// 0.19 to 0.33 at a half (V22).
template <class T>
static void dashpot(PairPackFor<T>& w, const PairSettings& set) {
  const Vec3<T> x = load3(w.pressure_centre), n = load3(w.normal);
  const Vec3<T> r = cross(x + load3(w.shift), n), o = transposed(relative_rotation<T>(w)) * cross(x, n);
  // of both bodies at x along n
  const T inverse_mass =
      load<T>(w.r[b_mass]) + load<T>(w.o[b_mass]) + dot(r, columns<T>(w.r + b_tensor) * r) + dot(o, columns<T>(w.o + b_tensor) * o);
  const T before = load<T>(w.p[p_peak_closing_speed]), kn = load<T>(w.p[p_kn]), impact = load<T>(w.p[p_impact]), total = load<T>(w.total),
          area = load<T>(w.area);
  // A blow of a face on one spring lasts pi over its circular frequency: until some time after, its speed is not forgotten. Then it decays
  // slowly against the duration of a soft impact (about 3 depth / speed on a corner).
  constexpr double blow_angle = 6;
  const T memory = select(before > 0, max(set.memory, 30 * load<T>(w.max_depth) / nonzero(before)), T(set.memory));
  const T age = load<T>(w.blow_age), closing_speed = load<T>(w.closing_speed);
  const MaskFor<T> lasts = kn * area * inverse_mass * (age * age) < blow_angle * blow_angle;
  const T remembered = select(lasts, before, before * (1 - min(1, set.dt / memory)));
  const T peak_closing_speed = max(max(remembered, closing_speed), set.reference_speed);
  store(w.blow_age, select(closing_speed > remembered, T(0), age + set.dt));
  // fades with speed: restitution governs an impact
  const T slow = set.reference_speed / peak_closing_speed, share = set.settling * slow * slow;
  const T pressing = kn * nonzero(total);
  T chi = impact / peak_closing_speed + 2 * share * sqrt(kn * area / nonzero(inverse_mass)) / pressing;
  const T contact_count = load<T>(w.contact_count), square = kn * area * inverse_mass * (set.dt * set.dt);
  const T bears = max(0.25, min(1 / (1 + contact_count), 0.45 * (4 / contact_count - square)));
  const T wanted = chi;
  if (set.dt > 0) chi = min(chi, bears / (nonzero(inverse_mass) * pressing * set.dt));
  store(w.p[p_peak_closing_speed], peak_closing_speed);
  store(w.inverse_mass, inverse_mass);
  store(w.chi, select(inverse_mass > 0, chi, T(0)));
  store(w.limit, select(inverse_mass > 0, 1 + max(impact, 1), T(1)));
  begin_lag<T>(w, set, wanted, chi);
}

// A wrench on the other body: force, moment on it and moment on the reference, world axes.
template <class T>
struct Wrench {
  Vec3<T> force, other, reference;

  friend ERBS_INLINE Wrench operator+(const Wrench& a, const Wrench& b) {
    return {a.force + b.force, a.other + b.other, a.reference + b.reference};
  }
};
template <class T>
ERBS_INLINE Wrench<T> to_world(const Mat3<T>& rotation, Vec3<T> shift, Vec3<T> force, Vec3<T> moment) {
  return {rotation * force, rotation * moment, -(rotation * (moment + cross(shift, force)))};
}
// As ContactPair and PairResult store it: force on b, moments on a and b.
template <class T>
ERBS_INLINE Wrench<T> load_wrench(const Lanes<T>* x, MaskFor<T> swapped) {
  const Vec3<T> force = load3(x), a = load3(x + 3), b = load3(x + 6);
  return {select(swapped, -force, force), select(swapped, a, b), select(swapped, b, a)};
}
template <class T>
ERBS_INLINE void store_wrench(Lanes<T>* x, const Wrench<T>& w, MaskFor<T> swapped) {
  store3(x, select(swapped, -w.force, w.force));
  store3(x + 3, select(swapped, w.other, w.reference));
  store3(x + 6, select(swapped, w.reference, w.other));
}

// Contact does not pull: of a wedge that leans, one face may press back, and the dashpot, which those that press forward make, exceeds the
// net pressure. Adds the lagging part to the capped dashpot, at the centre of pressure: the rocking of the faces is damped by the capped
// one alone.
template <class T>
static void lagging(PairPackFor<T>& w) {
  const T last = load<T>(w.lag), size = load<T>(w.size), limit = load<T>(w.limit), pressing = load<T>(w.damping[0]),
          kn = load<T>(w.p[p_kn]);
  const T total = max(pressing, -size), less = select(pressing < -size, total / select(pressing < 0, pressing, T(-1)), T(1));
  store(w.damping[0], total);
  for (int i = 0; i < 3; ++i) store(w.damping[1 + i], less * load<T>(w.damping[1 + i]));
  const MaskFor<T> lags = load<T>(w.lag_stiffness) > 0;
  store(w.lag, T(0));  // never -0: the bits of a pair must not depend on its neighbours in the pack
  if (!any(lags)) return;
  const auto bounded = [&](T x) { return max(-size, min((limit - 1) * size, x)); };
  const T lag = bounded(load<T>(w.lag_keeps) * last / nonzero(kn) + load<T>(w.lag_takes) * total), now = bounded(total + lag);
  const Vec3<T> first = load3(w.damping + 1);
  store(w.lag, select(lags, kn * lag, T(0)));
  store(w.damping[0], select(lags, now, total));
  store3(w.damping + 1, select(lags, first + (now - total) * load3(w.pressure_centre), first));
}

// The friction springs after the return map.
template <class T>
struct Springs {
  Vec3<T> u, force;   // m, N
  T psi, torsion;     // rad, N m, about the centroid
  T stored, slipped;  // J; J, lost in plastic slip this step
};
template <class T>
ERBS_INLINE Springs<T> springs_after(const PairPackFor<T>& w) {
  const MaskFor<T> slips = load<T>(w.slips) > 0;
  const T kt = load<T>(w.kt), kr = load<T>(w.kr), m = select(kr > 0, load<T>(w.torsion), T(0)), psi0 = load<T>(w.psi0),
          psi1 = load<T>(w.psi1);
  const Vec3<T> t = load3(w.springs), u0 = load3(w.u0), u1 = load3(w.u1);
  const Vec3<T> u = select(slips, select(kt > 0, (-1 / nonzero(kt)) * t, Vec3<T>{}), u1);
  const T psi = select(slips, select(kr > 0, -m / nonzero(kr), T(0)), psi1);
  return {
      u, t, psi, m, 0.5 * kt * dot(u, u) + 0.5 * kr * psi * psi, 0.5 * kt * dot(u0 + u, u1 - u) + 0.5 * kr * (psi0 + psi) * (psi1 - psi)};
}

// The share of a pair in the largest eigenvalue of one of its blocks `b` (1/s2). `arm`: the patch from the centroid of the block. `axis`:
// arm x n in the axes of its tensor. `relative`: from those axes to the pair axes; null if they are the same.
//
// The patch resists with at most kn A along its normal and kt across; its spread about the centroid adds the gyration to the arms.
// Dashpots are not in the sum, since they act on the velocity of half a step before. dashpot() and the cap of the tangential dashpot limit
// each to a quarter of m / dt. An explicit step allows this beside springs at this bound (dt^2 k / m + 2 c dt / m < 4).
//
// Rotations first count with the greatest inverse inertia J. For a slender body this is far too much; then the tensor A (pair axes) counts:
// tr(A N S N^T) for a pressure of second moment S about an axis across n, n.A n gyration^2 about n, tr(A) r^2 - r.A r for a force at r.
template <class T>
static T omega2_on(const PairPackFor<T>& w, const PairSettings& set, const Lanes<T>* b, Vec3<T> arm, Vec3<T> axis,
                   const Mat3<T>* relative) {
  const T gyration = load<T>(w.p[p_gyration]), spread = gyration * gyration, area = load<T>(w.area);
  const T normal = load<T>(w.p[p_kn]) * area, tangential = load<T>(w.p[p_ks]) * load<T>(w.p[p_area]);
  const T mass = load<T>(b[b_mass]), inertia = load<T>(b[b_inertia]), square = dot(arm, arm);
  const Mat3<T> tensor = columns<T>(b + b_tensor);
  T bend = spread * inertia, twist = bend, sway = square * inertia;
  if (const MaskFor<T> thin = bend + sway > set.slender * mass; any(thin)) {
    const Vec3<T> n = load3(w.normal), x = load3(w.centroid);
    Mat3<T> A = tensor;
    for (int i = 0; relative != nullptr && i < 3; ++i) A.row[i] = *relative * (tensor * relative->row[i]);
    const T xy = load<T>(w.second[3]), yz = load<T>(w.second[4]), zx = load<T>(w.second[5]);
    const Vec3<T> S[3] = {Vec3<T>{load<T>(w.second[0]), xy, zx} - (area * x.x) * x,
                          Vec3<T>{xy, load<T>(w.second[1]), yz} - (area * x.y) * x,
                          Vec3<T>{zx, yz, load<T>(w.second[2])} - (area * x.z) * x};
    const Mat3<T> NS = transposed(Mat3<T>{{cross(n, S[0]), cross(n, S[1]), cross(n, S[2])}});
    const T bent =
        (dot(A.row[0], cross(n, NS.row[0])) + dot(A.row[1], cross(n, NS.row[1])) + dot(A.row[2], cross(n, NS.row[2]))) / nonzero(area);
    const T swayed = (A.row[0].x + A.row[1].y + A.row[2].z) * square - dot(arm, A * arm);
    bend = select(thin, min(bend, bent), bend);
    twist = select(thin, min(twist, spread * dot(n, A * n)), twist);
    sway = select(thin, min(sway, swayed), sway);
  }
  return normal * (mass + dot(axis, tensor * axis) + bend) + tangential * (mass + sway + twist);
}

// Wrenches and losses. Each loss is the work of its own wrench, half a step of the last one and half a step of the present one.
template <class T>
ERBS_INLINE void act(PairPackFor<T>& w, const PairSettings& set, const Springs<T>& springs, MaskFor<T> swapped) {
  const T kn = load<T>(w.p[p_kn]), share = load<T>(w.share), damping = load<T>(w.damping[0]);
  const Vec3<T> n = load3(w.normal), x = load3(w.centroid), shift = load3(w.shift), first = load3(w.damping + 1);
  const Mat3<T> rotation = columns<T>(w.r + b_rotation);
  const Vec3<T> viscous = share * load3(w.dashpots);
  const Wrench<T> elastic = to_world<T>(rotation, shift, kn * load3(w.force), kn * load3(w.moment));
  const Wrench<T> damped = to_world<T>(rotation, shift, (kn * damping) * n + viscous,
                                       kn * cross(first, n) + cross(x, viscous) + (share * load<T>(w.dashpot_torsion)) * n);
  const Wrench<T> friction = to_world<T>(rotation, shift, springs.force, cross(x, springs.force) + springs.torsion * n);
  const Vec3<T> speed = load3(w.o + b_v) - load3(w.r + b_v), spin_other = load3(w.o + b_w), spin = load3(w.r + b_w);
  const auto power = [&](const Wrench<T>& a) { return dot(a.force, speed) + dot(a.other, spin_other) + dot(a.reference, spin); };
  const auto work = [&](const Lanes<T>* last, const Wrench<T>& now) {
    const T before = power(load_wrench<T>(last, swapped));
    return 0.5 * set.dt * ((set.booked > 0 ? T(0) : before) + power(now));
  };
  store(w.result[f_friction], -work(w.p + p_friction, friction) - (springs.stored - load<T>(w.p[p_tangential])));
  store(w.result[f_damping], -work(w.p + p_damping, damped));
  store_wrench<T>(w.result + f_wrench, elastic + damped + friction, swapped);
  store_wrench<T>(w.p + p_friction, friction, swapped);
  store_wrench<T>(w.p + p_damping, damped, swapped);
}

// Writes the rows of pairs and results.
template <class T>
static void finish(PairPackFor<T>& w, const PairSettings& set) {
  const MaskFor<T> swapped = load<T>(w.swapped) > 0;
  const Springs<T> springs = springs_after<T>(w);
  act<T>(w, set, springs, swapped);
  lend<T>(w, set);
  Lanes<T>* out = w.result;
  store(out[f_tangential], springs.stored);
  const T omega2 = load<T>(w.p[p_kn]) * load<T>(w.area) * load<T>(w.inverse_mass), stiffer = load<T>(w.lag_stiffness);
  store(out[f_slip_omega2], select((springs.slipped > 0) | (stiffer > 0), omega2 * (1 + stiffer), T(0)));
  store(out[f_depth], load<T>(w.max_depth));
  const Vec3<T> n = load3(w.normal), x = load3(w.centroid), shift = load3(w.shift), arm = x + shift;
  const Mat3<T> relative = relative_rotation<T>(w);
  const T other = omega2_on<T>(w, set, w.o, x, transposed(relative) * cross(x, n), &relative),
          reference = omega2_on<T>(w, set, w.r, arm, cross(arm, n), nullptr);
  store(out[f_omega2_a], select(swapped, other, reference));
  store(out[f_omega2_b], select(swapped, reference, other));
  store3(w.p + p_u, springs.u);
  store(w.p[p_psi], springs.psi);
  store(w.p[p_tangential], springs.stored);
  store3(w.p + p_shift, shift);
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) store(w.p[p_rotation + 3 * k + i], load<T>(w.rotation[3 * i + k]));
  }
}

}  // namespace erbs::ERBS_TARGET
