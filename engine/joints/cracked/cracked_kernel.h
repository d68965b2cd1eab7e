// Joints that have cracked, eight of one law side by side: the point laws of response.cpp, lane by lane.
#pragma once
#include "engine/joints/cracked/compression.h"
#include "engine/joints/kernels.h"
#include "engine/joints/relative_pose.h"
#include "engine/laws/point.h"

namespace erbs::ERBS_TARGET {

// What the cell of a point pulls with at unit stiffness (response.cpp).
struct Pull {
  Pack n, s, t;
};

static inline Pack work_of(const Pull& p, const Pack* gap) { return p.n * gap[2] + p.t * gap[3] - p.s * gap[4]; }

// The least and the greatest gap in a polygon.
struct Span {
  Pack least, most;
};
static inline Span span_of(const CornerPack* corner, int first, int last, const Pack* gap) {
  Span out{Pack(1e300), Pack(-1e300)};
  for (int k = first; k < last; ++k) {
    const Pack g = gap[2] + gap[3] * load(corner[k].t) - gap[4] * load(corner[k].s);
    out.least = min(g, out.least);
    out.most = max(g, out.most);
  }
  return out;
}

// `span` is that of the cell. Meaningful in the lanes marked: a cell without bond pulls with nothing, and its share is not worth an
// integral.
static inline Pull pull_of(const CrackedShape& shape, int i, const Pack* gap, Span span, Mask marked) {
  const Mask open = marked & (span.most > 0), partly_open = open & (span.least < 0), whole = open & !partly_open;
  if (!any(open)) return {Pack(0), Pack(0), Pack(0)};
  const CellPack& cell = shape.cell[i];
  const Pack area = load(shape.point[i].weight), s = load(cell.s), t = load(cell.t), st = load(cell.st);
  Pull out{select(whole, gap[2] * area + gap[3] * t - gap[4] * s, Pack(0)),
           select(whole, gap[2] * s + gap[3] * st - gap[4] * load(cell.ss), Pack(0)),
           select(whole, gap[2] * t + gap[3] * load(cell.tt) - gap[4] * st, Pack(0))};
  if (!any(partly_open)) return out;
  const EdgeSums sum =
      positive_part(shape.cell_loop + shape.first[i], shape.first[i + 1] - shape.first[i], gap[2], -gap[4], gap[3], partly_open);
  return {select(partly_open, sum.p, out.n), select(partly_open, sum.s, out.s), select(partly_open, sum.t, out.t)};
}
static inline Pull pull_of(const CrackedShape& shape, int i, const Pack* gap, Mask marked) {
  return pull_of(shape, i, gap, span_of(shape.cell_loop, shape.first[i], shape.first[i + 1], gap), marked);
}

// Shear strength that the bond gives (Pa) at tension sigma >= 0 and damage p < 1; point_law.h has the formulas.
static inline Pack bond(const PointLaw& law, Pack sigma, Pack p) {
  const Pack left = 1 - p;
  if (law.coupling == PointLaw::Coupling::coulomb)
    return select(p < 1, max(law.c * left - (law.mu + p * (law.mu_residual - law.mu)) * sigma, 0), Pack(0));
  const Pack ft = law.ft * left, use = sigma / nonzero(ft);
  Pack share = law.coupling == PointLaw::Coupling::linear ? max(1 - use, 0) : sqrt(max(1 - use * use, 0));
  share = select(sigma > 0, select(ft > 0, share, Pack(0)), Pack(1));
  return select(p < 1, law.c * left * share, Pack(0));
}

// One point: its place, share and gap.
struct PointSample {
  Pack s, t, weight, n;
};

// What a point remembers of its bond.
struct Bond {
  Pack damage, secant, kappa;
  Pack stiffness(const PointLaw& law) const { return select(damage > 0, secant, Pack(law.kn)); }
};

// Damage of the lanes marked goes up to `to`; secant and reach follow.
static inline void damage_to(const PointLaw& law, Bond& b, Mask marked, Pack to) {
  const Pack d = min(to, 1), opening = law.opening_peak + d * (law.opening_ultimate - law.opening_peak);
  const Pack secant = select((d < 1) & (opening > 0), law.ft * (1 - d) / nonzero(opening), Pack(0));
  b.damage = select(marked, d, b.damage);
  b.kappa = select(marked, opening, b.kappa);
  b.secant = select(marked, select(d > 0, secant, Pack(law.kn)), b.secant);
}

// Tension wears the bond, by the widest opening of its cell; returns the tension (Pa) that its shear strength feels.
static inline Pack stretch(const PointLaw& law, Bond& b, Mask holds, Pack wide, Pack opening) {
  const Mask more = holds & (wide > select(b.damage > 0, b.kappa, Pack(law.opening_peak)));
  if (any(more)) {
    const double span = law.opening_ultimate - law.opening_peak;
    damage_to(law, b, more, span > 0 ? (wide - law.opening_peak) / span : Pack(1));
  }
  return select(holds & (opening > 0), b.stiffness(law) * opening, Pack(0));
}

// The sliding lanes of one point: softening of the bond and radial return of the traction k (gs, gt) of size `size` to the limit
// `cap`; `pressure` (N) presses it.
static inline void slide(const PointLaw& law, SlipPack& p, const PointSample& x, Cracking& c, Bond& b, bool bonds, Mask slides, Pack sigma,
                         Pack pressure, Pack size, Pack cap, Pack& gs, Pack& gt) {
  const Pack k = law.ks * x.weight;
  Mask bonded{};
  Pack friction = law.mu + b.damage * (law.mu_residual - law.mu);
  if (bonds && law.c > 0) bonded = slides & (b.damage < 1);
  if (any(bonded)) {
    // Softening: the limit falls linearly with the slip it allows, size - k slip = cap + slope slip.
    Pack to = Pack(1);
    if (law.slip_ultimate > 0) {
      const Pack slope = k + ((law.mu_residual - law.mu) * pressure - law.c * x.weight) / law.slip_ultimate;
      to = select(slope > 0, b.damage + (size - cap) / nonzero(slope) / law.slip_ultimate, Pack(1));
    }
    damage_to(law, b, bonded, to);
    friction = law.mu + b.damage * (law.mu_residual - law.mu);
    cap = select(bonded, bond(law, sigma, b.damage) * x.weight + friction * pressure, cap);
  }
  const Pack slip_s = load(p.s), slip_t = load(p.t);
  const Pack share = select(slides, 1 - cap / nonzero(size), Pack(0)), ds = share * gs, dt = share * gt;
  const Pack s0 = k * (c.gap_before[0] - c.gap_before[5] * x.t - slip_s), t0 = k * (c.gap_before[1] + c.gap_before[5] * x.s - slip_t);
  store(p.s, slip_s + ds);
  store(p.t, slip_t + dt);
  gs -= ds;
  gt -= dt;
  const Pack work = 0.5 * ((s0 + k * gs) * ds + (t0 + k * gt) * dt);
  if (!any(bonded)) {
    c.friction += work;
    return;
  }
  const Pack most = friction * pressure * (size - cap) / nonzero(k), by_friction = select(bonded & (most < work), most, work);
  c.friction += by_friction;
  c.fracture += work - by_friction;
}

// One point: its bond stretched and rubbed, what presses it known. Returns its damage.
template <bool damped>
ERBS_INLINE Pack point_response(const PointLaw& law, const CrackedShape& shape, SlipPack& p, BondPack& bonded, int i, Pack stress,
                                Mask slow, Cracking& c) {
  const PointSample x{load(shape.point[i].s), load(shape.point[i].t), load(shape.point[i].weight), gap_of(shape.point[i], c.gap)};
  const Pack pressure = x.weight * interlocked_stress(shape, p, x.n, stress, slow);
  Bond b{load(bonded.damage), load(bonded.secant), load(bonded.kappa)};
  const Mask holds = b.damage < 1;
  const bool bonds = any(holds);
  const Pack before = b.stiffness(law);
  Pack sigma{}, strength{};
  Span span{};
  if (bonds) {
    span = span_of(shape.cell_loop, shape.first[i], shape.first[i + 1], c.gap);
    const Span tension_span =
        shape.tension_loop == shape.cell_loop ? span : span_of(shape.tension_loop, shape.first[i], shape.first[i + 1], c.gap);
    sigma = stretch(law, b, holds, max(tension_span.most, x.n), x.n);
    if (law.closing_ultimate > 0) {
      const Pack deepest = -min(tension_span.least, x.n);
      const Mask crushed = holds & (deepest > law.closing_ultimate) & (deepest > law.fc / law.kn);
      if (any(crushed)) damage_to(law, b, crushed, Pack(1));
      sigma = select(crushed, Pack(0), sigma);
    }
    strength = bond(law, sigma, b.damage);
  }
  const Pack k = law.ks * x.weight;
  Pack gs = c.gap[0] - c.gap[5] * x.t - load(p.s), gt = c.gap[1] + c.gap[5] * x.s - load(p.t);
  Pack ts = k * gs, tt = k * gt;
  const Pack cap = strength * x.weight + (law.mu + b.damage * (law.mu_residual - law.mu)) * pressure, square = ts * ts + tt * tt;
  const Mask slides = square > cap * cap;
  if (any(slides)) slide(law, p, x, c, b, bonds, slides, sigma, pressure, sqrt(square), cap, gs, gt), ts = k * gs, tt = k * gt;
  c.resultant[0] += ts;
  c.resultant[1] += tt;
  c.resultant[5] += tt * x.s - ts * x.t;
  c.stored += 0.5 * (ts * gs + tt * gt);
  if (damped) {
    const Mask sticking = ((x.n < 0) | (b.damage < 1)) & !slides;
    const Pack rotation = c.gap[5] - c.gap_before[5], rate = select(sticking, k * c.rate, Pack(0));
    Shear drag{rate * (c.gap[0] - c.gap_before[0] - rotation * x.t), rate * (c.gap[1] - c.gap_before[1] + rotation * x.s)};
    const Pack present = square_of(ts, tt), most = cap * cap;
    const Mask past = square_of(ts + drag.s, tt + drag.t) > max(present, most);
    if (any(past)) drag = drag_within(drag, {ts, tt}, cap, past);
    c.drag[0] += drag.s;
    c.drag[1] += drag.t;
    c.drag[5] += drag.t * x.s - drag.s * x.t;
  }
  if (!bonds) return b.damage;
  const Pack after = b.stiffness(law);
  const Pull pull = pull_of(shape, i, c.gap, span, holds);
  const Mask damage_changed = holds & (before != after);
  if (any(damage_changed)) {
    const Pack both = work_of(pull, c.gap_before) + work_of(pull_of(shape, i, c.gap_before, holds), c.gap);
    c.fracture += select(damage_changed, 0.25 * (before - after) * max(both, 0), Pack(0));
  }
  const Pack k1 = select(holds, after, Pack(0));
  c.resultant[2] += k1 * pull.n;
  c.resultant[3] += k1 * pull.t;
  c.resultant[4] -= k1 * pull.s;
  c.stored += 0.5 * k1 * work_of(pull, c.gap);
  if (damped) {
    const Pull then = pull_of(shape, i, c.gap_before, holds);
    const Pack left = select(b.damage < 1, k1 * c.rate, Pack(0));
    c.drag[2] += left * (pull.n - then.n);
    c.drag[3] += left * (pull.t - then.t);
    c.drag[4] -= left * (pull.s - then.s);
  }
  store(bonded.damage, b.damage);
  store(bonded.secant, b.secant);
  store(bonded.kappa, b.kappa);
  return b.damage;
}

template <bool damped>
static bool respond_lanes(const PointLaw& law, const CrackedShape& shape, BondPack* bond, CrackedPack& lane, const double* poses,
                          double* wrench_rows, CrackedSums& sums) {
  Pack depth[most_points_per_joint];
  bool out_of_range = false;
  JointMotion now;
  Cracking c;
  relative_motion(lane, *shape.face, poses, now);
  start<damped>(shape, lane, now, c);
  const Compression closed = compression(law.kn, shape, c.gap);
  const Compression then = damped ? compression(law.kn, shape, c.gap_before) : Compression{};
  const bool pressed = law.fc > 0 || any(closed.force > 0);
  const Pack scale = pressed ? compress<damped>(law, shape, c, closed, then, depth) : Pack(0);
  const Mask slides_slowly = slow(shape, c);
  Pack least = Pack(1);
  for (int i = 0; i < shape.points; ++i) {
    const Pack damage =
        point_response<damped>(law, shape, lane.slip()[i], bond[i], i, pressed ? scale * depth[i] : Pack(0), slides_slowly, c);
    least = min(damage, least);
  }
  finish_step<damped>(shape, c, lane, sums);
  store(lane.least_damage, least);
  write_joint_wrenches(lane, now, c.resultant, wrench_rows);
  out_of_range = may_be_out_of_range(*shape.face, c.gap) || out_of_range;
  return out_of_range;
}

static bool respond(const PointLaw& law, const CrackedShape& shape, BondPack* bond, CrackedPack& lane, const double* poses,
                    double* wrench_rows, CrackedSums& sums) {
  return (shape.per_step > 0 ? respond_lanes<true> : respond_lanes<false>)(law, shape, bond, lane, poses, wrench_rows, sums);
}

}  // namespace erbs::ERBS_TARGET
