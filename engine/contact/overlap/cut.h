// Cuts convex polygons of up to eight corners, with a corner in each lane and without a branch. A table gives, for the signs at the
// corners, which corners stay and where new ones come in. `cut_polygon()` in geometry/clip.h does the same for any polygon.
#pragma once
#include "engine/contact/overlap/clip.h"
#include "engine/simd/permute.h"

namespace erbs::ERBS_TARGET {

// Part of a face of b, with the pair that it belongs to and the cuts that are left.
struct Polygon {
  Pack x[3];               // m; lanes from n on repeat the first corner
  int n, pair;             // number of corners; number of the pair among those clipped together
  unsigned face, nearest;  // of b; of a
  unsigned left;           // faces of a that are still to cut it, as bits
};

// The corners, in order, of a polygon of which some corners stay: i stands for corner i, 8 + i for the point where the edge from corner i
// to the next is cut.
struct alignas(16) Cutting {
  unsigned char from[few], count, no_room;  // `count` is 0 if there is no room
};
constexpr Cutting cutting(int n, unsigned stays) {
  Cutting out{};
  int count = 0;
  for (int i = 0, last = n - 1; i < n; last = i++) {
    const bool stay = (stays >> i & 1u) != 0, other = (stays >> last & 1u) != stay;
    if (other && count < few) out.from[count] = static_cast<unsigned char>(8 + last);
    count += other;
    if (stay && count < few) out.from[count] = static_cast<unsigned char>(i);
    count += stay;
  }
  for (int i = count; i < few; ++i) out.from[i] = out.from[0];
  out.no_room = count > few ? 1 : 0;
  out.count = static_cast<unsigned char>(count > few ? 0 : count);
  return out;
}
struct Cuttings {
  Cutting of[few + 1][1 << few];
};
constexpr Cuttings all_cuttings() {
  Cuttings c{};
  for (int n = 3; n <= few; ++n)
    for (unsigned stays = 0; stays < 1u << n; ++stays) c.of[n][stays] = cutting(n, stays);
  return c;
}
inline constexpr Cuttings cuttings = all_cuttings();

// Sets the corners of `out`: those that stay, and the points `cut_at` where edges are cut.
ERBS_INLINE void apply_cut(const Cutting& c, const Pack x[3], const Pack cut_at[3], Polygon& out) {
  const Picks from = picks(c.from);
  for (int i = 0; i < 3; ++i) out.x[i] = pick(x[i], cut_at[i], from);
  out.n = c.count;
}

// Finds the zero of d, linear and given at the corners, on the edge from each corner to the next. Edges without a zero get any point.
ERBS_INLINE void edge_cuts(const Pack x[3], Pack d, Pack at[3]) {
  const Pack share = d / (d - next(d));
  for (int i = 0; i < 3; ++i) at[i] = x[i] + share * (next(x[i]) - x[i]);
}

// How a polygon is to be cut. All polygons of a stage are planned before the first is cut, so that the arithmetic of one does not wait for
// the signs of another.
struct CutPlan {
  Pack at[3];                // edge_cuts()
  const Cutting *stay, *go;  // corners of the part where d >= 0, and of the rest
  bool splits;               // the rest is not empty
};

static inline unsigned either(bool first, unsigned a, unsigned b) {  // without a branch
  const unsigned mask = 0u - static_cast<unsigned>(first);
  return (a & mask) | (b & ~mask);
}

// Plans to keep the part where d >= 0. A polygon in the plane of the cut is dropped.
ERBS_INLINE void plan_cut(const Polygon& g, const Pack x[3], Pack d, CutPlan& k) {
  const unsigned corners = (1u << g.n) - 1, above = bits(d > 0) & corners, below = bits(d < 0) & corners;
  k.stay = &cuttings.of[g.n][either((above != 0) & (below == 0), corners, above)];
  edge_cuts(x, d, k.at);
}

// Plans to split g into the part where d >= 0 and the rest, which is nearer to `other`. If all of g is the rest, g stays whole and changes
// its nearest face.
ERBS_INLINE void plan_split(Polygon& g, const Pack x[3], Pack d, unsigned other, CutPlan& k) {
  const unsigned corners = (1u << g.n) - 1, above = bits(d > 0) & corners, below = bits(d < 0) & corners;
  const bool up = above != 0, down = below != 0;
  const Cutting* of = cuttings.of[g.n];
  k.splits = down & up;
  k.stay = &of[either(k.splits, above, corners)];
  k.go = &of[either(k.splits, below, 0)];
  g.nearest = either(down & !up, other, g.nearest);
  edge_cuts(x, d, k.at);
}

// Splits g by a diagonal, to make room for more corners. One part stays in g, the other goes to `rest`.
static inline void split_by_diagonal(Polygon& g, Polygon& rest) {
  const int middle = g.n / 2;
  unsigned char first[few] = {}, second[few] = {};
  for (int i = 1; i <= middle; ++i) first[i] = static_cast<unsigned char>(i);
  for (int i = middle; i < g.n; ++i) second[1 + i - middle] = static_cast<unsigned char>(i);
  rest.pair = g.pair, rest.face = g.face, rest.left = g.left;
  rest.n = g.n - middle + 1;
  g.n = middle + 1;
  for (int i = 0; i < 3; ++i) {
    const Pack x = g.x[i];
    g.x[i] = pick(x, x, picks(first));
    rest.x[i] = pick(x, x, picks(second));
  }
}

}  // namespace erbs::ERBS_TARGET
