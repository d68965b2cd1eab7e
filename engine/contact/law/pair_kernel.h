// The law of a touching pair in eight lanes; see pair_lanes.h. The scalar form, term by term, is pair.cpp.
#pragma once
#include "engine/contact/law/friction_kernel.h"
#include "engine/contact/law/pair_lanes.h"
#include "engine/contact/law/pair_rows.h"
#include "engine/simd/vec3.h"

namespace erbs::ERBS_TARGET {

static void gather_pairs(PairPack& w) {
  read(w.pair, pair_rows, w.p);
  read(w.reference, block_rows, w.r);
  read(w.other, block_rows, w.o);
  // Relative positions first: a shift of the whole scene by 1e4 m must not cost digits.
  const Pack3 apart = (load3(w.o + b_rest) - load3(w.r + b_rest)) + (load3(w.o + b_u) - load3(w.r + b_u));
  const Mat3<Pack> back = transposed(columns(w.r + b_rotation)), other = transposed(columns(w.o + b_rotation));
  store3(w.shift, back * apart);
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) store(w.rotation[3 * i + k], dot(back.row[i], other.row[k]));
  }
}

static void patch(PairPack& w, const PairSettings& set) {
  PackArray sums[24];
  const double* from[8];
  for (int l = 0; l < 8; ++l) from[l] = &w.sums[l].total;
  read(from, 3, sums);
  const Pack3 force = load3(sums + 14);
  const Pack total = load(sums[0]), area = load(sums[4]), size = sqrt(dot(force, force));
  const Mask there = (total > 0) & (area > 0) & (size > 0);
  const Pack3 pressure = load3(sums + 1), first = load3(sums + 5), centroid = (1 / nonzero(area)) * first, n = (1 / nonzero(size)) * force;
  const Pack spread = (load(sums[8]) + load(sums[9]) + load(sums[10])) / nonzero(area) - dot(centroid, centroid);
  store(w.total, select(there, total, Pack(0)));
  store(w.area, area);
  store(w.size, size);
  store3(w.force, force);
  store3(w.moment, load3(sums + 17));
  store3(w.normal, n);
  store3(w.centroid, centroid);
  store3(w.pressure_centre, (1 / nonzero(total)) * pressure);
  store(w.gyration, sqrt(max(spread, 0)));
  for (int k = 0; k < 6; ++k) store(w.second[k], load(sums[8 + k]));
  const Mat3<Pack> rotation = columns(w.r + b_rotation), back = transposed(rotation);
  // as motion_of()
  const Pack3 away = load3(w.o + b_v) - load3(w.r + b_v), rw = load3(w.r + b_w);
  const Pack3 apart = rotation * load3(w.shift) - 0.5 * set.dt * away;
  const Pack3 linear = back * (away - cross(rw, apart)), angular = back * (load3(w.o + b_w) - rw);
  store3(w.linear, linear);
  store3(w.angular, angular);
  store(w.along, -dot(n, linear));
  store3(w.angular_part, cross(angular, n));
}

