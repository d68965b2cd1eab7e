// The elastic energy of a patch from surfaces alone. In the region where face f of A is nearest, div(-n_f d_f^2 / 2) = d_f, so
//   Int phi dV = - sum over pieces of B (n_f . n_j) Int d_f^2 / 2 dS + sum over walls between regions f, e |n_e - n_f| Int d^2 / 2 dS;
// the faces of A add nothing since d_f = 0 there.
#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/contact/narrow.h"

namespace erbs {
namespace {

using std::size_t;

// Int d^2 dS over a convex loop, d linear, by fan triangles.
double square_integral(const Vec3* x, const double* d, size_t count, const Vec3& n) {
  double sum = 0;
  for (size_t k = 1; k + 1 < count; ++k) {
    const double dS = 0.5 * n.dot((x[k] - x[0]).cross(x[k + 1] - x[0]));
    sum += dS / 6 * (d[0] * d[0] + d[k] * d[k] + d[k + 1] * d[k + 1] + d[0] * d[k] + d[k] * d[k + 1] + d[k + 1] * d[0]);
  }
  return sum;
}

// A convex loop, cut in place; each of the planes may add a corner.
struct Loop {
  Vec3 x[4 + 2 * most_faces];
  size_t size = 0;

  void cut_by(const Vec3& n, double c) {
    Vec3 kept[4 + 2 * most_faces];
    size_t count = 0;
    for (size_t i = 0; i < size; ++i) {
      const Vec3 &p = x[i], &q = x[i + 1 < size ? i + 1 : 0];
      const double dp = c - n.dot(p), dq = c - n.dot(q);
      if (dp >= 0) kept[count++] = p;
      if ((dp < 0 && dq > 0) || (dp > 0 && dq < 0)) kept[count++] = p + dp / (dp - dq) * (q - p);
    }
    std::copy_n(kept, count, x);
    size = count;
  }
};

// The faces of A that may be nearest somewhere in the overlap, as bits: nothing in it is deeper than the deepest corner of B below any
// one face.
std::uint64_t nearest_faces(const ContactShape& a, const ContactShape& b, const Pieces& w) {
  double least[most_faces], bound = std::numeric_limits<double>::infinity();
  for (size_t f = 0; f < a.normal.size(); ++f) {
    double most = least[f] = w.c[f] - a.normal[f].dot(w.v[0]);
    for (size_t i = 1; i < b.vertex.size(); ++i) {
      const double d = w.c[f] - a.normal[f].dot(w.v[i]);
      least[f] = std::min(least[f], d);
      most = std::max(most, d);
    }
    bound = std::min(bound, most);
  }
  std::uint64_t near = 0;
  for (size_t f = 0; f < a.normal.size(); ++f)
    if (least[f] <= bound) near |= std::uint64_t(1) << f;
  return near;
}

// The wall where faces e and f of A are equally near, inside both bodies.
double wall_integral(const ContactShape& a, const ContactShape& b, const PairPose& pose, const Pieces& w, size_t e, size_t f) {
  const double reach = 4 * b.reach;
  const Vec3 across = a.normal[e] - a.normal[f];
  const double length = across.norm();
  if (length < 1e-9) return 0;
  const Vec3 n = across / length, t = n.unitOrthogonal(), s = n.cross(t);
  if (std::abs(w.c[e] - w.c[f]) > length * b.reach) return 0;
  const Vec3 middle = (w.c[e] - w.c[f]) / length * n;
  Loop loop;
  for (const Vec3& corner : {Vec3(-t - s), Vec3(t - s), Vec3(t + s), Vec3(s - t)}) loop.x[loop.size++] = middle + reach * corner;
  for (size_t j = 0; j < b.normal.size() && loop.size > 0; ++j) loop.cut_by(pose.turn * b.normal[j], b.offset[j]);
  if (loop.size > 0) loop.cut_by(a.normal[f], w.c[f]);
  for (size_t g = 0; g < a.normal.size() && loop.size > 0; ++g) {
    if (g != e && g != f) loop.cut_by(a.normal[g] - a.normal[f], w.c[g] - w.c[f]);
  }
  if (loop.size < 3) return 0;
  double d[4 + 2 * most_faces];
  for (size_t i = 0; i < loop.size; ++i) d[i] = w.c[f] - a.normal[f].dot(loop.x[i]);
  return length * std::abs(square_integral(loop.x, d, loop.size, n)) / 2;
}

}  // namespace

double energy_integral(const ContactShape& a, const ContactShape& b, const PairPose& pose, const Pieces& w) {
  double sum = 0;
  for (const Piece& p : w.piece) {
    const auto first = static_cast<size_t>(p.first);
    const double square = square_integral(&w.vertex[first], &w.depth[first], static_cast<size_t>(p.count), w.n[p.face]);
    sum -= a.normal[static_cast<size_t>(p.nearest)].dot(w.n[p.face]) * square / 2;
  }
  const std::uint64_t near = nearest_faces(a, b, w);
  for (size_t f = 0; f < a.normal.size(); ++f)
    for (size_t e = 0; e < f; ++e)
      if ((near >> e & near >> f & 1u) != 0) sum += wall_integral(a, b, pose, w, e, f);
  return sum;
}

}  // namespace erbs
