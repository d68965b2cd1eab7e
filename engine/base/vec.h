// The only file that includes Eigen's dense types.
#pragma once
#include <Eigen/Dense>

namespace erbs {

using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;
using Vec6 = Eigen::Matrix<double, 6, 1>;
using Mat6 = Eigen::Matrix<double, 6, 6>;
using Quat = Eigen::Quaterniond;

// Quaternion of the rotation vector r (axis times angle, rad).
inline Quat rotation(const Vec3& r) {
  const double angle = r.norm();
  if (angle < 1e-12) return Quat(1.0, 0.5 * r.x(), 0.5 * r.y(), 0.5 * r.z()).normalized();
  return Quat(Eigen::AngleAxisd(angle, r / angle));
}

// Rotation vector of q (rad), angle in [0, pi].
inline Vec3 rotation_vector(const Quat& q) {
  const double sign = q.w() < 0 ? -1.0 : 1.0;
  const double sine = q.vec().norm();
  if (sine < 1e-9) return 2.0 * sign * q.vec();  // 2 asin(s)/s = 2 + O(s^2)
  return 2.0 * sign * std::atan2(sine, sign * q.w()) / sine * q.vec();
}

inline Mat3 cross_matrix(const Vec3& a) {
  Mat3 m;
  m << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
  return m;
}

}  // namespace erbs