static void dashpot(PairPack& w, const PairSettings& set) {
  const Pack3 x = load3(w.pressure_centre), n = load3(w.normal);
  const Pack3 r = cross(x + load3(w.shift), n), o = transposed(relative_rotation(w)) * cross(x, n);
  const Pack inverse_mass =
      load(w.r[b_mass]) + load(w.o[b_mass]) + dot(r, columns(w.r + b_tensor) * r) + dot(o, columns(w.o + b_tensor) * o);
  const Pack before = load(w.p[p_peak_closing_speed]), kn = load(w.p[p_kn]), impact = load(w.p[p_impact]), total = load(w.total),
             area = load(w.area);
  const Pack memory = select(before > 0, max(set.memory, 30 * load(w.max_depth) / nonzero(before)), Pack(set.memory));
  const Pack forgotten = before * (1 - min(1, set.dt / memory));
  const Pack peak_closing_speed = max(max(forgotten, load(w.closing_speed)), set.reference_speed);
  const Pack slow = set.reference_speed / peak_closing_speed, share = set.settling * slow * slow;
  const Pack pressing = kn * nonzero(total);
  Pack chi = impact / peak_closing_speed + 2 * share * sqrt(kn * area / nonzero(inverse_mass)) / pressing;
  const Pack contact_count = load(w.contact_count), square = kn * area * inverse_mass * (set.dt * set.dt);
  const Pack bears = max(0.25, min(1 / (1 + contact_count), 0.45 * (4 / contact_count - square)));
  if (set.dt > 0) chi = min(chi, bears / (nonzero(inverse_mass) * pressing * set.dt));
  store(w.p[p_peak_closing_speed], peak_closing_speed);
  store(w.inverse_mass, inverse_mass);
  store(w.chi, select(inverse_mass > 0, chi, Pack(0)));
  store(w.limit, select(inverse_mass > 0, 1 + max(impact, 1), Pack(1)));
}

// A wrench on the other body: force, moment on it and moment on the reference, world axes.
struct Wrench {
  Pack3 force, other, reference;
};
static inline Wrench to_world(const Mat3<Pack>& rotation, Pack3 shift, Pack3 force, Pack3 moment) {
  return {rotation * force, rotation * moment, -(rotation * (moment + cross(shift, force)))};
}
static inline Wrench operator+(const Wrench& a, const Wrench& b) {
  return {a.force + b.force, a.other + b.other, a.reference + b.reference};
}
// As Pair and PairResult hold it: force on b, moments on a and b.
static inline Wrench load_wrench(const PackArray* x, Mask swapped) {
  const Pack3 force = load3(x), a = load3(x + 3), b = load3(x + 6);
  return {select(swapped, -force, force), select(swapped, a, b), select(swapped, b, a)};
}
static inline void store_wrench(PackArray* x, const Wrench& w, Mask swapped) {
  store3(x, select(swapped, -w.force, w.force));
  store3(x + 3, select(swapped, w.other, w.reference));
  store3(x + 6, select(swapped, w.reference, w.other));
}

