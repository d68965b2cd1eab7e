// Cones of one contact point for the interior point method, with their scaling by Nesterov and Todd (1997), in the form of Vandenberghe,
// "The CVXOPT linear and quadratic cone program solvers" (2010), section 4.
//
// The force f = (n, s, t) has the slack `h + g f`, which lies in a product of cones: up to three half-lines (n above its lower limit; in a
// plane problem the two sides of the friction cone as well) and, in space, one round cone (head, s, t) with head >= |(s, t)|.
#pragma once
#include <algorithm>
#include <cmath>

#include "engine/base/vec.h"

namespace erbs::analysis {

// Values in the cones of one contact point: slack or multiplier.
struct ConeValue {
  double line[3] = {0, 0, 0};
  Vec3 round = Vec3::Zero();
};

// a' J a of the round cone.
inline double cone_norm2(const Vec3& a) { return a.x() * a.x() - a.y() * a.y() - a.z() * a.z(); }

struct ContactCone {
  int lines = 0;
  bool round = false;
  bool rubs = false;           // false: a frictionless point has the component n alone
  Vec3 g[3];                   // rows of the half-lines
  double h[3] = {0, 0, 0};     // their constants
  double slope = 0, head = 0;  // of the round cone: (head + slope n, s, t)
  // scaling: w of each half-line, beta and v of the round cone (W = beta (2 v v' - J)), and the scaled point
  double w[3] = {1, 1, 1}, beta = 1;
  Vec3 v = Vec3::UnitX();
  ConeValue scaled;

  int degree() const { return lines + (round ? 1 : 0); }

  // h + g f, or g f alone.
  ConeValue slack(const Vec3& f, bool constant) const {
    ConeValue out;
    for (int i = 0; i < lines; ++i) out.line[i] = g[i].dot(f) + (constant ? h[i] : 0);
    if (round) out.round = Vec3(slope * f.x() + (constant ? head : 0), f.y(), f.z());
    return out;
  }
  // g' z
  Vec3 transposed(const ConeValue& z) const {
    Vec3 out = Vec3::Zero();
    for (int i = 0; i < lines; ++i) out += z.line[i] * g[i];
    if (round) out += Vec3(slope * z.round.x(), z.round.y(), z.round.z());
    return out;
  }
  double dot(const ConeValue& a, const ConeValue& b) const {
    double sum = round ? a.round.dot(b.round) : 0;
    for (int i = 0; i < lines; ++i) sum += a.line[i] * b.line[i];
    return sum;
  }
  double constant_part(const ConeValue& z) const {  // h' z
    double sum = round ? head * z.round.x() : 0;
    for (int i = 0; i < lines; ++i) sum += h[i] * z.line[i];
    return sum;
  }

  // Distance by which a value lies outside its cones; negative inside.
  double outside(const ConeValue& a) const {
    double most = -1e300;
    for (int i = 0; i < lines; ++i) most = std::max(most, -a.line[i]);
    return round ? std::max(most, std::hypot(a.round.y(), a.round.z()) - a.round.x()) : most;
  }
  void shift(ConeValue& a, double by) const {
    for (int i = 0; i < lines; ++i) a.line[i] += by;
    if (round) a.round.x() += by;
  }

  void set_unit_scaling() {
    for (double& one : w) one = 1;
    beta = 1, v = Vec3::UnitX();  // 2 e e' - J = I
  }
  void set_scaling(const ConeValue& s, const ConeValue& z) {
    for (int i = 0; i < lines; ++i) w[i] = std::sqrt(s.line[i] / z.line[i]), scaled.line[i] = std::sqrt(s.line[i] * z.line[i]);
    if (!round) return;
    const double ss = std::sqrt(cone_norm2(s.round)), zz = std::sqrt(cone_norm2(z.round));
    beta = std::sqrt(ss / zz);
    const Vec3 a = s.round / ss, b = z.round / zz;
    const double gamma = std::sqrt(0.5 * (1 + a.dot(b)));
    Vec3 middle = (a + Vec3(b.x(), -b.y(), -b.z())) / (2 * gamma);
    middle.x() += 1;
    v = middle / std::sqrt(2 * middle.x());
    scaled.round = scale(z.round);
  }
  Vec3 scale(const Vec3& a) const {  // W a
    return beta * (2 * v.dot(a) * v - Vec3(a.x(), -a.y(), -a.z()));
  }
  Vec3 unscale(const Vec3& a) const {  // W^-1 a
    const Vec3 jv(v.x(), -v.y(), -v.z());
    return (2 * jv.dot(a) * jv - Vec3(a.x(), -a.y(), -a.z())) / beta;
  }
  ConeValue scale(const ConeValue& a) const {
    ConeValue out;
    for (int i = 0; i < lines; ++i) out.line[i] = w[i] * a.line[i];
    if (round) out.round = scale(a.round);
    return out;
  }
  ConeValue unscale(const ConeValue& a) const {
    ConeValue out;
    for (int i = 0; i < lines; ++i) out.line[i] = a.line[i] / w[i];
    if (round) out.round = unscale(a.round);
    return out;
  }

