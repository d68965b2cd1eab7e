// Vectors, matrices and quaternions of numbers or packs.
#pragma once
#include "engine/simd/pack.h"

namespace erbs::ERBS_TARGET {

template <class T>
struct Vec3 {
  T x, y, z;

  friend ERBS_INLINE Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend ERBS_INLINE Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend ERBS_INLINE Vec3 operator-(Vec3 a) { return {-a.x, -a.y, -a.z}; }
  friend ERBS_INLINE Vec3 operator*(T k, Vec3 a) { return {k * a.x, k * a.y, k * a.z}; }
  friend ERBS_INLINE T dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
  friend ERBS_INLINE Vec3 cross(Vec3 a, Vec3 b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
  template <class M>
  friend ERBS_INLINE Vec3 select(M m, Vec3 a, Vec3 b) {
    return {select(m, a.x, b.x), select(m, a.y, b.y), select(m, a.z, b.z)};
  }
};

template <class T>
struct Mat3 {
  Vec3<T> row[3];

  friend ERBS_INLINE Vec3<T> operator*(const Mat3& m, Vec3<T> a) { return {dot(m.row[0], a), dot(m.row[1], a), dot(m.row[2], a)}; }
  friend ERBS_INLINE Mat3 transposed(const Mat3& m) {
    const Vec3<T>&a = m.row[0], &b = m.row[1], &c = m.row[2];
    return {{{a.x, b.x, c.x}, {a.y, b.y, c.y}, {a.z, b.z, c.z}}};
  }
};

// A symmetric matrix: xx yy zz yz xz xy.
template <class T>
struct SymMat3 {
  T xx, yy, zz, yz, xz, xy;

  friend ERBS_INLINE Vec3<T> operator*(const SymMat3& m, Vec3<T> a) {
    return {m.xx * a.x + m.xy * a.y + m.xz * a.z, m.xy * a.x + m.yy * a.y + m.yz * a.z, m.xz * a.x + m.yz * a.y + m.zz * a.z};
  }
};

template <class T>
struct Quat {
  T x, y, z, w;

  friend ERBS_INLINE T dot(Quat a, Quat b) { return a.w * b.w + a.x * b.x + a.y * b.y + a.z * b.z; }
};

// The rotation by a unit quaternion; by any other with `two` over the square of its length.
template <class T>
ERBS_INLINE Mat3<T> rotation_of(Quat<T> q, T two) {
  const T x2 = two * q.x, y2 = two * q.y, z2 = two * q.z;
  const T xx = q.x * x2, yy = q.y * y2, zz = q.z * z2, xy = q.x * y2, xz = q.x * z2, yz = q.y * z2, wx = q.w * x2, wy = q.w * y2,
          wz = q.w * z2;
  return {{{1 - (yy + zz), xy - wz, xz + wy}, {xy + wz, 1 - (xx + zz), yz - wx}, {xz - wy, yz + wx, 1 - (xx + yy)}}};
}
template <class T>
ERBS_INLINE Mat3<T> rotation_of(Quat<T> q) {
  return rotation_of(q, T(2));
}

using Pack3 = Vec3<Pack>;

// Eight of them side by side, or a single one, with a row of memory for each component.
ERBS_INLINE Pack3 load3(const double (*x)[8]) { return {load(x[0]), load(x[1]), load(x[2])}; }
ERBS_INLINE Vec3<double> load3(const double (*x)[1]) { return {x[0][0], x[1][0], x[2][0]}; }
ERBS_INLINE void store3(double (*x)[8], Pack3 a) { store(x[0], a.x), store(x[1], a.y), store(x[2], a.z); }
ERBS_INLINE void store3(double (*x)[1], Vec3<double> a) { store(x[0], a.x), store(x[1], a.y), store(x[2], a.z); }
ERBS_INLINE Quat<Pack> load4(const double (*x)[8]) { return {load(x[0]), load(x[1]), load(x[2]), load(x[3])}; }
ERBS_INLINE SymMat3<Pack> load6(const double (*x)[8]) { return {load(x[0]), load(x[1]), load(x[2]), load(x[3]), load(x[4]), load(x[5])}; }

}  // namespace erbs::ERBS_TARGET
