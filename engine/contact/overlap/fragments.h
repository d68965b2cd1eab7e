// Clips and splits the faces of the other bodies of up to eight pairs, stage by stage. A polygon's next cut waits some sixty cycles for the
// one before. So each stage goes through the polygons of all pairs, which do not wait for one another. No branch depends on their shape.
// A pair's polygons and their order do not depend on the other pairs.
#pragma once
#include "engine/contact/overlap/clip.h"
#include "engine/contact/overlap/cut.h"

namespace erbs::ERBS_TARGET {

inline constexpr int most_fragments = 48;  // of a pair

struct ClipFragments {
  Polygon of[8 * most_fragments];
  int count = 0;
  int of_pair[8] = {};
  Polygon* list[2][8 * most_fragments];  // polygons with work left, in this round and in the next
  CutPlan plan[8 * most_fragments];      // of the polygons in this round
  Triangles* out[8];
};

static Pack depth_below(const Triangles& w, int f, const Pack x[3]) {
  return w.plane[3][f] - (w.plane[0][f] * x[0] + w.plane[1][f] * x[1] + w.plane[2][f] * x[2]);
}

// How much deeper below face e than below face f.
static Pack depth_between(const Triangles& w, unsigned e, unsigned f, const Pack x[3]) {
  const auto& p = w.plane;
  return (p[3][e] - p[3][f]) - ((p[0][e] - p[0][f]) * x[0] + (p[1][e] - p[1][f]) * x[1] + (p[2][e] - p[2][f]) * x[2]);
}

// True if a pair has room for one more piece; otherwise its overlap is marked as too large.
static bool has_room(ClipFragments& all, int pair) {
  if (all.of_pair[pair] < most_fragments) return true;
  all.out[pair]->overflow = true;
  return false;
}

// Sets the planes of both bodies and the corners of b in pair axes.
static inline void place_bodies(const ClipTask& task, Pack vertex[3]) {
  const SmallShape &a = *task.a, &b = *task.b;
  const SmallPose& pose = task.pose;
  Triangles& out = *task.out;
  out.count = 0;
  out.separating_axis = -1;
  out.overflow = false;
  const Pack n[3] = {load(a.normal[0]), load(a.normal[1]), load(a.normal[2])};
  store(out.plane[3], load(a.offset) - (n[0] * pose.shift[0] + n[1] * pose.shift[1] + n[2] * pose.shift[2]));
  for (int i = 0; i < 3; ++i) {
    const double* r = &pose.rotation[3 * i];
    vertex[i] = r[0] * load(b.vertex[0]) + r[1] * load(b.vertex[1]) + r[2] * load(b.vertex[2]);
    store(out.plane[i], n[i]);
    store(out.normal[i], r[0] * load(b.normal[0]) + r[1] * load(b.normal[1]) + r[2] * load(b.normal[2]));
  }
}

// Lists the faces of b of which no face of a has all corners on its outer side.
static void list_faces(const ClipTask& task, const Pack vertex[3], int pair, ClipFragments& all) {
  const SmallShape &a = *task.a, &b = *task.b;
  Triangles& out = *task.out;
  all.out[pair] = &out;
  // a byte for each face of a, with the vertices of b on its inner side as bits
  constexpr unsigned long long ones = 0x0101010101010101ull, tops = 0x8080808080808080ull;
  unsigned long long inside = ~0ull;
  for (int f = 0; f < a.faces; ++f) {
    const unsigned in = bits(depth_below(out, f, vertex) > 0);
    if (in == 0) {
      out.separating_axis = f;
      return;
    }
    inside &= ~(0xffull << 8 * f) | static_cast<unsigned long long>(in) << 8 * f;
  }
  for (int j = 0; j < b.faces; ++j) {
    const unsigned long long all_of_it = ones * b.mask[j], in = inside & all_of_it, not_in = in ^ all_of_it;
    const bool outside = ((in - ones) & ~in & tops) != 0;  // a zero byte
    Polygon& g = all.of[all.count];
    const Picks loop = picks(b.loop[j]);
    for (int i = 0; i < 3; ++i) g.x[i] = pick(vertex[i], vertex[i], loop);
    g.n = b.count[j];
    g.pair = pair;
    g.face = static_cast<unsigned>(j);
    const unsigned long long top_of_each = (((not_in & ~tops) + ~tops) | not_in) & tops;  // top bits of the bytes that are not zero
    g.left = static_cast<unsigned>((top_of_each >> 7) * 0x0102040810204080ull >> 56);
    all.count += !outside;
    all.of_pair[pair] += !outside;
  }
}

static int list_unfinished(ClipFragments& all) {
  int count = 0;
  for (int i = 0; i < all.count; ++i) {
    all.list[0][count] = &all.of[i];
    count += all.of[i].left != 0;
  }
  return count;
}

// Cuts all polygons by the faces of a in `Polygon::left`.
static void cut_all(ClipFragments& all) {
  Polygon **now = all.list[0], **then = all.list[1];
  for (int count = list_unfinished(all); count > 0;) {
    for (int k = 0; k < count; ++k) {
      Polygon& g = *now[k];
      if (g.n == few && has_room(all, g.pair)) {
        split_by_diagonal(g, all.of[all.count]);
        ++all.of_pair[g.pair];
        now[count++] = &all.of[all.count++];
      }
      const int f = __builtin_ctz(g.left);
      g.left &= g.left - 1;
      const Pack x[3] = {g.x[0], g.x[1], g.x[2]};
      plan_cut(g, x, depth_below(*all.out[g.pair], f, x), all.plan[k]);
    }
    int more = 0;
    for (int k = 0; k < count; ++k) {
      Polygon& g = *now[k];
      const CutPlan& plan = all.plan[k];
      const Cutting& stay = *plan.stay;
      const Pack x[3] = {g.x[0], g.x[1], g.x[2]};
      apply_cut(stay, x, plan.at, g);
      if (stay.no_room != 0) all.out[g.pair]->overflow = true;
      then[more] = &g;
      more += (g.left != 0) & (stay.count > 0);
    }
    count = more;
    Polygon** const done = now;
    now = then;
    then = done;
  }
}

// The faces of a that may be nearest somewhere on g, as bits. Only a face whose least depth is at most the smallest of the greatest depths
// can be.
static unsigned nearest_faces(const Polygon& g, const Triangles& w) {
  const Pack nx = load(w.plane[0]), ny = load(w.plane[1]), nz = load(w.plane[2]), below = load(w.plane[3]);
  const auto depth = [&](int i) { return below - (nx * g.x[0][i] + ny * g.x[1][i] + nz * g.x[2][i]); };
  Pack least = depth(0), most = least;
  const auto take = [&](int i) {
    const Pack d = depth(i);
    least = min(d, least);
    most = max(d, most);
  };
  take(1), take(2), take(3), take(4), take(5);  // lanes beyond the last corner repeat the first
  if (g.n > 6) take(6), take(7);
  const double bound = least_of(max(most, Pack(0)));
  return bits(bound - least >= 0);
}

// Finds the faces of a that may be nearest on each polygon. Polygons with many such faces are split for room.
static void find_nearest(ClipFragments& all) {
  for (int i = 0; i < all.count; ++i) {
    Polygon& g = all.of[i];
    g.left = 0;
    if (g.n == 0) continue;
    const Triangles& w = *all.out[g.pair];
    unsigned found = nearest_faces(g, w);
    while (g.n + __builtin_popcount(found) - 1 > few && g.n > 3 && has_room(all, g.pair)) {  // all corners might not fit
      split_by_diagonal(g, all.of[all.count++]);
      ++all.of_pair[g.pair];
      found = nearest_faces(g, w);
    }
    g.nearest = static_cast<unsigned>(__builtin_ctz(found | 1u << few));
    g.left = found & (found - 1);
  }
}

// Splits the polygons by nearest face: each candidate face in turn takes the part of every piece where it is nearer.
static void split_by_nearest_face(ClipFragments& all) {
  Polygon **now = all.list[0], **then = all.list[1];
  for (int count = list_unfinished(all); count > 0;) {
    for (int k = 0; k < count; ++k) {
      Polygon& g = *now[k];
      const unsigned face = static_cast<unsigned>(__builtin_ctz(g.left));
      const Pack x[3] = {g.x[0], g.x[1], g.x[2]};
      plan_split(g, x, depth_between(*all.out[g.pair], face, g.nearest, x), face, all.plan[k]);
    }
    int more = 0, fragments = all.count;
    for (int k = 0; k < count; ++k) {
      Polygon &g = *now[k], &split_off = all.of[fragments];
      const CutPlan& plan = all.plan[k];
      const Cutting &stay = *plan.stay, &go = *plan.go;
      if (!has_room(all, g.pair)) continue;
      if ((stay.no_room | go.no_room) != 0) all.out[g.pair]->overflow = true;
      const unsigned left = g.left & (g.left - 1);
      const Pack x[3] = {g.x[0], g.x[1], g.x[2]};
      split_off.pair = g.pair;
      split_off.face = g.face;
      split_off.nearest = static_cast<unsigned>(__builtin_ctz(g.left));
      split_off.left = g.left = left;
      apply_cut(go, x, plan.at, split_off);
      apply_cut(stay, x, plan.at, g);
      const int again = left != 0, two = plan.splits;
      then[more] = &g;
      more += again;
      then[more] = &split_off;
      more += again & two;
      fragments += two;
      all.of_pair[g.pair] += two;
    }
    all.count = fragments;
    count = more;
    Polygon** const done = now;
    now = then;
    then = done;
  }
}

// Appends four triangles of a polygon: those between its first corner and the edges from corner `first` to corner first + 4.
template <int first>
ERBS_INLINE void append(const Polygon& g, int t, Triangles& out) {
  for (int i = 0; i < 3; ++i) {
    store_four<0, 0, 0, 0>(out.corner[0][i] + t, g.x[i]);
    store_four<first, first + 1, first + 2, (first + 3) % 8>(out.corner[1][i] + t, g.x[i]);
    store_four<first + 1, first + 2, (first + 3) % 8, (first + 4) % 8>(out.corner[2][i] + t, g.x[i]);
  }
}

// Adds empty triangles at an existing corner, up to a multiple of eight.
static void fill_up(Triangles& out) {
  const int t = out.count;
  if (t % 8 == 0) return;
  for (int k = 0; k < 3; ++k) {
    for (int i = 0; i < 3; ++i) store(&out.corner[k][i][t], Pack(out.corner[0][i][t - 1]));
  }
  __builtin_memset(&out.faces[t], out.faces[t - 1], 8);
  out.count = (t + 7) / 8 * 8;
}

[[gnu::noinline, maybe_unused]] static void append_rest(const Polygon& g, int t, Triangles& out) { append<5>(g, t, out); }

// Divides the pieces into triangles, fans from their first corners.
static void append_all(const ClipFragments& all, int pairs) {
  unsigned long long counts = 0;  // of triangles, a byte for each pair
  for (int i = 0; i < all.count; ++i) {
    const Polygon& g = all.of[i];
    const int t = counts >> 8 * g.pair & 0xff, triangles = g.n > 2 ? g.n - 2 : 0;
    Triangles& out = *all.out[g.pair];
    if (t + triangles > most_triangles) {
      out.overflow = true;
      continue;
    }
    counts += static_cast<unsigned long long>(triangles) << 8 * g.pair;
    append<1>(g, t, out);
    if (triangles > 4) append_rest(g, t + 4, out);
    constexpr unsigned long long ones = 0x0101010101010101ull;
    const unsigned long long faces = ones * (g.face + few * g.nearest);
    __builtin_memcpy(&out.faces[t], &faces, sizeof faces);
  }
  for (int l = 0; l < pairs; ++l) {
    all.out[l]->count = counts >> 8 * l & 0xff;
    fill_up(*all.out[l]);
  }
}

}  // namespace erbs::ERBS_TARGET
