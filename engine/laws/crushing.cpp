#include "engine/laws/crushing.h"

#include <algorithm>

#include "engine/geometry/clip.h"

namespace erbs {
namespace {

struct GapPlane {
  double c = 0, s = 0, t = 0;
  double at(const Vec2& x) const { return c + s * x.x() + t * x.y(); }
};
GapPlane operator-(const GapPlane& a, const GapPlane& b) { return {a.c - b.c, a.s - b.s, a.t - b.t}; }
bool same(const GapPlane& a, const GapPlane& b) { return a.c == b.c && a.s == b.s && a.t == b.t; }
GapPlane plane(const double p[3]) { return {p[0], p[1], p[2]}; }

// z = min(0, planes). GapPlane 0 is zero; there is room for one plane more than a face stores.
struct Envelope {
  int count = 1;
  GapPlane plane[CrushedFace::most + 2];
  void add(const GapPlane& p) { plane[count++] = p; }
  void remove(int k) {
    std::copy(plane + k + 1, plane + count, plane + k);
    --count;
  }
};

Envelope envelope(const CrushedFace& crushed) {
  Envelope z;
  for (int k = 0; k < crushed.planes; ++k) z.add(plane(crushed.plane[k]));
  return z;
}

struct Loop {
  static constexpr int most = CompressionFace::most_corners + 2 * (CrushedFace::most + 2) + 2;
  int count = 0;
  Vec2 corner[most];
  Loop() = default;
  Loop(const Loop& other) { *this = other; }
  Loop& operator=(const Loop& other) {  // copies the used corners only
    count = other.count;
    std::copy_n(other.corner, count, corner);
    return *this;
  }
  void add(const Vec2& x) { corner[count++] = x; }
};

// Cuts a convex loop to the part where f >= 0.
void clip_to(Loop& loop, const GapPlane& f) {
  const auto value = [&](int i) { return f.at(loop.corner[i]); };
  int inside = 0;
  for (int i = 0; i < loop.count; ++i) inside += value(i) >= 0;
  if (inside == loop.count) return;
  Loop part;
  if (inside > 0)
    cut_polygon(
        loop.count, [&](int i) -> const Vec2& { return loop.corner[i]; }, value, [&](const Vec2& x, double) { part.add(x); });
  if (part.count < 3) part.count = 0;
  loop = part;
}

// Cuts the loop to the part where plane k is the lowest of the envelope.
void clip_to_region(Loop& loop, const Envelope& z, int k) {
  for (int j = 0; j < z.count && loop.count > 0; ++j)
    if (j != k) clip_to(loop, z.plane[j] - z.plane[k]);
}

Vec2 corner(const CompressionFace& face, int i) { return {face.corner[2 * i], face.corner[2 * i + 1]}; }

Loop whole(const CompressionFace& face) {
  Loop loop;
  for (int i = 0; i < face.corners; ++i) loop.add(corner(face, i));
  return loop;
}

// Calls f(area, x, y, z) for each triangle of the fan from the first corner; x, y, z: its corners.
template <class F>
void triangles(const Loop& loop, const F& f) {
  const Vec2& x = loop.corner[0];
  for (int i = 2; i < loop.count; ++i) {
    const Vec2 &y = loop.corner[i - 1], &z = loop.corner[i];
    f(0.5 * ((y.x() - x.x()) * (z.y() - x.y()) - (z.x() - x.x()) * (y.y() - x.y())), x, y, z);
  }
}

double area(const Loop& loop) {
  double sum = 0;
  triangles(loop, [&](double a, const Vec2&, const Vec2&, const Vec2&) { sum += a; });
  return sum;
}

// Int u v dA of linear u and v; over a triangle A/12 (sum u sum v + sum u_i v_i).
double product(const Loop& loop, const GapPlane& u, const GapPlane& v) {
  double sum = 0;
  triangles(loop, [&](double a, const Vec2& x, const Vec2& y, const Vec2& z) {
    const double u0 = u.at(x), u1 = u.at(y), u2 = u.at(z), v0 = v.at(x), v1 = v.at(y), v2 = v.at(z);
    sum += a / 12 * ((u0 + u1 + u2) * (v0 + v1 + v2) + u0 * v0 + u1 * v1 + u2 * v2);
  });
  return sum;
}

double positive_product(Loop loop, const GapPlane& u, const GapPlane& v) {
  clip_to(loop, v);
  return product(loop, u, v);
}

// Cuts the loop, where `z` is the plastic closing, to the part that still bears.
void clip_to_bearing(Loop& loop, const CompressionFace& face, const GapPlane& z) {
  if (face.ultimate > 0) clip_to(loop, {z.c + face.ultimate, z.s, z.t});
}
void clip_to_spent(Loop& loop, const CompressionFace& face, const GapPlane& z) {
  if (face.ultimate > 0) clip_to(loop, {-z.c - face.ultimate, -z.s, -z.t});
  else loop.count = 0;
}

// Int z dA; -face.ultimate is the least that counts.
double volume(const CompressionFace& face, const Envelope& z) {
  double sum = 0;
  for (int k = 1; k < z.count; ++k) {
    Loop loop = whole(face);
    clip_to_region(loop, z, k);
    if (face.ultimate > 0) {
      Loop spent = loop;
      clip_to_spent(spent, face, z.plane[k]);
      sum -= face.ultimate * area(spent);
      clip_to_bearing(loop, face, z.plane[k]);
    }
    sum += product(loop, z.plane[k], {1, 0, 0});
  }
  return sum;
}

// Removes planes that are nowhere the lowest, then planes beyond the room of a face. The last plane always stays.
void thin_out(const CompressionFace& face, Envelope& z) {
  const double face_area = area(whole(face));
  for (int k = z.count - 2; k > 0; --k) {
    Loop loop = whole(face);
    clip_to_region(loop, z, k);
    if (area(loop) <= 1e-12 * face_area) z.remove(k);
  }
  while (z.count - 1 > CrushedFace::most) {
    int least = 1;
    double deepest = 0;
    for (int k = 1; k < z.count - 1; ++k) {
      Envelope without = z;
      without.remove(k);
      const double left = volume(face, without);
      if (k == 1 || left < deepest) deepest = left, least = k;
    }
    z.remove(least);
  }
}

bool passes(const CompressionFace& face, const Envelope& z, const GapPlane& lower) {
  const double round_off = 1e-12 * face.limit;
  bool below = false;
  for (int i = 0; i < face.corners; ++i) below = below || lower.at(corner(face, i)) < -round_off;
  for (int k = 0; below && k < z.count; ++k) {
    Loop loop = whole(face);
    clip_to_region(loop, z, k);
    clip_to_bearing(loop, face, z.plane[k]);
    const GapPlane over = z.plane[k] - lower;
    for (int i = 0; i < loop.count; ++i)
      if (over.at(loop.corner[i]) > round_off) return true;
  }
  return false;
}

// Where a step from gap g0 to g1 crushes the bed, at a gap of `face`.
GapPlane crushed_by(const CompressionFace& face, const GapPlane& g) {
  const GapPlane z{g.c + face.limit, g.s, g.t};
  if (!(face.ultimate > 0)) return z;
  const double steeper = 1 / (1 - face.limit / face.ultimate);
  return {steeper * z.c, steeper * z.s, steeper * z.t};
}

// Work (J) where the closing falls from z0 to z1 as the gap goes from g0 to g1, by the mean of the two pressures. A part that is spent by
// it falls to g1 and bears nothing then; a part that was spent bears again only if its plane was dropped.
double work_of(const CompressionFace& face, const Loop& loop, const GapPlane& z0, const GapPlane& z1, const GapPlane& g0,
               const GapPlane& g1) {
  if (!(face.ultimate > 0)) {
    const GapPlane fall = z0 - z1;
    return 0.5 * face.kn * (positive_product(loop, fall, z0 - g0) + positive_product(loop, fall, z1 - g1));
  }
  Loop bore = loop, had_gone = loop;
  clip_to_bearing(bore, face, z0);
  clip_to_spent(had_gone, face, z0);
  Loop bears = bore, goes = bore;
  clip_to_bearing(bears, face, z1);
  clip_to_spent(goes, face, z1);
  clip_to_bearing(had_gone, face, z1);
  return 0.5 * face.kn *
         (positive_product(bears, z0 - z1, z0 - g0) + positive_product(bears, z0 - z1, z1 - g1) + positive_product(goes, z0 - g1, z0 - g0) +
          positive_product(had_gone, g0 - z1, z1 - g1));
}

// Where contact points bear the face: the same law at each of them.
struct BearingPoint {
  Vec2 at;
  double area;
};
BearingPoint bearing_point(const CompressionFace& face, int i) {
  return {{face.point[3 * i], face.point[3 * i + 1]}, face.point[3 * i + 2]};
}
const double& closing(const CrushedFace& crushed, int i) { return crushed.plane[i / 3][i % 3]; }
double& closing(CrushedFace& crushed, int i) { return crushed.plane[i / 3][i % 3]; }
bool spent(const CompressionFace& face, double z) { return face.ultimate > 0 && z <= -face.ultimate; }

Pressed pressed_at_points(const CompressionFace& face, const CrushedFace& crushed, const GapPlane& gap) {
  Pressed out;
  for (int i = 0; i < face.points; ++i) {
    const auto [at, area] = bearing_point(face, i);
    const double z = closing(crushed, i), y = spent(face, z) ? 0 : std::max(0.0, z - gap.at(at)), force = face.kn * area * y;
    out.force += force, out.s += force * at.x(), out.t += force * at.y(), out.energy += 0.5 * force * y;
  }
  return out;
}

double crush_points(const CompressionFace& face, CrushedFace& crushed, const GapPlane& g0, const GapPlane& g1) {
  const GapPlane lower = crushed_by(face, g1);
  const double round_off = 1e-12 * face.limit;
  double work = 0;
  for (int i = 0; i < face.points; ++i) {
    const auto [at, area] = bearing_point(face, i);
    const double z0 = closing(crushed, i), z1 = lower.at(at), before = std::max(0.0, z0 - g0.at(at));
    if (spent(face, z0) || z1 >= -round_off || z1 >= z0 - round_off) continue;
    const bool goes = spent(face, z1);
    const double fall = z0 - (goes ? g1.at(at) : z1), after = goes ? 0 : std::max(0.0, z1 - g1.at(at));
    work += 0.5 * face.kn * area * fall * (before + after);
    closing(crushed, i) = z1, crushed.planes = 1;
  }
  return work;
}

int nearest_point(const CompressionFace& face, const Vec2& x) {
  int nearest = 0;
  for (int i = 1; i < face.points; ++i)
    if ((bearing_point(face, i).at - x).squaredNorm() < (bearing_point(face, nearest).at - x).squaredNorm()) nearest = i;
  return nearest;
}

double lost_at_points(const CompressionFace& face, const CrushedFace& crushed) {
  double lost = 0, whole = 0;
  for (int i = 0; i < face.points; ++i) {
    const double area = bearing_point(face, i).area;
    lost += area * std::min(-closing(crushed, i), face.ultimate), whole += area;
  }
  return lost / (face.ultimate * whole);
}

}  // namespace

Pressed pressed(const CompressionFace& face, const CrushedFace& crushed, const double gap[3]) {
  if (face.points > 0) return pressed_at_points(face, crushed, plane(gap));
  const Envelope z = envelope(crushed);
  Pressed out;
  for (int k = 0; k < z.count; ++k) {
    Loop loop = whole(face);
    const GapPlane y = z.plane[k] - plane(gap);
    clip_to(loop, y);
    clip_to_region(loop, z, k);
    clip_to_bearing(loop, face, z.plane[k]);
    out.force += face.kn * product(loop, y, {1, 0, 0});
    out.s += face.kn * product(loop, y, {0, 1, 0});
    out.t += face.kn * product(loop, y, {0, 0, 1});
    out.energy += 0.5 * face.kn * product(loop, y, y);
  }
  return out;
}

double crush(const CompressionFace& face, CrushedFace& crushed, const double before[3], const double now[3]) {
  if (face.points > 0) return crush_points(face, crushed, plane(before), plane(now));
  const GapPlane g0 = plane(before), g1 = plane(now), lower = crushed_by(face, g1);
  const Envelope old = envelope(crushed);
  if (!passes(face, old, lower)) return 0;
  Envelope next = old;
  next.add(lower);
  thin_out(face, next);
  double work = 0;
  for (int k = 0; k < old.count; ++k) {
    Loop part = whole(face);
    clip_to_region(part, old, k);
    for (int j = 0; j < next.count && part.count > 0; ++j) {
      if (same(old.plane[k], next.plane[j])) continue;
      Loop loop = part;
      clip_to_region(loop, next, j);
      work += work_of(face, loop, old.plane[k], next.plane[j], g0, g1);
    }
  }
  crushed.planes = next.count - 1;
  for (int k = 0; k < next.count - 1; ++k) {
    const GapPlane& p = next.plane[k + 1];
    crushed.plane[k][0] = p.c, crushed.plane[k][1] = p.s, crushed.plane[k][2] = p.t;
  }
  return work;
}

double pressed_depth(const CompressionFace& face, const CrushedFace& crushed, const double gap[3], double s, double t) {
  const double z = -crushed_depth(face, crushed, s, t);
  if (spent(face, z)) return 0;
  return std::clamp(z - plane(gap).at({s, t}), 0.0, face.limit);
}

double crushed_depth(const CompressionFace& face, const CrushedFace& crushed, double s, double t) {
  if (face.points > 0) return -closing(crushed, nearest_point(face, {s, t}));
  double lowest = 0;
  for (int k = 0; k < crushed.planes; ++k) lowest = std::min(lowest, plane(crushed.plane[k]).at({s, t}));
  return -lowest;
}

double lost_strength(const CompressionFace& face, const CrushedFace& crushed) {
  if (!(face.ultimate > 0) || crushed.planes == 0) return 0;
  if (face.points > 0) return lost_at_points(face, crushed);
  return -volume(face, envelope(crushed)) / (face.ultimate * area(whole(face)));
}

}  // namespace erbs
