// Closed-form integrals over rectangles of the positive part p+ of a linear field p, eight joints side by side.
//
// Let y be the axis of the face along which p changes most, x the other: gy = dp/dy. Then p+ is integrated along y first (divergence
// theorem with a field along y alone), so that only edges along x remain, at y_0 < y_1:
//   Int p+ dA = (E2(y_1) - E2(y_0)) / (2 gy),   Int p+^2 dA = (E3(y_1) - E3(y_0)) / (3 gy),   E_m(y) = Int p+^m dx,
//   Int x p+ dA alike with Int x p+^2 dx,   Int y p+ dA = ([y E2] - Int p+^2 dA) / (2 gy).
// It is well conditioned where p changes sign on the face: |gy| times half the side is then at least a quarter of the greatest |p|.
// compression.h has the same for any polygon, with twice the edges. Cells of a face that lie in a square grid share their edges: an edge
// counts with the difference of the stiffnesses below and above it.
#pragma once
#include "engine/joints/kernels.h"
#include "engine/simd/pack.h"

namespace erbs::ERBS_TARGET {

// The field about the joint's centre, its axes named as above; `swapped`: y is the s axis.
struct Strips {
  Mask swapped;
  Pack p, gx, gy, inverse;  // m; -; one over twelve gy
  ERBS_INLINE Pack x(Pack s, Pack t) const { return select(swapped, t, s); }
  ERBS_INLINE Pack y(Pack s, Pack t) const { return select(swapped, s, t); }
};

// p = p_0 + gs s + gt t. Valid in the lanes `marked`, where p changes sign on the face.
ERBS_INLINE Strips strips_of(const FacePack& face, Pack p_0, Pack gs, Pack gt, Mask marked) {
  const Mask swapped = abs(gs) * load(face.half_s) > abs(gt) * load(face.half_t);
  const Pack gx = select(swapped, gt, gs), gy = select(swapped, gs, gt);
  return {swapped, p_0, gx, gy, (1.0 / 12) / select(marked & (abs(gy) > 1e-150), gy, Pack(1))};
}

// A node: p+, |p| and p+^2.
struct StripNode {
  Pack p, size, square;
};
ERBS_INLINE StripNode strip_node(Pack p) {
  const Pack positive = max(p, 0);
  return {positive, abs(p), positive * positive};
}

struct StripSums {
  Pack p, x, square;  // sums of 6 Int p+^2 dx, 6 Int x p+^2 dx, 4 Int p+^3 dx
};

// Adds `weight` times the integrals over the edge of length dx that begins at x.
ERBS_INLINE void add_piece(const StripNode& a, const StripNode& b, Pack x, Pack dx, Pack weight, StripSums& sum) {
  const Pack both = a.p + b.p, part = both / not_quite_zero(a.size + b.size), squares = a.square + b.square;
  const Pack from = select(a.size > a.p, 1 - part, Pack(0)), share = weight * dx * part;
  const Pack p = share * (squares + both * both), along = p * from + share * (0.5 * squares + both * b.p) * part;
  sum.p += p;
  sum.x += p * x + along * dx;
  sum.square += share * (both * squares);
}

// Int p+, s p+, t p+ and p+^2 dA.
struct StripIntegrals {
  Pack p, s, t, square;
};

// From the sums over all edges; `rising`: the sum of y times that of p.
ERBS_INLINE StripIntegrals integrals_of(const Strips& strips, const StripSums& sum, Pack rising) {
  const Pack square = strips.inverse * sum.square, x = strips.inverse * sum.x, y = strips.inverse * (rising - 6 * square);
  return {strips.inverse * sum.p, select(strips.swapped, y, x), select(strips.swapped, x, y), square};
}

// Over the whole face.
ERBS_INLINE StripIntegrals positive_part_of_rectangle(const FacePack& face, Pack p_0, Pack gs, Pack gt, Mask marked) {
  const Strips strips = strips_of(face, p_0, gs, gt, marked);
  const Pack half_x = strips.x(load(face.half_s), load(face.half_t)), half_y = strips.y(load(face.half_s), load(face.half_t));
  const Pack rise = strips.gy * half_y, across = strips.gx * half_x, above = p_0 + rise, below = p_0 - rise;
  StripSums upper{}, lower{};
  add_piece(strip_node(above - across), strip_node(above + across), -half_x, 2 * half_x, Pack(1), upper);
  add_piece(strip_node(below - across), strip_node(below + across), -half_x, 2 * half_x, Pack(1), lower);
  return integrals_of(strips, {upper.p - lower.p, upper.x - lower.x, upper.square - lower.square}, half_y * (upper.p + lower.p));
}

// Over the cells of a face in a grid of n x n, each times its stiffness `k` (Pa/m). Point n b + a has the cell between the lines a and
// a + 1 along s, b and b + 1 along t. `size`: n where it is known, for the compiler.
template <int size>
ERBS_INLINE StripIntegrals positive_part_of_cells(const CrackedShape& shape, const Pack* k, Pack p_0, Pack gs, Pack gt, Mask marked) {
  const int n = size > 0 ? size : shape.lines;
  const Strips strips = strips_of(*shape.face, p_0, gs, gt, marked);
  Pack at[most_cells_in_line + 1], across[most_cells_in_line + 1], below[most_cells_in_line];
  for (int i = 0; i <= n; ++i) {
    at[i] = strips.x(load(shape.line[i].s), load(shape.line[i].t));
    across[i] = strips.gx * at[i];
  }
  for (int i = 0; i < n; ++i) below[i] = Pack(0);
  StripSums sum{};
  Pack rising{};
  for (int row = 0; row <= n; ++row) {
    const Pack y = strips.y(load(shape.line[row].s), load(shape.line[row].t)), p = p_0 + strips.gy * y;
    StripSums edge{};
    StripNode last = strip_node(p + across[0]);
    for (int i = 0; i < n; ++i) {
      const StripNode next = strip_node(p + across[i + 1]);
      const Pack here = row < n ? select(strips.swapped, k[n * i + row], k[n * row + i]) : Pack(0);
      add_piece(last, next, at[i], at[i + 1] - at[i], below[i] - here, edge);
      below[i] = here;
      last = next;
    }
    sum = {sum.p + edge.p, sum.x + edge.x, sum.square + edge.square};
    rising += y * edge.p;
  }
  return integrals_of(strips, sum, rising);
}

}  // namespace erbs::ERBS_TARGET