  // (g' W^-2 g)^-1. The sides of a friction cone give it as g^-1 W^2 g'^-1 without the inverse of a matrix that reaches from what presses
  // to what slides; the lower limit of n is added as a change of rank one (Sherman and Morrison 1950).
  Mat3 flexibility() const {
    Mat3 out = Mat3::Zero();
    const double limit = w[0] * w[0];  // of n, the first line where it is there
    if (!rubs) return out(0, 0) = limit, out;
    const double slope_now = round ? slope : g[lines - 1].x();
    if (slope_now <= 0) return without_friction(limit);
    if (round) {
      Mat3 scaling = 2 * beta * v * v.transpose();
      scaling(0, 0) -= beta, scaling(1, 1) += beta, scaling(2, 2) += beta;
      scaling.row(0) /= slope_now;
      out = scaling * scaling.transpose();
    } else {
      const double a = w[lines - 2] * w[lines - 2], b = w[lines - 1] * w[lines - 1];
      out(0, 0) = (a + b) / (4 * slope_now * slope_now);
      out(0, 1) = out(1, 0) = (a - b) / (4 * slope_now);
      out(1, 1) = (a + b) / 4;
    }
    if (lines == (round ? 0 : 2)) return out;
    const Vec3 n = out.col(0);
    return out - n * n.transpose() / (limit + n.x());
  }
  // Cohesion alone: n and the shear do not know each other.
  Mat3 without_friction(double limit) const {
    Mat3 out = Mat3::Zero();
    out(0, 0) = limit;
    if (round) {
      Eigen::Matrix<double, 3, 2> rows;
      rows.col(0) = unscale(Vec3(0, 1, 0)), rows.col(1) = unscale(Vec3(0, 0, 1));
      out.bottomRightCorner<2, 2>() = (rows.transpose() * rows).inverse();
    } else {
      out(1, 1) = 1 / (1 / (w[lines - 2] * w[lines - 2]) + 1 / (w[lines - 1] * w[lines - 1]));
    }
    return out;
  }

  // The right-hand side of the complementarity: scaled \ (target e - scaled o scaled - ds o dz), ds and dz scaled.
  ConeValue complementarity(double target, const ConeValue& ds, const ConeValue& dz) const {
    ConeValue out;
    for (int i = 0; i < lines; ++i) out.line[i] = (target - scaled.line[i] * scaled.line[i] - ds.line[i] * dz.line[i]) / scaled.line[i];
    if (!round) return out;
    const auto product = [](const Vec3& a, const Vec3& b) {
      return Vec3(a.dot(b), a.x() * b.y() + b.x() * a.y(), a.x() * b.z() + b.x() * a.z());
    };
    const Vec3& l = scaled.round;
    const Vec3 r = Vec3(target, 0, 0) - product(l, l) - product(ds.round, dz.round);
    const double across = l.y() * r.y() + l.z() * r.z(), first = (l.x() * r.x() - across) / cone_norm2(l);
    out.round = Vec3(first, (r.y() - first * l.y()) / l.x(), (r.z() - first * l.z()) / l.x());
    return out;
  }

  // The largest step along `way` that stays in the cones, at most `most`.
  double longest_step(const ConeValue& at, const ConeValue& way, double most) const {
    for (int i = 0; i < lines; ++i)
      if (way.line[i] < 0) most = std::min(most, -at.line[i] / way.line[i]);
    if (!round) return most;
    if (way.round.x() < 0) most = std::min(most, -at.round.x() / way.round.x());
    const double a = cone_norm2(way.round), c = std::max(0.0, cone_norm2(at.round));
    const double b = at.round.x() * way.round.x() - at.round.y() * way.round.y() - at.round.z() * way.round.z();
    const double d = b * b - a * c;
    if (d < 0 || (a >= 0 && b >= 0)) return most;  // a t^2 + 2 b t + c has no positive root
    const double root = c / (-b + std::sqrt(d));   // the smallest positive one
    return root > 0 ? std::min(most, root) : most;
  }
};

}  // namespace erbs::analysis
