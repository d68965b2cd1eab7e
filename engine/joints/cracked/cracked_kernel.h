// Response of cracked joints with a bond, eight of one law side by side. response.cpp is the plain form of the same.
#pragma once
#include "engine/joints/cracked/compression.h"
#include "engine/joints/kernels.h"
#include "engine/joints/relative_pose.h"
#include "engine/laws/bond.h"

namespace erbs::ERBS_TARGET {

// Tension of the cell of a point at unit stiffness, Int max(g, 0) dA and its first moments (response.cpp).
struct Pull {
  Pack n, s, t;  // m3, m4, m4
};

static inline Pack work_of(const Pull& p, const Pack* gap) { return p.n * gap[2] + p.t * gap[3] - p.s * gap[4]; }

// The least and the greatest gap in a polygon (m).
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

// `span`: of the cell. Valid in the lanes `marked`: a cell without a bond has no tension, and its integral would cost time for nothing.
static inline Pull pull_of(const CrackedShape& shape, int i, const Pack* gap, Span span, Mask marked) {
  const Mask open = marked & (span.most > 0), partly_open = open & (span.least < 0), whole = open & !partly_open;
  if (!any(open)) return {Pack(0), Pack(0), Pack(0)};
  const CellPack& cell = shape.cell[i];
  const Pack area = load(shape.point[i].weight), s = load(cell.s), t = load(cell.t), st = load(cell.st);
  Pull out{select(whole, gap[2] * area + gap[3] * t - gap[4] * s, Pack(0)),
           select(whole, gap[2] * s + gap[3] * st - gap[4] * load(cell.ss), Pack(0)),
           select(whole, gap[2] * t + gap[3] * load(cell.tt) - gap[4] * st, Pack(0))};
  if (!any(partly_open)) return out;
  const StripIntegrals sum =
      positive_part(shape.cell_loop + shape.first[i], shape.first[i + 1] - shape.first[i], gap[2], -gap[4], gap[3], partly_open);
  return {select(partly_open, sum.p, out.n), select(partly_open, sum.s, out.s), select(partly_open, sum.t, out.t)};
}
static inline Pull pull_of(const CrackedShape& shape, int i, const Pack* gap, Mask marked) {
  return pull_of(shape, i, gap, span_of(shape.cell_loop, shape.first[i], shape.first[i + 1], gap), marked);
}

// Position (m), share of the area (m2) and gap (m) of a point.
struct PointSample {
  Pack s, t, weight, n;
};

// Radial return of the sliding lanes of one point.
static inline void slide(const PointLaw& law, SlipPack& p, const PointSample& x, Cracking& c, Bond<Pack>& b, bool bonds, Mask slides,
                         Pack sigma, Pack pressure, Pack size, Pack cap, Pack& gs, Pack& gt) {
  SlipReturn<Pack> slip{{gs, gt}, {load(p.s), load(p.t)}, {}, {}};
  const InPlane<Pack> before{c.gap_before[0] - c.gap_before[5] * x.t - slip.plastic.s,
                             c.gap_before[1] + c.gap_before[5] * x.s - slip.plastic.t};
  return_slip(law, b, bonds, slides, c.ks * x.weight, x.weight, size, cap, pressure, sigma, before, slip);
  store(p.s, slip.plastic.s);
  store(p.t, slip.plastic.t);
  gs = slip.elastic.s, gt = slip.elastic.t;
  c.friction += slip.friction;
  c.fracture += slip.fracture;
}

// Dashpots of a point that neither slides nor hangs open, k its shear stiffness (N/m), within its limit `cap` (N).
ERBS_INLINE void add_drag(const PointSample& x, Pack k, Mask sticking, InPlane<Pack> shear, Pack cap, Cracking& c) {
  const Pack rotation = c.gap[5] - c.gap_before[5], rate = select(sticking, k * c.rate, Pack(0));
  InPlane<Pack> drag{rate * (c.gap[0] - c.gap_before[0] - rotation * x.t), rate * (c.gap[1] - c.gap_before[1] + rotation * x.s)};
  const Mask past = square(InPlane<Pack>{shear.s + drag.s, shear.t + drag.t}) > max(square(shear), cap * cap);
  if (any(past)) {
    const Pack share = share_within(shear, drag, cap, past);
    drag = {share * drag.s, share * drag.t};
  }
  c.drag[0] += drag.s;
  c.drag[1] += drag.t;
  c.drag[5] += drag.t * x.s - drag.s * x.t;
}

// Fracture energy of a cell whose stiffness falls in this step (Pa/m): half the loss times Int g0 g1 over the open part of the cell, as the
// mean over the open parts before and after.
ERBS_INLINE void book_fracture(const CrackedShape& shape, int i, const Pull& pull, Mask holds, Mask damage_changed, Pack before, Pack after,
                               Cracking& c) {
  const Pack both = work_of(pull, c.gap_before) + work_of(pull_of(shape, i, c.gap_before, holds), c.gap);
  c.fracture += select(damage_changed, 0.25 * (before - after) * max(both, 0), Pack(0));
}

// Tension of the cell of a point that `holds`, from its stiffness before and after this step's damage (Pa/m).
template <bool damped>
ERBS_INLINE void add_tension(const CrackedShape& shape, int i, Span span, Mask holds, Mask still_holds, Pack before, Pack after,
                             Cracking& c) {
  const Pull pull = pull_of(shape, i, c.gap, span, holds);
  const Mask damage_changed = holds & (before != after);
  if (any(damage_changed)) book_fracture(shape, i, pull, holds, damage_changed, before, after, c);
  const Pack k = select(holds, after, Pack(0));
  c.resultant[2] += k * pull.n;
  c.resultant[3] += k * pull.t;
  c.resultant[4] -= k * pull.s;
  c.stored += 0.5 * k * work_of(pull, c.gap);
  if (!damped) return;
  const Pull then = pull_of(shape, i, c.gap_before, holds);
  const Pack left = select(still_holds, k * c.rate, Pack(0));
  c.drag[2] += left * (pull.n - then.n);
  c.drag[3] += left * (pull.t - then.t);
  c.drag[4] -= left * (pull.s - then.s);
}

// Tension of all cells of a face whose cells form a grid. A joint that is open all over has a linear tension.
struct GridTension {
  Pack k[most_cells_in_line * most_cells_in_line];              // Pa/m, of each point; 0 without a bond
  Pack most_s[most_cells_in_line], most_t[most_cells_in_line];  // m, greatest parts of the gap by rotation in each strip
  Pack least_s[most_cells_in_line], least_t[most_cells_in_line];
  bool damage_changed = false;

