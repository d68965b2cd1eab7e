// Convex polygons of up to eight corners, a corner a lane, cut without a branch: which corners stay, and where new ones come in,
// follows from the signs by a table.
#pragma once
#include "engine/contact/overlap/clip.h"
#include "engine/simd/permute.h"

namespace erbs::ERBS_TARGET {

// Part of a face of b; what is left to do with it, and where it belongs.
struct Polygon {
  Pack x[3];               // m; lanes from n on repeat the first corner
  int n, pair;             // of those clipped together
  unsigned face, nearest;  // of b; of a
  unsigned left;           // faces of a that are still to cut it, as bits
};

// For a polygon of n corners of which those marked stay: the corners that are left, in order; lane i of it stays corner i, 8 + i is the
// point where the edge from corner i to the next is cut.
struct alignas(16) Cutting {
  unsigned char from[few], count, no_room;  // count: 0 where there is no room
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

// The corners that stay, and the points where edges are cut.
ERBS_INLINE void apply_cut(const Cutting& c, const Pack x[3], const Pack cut_at[3], Polygon& out) {
  const Picks from = picks(c.from);
  for (int i = 0; i < 3; ++i) out.x[i] = pick(x[i], cut_at[i], from);
  out.n = c.count;
}

// Where d, linear and given at the corners, is zero on the edge from each corner to the next; anything where it has no zero.
ERBS_INLINE void edge_cuts(const Pack x[3], Pack d, Pack at[3]) {
  const Pack share = d / (d - next(d));
  for (int i = 0; i < 3; ++i) at[i] = x[i] + share * (next(x[i]) - x[i]);
}

// How a polygon is to be cut. Found for many polygons first, then done: what waits for the signs of d should not wait in line with the
// next polygon's arithmetic.
struct CutPlan {
  Pack at[3];                // crossings()
  const Cutting *stay, *go;  // of the part where d >= 0, and of the rest
  bool splits;               // something of the rest
};

static inline unsigned either(bool first, unsigned a, unsigned b) {  // never a jump
  const unsigned mask = 0u - static_cast<unsigned>(first);
  return (a & mask) | (b & ~mask);
}

// Leaves the part where d >= 0: of a polygon in the plane nothing.
ERBS_INLINE void plan_cut(const Polygon& g, const Pack x[3], Pack d, CutPlan& k) {
  const unsigned corners = (1u << g.n) - 1, above = bits(d > 0) & corners, below = bits(d < 0) & corners;
  k.stay = &cuttings.of[g.n][either((above != 0) & (below == 0), corners, above)];
  edge_cuts(x, d, k.at);
}

// Where all of it would be taken, g remains as it is and is said to be near `other`.
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

// Leaves one of the two parts that a diagonal makes, for more room; the other in `rest`.
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
