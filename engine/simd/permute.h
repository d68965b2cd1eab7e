// Lanes that change places: picks by a table, neighbours, sums and the least of all lanes.
#pragma once
#include "engine/simd/transpose.h"

namespace erbs::ERBS_TARGET {

// Lane i takes lane i + 1 of a and b, one behind the other.
ERBS_INLINE PackOf<register_size> shift_in(PackOf<register_size> a, PackOf<register_size> b) {
#if defined(__AVX512F__)
  return __builtin_shufflevector(a.v, b.v, 1, 2, 3, 4, 5, 6, 7, 8);
#elif defined(__AVX__)
  return __builtin_shufflevector(a.v, b.v, 1, 2, 3, 4);
#else
  return __builtin_shufflevector(a.v, b.v, 1, 2);
#endif
}
template <int n>
ERBS_INLINE PackOf<n> shift_in(PackOf<n> a, PackOf<n> b) {
  return {shift_in(a.low, a.high), shift_in(a.high, b.low)};
}
// Each lane takes the one after it, the last one the first.
ERBS_INLINE Pack next(Pack x) { return shift_in(x, x); }

// Which lanes to pick: lane i is lane from[i] of a, or lane from[i] - 8 of b.
#if defined(__AVX512F__)
typedef __m512i Picks;
ERBS_INLINE Picks picks(const unsigned char from[8]) {
  return _mm512_maskz_cvtepu8_epi64(0xff, _mm_loadl_epi64(reinterpret_cast<const __m128i*>(from)));
}
// The lowest four bits of eight numbers, after a shift.
typedef __m512i Words;
ERBS_INLINE Words words(const unsigned* x) {
  return _mm512_maskz_cvtepu32_epi64(0xff, _mm256_loadu_si256(reinterpret_cast<const __m256i*>(x)));
}
template <int shift>
ERBS_INLINE Picks picks(Words w) {
  return _mm512_maskz_srli_epi64(0xff, w, shift);  // of which pick() takes the lowest four
}
ERBS_INLINE Pack pick(Pack a, Pack b, Picks from) { return Pack::Register(_mm512_permutex2var_pd(__m512d(a.v), from, __m512d(b.v))); }
ERBS_INLINE Pack pick(const double a[8], Picks from) { return Pack::Register(_mm512_maskz_permutexvar_pd(0xff, from, __m512d(load(a).v))); }
// Two picks from eight each: by the lowest three bits, and by the three above.
ERBS_INLINE void two_picks(const unsigned char from[8], Picks& lowest, Picks& above) {
  lowest = picks(from);  // the lowest three bits count
  above = _mm512_maskz_srli_epi64(0xff, lowest, 3);
}
#else
struct Picks {
  unsigned char from[8];
};
ERBS_INLINE Picks picks(const unsigned char from[8]) {
  Picks p;
  __builtin_memcpy(p.from, from, 8);
  return p;
}
typedef const unsigned* Words;
ERBS_INLINE Words words(const unsigned* x) { return x; }
template <int shift>
ERBS_INLINE Picks picks(Words w) {
  Picks p;
  for (int i = 0; i < 8; ++i) p.from[i] = static_cast<unsigned char>(w[i] >> shift & 15u);
  return p;
}
ERBS_INLINE Pack pick(Pack a, Pack b, const Picks& p) {
  alignas(64) double both[16], out[8];
  store(both, a);
  store(both + 8, b);
  for (int i = 0; i < 8; ++i) out[i] = both[p.from[i] % 16];
  return load(out);
}
ERBS_INLINE Pack pick(const double a[8], const Picks& p) {
  alignas(64) double out[8];
  for (int i = 0; i < 8; ++i) out[i] = a[p.from[i]];
  return load(out);
}
ERBS_INLINE void two_picks(const unsigned char from[8], Picks& lowest, Picks& above) {
  for (int i = 0; i < 8; ++i) lowest.from[i] = from[i] % 8, above.from[i] = from[i] / 8;
}
#endif

template <int n>
ERBS_INLINE double least_of(PackOf<n> x) {
  if constexpr (n > register_size) {
    return least_of(min(x.low, x.high));
  } else {
#if defined(__AVX512F__)
    x = min(x, Pack(__builtin_shufflevector(x.v, x.v, 4, 5, 6, 7, 0, 1, 2, 3)));
    x = min(x, Pack(__builtin_shufflevector(x.v, x.v, 2, 3, 0, 1, 4, 5, 6, 7)));
#elif defined(__AVX__)
    x = min(x, PackOf<n>(__builtin_shufflevector(x.v, x.v, 2, 3, 0, 1)));
#endif
    return x[0] < x[1] ? x[0] : x[1];
  }
}

// The sums of eight packs, each as ((0 + 1) + (2 + 3)) + ((4 + 5) + (6 + 7)).
ERBS_INLINE Pack add_up(const Pack p[8]) {
#if defined(__AVX512F__)
  const auto pairs = [](Pack a, Pack b) { return evens(a, b) + odds(a, b); };
  const auto fours = [&](int i) {
    const Pack a = pairs(p[i], p[i + 1]), b = pairs(p[i + 2], p[i + 3]);
    return Pack(__builtin_shufflevector(a.v, b.v, 0, 1, 8, 9, 4, 5, 12, 13)) +
           Pack(__builtin_shufflevector(a.v, b.v, 2, 3, 10, 11, 6, 7, 14, 15));
  };
  const Pack a = fours(0), b = fours(4);
  return Pack(__builtin_shufflevector(a.v, b.v, 0, 1, 2, 3, 8, 9, 10, 11)) +
         Pack(__builtin_shufflevector(a.v, b.v, 4, 5, 6, 7, 12, 13, 14, 15));
#else
  Pack t[8];
  transpose<8>(p, t);
  return ((t[0] + t[1]) + (t[2] + t[3])) + ((t[4] + t[5]) + (t[6] + t[7]));
#endif
}

// Stores four lanes side by side.
template <int i, int j, int k, int l>
ERBS_INLINE void store_four(double* to, Pack x) {
#if defined(__AVX512F__)
  const auto four = __builtin_shufflevector(x.v, x.v, i, j, k, l);
  __builtin_memcpy(to, &four, sizeof four);
#else
  alignas(64) double all[8];
  store(all, x);
  to[0] = all[i], to[1] = all[j], to[2] = all[k], to[3] = all[l];
#endif
}

}  // namespace erbs::ERBS_TARGET
