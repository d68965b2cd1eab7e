// The overlap of a pair from the planes that meet in its corners. Corners move between two steps, but mostly the same planes meet in them.
// Then the overlap is found without a cut, and only the proof is left that nothing has changed.
//
// Each face j of b has a convex piece for each face f of a. The piece is inside b, inside a, and nearer to f than to any other face of a.
// Three planes meet at a corner: faces of b, faces of a, planes half-way between two faces of a. A known corner is tested against all
// conditions other than those that make it. If it satisfies them strictly, it is a corner of the true piece, and so are its sides. If all
// corners do, the sides close, and the pieces are the true ones. Along edges of b pieces continue on the next face. So only a piece apart
// from all others could be missed. Since phi is concave on a face, such a piece arises where a corner of a leaves b. The corners of a
// inside b are known too.
//
// Corners are numbered in the order of their planes, pieces in the order of their faces. So the result depends on the pose alone, not on
// when the corners were found.
#pragma once
#include <cstdint>

#include "engine/contact/overlap/clip.h"
#include "engine/contact/overlap/fragments.h"
#include "engine/simd/permute.h"

namespace erbs::ERBS_TARGET {

// Shares of the smallest edge of b: greatest distance of a corner on a plane, and least distance of one that surely is not on it.
inline constexpr double on_plane = 1e-12, off_plane = 1e-10, off_over_sine = 1e-13;

// The planes of both bodies, pair axes: normal (components 0 to 2) . x <= component 3.
struct Planes {
  Pack a[4], b[4];
};

ERBS_INLINE Planes planes_of(const ClipTask& task) {
  const Triangles& w = *task.out;
  return {{load(w.plane[0]), load(w.plane[1]), load(w.plane[2]), load(w.plane[3])},
          {load(w.normal[0]), load(w.normal[1]), load(w.normal[2]), load(task.b->offset)}};
}

// Corners of a inside b, as bits.
static inline unsigned corners_inside(const ClipTask& task) {
  const SmallShape &a = *task.a, &b = *task.b;
  Pack x[3];
  for (int i = 0; i < 3; ++i) x[i] = load(a.vertex[i]) - task.pose.shift[i];
  unsigned inside = (1u << a.vertices) - 1;
  const auto& n = task.out->normal;
  for (int j = 0; j < b.faces; ++j) inside &= bits(b.offset[j] - (n[0][j] * x[0] + n[1][j] * x[1] + n[2][j] * x[2]) > 0);
  return inside;
}

// The lanes with the bit `last`, as bits.
ERBS_INLINE unsigned beyond(const unsigned char from[8], unsigned last) {
  unsigned bits = 0;
  for (int i = 0; i < 8; ++i) bits |= unsigned((from[i] & last) != 0) << i;
  return bits;
}

// a - b in the marked lanes, else a.
ERBS_INLINE Pack subtract_where(Mask m, Pack a, Pack b) { return select(m, a - b, a); }

// Finds eight corners, from number `from` on, where their planes meet. False if one of them no longer is a corner.
ERBS_INLINE bool intersect_planes(const ClipTask& task, const Planes& p, const Pack vertex[3], const Corners& c, int from, Pack x[3]) {
  const SmallShape &a = *task.a, &b = *task.b;
  const Words of_corner = words(c.planes + from);
  const Picks first = picks<0>(of_corner), second = picks<4>(of_corner), third = picks<12>(of_corner), nearest = picks<20>(of_corner);
  const Picks other_second = picks<8>(of_corner), other_third = picks<16>(of_corner);
  const auto of = [from](std::uint32_t bits) { return Mask::of_bits((bits >> from) & 0xffu); };
  const Mask is_vertex = of(c.is_vertex), on_surface = of(c.on[Corners::surface]);
  Pack n[4], m[4], o[4];
  for (int i = 0; i < 4; ++i) {
    n[i] = pick(p.a[i], p.b[i], first);
    m[i] = subtract_where(of(c.second_half), pick(p.a[i], p.b[i], second), pick(p.a[i], p.b[i], other_second));
    o[i] = subtract_where(of(c.third_half), pick(p.a[i], p.b[i], third), pick(p.a[i], p.b[i], other_third));
  }
  // x = (c_n m x o + (c_m o - c_o m) x n) / (n . m x o)
  const Pack mo[3] = {m[1] * o[2] - m[2] * o[1], m[2] * o[0] - m[0] * o[2], m[0] * o[1] - m[1] * o[0]};
  const Pack q[3] = {m[3] * o[0] - o[3] * m[0], m[3] * o[1] - o[3] * m[1], m[3] * o[2] - o[3] * m[2]};
  const Pack qn[3] = {q[1] * n[2] - q[2] * n[1], q[2] * n[0] - q[0] * n[2], q[0] * n[1] - q[1] * n[0]};
  const Pack over = 1 / (n[0] * mo[0] + n[1] * mo[1] + n[2] * mo[2]);
  for (int i = 0; i < 3; ++i) x[i] = select(is_vertex, pick(vertex[i], vertex[i], first), over * (n[3] * mo[i] + qn[i]));
  const Pack margin = b.edge * (off_plane + off_over_sine * select(is_vertex, Pack(0), abs(over)));
  const Pack depth = pick(p.a[3], p.a[3], nearest) -
                     (pick(p.a[0], p.a[0], nearest) * x[0] + pick(p.a[1], p.a[1], nearest) * x[1] + pick(p.a[2], p.a[2], nearest) * x[2]);
  const Pack phi = select(on_surface, Pack(0), depth);
  const auto& u = task.out->plane;
  const auto& v = task.out->normal;
  Pack nearer = Pack(1e300), inside = select(on_surface, nearer, phi);
  for (int f = 0; f < a.faces; ++f)
    nearer = select(of(c.on[f]), nearer, min(u[3][f] - (u[0][f] * x[0] + u[1][f] * x[1] + u[2][f] * x[2]), nearer));
  for (int j = 0; j < b.faces; ++j)
    inside = select(of(c.on[few + j]), inside, min(b.offset[j] - (v[0][j] * x[0] + v[1][j] * x[1] + v[2][j] * x[2]), inside));
  return bits((nearer - phi > margin) & (inside > margin)) == 0xff;
}

// Finds the overlap of a placed pair from its known corners. False if they no longer hold.
static bool by_corners(const ClipTask& task, const Pack vertex[3], const Corners& c) {
  Triangles& out = *task.out;
  const Planes p = planes_of(task);
  Pack x[3][3];
  bool holds = corners_inside(task) == c.inside;
  holds &= intersect_planes(task, p, vertex, c, 0, x[0]);  // both are computed: no branch
  for (int i = 0; i < 3; ++i) x[1][i] = x[0][i];
  if (c.count > 8) holds &= intersect_planes(task, p, vertex, c, 8, x[1]);
  if (c.count > 16) holds &= intersect_planes(task, p, vertex, c, 16, x[2]);
  if (!holds) return false;
  for (int t = 0; t < c.triangles; t += 8) {
    const Corners::TrianglePack& triangle_pack = c.triangle_pack[t / 8];
    for (int k = 0; k < 3; ++k) {
      const Picks from = picks(triangle_pack.corner[k]);
      for (int i = 0; i < 3; ++i) store(&out.corner[k][i][t], pick(x[0][i], x[1][i], from));
      if (c.count <= 16) continue;
      const Mask behind = Mask::of_bits(beyond(triangle_pack.corner[k], 16));
      for (int i = 0; i < 3; ++i) store(&out.corner[k][i][t], select(behind, pick(x[2][i], x[2][i], from), load(&out.corner[k][i][t])));
    }
    __builtin_memcpy(&out.faces[t], triangle_pack.faces, 8);
  }
  out.count = (c.triangles + 7) / 8 * 8;
  return true;
}

// Planes of an overlap that has been cut

inline constexpr int most_found = 32;  // corners of all polygons

// Corners of an overlap, each once, with the planes on which they lie.
struct Found {
  alignas(64) unsigned planes[most_found];
  double x[most_found][3];
  unsigned faces[most_fragments];  // of the pieces, as in Triangles
  int count = 0, fragments = 0;
};

// The planes through each corner of a polygon, as bits in the order of Corners::on. The sum of powers of two is exact.
static inline Pack planes_at(const ClipTask& task, const Pack x[3]) {
  const Triangles& w = *task.out;
  const SmallShape &a = *task.a, &b = *task.b;
  const Pack near = on_plane * b.edge;
  Pack depth[few], phi = Pack(1e300);
  for (int f = 0; f < a.faces; ++f) phi = min(depth[f] = depth_below(w, f, x), phi);
  Pack planes = select(phi <= near, Pack(1 << Corners::surface), Pack(0));
  const Pack most = max(phi, Pack(0)) + near;
  for (int f = 0; f < a.faces; ++f) planes += select(depth[f] <= most, Pack(1 << f), Pack(0));
  for (int j = 0; j < b.faces; ++j) {
    const Pack below = b.offset[j] - (w.normal[0][j] * x[0] + w.normal[1][j] * x[1] + w.normal[2][j] * x[2]);
    planes += select(below <= near, Pack(1 << (few + j)), Pack(0));
  }
  return planes;
}

// A copy of Found::planes in registers. A search in memory would make each new corner wait for the store of the one before.
typedef unsigned W16 __attribute__((vector_size(64)));
struct Known {
  W16 planes[most_found / 16] = {};