static void finish(PairPack& w, const PairSettings& set) {
  const Mask swapped = load(w.swapped) > 0, slips = load(w.slips) > 0;
  const Pack kn = load(w.p[p_kn]), kt = load(w.kt), kr = load(w.kr), share = load(w.share);
  const Pack3 n = load3(w.normal), x = load3(w.centroid), shift = load3(w.shift);
  const Mat3<Pack> rotation = columns(w.r + b_rotation);
  // friction: what is held
  const Pack3 t = load3(w.springs), u0 = load3(w.u0), u1 = load3(w.u1);
  const Pack m = select(kr > 0, load(w.torsion), Pack(0)), psi0 = load(w.psi0), psi1 = load(w.psi1);
  const Pack3 u = select(slips, select(kt > 0, (-1 / nonzero(kt)) * t, Pack3{}), u1);
  const Pack psi = select(slips, select(kr > 0, -m / nonzero(kr), Pack(0)), psi1);
  const Pack slipped = 0.5 * kt * dot(u0 + u, u1 - u) + 0.5 * kr * (psi0 + psi) * (psi1 - psi);
  const Pack stored = 0.5 * kt * dot(u, u) + 0.5 * kr * psi * psi;
  const Pack3 viscous = share * load3(w.dashpots);
  // wrenches
  const Pack damping = load(w.damping[0]);
  const Pack3 first = load3(w.damping + 1);
  const Wrench elastic = to_world(rotation, shift, kn * load3(w.force), kn * load3(w.moment));
  const Wrench damped = to_world(rotation, shift, (kn * damping) * n + viscous,
                                 kn * cross(first, n) + cross(x, viscous) + (share * load(w.dashpot_torsion)) * n);
  const Wrench friction = to_world(rotation, shift, t, cross(x, t) + m * n);
  // works of the half steps
  const Pack3 speed = load3(w.o + b_v) - load3(w.r + b_v), spin_other = load3(w.o + b_w), spin = load3(w.r + b_w);
  const auto work = [&](const Wrench& a) { return dot(a.force, speed) + dot(a.other, spin_other) + dot(a.reference, spin); };
  const Pack lost = -(0.5 * set.dt * (work(load_wrench(w.p + p_friction, swapped)) + work(friction))) - (stored - load(w.p[p_tangential]));
  PackArray* out = w.result;
  store_wrench(out + f_wrench, elastic + damped + friction, swapped);
  store(out[f_tangential], stored);
  store(out[f_friction], lost);
  store(out[f_damping], -(0.5 * set.dt * (work(load_wrench(w.p + p_damping, swapped)) + work(damped))));
  store(out[f_slip_omega2], select(slipped > 0, kn * load(w.area) * load(w.inverse_mass), Pack(0)));
  store(out[f_depth], load(w.max_depth));
  // stability (pair.cpp)
  const Pack normal = kn * load(w.area), tangential = load(w.p[p_ks]) * load(w.p[p_area]), gyration = load(w.p[p_gyration]),
             spread = gyration * gyration;
  const Mat3<Pack> relative = relative_rotation(w);
  const auto rate = [&](const PackArray* b, Pack3 arm, Pack3 axis, bool with_tensor) {
    const Pack mass = load(b[b_mass]), inertia = load(b[b_inertia]), square = dot(arm, arm);
    const Mat3<Pack> tensor = columns(b + b_tensor);
    Pack bend = spread * inertia, twist = bend, sway = square * inertia;
    if (const Mask thin = bend + sway > set.slender * mass; any(thin)) {
      Mat3<Pack> A = tensor;
      for (int i = 0; with_tensor && i < 3; ++i) A.row[i] = relative * (tensor * relative.row[i]);
      const Pack area = load(w.area);
      const Pack xy = load(w.second[3]), yz = load(w.second[4]), zx = load(w.second[5]);
      const Pack3 S[3] = {Pack3{load(w.second[0]), xy, zx} - (area * x.x) * x, Pack3{xy, load(w.second[1]), yz} - (area * x.y) * x,
                          Pack3{zx, yz, load(w.second[2])} - (area * x.z) * x};
      const Mat3<Pack> NS = transposed(Mat3<Pack>{{cross(n, S[0]), cross(n, S[1]), cross(n, S[2])}});  // by row
      const Pack bent =
          (dot(A.row[0], cross(n, NS.row[0])) + dot(A.row[1], cross(n, NS.row[1])) + dot(A.row[2], cross(n, NS.row[2]))) / nonzero(area);
      const Pack swayed = (A.row[0].x + A.row[1].y + A.row[2].z) * square - dot(arm, A * arm);
      bend = select(thin, min(bend, bent), bend);
      twist = select(thin, min(twist, spread * dot(n, A * n)), twist);
      sway = select(thin, min(sway, swayed), sway);
    }
    return normal * (mass + dot(axis, tensor * axis) + bend) + tangential * (mass + sway + twist);
  };
  const Pack3 arm = x + shift;
  const Pack other = rate(w.o, x, transposed(relative) * cross(x, n), true), reference = rate(w.r, arm, cross(arm, n), false);
  store(out[f_omega2_a], select(swapped, other, reference));
  store(out[f_omega2_b], select(swapped, reference, other));
  // memory
  store3(w.p + p_u, u);
  store(w.p[p_psi], psi);
  store(w.p[p_tangential], stored);
  store_wrench(w.p + p_friction, friction, swapped);
  store_wrench(w.p + p_damping, damped, swapped);
  store3(w.p + p_shift, shift);
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) store(w.p[p_rotation + 3 * k + i], load(w.rotation[3 * i + k]));
  }
}

}  // namespace erbs::ERBS_TARGET
