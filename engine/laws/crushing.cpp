#include "engine/laws/crushing.h"

#include <algorithm>

namespace erbs {
namespace {

struct Plane {
  double c = 0, s = 0, t = 0;
  double at(double x, double y) const { return c + s * x + t * y; }
};
Plane operator-(const Plane& a, const Plane& b) { return {a.c - b.c, a.s - b.s, a.t - b.t}; }
bool same(const Plane& a, const Plane& b) { return a.c == b.c && a.s == b.s && a.t == b.t; }
Plane plane(const double p[3]) { return {p[0], p[1], p[2]}; }

// z = min(0, planes). Plane 0 is zero; there is room for one plane more than a face stores.
struct Envelope {
  int count = 1;
  Plane plane[CrushedFace::most + 2];
  void add(const Plane& p) { plane[count++] = p; }
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
  double s[most], t[most];
  Loop() = default;
  Loop(const Loop& other) { *this = other; }
  Loop& operator=(const Loop& other) {  // copies the used corners only
    count = other.count;
    std::copy_n(other.s, count, s);
    std::copy_n(other.t, count, t);
    return *this;
  }
  void add(double x, double y) {
    s[count] = x;
    t[count++] = y;
  }
};

// The part of a convex loop where f >= 0.
void clip(const Loop& in, const Plane& f, Loop& out) {
  out.count = 0;
  double s0 = in.s[in.count - 1], t0 = in.t[in.count - 1], f0 = f.at(s0, t0);
  for (int i = 0; i < in.count; ++i) {
    const double s1 = in.s[i], t1 = in.t[i], f1 = f.at(s1, t1);
    if ((f0 >= 0) != (f1 >= 0)) {
      const double x = f0 / (f0 - f1);
      out.add(s0 + x * (s1 - s0), t0 + x * (t1 - t0));
    }
    if (f1 >= 0) out.add(s1, t1);
    s0 = s1, t0 = t1, f0 = f1;
  }
  if (out.count < 3) out.count = 0;
}

void clip_to(Loop& loop, const Plane& f) {
  int inside = 0;
  for (int i = 0; i < loop.count; ++i) inside += f.at(loop.s[i], loop.t[i]) >= 0;
  if (inside == loop.count) return;
  if (inside == 0) {
    loop.count = 0;
    return;
  }
  Loop part;
  clip(loop, f, part);
  loop = part;
}

// Cuts the loop to the part where plane k is the lowest of the envelope.
void clip_to_region(Loop& loop, const Envelope& z, int k) {
  for (int j = 0; j < z.count && loop.count > 0; ++j)
    if (j != k) clip_to(loop, z.plane[j] - z.plane[k]);
}

Loop whole(const CompressionFace& face) {
  Loop loop;
  for (int i = 0; i < face.corners; ++i) loop.add(face.corner[2 * i], face.corner[2 * i + 1]);
  return loop;
}

// Calls f(area, i, j, k) for each triangle of the fan from the first corner; i, j, k number its corners.
template <class F>
void triangles(const Loop& loop, const F& f) {
  for (int i = 2; i < loop.count; ++i)
    f(0.5 * ((loop.s[i - 1] - loop.s[0]) * (loop.t[i] - loop.t[0]) - (loop.s[i] - loop.s[0]) * (loop.t[i - 1] - loop.t[0])), 0, i - 1, i);
}

double area(const Loop& loop) {
  double sum = 0;
  triangles(loop, [&](double a, int, int, int) { sum += a; });
  return sum;
}

// Int u v dA of linear u and v; over a triangle A/12 (sum u sum v + sum u_i v_i).
double product(const Loop& loop, const Plane& u, const Plane& v) {
  double sum = 0;
  triangles(loop, [&](double a, int i, int j, int k) {
    const double u0 = u.at(loop.s[i], loop.t[i]), u1 = u.at(loop.s[j], loop.t[j]), u2 = u.at(loop.s[k], loop.t[k]);
    const double v0 = v.at(loop.s[i], loop.t[i]), v1 = v.at(loop.s[j], loop.t[j]), v2 = v.at(loop.s[k], loop.t[k]);
    sum += a / 12 * ((u0 + u1 + u2) * (v0 + v1 + v2) + u0 * v0 + u1 * v1 + u2 * v2);
  });
  return sum;
}

double positive_product(Loop loop, const Plane& u, const Plane& v) {
  clip_to(loop, v);
  return product(loop, u, v);
}

// Int z dA.
double volume(const CompressionFace& face, const Envelope& z) {
  double sum = 0;
  for (int k = 1; k < z.count; ++k) {
    Loop loop = whole(face);
    clip_to_region(loop, z, k);
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

bool passes(const CompressionFace& face, const Envelope& z, const Plane& lower) {
  const double round_off = 1e-12 * face.limit;
  bool below = false;
  for (int i = 0; i < face.corners; ++i) below = below || lower.at(face.corner[2 * i], face.corner[2 * i + 1]) < -round_off;
  for (int k = 0; below && k < z.count; ++k) {
    Loop loop = whole(face);
    clip_to_region(loop, z, k);
    const Plane over = z.plane[k] - lower;
    for (int i = 0; i < loop.count; ++i)
      if (over.at(loop.s[i], loop.t[i]) > round_off) return true;
  }
  return false;
}

}  // namespace

Pressed pressed(const CompressionFace& face, const CrushedFace& crushed, const double gap[3]) {
  const Envelope z = envelope(crushed);
  Pressed out;
  for (int k = 0; k < z.count; ++k) {
    Loop loop = whole(face);
    const Plane y = z.plane[k] - plane(gap);
    clip_to(loop, y);
    clip_to_region(loop, z, k);
    out.force += face.kn * product(loop, y, {1, 0, 0});
    out.s += face.kn * product(loop, y, {0, 1, 0});
    out.t += face.kn * product(loop, y, {0, 0, 1});
    out.energy += 0.5 * face.kn * product(loop, y, y);
  }
  return out;
}

double crush(const CompressionFace& face, CrushedFace& crushed, const double before[3], const double now[3]) {
  const Plane g0 = plane(before), g1 = plane(now), lower{g1.c + face.limit, g1.s, g1.t};
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
      const Plane fall = old.plane[k] - next.plane[j];
      work += 0.5 * face.kn * (positive_product(loop, fall, old.plane[k] - g0) + positive_product(loop, fall, next.plane[j] - g1));
    }
  }
  crushed.planes = next.count - 1;
  for (int k = 0; k < next.count - 1; ++k) {
    const Plane& p = next.plane[k + 1];
    crushed.plane[k][0] = p.c, crushed.plane[k][1] = p.s, crushed.plane[k][2] = p.t;
  }
  return work;
}

double pressed_depth(const CompressionFace& face, const CrushedFace& crushed, const double gap[3], double s, double t) {
  const Envelope z = envelope(crushed);
  double lowest = 0;
  for (int k = 1; k < z.count; ++k) lowest = std::min(lowest, z.plane[k].at(s, t));
  return std::clamp(lowest - plane(gap).at(s, t), 0.0, face.limit);
}

}  // namespace erbs
