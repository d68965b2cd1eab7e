// Compression of cracked joints, eight of one law side by side: the closed-form integral over a face, and the share of each point.
//
// The integral needs no clipping: by the divergence theorem the integrals of p+ = max(p, 0), p linear with the gradient g, over the polygon
// are sums over its edges,
//   Int p dA = 1/(2 g.g) sum (g.n) Int p+^2 ds,   Int p^2 dA = 1/(3 g.g) sum (g.n) Int p+^3 ds,
//   Int p x dA = 1/(2 g.g) (sum (g.n) Int x p+^2 ds - g Int p^2 dA),
// which is well conditioned where the joint is partly open: p then changes sign inside, so its gradient is not small.
#pragma once
#include "engine/joints/cracked/strips.h"
#include "engine/joints/elastic_kernel.h"
#include "engine/joints/kernels.h"
#include "engine/joints/relative_pose.h"
#include "engine/laws/crushing.h"
#include "engine/laws/laws.h"
#include "engine/simd/vec3.h"

namespace erbs::ERBS_TARGET {

// Relative displacement of the joint now and one step ago, its resultant, and its energies in this step (J).
struct Cracking {
  Pack gap[6], gap_before[6], resultant[6];
  Pack stored, friction, fracture, crushing;
  Pack share_n, share_s, kn, ks;  // stiffness now: as shares of the intact one, and in Pa/m (fading.h)
  Pack rate, debonded_rate;       // of dashpots, b over the last step; the same of points without a bond
  Pack drag[6];                   // dashpots (viscous_response)
  Pack lift;                      // m, by asperities; set where the law has them
  Interlock<Pack> lock;
};

// The gap at a point, m.
ERBS_INLINE Pack gap_of(const PointPack& p, const Pack* gap) { return gap[2] + gap[3] * load(p.t) - gap[4] * load(p.s); }

struct EdgeSums {
  Pack p, s, t, square;  // sums of (g.n) Int p+^2, x p+^2, p+^3 ds times 6, 6, 4
};

// A corner: its position, p+, |p| and p+^2.
struct Corner {
  Pack s, t, p, size, square;
};
ERBS_INLINE Corner corner_of(const CornerPack& of, Pack p_0, Pack gs, Pack gt) {
  const Pack s = load(of.s), t = load(of.t), p = gs * s + gt * t + p_0, positive = max(p, 0);
  return {s, t, positive, abs(p), positive * positive};
}

// On an edge p+ is linear where p is positive, from its value at one end to that at the other.
ERBS_INLINE void add_edge(const Corner& a, const Corner& b, Pack gs, Pack gt, EdgeSums& sum) {
  const Pack ds = b.s - a.s, dt = b.t - a.t, both = a.p + b.p, part = both / not_quite_zero(a.size + b.size);
  const Pack from = select(a.size > a.p, 1 - part, Pack(0)), squares = a.square + b.square, share = (gs * dt - gt * ds) * part;
  const Pack p = share * (squares + both * both), along = p * from + share * (0.5 * squares + both * b.p) * part;
  sum.p += p;
  sum.s += p * a.s + along * ds;
  sum.t += p * a.t + along * dt;
  sum.square += share * (both * squares);
}

// Integrals of p+, p = p_0 + gs s + gt t, over the loop; valid in the lanes `marked`, where p changes sign inside.
static inline StripIntegrals positive_part(const CornerPack* corner, int corners, Pack p_0, Pack gs, Pack gt, Mask marked) {
  EdgeSums sum{};
  Corner last = corner_of(corner[corners - 1], p_0, gs, gt);
  for (int i = 0; i < corners; ++i) {
    const Corner next = corner_of(corner[i], p_0, gs, gt);
    add_edge(last, next, gs, gt, sum);
    last = next;
  }
  const Pack inverse = 1 / select(marked, nonzero(gs * gs + gt * gt), Pack(1)), twelfth = (1.0 / 12) * inverse, half = 0.5 * inverse;
  const Pack square = twelfth * sum.square;
  return {twelfth * sum.p, twelfth * sum.s - half * square * gs, twelfth * sum.t - half * square * gt, square};
}

struct Compression {
  Pack force, ms, mt, energy;  // N; N m; J
};

// Integrals of p+ over a face that lies in its points.
static inline StripIntegrals positive_part_at_points(const CrackedShape& shape, const Pack* gap) {
  StripIntegrals sum{};
  for (int i = 0; i < shape.points; ++i) {
    const Pack depth = max(-gap_of(shape.point[i], gap), 0), volume = load(shape.point[i].weight) * depth;
    sum.p += volume;
    sum.s += volume * load(shape.point[i].s);
    sum.t += volume * load(shape.point[i].t);
    sum.square += volume * depth;
  }
  return sum;
}

// The no-tension integral over the true overlap polygon. `share`: of the intact stiffness.
ERBS_INLINE Compression compression(double kn, Pack share, const CrackedShape& shape, const Pack* gap) {
  const FacePack& face = *shape.face;
  const Pack reach = abs(gap[3]) * load(face.half_t) + abs(gap[4]) * load(face.half_s);
  const Mask closed = gap[2] + reach < 0, pressed = gap[2] - reach < 0, partly = pressed & !closed;
  const Pack twist = load(face.twist);
  Pack force = select(closed, -load(face.stiffness[2]) * gap[2], Pack(0));
  Pack mt = select(closed, twist * gap[4] - load(face.bend_s) * gap[3], Pack(0));
  Pack ms = select(closed, load(face.bend_t) * gap[4] - twist * gap[3], Pack(0));
  Pack energy = 0.5 * (ms * gap[4] - force * gap[2] - mt * gap[3]);
  if (any(partly)) {
    const StripIntegrals sum = shape.lumped()     ? positive_part_at_points(shape, gap)
                               : shape.rectangles ? positive_part_of_rectangle(face, -gap[2], gap[4], -gap[3], partly)
                                                  : positive_part(shape.overlap_corner, shape.corners, -gap[2], gap[4], -gap[3], partly);
    force = select(partly, kn * sum.p, force);
    ms = select(partly, kn * sum.s, ms);
    mt = select(partly, kn * sum.t, mt);
    energy = select(partly, 0.5 * kn * sum.square, energy);
  }
  return {share * force, share * ms, share * mt, share * energy};
}

// Rate of the dashpots of the closed part, which may not pull.
ERBS_INLINE Pack compression_rate(const Compression& now, const Compression& then, const Cracking& c) {
  const Pack pull = c.rate * (then.force - now.force);
  const Mask past = pull > now.force;
  return any(past) ? select(past, c.rate * (now.force / nonzero(pull)), c.rate) : c.rate;
}

// The force (N) that presses the faces, which friction follows: that of the springs and of their dashpots.
template <bool damped>
ERBS_INLINE Pack pressing_force(const Compression& now, const Compression& then, const Cracking& c) {
  return damped ? max(now.force - compression_rate(now, then, c) * (then.force - now.force), 0) : now.force;
}

// Adds the compression to the resultant, and the dashpots of the closed part: the change of its pressure.
template <bool damped>
ERBS_INLINE void add_compression(const Compression& now, const Compression& then, Cracking& c) {
  c.resultant[2] -= now.force;
  c.resultant[3] -= now.mt;
  c.resultant[4] += now.ms;
  c.stored += now.energy;
  if (!damped) return;
  const Pack rate = compression_rate(now, then, c);
  c.drag[2] += rate * (then.force - now.force);
  c.drag[3] += rate * (then.mt - now.mt);
  c.drag[4] -= rate * (then.ms - now.ms);
}

// Faces that are crushed, or may be in this step. They are few, so they are evaluated lane by lane.
struct Crushing {
  Pack gap[6], gap_before[6], kn;
  Compression now, then;
  Pack work;
};

ERBS_INLINE void set_lane(Pack& x, int lane, double to) {
  double all[pack_size];
  x.store(all);
  all[lane] = to;
  x = Pack::load(all);
}
static inline void put(const Pressed& from, int l, Compression& to) {
  set_lane(to.force, l, from.force), set_lane(to.ms, l, from.s), set_lane(to.mt, l, from.t), set_lane(to.energy, l, from.energy);
}

[[gnu::noinline, maybe_unused]] static void crush_lanes(const PointLaw& law, const CrackedShape& shape, Crushing& c, Pack* depth) {
  const Pack limit = law.fc / c.kn;
  const Pack deepest = abs(c.gap[3]) * load(shape.face->half_t) + abs(c.gap[4]) * load(shape.face->half_s) - c.gap[2];
  for (int l = 0; l < pack_size; ++l) {
    CrushedFace* crushed = shape.crushed[l];
    if (crushed == nullptr || (crushed->planes == 0 && deepest[l] <= limit[l])) continue;
    CompressionFace face{c.kn[l], limit[l], shape.corners, shape.bearing[l], law.crush_depth};
    if (shape.lumped()) face.points = shape.points, face.point = shape.bearing[l];
    const double before[3] = {c.gap_before[2][l], -c.gap_before[4][l], c.gap_before[3][l]},
                 gap[3] = {c.gap[2][l], -c.gap[4][l], c.gap[3][l]};
    set_lane(c.work, l, erbs::crush(face, *crushed, before, gap));
    if (crushed->planes == 0) continue;
    put(pressed(face, *crushed, gap), l, c.now);
    if (shape.per_step > 0) put(pressed(face, *crushed, before), l, c.then);
    for (int i = 0; i < shape.points; ++i)
      set_lane(depth[i], l, pressed_depth(face, *crushed, gap, shape.point[i].s[l], shape.point[i].t[l]));
  }
}

ERBS_INLINE void crush(const PointLaw& law, const CrackedShape& shape, Cracking& c, Compression& now, Compression& then, Pack* depth) {
  Crushing of{};
  for (int i = 0; i < 6; ++i) of.gap[i] = c.gap[i], of.gap_before[i] = c.gap_before[i];
  of.now = now, of.then = then, of.kn = c.kn;
  crush_lanes(law, shape, of, depth);
  now = of.now, then = of.then, c.crushing += of.work;
}

// Where no point is pressed (the lanes `lone`), the first of the deepest points receives the whole force.
ERBS_INLINE void assign_to_deepest(const CrackedShape& shape, const Pack* gap, Mask lone, Pack* depth) {
  Pack least = Pack(1e300);
  for (int i = 0; i < shape.points; ++i) {
    const Pack n = gap_of(shape.point[i], gap);
    least = min(n, least);
  }
  for (int i = 0; any(lone) && i < shape.points; ++i) {
    const Mask here = lone & (gap_of(shape.point[i], gap) <= least);
    depth[i] = select(here, 1 / nonzero(load(shape.point[i].weight)), depth[i]);
    lone &= !here;
  }
}

// Distributes the pressing force of the whole face by the depths of its points, which `depth` receives. A point's share (N) is the
// returned scale times its depth and weight.
template <class Face, bool damped>
ERBS_INLINE Pack compress(const PointLaw& law, const CrackedShape& shape, Cracking& c, Compression now, Compression then, Pack* depth) {
  Pack sum{};
  for (int i = 0; i < shape.points; ++i) {
    depth[i] = max(-gap_of(shape.point[i], c.gap), 0);
    sum += load(shape.point[i].weight) * depth[i];
  }
  if (Face::yields && law.crushes()) {
    crush(law, shape, c, now, then, depth);
    sum = Pack(0);
    for (int i = 0; i < shape.points; ++i) sum += load(shape.point[i].weight) * depth[i];
  }
  add_compression<damped>(now, then, c);
  const Mask lone = (sum <= 0) & (now.force > 0);
  if (any(lone))
    assign_to_deepest(shape, c.gap, lone, depth), c.debonded_rate = select(lone, Pack(0), c.rate);  // only this share presses it
  const Pack force = pressing_force<damped>(now, then, c);
  return select(sum > 0, force / nonzero(sum), force);
}

// `interlocked_stress()` of a point of the pack, with its mean pressure in memory.
ERBS_INLINE Pack interlocked_stress(const Interlock<Pack>& lock, SlipPack& slip, Pack gap, Pack stress, Mask slow) {
  Pack mean = load(slip.mean_pressure);
  const Pack held = interlocked_stress(lock, mean, load(slip.lent), gap, stress, slow);
  if (lock.updates) store(slip.mean_pressure, mean);
  return held;
}
ERBS_INLINE void lend(const Interlock<Pack>& lock, SlipPack& slip, Pack stress, Pack held, Pack used) {
  store(slip.lent, lent_after(lock, load(slip.lent), stress, held, used));
}
ERBS_INLINE Mask slides_slowly(const CrackedShape& shape, const Cracking& c) {
  return slides_slowly(c.lock, c.gap, c.gap_before, load(shape.face->radius));
}

// Relative displacement now and one step ago, and an empty account. Asperities that lift the faces close the gap.
template <class Face, bool damped>
ERBS_INLINE void start(const PointLaw& law, const CrackedShape& shape, const CrackedPack& lane, const JointMotion& now, Cracking& c) {
  c.share_n = load(lane.share_n), c.share_s = load(lane.share_s);
  c.kn = law.kn * c.share_n, c.ks = law.ks * c.share_s;
  c.stored = c.friction = c.fracture = c.crushing = Pack(0);
  c.rate = c.debonded_rate = damped ? shape.per_step * load(lane.viscous) : Pack(0);
  for (int i = 0; i < 6; ++i) {
    c.gap[i] = now.gap[i];
    c.gap_before[i] = load(lane.gap[i]);
    c.resultant[i] = Pack(0);
    if (damped) c.drag[i] = Pack(0);
  }
  if constexpr (Face::lifts) c.gap[2] -= load(lane.own(shape.points)[Face::uplift]);
  c.lock = interlock_of(shape.interlock, load(lane.hop_time), load(lane.hop_loan));
}

// Lifts the faces of a law with asperities by the slip of this step, which needs their force at the uplift so far.
template <class Face>
ERBS_INLINE void lift(const PointLaw& law, const CrackedShape& shape, const CrackedPack& lane, Cracking& c, Compression& now) {
  const FacePack& face = *shape.face;
  Pack own[Face::numbers];
  for (int i = 0; i < Face::numbers; ++i) own[i] = load(lane.own(shape.points)[i]);
  const Pack rise = Face::coming_rise(law, own, c.gap[0], c.gap[1], now.force, load(face.stiffness[0]) / law.ks);
  c.gap[2] -= rise;
  c.lift = own[Face::uplift] + rise;
  now = compression(law.kn, c.share_n, shape, c.gap);
}

// Books the work of the change of lift and advances the asperities.
template <class Face, bool damped>
ERBS_INLINE void advance_asperities(const PointLaw& law, const CrackedShape& shape, const Cracking& c, CrackedPack& lane,
                                    CrackedSums& sums) {
  Pack own[Face::numbers];
  auto* memory = lane.own(shape.points);
  for (int i = 0; i < Face::numbers; ++i) own[i] = load(memory[i]);
  Pack across = load(lane.resultant[2]) + c.resultant[2], area{};
  if (damped) across += load(lane.drag[2]) + c.drag[2];
  add_to(sums.friction, 0.5 * across * (c.lift - own[Face::used]));
  InPlane<Pack> slip{Pack(0), Pack(0)};
  for (int i = 0; i < shape.points; ++i) {
    const Pack weight = load(shape.point[i].weight);
    slip = {slip.s + weight * load(lane.slip()[i].s), slip.t + weight * load(lane.slip()[i].t)};
    area += weight;
  }
  Face::advance(law, own, InPlane<Pack>{slip.s / nonzero(area), slip.t / nonzero(area)}, c.lift);
  for (int i = 0; i < Face::numbers; ++i) store(memory[i], own[i]);
  store(lane.least_damage, Face::released(law, own, c.gap, load(shape.face->half_s), load(shape.face->half_t)));
}

// event_bound.h, by the corners of the face, or by the points that bear it.
static inline void foresee(const CrackedShape& shape, const Cracking& c, CrackedSums& sums) {
  const Pack dn = c.gap[2] - c.gap_before[2], ds = c.gap[3] - c.gap_before[3], dt = c.gap[4] - c.gap_before[4];
  Pack square{}, soon{};
  const bool lumped = shape.lumped();
  const int corners = lumped ? shape.points : shape.corners;
  const Pack scale = lumped ? corners * c.kn / nonzero(load(shape.face->stiffness[2]) * c.share_n) : Pack(0);  // points over the area
  for (int i = 0; i < corners; ++i) {
    const Pack s = load(lumped ? shape.point[i].s : shape.overlap_corner[i].s),
               t = load(lumped ? shape.point[i].t : shape.overlap_corner[i].t);
    const Pack gap = c.gap[2] + c.gap[3] * t - c.gap[4] * s, rate = dn + ds * t - dt * s;
    const Mask ahead = gap * rate < 0;
    const Pack near = select(ahead, abs(rate) / abs(nonzero(gap)), Pack(0));
    const Pack part = lumped ? load(shape.point[i].weight) * scale : Pack(1);
    square += select(ahead, part * rate * rate, Pack(0));
    soon = max(near, soon);
  }
  const Pack errs = sqrt((event_share / (corners * shape.event_budget)) * load(shape.face->stiffness[2]) * c.share_n * square),
             event_rate = event_steps * soon, both = min(errs, event_rate), most = load(sums.event_rate);
  store(sums.event_rate, max(both, most));
}

// Memory and account of the step, once the resultant is known; dashpots join it.
template <class Face, bool damped>
ERBS_INLINE void finish_step(const PointLaw& law, const CrackedShape& shape, Cracking& c, CrackedPack& lane, CrackedSums& sums) {
  if constexpr (Face::lifts) advance_asperities<Face, damped>(law, shape, c, lane, sums);
  if (shape.event_budget > 0) foresee(shape, c, sums);
  Pack work{}, damping{};
  for (int i = 0; i < 6; ++i) {
    const Pack dq = c.gap[i] - c.gap_before[i];
    work += (load(lane.resultant[i]) + c.resultant[i]) * dq;
    store(lane.resultant[i], c.resultant[i]);
    store(lane.gap[i], c.gap[i]);
    if (!damped) continue;
    damping += (load(lane.drag[i]) + c.drag[i]) * dq;
    store(lane.drag[i], c.drag[i]);
    c.resultant[i] += c.drag[i];
  }
  const Pack error = abs(0.5 * work - (c.stored - load(lane.stored)) - c.friction - c.fracture - c.crushing), worst = load(sums.error);
  store(sums.error, max(error, worst));
  store(sums.worst, select(error > worst, Pack(shape.number), load(sums.worst)));
  store(lane.stored, c.stored);
  add_to(sums.friction, c.friction);
  add_to(sums.fracture, c.fracture);
  add_to(sums.crushing, c.crushing);
  if (damped) add_to(sums.damping, 0.5 * damping);
}

// True if a joint may be out of range: the limits of `out_of_range()`, slightly tighter.
ERBS_INLINE bool may_be_out_of_range(const FacePack& face, const Pack* gap) {
  const Pack half_s = load(face.half_s), half_t = load(face.half_t), side = 2 * min(half_s, half_t);
  const Pack room = 0.00999 * side - abs(gap[5]) * load(face.radius), least_gap = gap[2] - abs(gap[3]) * half_t - abs(gap[4]) * half_s;
  return any((gap[0] * gap[0] + gap[1] * gap[1] > room * abs(room)) | (gap[3] * gap[3] + gap[4] * gap[4] > 0.0299 * 0.0299) |
             (least_gap > 0.00199 * side));
}

}  // namespace erbs::ERBS_TARGET
