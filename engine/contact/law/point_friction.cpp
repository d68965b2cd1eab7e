#include "engine/contact/law/point_friction.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/base/vec.h"
#include "engine/contact/law/pair_rows.h"

namespace erbs {
namespace {

struct PointFriction {
  double limit = 0;           // N
  double gyration2 = 0;       // m2, of the springs: kr / kt
  Vec3 lever = Vec3::Zero();  // m, n x (centroid - centre of pressure)
};

// Factor that scales a force onto the limit.
double scale_to_limit(const PointFriction& b, const Vec3& force) {
  const double t = force.norm() / b.limit;
  return std::sqrt(1 / (t * t));
}

// The force after a slip of x t / kt at the centre of pressure and a rotation that leaves no torsion there (`Return` in `friction_law.h`).
Vec3 slipped(const PointFriction& b, const Vec3& trial, double torsion, double x) {
  const double soft = 1 + x, stiff = b.gyration2 + b.lever.squaredNorm() / soft;
  const double rotation = stiff > 0 ? (torsion + b.lever.dot(trial) / soft) / stiff : 0;
  return (trial - rotation * b.lever) / soft;
}

// Secant method for limit / t - 1, which is linear in x if the lever is zero.
Vec3 returned(const PointFriction& b, const Vec3& trial, double torsion) {
  double low = 0, high = std::numeric_limits<double>::infinity(), x = 0, x_before = 0, h_before = 0;
  Vec3 force = Vec3::Zero();
  for (int i = 0; i < 60; ++i) {
    force = slipped(b, trial, torsion, x);
    const double t = force.norm() / b.limit, h = t > 0 ? 1 / t - 1 : 1;
    if (std::fabs(h) < 1e-10 || (x == 0 && h >= 0)) break;
    (h < 0 ? low : high) = x;
    double next = i == 0 ? t - 1 : x - h * (x - x_before) / (h - h_before);
    if (!(next > low && next < high)) next = std::isinf(high) ? 2 * x + 1 : (low + high) / 2;
    x_before = x, h_before = h, x = next;
  }
  return force * std::min(1.0, scale_to_limit(b, force));  // remaining error of the iteration
}

// Share of the dashpots that the point can transmit beside springs that stick.
double bearable(const PointFriction& b, const Vec3& force, const Vec3& viscous) {
  if (scale_to_limit(b, force + viscous) >= 1) return 1;
  double low = 0, high = 1;
  for (int i = 0; i < 30; ++i) {
    const double middle = (low + high) / 2;
    (scale_to_limit(b, force + middle * viscous) >= 1 ? low : high) = middle;
  }
  return low;
}

template <int n>
void return_lane(PairPackOf<n>& w, int l) {
  const auto vec = [l](const double(*x)[n]) { return Vec3(x[0][l], x[1][l], x[2][l]); };
  const double gyration = w.p[scalar::p_gyration][l];
  const PointFriction b{w.most[l], gyration * gyration, vec(w.lever)};
  const Vec3 springs = vec(w.springs);
  Vec3 force = springs;
  w.slips[l] = !(b.limit > 0) || w.torsion[l] + b.lever.dot(springs) != 0 || !(scale_to_limit(b, springs) >= 1);
  w.share[l] = w.slips[l] > 0 ? 0 : bearable(b, springs, vec(w.dashpots));
  if (w.slips[l] > 0) {
    force = b.limit > 0 ? returned(b, springs, w.torsion[l]) : Vec3(Vec3::Zero());
    w.torsion[l] = 0 - b.lever.dot(force);
  }
  for (int i = 0; i < 3; ++i) w.springs[i][l] = force[i];
}

}  // namespace

void return_point(PairPack& w, int l) { return_lane(w, l); }
void return_point(OnePair& w) { return_lane(w, 0); }

}  // namespace erbs