  ERBS_INLINE Span span(const CrackedShape& shape, int i, const Pack* gap) const {
    const int a = i % shape.lines, b = i / shape.lines;
    return {(gap[2] + least_t[b]) - most_s[a], (gap[2] + most_t[b]) - least_s[a]};
  }
};

ERBS_INLINE void set_spans(const CrackedShape& shape, const Pack* gap, GridTension& grid) {
  Pack s = gap[4] * load(shape.line[0].s), t = gap[3] * load(shape.line[0].t);
  for (int i = 0; i < shape.lines; ++i) {
    const Pack next_s = gap[4] * load(shape.line[i + 1].s), next_t = gap[3] * load(shape.line[i + 1].t);
    grid.least_s[i] = min(s, next_s), grid.most_s[i] = max(s, next_s);
    grid.least_t[i] = min(t, next_t), grid.most_t[i] = max(t, next_t);
    s = next_s, t = next_t;
  }
}

static inline void update_tension(const CrackedShape& shape, const Pack* k, TensionPack& out) {
  Pack sum{}, s{}, t{}, ss{}, st{}, tt{};
  for (int i = 0; i < shape.points; ++i) {
    const CellPack& cell = shape.cell[i];
    sum += k[i] * load(shape.point[i].weight);
    s += k[i] * load(cell.s), t += k[i] * load(cell.t);
    ss += k[i] * load(cell.ss), st += k[i] * load(cell.st), tt += k[i] * load(cell.tt);
  }
  store(out.k, sum), store(out.s, s), store(out.t, t), store(out.ss, ss), store(out.st, st), store(out.tt, tt);
}

ERBS_INLINE void add_grid_tension(const CrackedShape& shape, const GridTension& grid, CrackedPack& lane, Cracking& c) {
  const Pack* gap = c.gap;
  const Pack reach = abs(gap[3]) * load(shape.face->half_t) + abs(gap[4]) * load(shape.face->half_s);
  const Mask open = gap[2] - reach >= 0, closed = gap[2] + reach < 0, partly = !(open | closed);
  StripIntegrals sum{};
  Pack twice_stored{};
  if (grid.damage_changed || lane.tension_outdated != 0) update_tension(shape, grid.k, lane.tension), lane.tension_outdated = 0;
  if (any(open)) {
    const TensionPack& k = lane.tension;
    const Pack s = load(k.s), t = load(k.t), st = load(k.st);
    sum.p = select(open, gap[2] * load(k.k) + gap[3] * t - gap[4] * s, Pack(0));
    sum.s = select(open, gap[2] * s + gap[3] * st - gap[4] * load(k.ss), Pack(0));
    sum.t = select(open, gap[2] * t + gap[3] * load(k.tt) - gap[4] * st, Pack(0));
    twice_stored = sum.p * gap[2] + sum.t * gap[3] - sum.s * gap[4];
  }
  if (any(partly)) {
    const StripIntegrals cells = shape.lines == 3 ? positive_part_of_cells<3>(shape, grid.k, gap[2], -gap[4], gap[3], partly)
                                                  : positive_part_of_cells<0>(shape, grid.k, gap[2], -gap[4], gap[3], partly);
    sum = {select(partly, cells.p, sum.p), select(partly, cells.s, sum.s), select(partly, cells.t, sum.t), Pack(0)};
    twice_stored = select(partly, cells.square, twice_stored);
  }
  c.resultant[2] += sum.p;
  c.resultant[3] += sum.t;
  c.resultant[4] -= sum.s;
  c.stored += 0.5 * twice_stored;
}

// One point under the pressure `stress` (Pa): its bond, its friction, its tension. Returns its damage.
// `in_grid`: its tension is added later, with that of all cells of the grid.
template <bool damped, bool in_grid>
ERBS_INLINE Pack point_response(const PointLaw& law, const CrackedShape& shape, SlipPack& p, BondPack& bonded, int i, Pack stress,
                                Mask slow, GridTension& grid, Cracking& c) {
  const PointSample x{load(shape.point[i].s), load(shape.point[i].t), load(shape.point[i].weight), gap_of(shape.point[i], c.gap)};
  const Pack held = interlocked_stress(c.lock, p, x.n, stress, slow), pressure = x.weight * held;
  Bond<Pack> b{load(bonded.damage), load(bonded.secant), load(bonded.kappa)};
  const Mask holds = b.damage < 1;
  const bool bonds = any(holds);
  const Pack before = b.stiffness(law);
  Pack sigma{}, strength{};
  Span span{};
  if (bonds) {
    span = in_grid ? grid.span(shape, i, c.gap) : span_of(shape.cell_loop, shape.first[i], shape.first[i + 1], c.gap);
    const Span tension_span =
        shape.tension_loop == shape.cell_loop ? span : span_of(shape.tension_loop, shape.first[i], shape.first[i + 1], c.gap);
    sigma = damage_by_opening(law, b, holds, max(tension_span.most, x.n), x.n);
    if (law.closing_ultimate > 0) damage_by_closing(law, b, holds, -min(tension_span.least, x.n), sigma);
    strength = bond_shear(law, sigma, b.damage);
  }
  const Pack k = c.ks * x.weight;
  Pack gs = c.gap[0] - c.gap[5] * x.t - load(p.s), gt = c.gap[1] + c.gap[5] * x.s - load(p.t);
  Pack ts = k * gs, tt = k * gt;
  const Pack cap = strength * x.weight + friction_at(law, b.damage) * pressure, square = ts * ts + tt * tt;
  const Mask slides = square > cap * cap;
  if (any(slides)) slide(law, p, x, c, b, bonds, slides, sigma, pressure, sqrt(square), cap, gs, gt), ts = k * gs, tt = k * gt;
  if (any((held > stress) | (load(p.lent) > 0)))
    lend(c.lock, p, stress, held,
         pressure_of_friction(sqrt(ts * ts + tt * tt), bond_shear(law, sigma, b.damage) * x.weight, friction_at(law, b.damage), x.weight));
  c.resultant[0] += ts;
  c.resultant[1] += tt;
  c.resultant[5] += tt * x.s - ts * x.t;
  c.stored += 0.5 * (ts * gs + tt * gt);
  if (damped) add_drag(x, k, ((x.n < 0) | (b.damage < 1)) & !slides, InPlane<Pack>{ts, tt}, cap, c);
  if (in_grid) grid.k[i] = select(holds, b.stiffness(law), Pack(0));
  if (!bonds) return b.damage;
  if (!in_grid) add_tension<damped>(shape, i, span, holds, b.damage < 1, before, b.stiffness(law), c);
  else if (const Mask damage_changed = holds & (before != b.stiffness(law)); any(damage_changed)) {
    book_fracture(shape, i, pull_of(shape, i, c.gap, span, damage_changed), damage_changed, damage_changed, before, b.stiffness(law), c);
    grid.damage_changed = true;
  } else if (!any(b.damage != load(bonded.damage))) return b.damage;
  store(bonded.damage, b.damage);
  store(bonded.secant, b.secant);
  store(bonded.kappa, b.kappa);
  return b.damage;
}

template <class Face, bool damped, bool in_grid>
static bool respond_pack(const PointLaw& law, const CrackedShape& shape, BondPack* bond, CrackedPack& lane, const double* poses,
                         double* wrench_rows, CrackedSums& sums) {
  Pack depth[most_points_per_joint];
  JointMotion now;
  Cracking c;
  relative_motion(lane, *shape.face, poses, now);
  start<Face, damped>(law, shape, lane, now, c);
  Compression closed = compression(law.kn, c.share_n, shape, c.gap);
  if constexpr (Face::lifts) lift<Face>(law, shape, lane, c, closed);
  const Compression then = damped ? compression(law.kn, c.share_n, shape, c.gap_before) : Compression{};
  const bool pressed = (Face::yields && law.crushes()) || any(closed.force > 0);
  const Pack scale = pressed ? compress<Face, damped>(law, shape, c, closed, then, depth) : Pack(0);
  const Mask slow = slides_slowly(shape, c);
  Pack least = Pack(1);
  GridTension grid;
  if (in_grid) set_spans(shape, c.gap, grid);
  for (int i = 0; i < shape.points; ++i) {
    const Pack stress = pressed ? scale * depth[i] : Pack(0);
    const Pack damage = point_response<damped, in_grid>(law, shape, lane.slip()[i], bond[i], i, stress, slow, grid, c);
    least = min(damage, least);
  }
  if (in_grid) add_grid_tension(shape, grid, lane, c);
  store(lane.least_damage, least);
  finish_step<Face, damped>(law, shape, c, lane, sums);
  write_joint_wrenches(lane, now, c.resultant, wrench_rows);
  return may_be_out_of_range(*shape.face, c.gap);
}

template <class Face>
static bool respond(const PointLaw& law, const CrackedShape& shape, BondPack* bond, CrackedPack& lane, const double* poses,
                    double* wrench_rows, CrackedSums& sums) {
  const auto pack = shape.per_step > 0 ? respond_pack<Face, true, false>
                    : shape.lines > 0  ? respond_pack<Face, false, true>
                                       : respond_pack<Face, false, false>;
  return pack(law, shape, bond, lane, poses, wrench_rows, sums);
}

}  // namespace erbs::ERBS_TARGET
