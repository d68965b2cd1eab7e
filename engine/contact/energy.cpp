// The elastic energy of a patch from surfaces alone. In the region where face f of A is nearest, div(-n_f d_f^2 / 2) = d_f, so
//   Int phi dV = - sum over pieces of B (n_f . n_j) Int d_f^2 / 2 dS + sum over walls between regions f, e |n_e - n_f| Int d^2 / 2 dS;
// the faces of A add nothing since d_f = 0 there.
#include <algorithm>
#include <cmath>

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

void cut_by(std::vector<Vec3>& loop, const Vec3& n, double c) {
  std::vector<Vec3> kept;
  for (size_t i = 0; i < loop.size(); ++i) {
    const Vec3 p = loop[i], q = loop[(i + 1) % loop.size()];
    const double dp = c - n.dot(p), dq = c - n.dot(q);
    if (dp >= 0) kept.push_back(p);
    if ((dp < 0 && dq > 0) || (dp > 0 && dq < 0)) kept.push_back(p + dp / (dp - dq) * (q - p));
  }
  loop = std::move(kept);
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
  std::vector<Vec3> loop{middle - reach * t - reach * s, middle + reach * t - reach * s, middle + reach * t + reach * s,
                         middle - reach * t + reach * s};
  for (size_t j = 0; j < b.normal.size() && !loop.empty(); ++j) cut_by(loop, pose.turn * b.normal[j], b.offset[j]);
  if (!loop.empty()) cut_by(loop, a.normal[f], w.c[f]);
  for (size_t g = 0; g < a.normal.size() && !loop.empty(); ++g) {
    if (g != e && g != f) cut_by(loop, a.normal[g] - a.normal[f], w.c[g] - w.c[f]);
  }
  std::vector<double> d;
  for (const Vec3& x : loop) d.push_back(w.c[f] - a.normal[f].dot(x));
  return loop.size() < 3 ? 0 : length * std::abs(square_integral(loop.data(), d.data(), loop.size(), n)) / 2;
}

}  // namespace

double energy_integral(const ContactShape& a, const ContactShape& b, const PairPose& pose, const Pieces& w) {
  double sum = 0;
  for (const Piece& p : w.piece) {
    const auto first = static_cast<size_t>(p.first);
    const double square = square_integral(&w.vertex[first], &w.depth[first], static_cast<size_t>(p.count), w.n[p.face]);
    sum -= a.normal[static_cast<size_t>(p.nearest)].dot(w.n[p.face]) * square / 2;
  }
  for (size_t f = 0; f < a.normal.size(); ++f) {
    for (size_t e = 0; e < f; ++e) sum += wall_integral(a, b, pose, w, e, f);
  }
  return sum;
}

}  // namespace erbs
