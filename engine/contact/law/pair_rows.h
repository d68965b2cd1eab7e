// The rows of eight numbers in which pairs, blocks and results are stored, transposed to lanes and back.
#pragma once
#include "engine/contact/law/pair_lanes.h"
#include "engine/simd/transpose.h"
#include "engine/simd/vec3.h"

namespace erbs::ERBS_TARGET {

template <class T>
using Lanes = double[lanes_of<T>];
template <class T>
using PairPackFor = PairPackOf<lanes_of<T>>;

// Places of numbers in the rows.
enum : int {
  p_kn = 0,
  p_ks = 1,
  p_mu = 2,
  p_hop_time = 4,
  p_hop_loan = 5,
  p_impact = 6,
  p_rotation = 7,
  p_shift = 16,
  p_n = 19,
  p_c = 22,
  p_u = 25,
  p_psi = 28,
  p_area = 29,
  p_gyration = 30,
  p_peak_closing_speed = 31,
  p_tangential = 32,
  p_mean_normal_force = 33,
  p_lent = 34,
  p_friction = 35,
  p_damping = 44
};
enum : int { b_u = 0, b_rotation = 3, b_v = 12, b_w = 15, b_mass = 18, b_inertia = 19, b_rest = 20, b_tensor = 23 };
enum : int {
  f_wrench = 0,
  f_tangential = 9,
  f_friction = 10,
  f_damping = 11,
  f_slip_omega2 = 12,
  f_depth = 13,
  f_omega2_a = 14,
  f_omega2_b = 15
};

// A matrix stored by column, as Eigen does.
template <class T>
ERBS_INLINE Mat3<T> columns(const Lanes<T>* x) {
  return transposed(Mat3<T>{load3(x), load3(x + 3), load3(x + 6)});
}

template <class T>
ERBS_INLINE Mat3<T> relative_rotation(const PairPackFor<T>& w) {
  return {{load3(w.rotation), load3(w.rotation + 3), load3(w.rotation + 6)}};
}

[[maybe_unused]] static void read(const double* const from[8], int rows, PackArray* to) {
  for (int i = 0; i < rows; ++i) {
    Pack a[8], b[8];
    for (int l = 0; l < 8; ++l) a[l] = load(from[l] + 8 * i);
    transpose<8>(a, b);
    for (int k = 0; k < 8; ++k) store(to[8 * i + k], b[k]);
  }
}

ERBS_INLINE void read(const double* const from[1], int rows, double (*to)[1]) {
  for (int i = 0; i < 8 * rows; ++i) to[i][0] = from[0][i];
}

ERBS_INLINE void write(const double (*from)[1], int rows, double* to) {
  for (int i = 0; i < 8 * rows; ++i) to[i] = from[i][0];
}

[[maybe_unused]] static void write(const PackArray* from, int rows, double* const to[8]) {
  for (int i = 0; i < rows; ++i) {
    Pack a[8], b[8];
    for (int k = 0; k < 8; ++k) a[k] = load(from[8 * i + k]);
    transpose<8>(a, b);
    for (int l = 0; l < 8; ++l) store(to[l] + 8 * i, b[l]);
  }
}

}  // namespace erbs::ERBS_TARGET