  bool has(unsigned p) const {
    const auto same = (planes[0] == p) | (planes[1] == p);
#if defined(__AVX512F__)
    return _mm512_test_epi32_mask(__m512i(same), __m512i(same)) != 0;
#else
    unsigned any = 0;
    for (int i = 0; i < 16; ++i) any |= unsigned(same[i]);
    return any != 0;
#endif
  }
  void put(int at, unsigned p) {
    constexpr W16 first = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
    const unsigned place = static_cast<unsigned>(at);
    planes[0] = first == place ? p - W16{} : planes[0];
    planes[1] = first + 16 == place ? p - W16{} : planes[1];
  }
};

// Adds the corners and the piece of a polygon; false if there is no room.
static inline bool take(const Polygon& g, Pack planes, Known& known, Found& found) {
  const unsigned face = g.face + few * g.nearest;
  bool is_new = true;
  for (int k = 0; k < found.fragments; ++k) is_new &= found.faces[k] != face;
  found.faces[found.fragments] = face;
  found.fragments += is_new;
  for (int l = 0; l < g.n; ++l) {
    const unsigned p = static_cast<unsigned>(static_cast<int>(planes[l]));
    const bool is_there = known.has(p);
    known.put(found.count, p);
    found.planes[found.count] = p;
    for (int i = 0; i < 3; ++i) found.x[found.count][i] = g.x[i][l];
    // A corner on fewer than three planes divides a side, as where two other pieces meet; it is none of this piece.
    found.count += !is_there & (__builtin_popcount(p) >= 4);
    if (found.count == most_found) return false;
  }
  return true;
}

// Sorts corners by their planes and pieces by their faces.
static void sort(Found& found) {
  Found out;
  for (int i = 0; i < found.count; ++i) {
    int at = 0;
    for (int k = 0; k < found.count; ++k) at += found.planes[k] < found.planes[i];
    out.planes[at] = found.planes[i];
    for (int k = 0; k < 3; ++k) out.x[at][k] = found.x[i][k];
  }
  for (int i = 0; i < found.count; ++i) {
    found.planes[i] = out.planes[i];
    for (int k = 0; k < 3; ++k) found.x[i][k] = out.x[i][k];
  }
  for (int i = 0; i < found.fragments; ++i) {
    int at = 0;
    for (int k = 0; k < found.fragments; ++k) at += found.faces[k] < found.faces[i];
    out.faces[at] = found.faces[i];
  }
  for (int i = 0; i < found.fragments; ++i) found.faces[i] = out.faces[i];
}

// Sets the three planes of corner i; false if it is on more.
static bool set_planes(const SmallShape& b, unsigned planes, int i, Corners& c) {
  const auto low = [](unsigned bits) { return static_cast<unsigned>(__builtin_ctz(bits)); };
  unsigned on_a = planes & 0xffu, on_b = planes >> few & 0xffu;
  const bool surface = (planes >> Corners::surface & 1u) != 0;
  if (on_a == 0 || on_b == 0 || __builtin_popcount(planes) != 4) return false;
  const std::uint32_t bit = 1u << i;
  for (unsigned rest = planes; rest != 0; rest &= rest - 1) c.on[low(rest)] |= bit;
  const unsigned nearest = low(on_a), face = few + low(on_b);
  const auto set = [&](unsigned first, unsigned second, unsigned other_second, unsigned third, unsigned other_third) {
    c.planes[i] = first | second << 4 | other_second << 8 | third << 12 | other_third << 16 | nearest << 20;
    return true;
  };
  on_a &= on_a - 1, on_b &= on_b - 1;
  if (on_b == 0 && surface) return set(face, nearest, 0, low(on_a), 0);  // an edge of a pierces a face of b
  if (on_b == 0) {
    c.second_half |= bit, c.third_half |= bit;
    return set(face, nearest, low(on_a), nearest, low(on_a & (on_a - 1)));
  }
  if ((on_b & (on_b - 1)) == 0 && surface) return set(face, few + low(on_b), 0, nearest, 0);  // an edge of b pierces a face of a
  if ((on_b & (on_b - 1)) == 0) {
    c.third_half |= bit;
    return set(face, few + low(on_b), 0, nearest, low(on_a));
  }
  unsigned corner = 0xff;
  for (unsigned rest = planes >> few & 0xffu; rest != 0; rest &= rest - 1) corner &= b.mask[low(rest)];
  c.is_vertex |= bit;
  set(low(corner | 0x100u), nearest, 0, nearest, 0);
  return __builtin_popcount(corner) == 1;
}

// Finds the corners of the piece of `face` (as in Triangles), counter-clockwise from the lowest. Returns their number; 0 if they do not
// close.
static int find_loop(const ClipTask& task, const Found& found, const Corners& c, unsigned face, unsigned char* loop) {
  const unsigned own = 1u << face / few | 1u << (few + face % few);
  const std::uint32_t fragment = c.on[face / few] & c.on[few + face % few];
  const int size = __builtin_popcount(fragment);
  const auto beside = [&](int i) {  // the corners at the other ends of the two sides at corner i
    const unsigned two = found.planes[i] & ~own;
    return (c.on[__builtin_ctz(two)] | c.on[31 - __builtin_clz(two)]) & fragment & ~(1u << i);
  };
  if (size < 3) return 0;
  int at = __builtin_ctz(fragment);
  std::uint32_t next = beside(at);
  if (__builtin_popcount(next) != 2) return 0;
  const int one = __builtin_ctz(next), two = 31 - __builtin_clz(next);
  const double *p = found.x[at], *q = found.x[one], *r = found.x[two];
  double orientation = 0;
  for (int i = 0; i < 3; ++i) {
    const int k = (i + 1) % 3, l = (i + 2) % 3;
    orientation += task.out->normal[i][face % few] * ((q[k] - p[k]) * (r[l] - p[l]) - (q[l] - p[l]) * (r[k] - p[k]));
  }
  next = 1u << (orientation > 0 ? one : two);
  std::uint32_t left = fragment;
  for (int n = 0; n < size; ++n) {
    loop[n] = static_cast<unsigned char>(at);
    left &= ~(1u << at);
    if (n + 1 == size) break;
    at = __builtin_ctz(next);
    next = beside(at) & left;
    if (__builtin_popcount(next) != (n + 2 < size ? 1 : 0)) return 0;
  }
  return (beside(at) >> loop[0] & 1u) != 0 ? size : 0;
}

// Stores the planes that make an overlap; nothing if corners coincide or do not fit.
static void make_corners(const ClipTask& task, const Found& found, Corners& c) {
  c = Corners();
  if (found.count > Corners::most || found.count < 3) return;
  bool right = true;
  for (int i = 0; i < found.count; ++i) right &= set_planes(*task.b, found.planes[i], i, c);
  if (!right) return;
  int triangles = 0;
  const auto put = [&](unsigned face, unsigned char p, unsigned char q, unsigned char r) {
    Corners::TrianglePack& to = c.triangle_pack[triangles / 8];
    const int t = triangles++ % 8;
    to.corner[0][t] = p, to.corner[1][t] = q, to.corner[2][t] = r;
    to.faces[t] = static_cast<unsigned char>(face);
  };
  unsigned char loop[Corners::most] = {};
  for (int k = 0; k < found.fragments; ++k) {
    const int size = find_loop(task, found, c, found.faces[k], loop);
    if (size == 0 || triangles + size - 2 > Corners::most_triangles) return;
    for (int i = 1; i + 1 < size; ++i) put(found.faces[k], loop[0], loop[i], loop[i + 1]);
  }
  c.triangles = static_cast<std::uint8_t>(triangles);
  while (triangles % 8 != 0) put(found.faces[found.fragments - 1], loop[0], loop[0], loop[0]);  // empty ones
  // the other lanes repeat the last corner
  for (int i = found.count; i < Corners::most; ++i) c.planes[i] = c.planes[found.count - 1];
  const auto repeat = [&](std::uint32_t& bits) { bits |= (0u - (bits >> (found.count - 1) & 1u)) << (found.count - 1); };
  for (std::uint32_t& bits : c.on) repeat(bits);
  repeat(c.second_half), repeat(c.third_half), repeat(c.is_vertex);
  c.inside = static_cast<std::uint8_t>(corners_inside(task));
  c.count = static_cast<std::uint8_t>(found.count);
}

// Stores the corners of pair `pair`, whose polygons have been cut, for the next step. The present overlap is computed from them too, so
// that it does not depend on when they were found.
static void store_corners(const ClipTask& task, const Pack vertex[3], const ClipFragments& all, int pair, Corners& c) {
  c.count = 0;
  if (task.out->overflow || task.out->count == 0) return;
  Found found;
  Known known;
  for (int i = 0; i < all.count; ++i) {
    const Polygon& g = all.of[i];
    if (g.pair == pair && g.n >= 3 && !take(g, planes_at(task, g.x), known, found)) return;
  }
  sort(found);
  make_corners(task, found, c);
  if (c.count > 0 && !by_corners(task, vertex, c)) c.count = 0;
}

}  // namespace erbs::ERBS_TARGET
