// Response of cracked joints without a bond, eight of one law side by side: compression and friction.
//
// Let s_i be the slips of the points and k_i = ks w_i their shear stiffness. The rigid motion a nearest to the slips (weighted least
// squares) leaves the residuals r_i. Points that all stick transmit K (q - a), where K is the shear and torsion of the intact joint. They
// store (q - a) K (q - a) / 2 + sum k_i r_i^2 / 2. They all stick while no point can exceed its limit: |q - a| at the farthest corner plus
// the greatest |r_i| against the least pressure.
#pragma once
#include "engine/joints/cracked/compression.h"
#include "engine/joints/kernels.h"
#include "engine/joints/relative_pose.h"

namespace erbs::ERBS_TARGET {

// Finds the rigid motion nearest to the slips of the points, after they have changed.
static inline void find_mean_slip(double ks, const CrackedShape& shape, const SlipPack* slip, MeanSlipPack& mean_slip) {
  Pack s{}, t{}, rotation{}, apart{}, square{};
  for (int i = 0; i < shape.points; ++i) {
    const PointPack& p = shape.point[i];
    const Pack weight = load(p.weight), ws = weight * load(slip[i].s), wt = weight * load(slip[i].t);
    s += ws, t += wt;
    rotation += wt * load(p.s) - ws * load(p.t);
  }
  const Pack slip_per_stress = ks / nonzero(load(shape.face->stiffness[0]));
  s *= slip_per_stress, t *= slip_per_stress;
  rotation *= ks / nonzero(load(shape.face->stiffness[5]));
  for (int i = 0; i < shape.points; ++i) {
    const PointPack& p = shape.point[i];
    const Pack ds = load(slip[i].s) - (s - rotation * load(p.t)), dt = load(slip[i].t) - (t + rotation * load(p.s)),
               size = ds * ds + dt * dt;
    apart = max(size, apart);
    square += load(p.weight) * size;
  }
  store(mean_slip.s, s);
  store(mean_slip.t, t);
  store(mean_slip.rotation, rotation);
  store(mean_slip.apart, sqrt(apart));
  store(mean_slip.stored, 0.5 * ks * square);
  store(mean_slip.outdated, Pack(0));
}

// Lanes in which all points stick, and their shear.
struct StickState {
  Mask mask;
  Pack s, t, rotation, stored;  // N; N m; J
};

// `closed_by`: m, least closing of a face that is closed all over. `pressed`: the force that presses it over that of its springs.
template <bool damped>
ERBS_INLINE StickState try_stick(const PointLaw& law, double mu, const CrackedShape& shape, const SlipPack* slip, Pack closed_by,
                                 Pack pressed, MeanSlipPack& mean_slip, Cracking& c) {
  StickState out{};
  const Mask closed = (closed_by > 0) & !(load(mean_slip.lent) > 0);
  if (!any(closed)) return out;
  if (any(closed & (load(mean_slip.outdated) > 0))) find_mean_slip(law.ks, shape, slip, mean_slip);
  const Pack s = c.gap[0] - load(mean_slip.s), t = c.gap[1] - load(mean_slip.t), rotation = c.gap[5] - load(mean_slip.rotation),
             radius = load(shape.face->radius);
  const Pack ds = c.gap[0] - c.gap_before[0], dt = c.gap[1] - c.gap_before[1], rotated = c.gap[5] - c.gap_before[5];
  Pack room = mu * c.kn * closed_by * min(pressed, 1) - c.ks * (abs(rotation) * radius + load(mean_slip.apart));
  if (damped) room -= c.ks * c.rate * (abs(ds) + abs(dt) + abs(rotated) * radius);
  out.mask = closed & (room > 0) & (c.ks * c.ks * (s * s + t * t) < room * room);
  const Pack k = c.share_s * load(shape.face->stiffness[0]), twist = c.share_s * load(shape.face->stiffness[5]);
  out.s = k * s, out.t = k * t, out.rotation = twist * rotation;
  out.stored = 0.5 * (out.s * s + out.t * t + out.rotation * rotation) + c.share_s * load(mean_slip.stored);
  if (damped) {
    const Pack rate = select(out.mask, c.rate, Pack(0));
    c.drag[0] = k * rate * ds;
    c.drag[1] = k * rate * dt;
    c.drag[5] = twist * rate * rotated;
  }
  return out;
}

// Sums over points of weight times elastic slip: times ks they are the shear, its stored energy and its work.
struct SlipSums {
  Pack s, t, rotation, stored, work;
  Pack drag_s, drag_t, drag_rotation;
  Mask slid;
};

// Friction of a point without a bond. Its pressure, given by `depth`, allows an elastic slip of `limit` (m). Returns the square of the
// elastic slip.
template <bool damped>
ERBS_INLINE Pack friction_at_point(const PointPack& point, SlipPack& slip, Pack depth, Pack limit, const Cracking& c, SlipSums& sum) {
  const Pack s = load(point.s), t = load(point.t), weight = load(point.weight), slip_s = load(slip.s), slip_t = load(slip.t);
  const Pack rigid_s = c.gap[0] - c.gap[5] * t, rigid_t = c.gap[1] + c.gap[5] * s;
  Pack gs = rigid_s - slip_s, gt = rigid_t - slip_t;
  const Pack trial = square(InPlane<Pack>{gs, gt}), most = limit * limit;
  const Mask slides = trial > most;
  if (any(slides)) {
    const InPlane<Pack> left = radial_return(InPlane<Pack>{gs, gt}, sqrt(trial), limit, slides);
    const Pack s0 = c.gap_before[0] - c.gap_before[5] * t - slip_s, t0 = c.gap_before[1] + c.gap_before[5] * s - slip_t;
    store(slip.s, select(slides, rigid_s - left.s, slip_s));
    store(slip.t, select(slides, rigid_t - left.t, slip_t));
    sum.work += weight * ((s0 + left.s) * (gs - left.s) + (t0 + left.t) * (gt - left.t));
    gs = left.s, gt = left.t;
    sum.slid |= slides;
  }
  const Pack ws = weight * gs, wt = weight * gt;
  sum.s += ws;
  sum.t += wt;
  sum.rotation += wt * s - ws * t;
  sum.stored += ws * gs + wt * gt;
  const Pack left_square = min(trial, most);
  if (!damped) return left_square;
  const Pack rate = select((trial <= most) & (depth > 0), c.debonded_rate, Pack(0)), rotation = c.gap[5] - c.gap_before[5];
  const InPlane<Pack> elastic{gs, gt};
  InPlane<Pack> drag{rate * ((c.gap[0] - c.gap_before[0]) - rotation * t), rate * ((c.gap[1] - c.gap_before[1]) + rotation * s)};
  const Mask past = square(InPlane<Pack>{gs + drag.s, gt + drag.t}) > max(trial, most);
  if (any(past)) {
    const Pack share = share_within(elastic, drag, limit, past);
    drag = {share * drag.s, share * drag.t};
  }
  const Pack drag_s = weight * drag.s, drag_t = weight * drag.t;
  sum.drag_s += drag_s;
  sum.drag_t += drag_t;
  sum.drag_rotation += drag_t * s - drag_s * t;
  return left_square;
}

// Points of faces that are open, and were so before, follow the faces.
ERBS_INLINE void follow_open_faces(const PointPack& point, SlipPack& slip, const Cracking& c, Mask slow) {
  if (c.lock.updates) interlocked_stress(c.lock, slip, gap_of(point, c.gap), Pack(0), slow);
  store(slip.s, c.gap[0] - c.gap[5] * load(point.t));
  store(slip.t, c.gap[1] + c.gap[5] * load(point.s));
}

// Friction of all points, if not all joints of the pack stick.
template <bool damped>
ERBS_INLINE void friction_at_points(double mu, Pack scale, const Pack* depth, const CrackedShape& shape, SlipPack* slip,
                                    MeanSlipPack& mean_slip, const StickState& stick, Cracking& c) {
  SlipSums sum{};
  const Pack lets = mu / c.ks;
  const Mask slow = slides_slowly(shape, c);
  Pack lent{};
  for (int i = 0; i < shape.points; ++i) {
    const Pack gap = gap_of(shape.point[i], c.gap), stress = scale * depth[i],
               held = interlocked_stress(c.lock, slip[i], gap, stress, slow);
    // no limit where all stick
    const Pack square = friction_at_point<damped>(shape.point[i], slip[i], depth[i], select(stick.mask, Pack(1e150), lets * held), c, sum);
    if (any((held > stress) | (load(slip[i].lent) > 0))) lend(c.lock, slip[i], stress, held, sqrt(square) / nonzero(lets));
    lent = max(lent, load(slip[i].lent));
  }
  store(mean_slip.lent, lent);
  c.resultant[0] = select(stick.mask, stick.s, c.ks * sum.s);
  c.resultant[1] = select(stick.mask, stick.t, c.ks * sum.t);
  c.resultant[5] = select(stick.mask, stick.rotation, c.ks * sum.rotation);
  c.stored += select(stick.mask, stick.stored, 0.5 * c.ks * sum.stored);
  c.friction = 0.5 * c.ks * sum.work;
  if (any(sum.slid)) store(mean_slip.outdated, select(sum.slid, Pack(1), load(mean_slip.outdated)));
  if (!damped) return;
  c.drag[0] = select(stick.mask, c.drag[0], c.ks * sum.drag_s);
  c.drag[1] = select(stick.mask, c.drag[1], c.ks * sum.drag_t);
  c.drag[5] = select(stick.mask, c.drag[5], c.ks * sum.drag_rotation);
}

// Updates the mean pressures where all points stick and the faces are closed all over.
static inline void update_mean_pressure(const CrackedShape& shape, Pack force, SlipPack* slip, const Cracking& c) {
  const Mask slow = slides_slowly(shape, c);
  Pack sum{};
  for (int i = 0; i < shape.points; ++i) sum += load(shape.point[i].weight) * max(-gap_of(shape.point[i], c.gap), 0);
  const Pack scale = force / nonzero(sum);
  for (int i = 0; i < shape.points; ++i) {
    const Pack gap = gap_of(shape.point[i], c.gap);
    interlocked_stress(c.lock, slip[i], gap, scale * max(-gap, 0), slow);
  }
}

// The compression one step ago: without a bond and crushing it is the joint's resultant across its face.
template <class Face, bool damped>
ERBS_INLINE Compression before(const PointLaw& law, const CrackedShape& shape, const CrackedPack& lane, const Cracking& c) {
  if (!damped) return Compression{};
  if (Face::yields && law.crushes()) return compression(law.kn, c.share_n, shape, c.gap_before);
  return {-load(lane.resultant[2]), load(lane.resultant[4]), -load(lane.resultant[3]), Pack(0)};
}

template <class Face, bool damped>
static bool friction_pack(const PointLaw& law, const CrackedShape& shape, CrackedPack& lane, const double* poses, double* wrench_rows,
                          CrackedSums& sums) {
  SlipPack* slip = lane.slip();
  MeanSlipPack& mean_slip = lane.mean_slip;
  const double mu = law.mu_debonded();
  const bool crushes = Face::yields && law.crushes();
  Pack depth[most_points_per_joint];
  JointMotion now;
  Cracking c;
  relative_motion(lane, *shape.face, poses, now);
  start<Face, damped>(law, shape, lane, now, c);
  Compression pressed = compression(law.kn, c.share_n, shape, c.gap);
  if constexpr (Face::lifts) lift<Face>(law, shape, lane, c, pressed);
  const Pack closed_by = -c.gap[2] - (abs(c.gap[3]) * load(shape.face->half_t) + abs(c.gap[4]) * load(shape.face->half_s));
  const Compression then = before<Face, damped>(law, shape, lane, c);
  const Pack force = pressing_force<damped>(pressed, then, c);
  const StickState stick =
      crushes ? StickState{} : try_stick<damped>(law, mu, shape, slip, closed_by, force / nonzero(pressed.force), mean_slip, c);
  if (!any(Mask::of_bits(shape.used) & !stick.mask)) {
    add_compression<damped>(pressed, then, c);
    c.resultant[0] = stick.s, c.resultant[1] = stick.t, c.resultant[5] = stick.rotation;
    c.stored += stick.stored;
    if (c.lock.updates) update_mean_pressure(shape, force, slip, c);
  } else if (crushes || any(pressed.force > 0) || any(load(lane.stored) > 0)) {
    const Pack scale = compress<Face, damped>(law, shape, c, pressed, then, depth);
    friction_at_points<damped>(mu, scale, depth, shape, slip, mean_slip, stick, c);
  } else {
    const Mask slow = slides_slowly(shape, c);
    for (int i = 0; i < shape.points; ++i) follow_open_faces(shape.point[i], slip[i], c, slow);
    store(mean_slip.outdated, Pack(1));
  }
  finish_step<Face, damped>(law, shape, c, lane, sums);
  write_joint_wrenches(lane, now, c.resultant, wrench_rows);
  return may_be_out_of_range(*shape.face, c.gap);
}

template <class Face>
static bool friction(const PointLaw& law, const CrackedShape& shape, CrackedPack& lane, const double* poses, double* wrench_rows,
                     CrackedSums& sums) {
  return (shape.per_step > 0 ? friction_pack<Face, true> : friction_pack<Face, false>)(law, shape, lane, poses, wrench_rows, sums);
}

}  // namespace erbs::ERBS_TARGET
