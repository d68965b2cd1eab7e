// Rows of eight doubles to packs and back: what one body has side by side in memory (displacement and rotation, force and moment), as a
// pack has it of eight bodies.
#pragma once
#include "engine/simd/pack.h"

namespace erbs::ERBS_TARGET {

// Every other lane of a and b in turn: a0 b0 a2 b2 ..., a1 b1 a3 b3 ...
ERBS_INLINE PackOf<register_size> evens(PackOf<register_size> a, PackOf<register_size> b) {
#if defined(__AVX512F__)
  return __builtin_shufflevector(a.v, b.v, 0, 8, 2, 10, 4, 12, 6, 14);
#elif defined(__AVX__)
  return __builtin_shufflevector(a.v, b.v, 0, 4, 2, 6);
#else
  return __builtin_shufflevector(a.v, b.v, 0, 2);
#endif
}
ERBS_INLINE PackOf<register_size> odds(PackOf<register_size> a, PackOf<register_size> b) {
#if defined(__AVX512F__)
  return __builtin_shufflevector(a.v, b.v, 1, 9, 3, 11, 5, 13, 7, 15);
#elif defined(__AVX__)
  return __builtin_shufflevector(a.v, b.v, 1, 5, 3, 7);
#else
  return __builtin_shufflevector(a.v, b.v, 1, 3);
#endif
}

#if defined(__AVX512F__)
// Quarters i, j of the first and k, l of the second.
template <int i, int j, int k, int l>
ERBS_INLINE Pack quarters(Pack a, Pack b) {
  return __builtin_shufflevector(a.v, b.v, 2 * i, 2 * i + 1, 2 * j, 2 * j + 1, 8 + 2 * k, 9 + 2 * k, 8 + 2 * l, 9 + 2 * l);
}
#endif

// Lane l of out[k] is lane k of in[l]. What is not read of `out` costs nothing.
template <int n>
ERBS_INLINE void transpose(const PackOf<n>* in, PackOf<n>* out) {
  if constexpr (n > register_size) {
    PackOf<n / 2> part[n / 2], turned[n / 2];
    for (int block = 0; block < 4; ++block) {
      const int row = block / 2 * (n / 2), column = block % 2 * (n / 2);
      for (int i = 0; i < n / 2; ++i) part[i] = column == 0 ? in[row + i].low : in[row + i].high;
      transpose<n / 2>(part, turned);
      for (int i = 0; i < n / 2; ++i) (row == 0 ? out[column + i].low : out[column + i].high) = turned[i];
    }
  } else {
#if defined(__AVX512F__)
    const auto every_other = [&](Pack r01, Pack r23, Pack r45, Pack r67, int from) {
      const Pack ends_0 = quarters<0, 2, 0, 2>(r01, r23), ends_4 = quarters<0, 2, 0, 2>(r45, r67),
                 middle_0 = quarters<1, 3, 1, 3>(r01, r23), middle_4 = quarters<1, 3, 1, 3>(r45, r67);
      out[from] = quarters<0, 2, 0, 2>(ends_0, ends_4);
      out[from + 2] = quarters<0, 2, 0, 2>(middle_0, middle_4);
      out[from + 4] = quarters<1, 3, 1, 3>(ends_0, ends_4);
      out[from + 6] = quarters<1, 3, 1, 3>(middle_0, middle_4);
    };
    every_other(evens(in[0], in[1]), evens(in[2], in[3]), evens(in[4], in[5]), evens(in[6], in[7]), 0);
    every_other(odds(in[0], in[1]), odds(in[2], in[3]), odds(in[4], in[5]), odds(in[6], in[7]), 1);
#elif defined(__AVX__)
    const auto t0 = evens(in[0], in[1]), t1 = odds(in[0], in[1]), t2 = evens(in[2], in[3]), t3 = odds(in[2], in[3]);
    out[0] = __builtin_shufflevector(t0.v, t2.v, 0, 1, 4, 5);
    out[1] = __builtin_shufflevector(t1.v, t3.v, 0, 1, 4, 5);
    out[2] = __builtin_shufflevector(t0.v, t2.v, 2, 3, 6, 7);
    out[3] = __builtin_shufflevector(t1.v, t3.v, 2, 3, 6, 7);
#else
    out[0] = evens(in[0], in[1]);
    out[1] = odds(in[0], in[1]);
#endif
  }
}

// out[i] takes rows[offset[l] + i] as lane l.
ERBS_INLINE void rows_to_pack(const double* rows, const int offset[8], Pack out[8]) {
  Pack row[8];
  for (int l = 0; l < 8; ++l) row[l] = load(rows + offset[l]);
  transpose<8>(row, out);
}

// The reverse.
ERBS_INLINE void pack_to_rows(const Pack in[8], double* rows, const int offset[8]) {
  Pack row[8];
  transpose<8>(in, row);
  for (int l = 0; l < 8; ++l) store(rows + offset[l], row[l]);
}

// Of rows that lie one behind the other.
inline constexpr int side_by_side[8] = {0, 8, 16, 24, 32, 40, 48, 56};

}  // namespace erbs::ERBS_TARGET
