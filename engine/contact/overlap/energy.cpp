// Elastic energy of a patch from surface integrals alone. In the region where face f of A is nearest, div(-n_f d_f^2 / 2) = d_f, so
//   Int phi dV = - sum over pieces of B (n_f . n_j) Int d_f^2 / 2 dS + sum over walls between regions f, e |n_e - n_f| Int d^2 / 2 dS.
// The faces of A add nothing, since d_f = 0 there.
#include <algorithm>
#include <bitset>
#include <cmath>

#include "engine/contact/overlap/general.h"
#include "engine/geometry/clip.h"

namespace erbs {
namespace {

using std::size_t;
using FaceSet = std::bitset<most_faces>;

// Int d^2 dS over a convex loop, d linear, by a fan of triangles.
double square_integral(const Vec3* x, const double* d, size_t count, const Vec3& n) {
  double sum = 0;
  for (size_t k = 1; k + 1 < count; ++k) {
    const double dS = 0.5 * n.dot((x[k] - x[0]).cross(x[k + 1] - x[0]));
    sum += dS / 6 * (d[0] * d[0] + d[k] * d[k] + d[k + 1] * d[k + 1] + d[0] * d[k] + d[k] * d[k + 1] + d[k + 1] * d[0]);
  }
  return sum;
}

// A convex loop, clipped in place; each plane may add a corner.
struct FaceLoop {
  Vec3 x[4 + 2 * most_faces];
  int size = 0;

  void cut_by(const Vec3& n, double c) {
    Vec3 kept[4 + 2 * most_faces];
    int count = 0;
    const auto corner = [&](int i) -> const Vec3& { return x[i]; };
    cut_polygon(
        size, corner, [&](int i) { return c - n.dot(x[i]); }, [&](const Vec3& p, double) { kept[count++] = p; });
    std::copy_n(kept, count, x);
    size = count;
  }
};

// Adds the faces of A that are entirely inside B.
void add_faces_inside(const ContactShape& a, const ContactShape& b, const PairPose& pose, FaceSet& faces) {
  std::bitset<most_vertices> inside;
  for (size_t i = 0; i < a.vertex.size(); ++i) inside.set(i);
  for (size_t j = 0; j < b.normal.size() && inside.any(); ++j) {
    const Vec3 n = pose.rotation * b.normal[j];
    const double c = b.offset[j] + n.dot(pose.shift);
    for (size_t i = 0; i < a.vertex.size(); ++i)
      if (inside[i] && !(n.dot(a.vertex[i]) <= c)) inside.reset(i);
  }
  if (inside.none()) return;
  for (size_t f = 0; f < a.normal.size(); ++f) {
    const auto from = a.loop.begin() + a.loop_first[f], to = a.loop.begin() + a.loop_first[f + 1];
    if (std::all_of(from, to, [&](int i) { return inside[static_cast<size_t>(i)]; })) faces.set(f);
  }
}

// Integral over the wall on which faces e and f of A are equally near, inside both bodies.
double wall_integral(const ContactShape& a, const ContactShape& b, const PairPose& pose, const double* c, size_t e, size_t f) {
  const double reach = 4 * b.reach;
  const Vec3 across = a.normal[e] - a.normal[f];
  const double length = across.norm();
  if (length < 1e-9) return 0;
  const Vec3 n = across / length, t = n.unitOrthogonal(), s = n.cross(t);
  if (std::abs(c[e] - c[f]) > length * b.reach) return 0;
  const Vec3 middle = (c[e] - c[f]) / length * n;
  FaceLoop loop;
  for (const Vec3& corner : {Vec3(-t - s), Vec3(t - s), Vec3(t + s), Vec3(s - t)}) loop.x[loop.size++] = middle + reach * corner;
  for (size_t j = 0; j < b.normal.size() && loop.size > 0; ++j) loop.cut_by(pose.rotation * b.normal[j], b.offset[j]);
  if (loop.size > 0) loop.cut_by(a.normal[f], c[f]);
  for (size_t g = 0; g < a.normal.size() && loop.size > 0; ++g) {
    if (g != e && g != f) loop.cut_by(a.normal[g] - a.normal[f], c[g] - c[f]);
  }
  if (loop.size < 3) return 0;
  double d[4 + 2 * most_faces];
  for (int i = 0; i < loop.size; ++i) d[i] = c[f] - a.normal[f].dot(loop.x[i]);
  return length * std::abs(square_integral(loop.x, d, static_cast<size_t>(loop.size), n)) / 2;
}

// Sum over all walls. `near`: the faces of A that are nearest to some part of B's surface. Any other face that is nearest somewhere in the
// overlap has its whole region inside B, and so itself.
double walls(const ContactShape& a, const ContactShape& b, const PairPose& pose, FaceSet near) {
  double c[most_faces], sum = 0;
  for (size_t f = 0; f < a.normal.size(); ++f) c[f] = a.offset[f] - a.normal[f].dot(pose.shift);
  add_faces_inside(a, b, pose, near);
  for (size_t f = 0; f < a.normal.size(); ++f)
    for (size_t e = 0; e < f && near[f]; ++e)
      if (near[e]) sum += wall_integral(a, b, pose, c, e, f);
  return sum;
}

}  // namespace

double energy_integral(const ContactShape& a, const ContactShape& b, const PairPose& pose, const Fragments& w) {
  double sum = 0;
  FaceSet near;
  for (const Fragment& p : w.fragment) {
    const auto first = static_cast<size_t>(p.first);
    const double square = square_integral(&w.vertex[first], &w.depth[first], static_cast<size_t>(p.count), w.n[p.face]);
    sum -= a.normal[static_cast<size_t>(p.nearest)].dot(w.n[p.face]) * square / 2;
    near.set(static_cast<size_t>(p.nearest));
  }
  return sum + walls(a, b, pose, near);
}

double energy_integral(const ContactShape& a, const ContactShape& b, const PairPose& pose, const Triangles& w) {
  double sum = 0;
  FaceSet near;
  for (int t = 0; t < w.count; ++t) {
    if (!(w.size[t] > 0)) continue;
    const int of_b = w.faces[t] % few, of_a = w.faces[t] / few;
    const double p = w.depth[0][t], q = w.depth[1][t], r = w.depth[2][t];
    const double square = w.size[t] / 6 * (p * p + q * q + r * r + p * q + q * r + r * p);
    double along = 0;
    for (int i = 0; i < 3; ++i) along += w.plane[i][of_a] * w.normal[i][of_b];
    sum -= along * square / 2;
    near.set(static_cast<size_t>(of_a));
  }
  return sum + walls(a, b, pose, near);
}

}  // namespace erbs
