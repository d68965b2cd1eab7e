// Eight doubles side by side, in as many registers as the instruction set needs, with the same functions for a single number: a template
// on `double` or `Pack` reads alike for both. Names follow std::simd and xsimd. All operations are elementwise and none is fused, min and
// max are the processor's own (a < b ? a : b); so the bits do not depend on the register width.
#pragma once
#include <math.h>
#if defined(__SSE2__)
#include <immintrin.h>
#endif

#include <type_traits>

#include "engine/simd/target.h"

namespace erbs::ERBS_TARGET {

#if defined(__AVX512F__)
inline constexpr int register_size = 8;  // doubles
#elif defined(__AVX__)
inline constexpr int register_size = 4;
#else
inline constexpr int register_size = 2;
#endif

template <int n>
struct MaskOf;
template <int n>
struct PackOf;
using Pack = PackOf<8>;
using Mask = MaskOf<8>;

// One register.
template <>
struct MaskOf<register_size> {
#if defined(__AVX512F__)
  using Bits = __mmask8;
#else
  typedef long long Bits __attribute__((vector_size(8 * register_size)));  // all bits of a lane: true or false
#endif
  Bits m;

#if defined(__AVX512F__)
  friend ERBS_INLINE MaskOf operator&(MaskOf a, MaskOf b) { return {_kand_mask8(a.m, b.m)}; }
  friend ERBS_INLINE MaskOf operator|(MaskOf a, MaskOf b) { return {_kor_mask8(a.m, b.m)}; }
  friend ERBS_INLINE MaskOf operator!(MaskOf a) { return {_knot_mask8(a.m)}; }
  friend ERBS_INLINE unsigned bits(MaskOf a) { return a.m; }
  static ERBS_INLINE MaskOf of_bits(unsigned bits) { return {__mmask8(bits)}; }
#else
  friend ERBS_INLINE MaskOf operator&(MaskOf a, MaskOf b) { return {a.m & b.m}; }
  friend ERBS_INLINE MaskOf operator|(MaskOf a, MaskOf b) { return {a.m | b.m}; }
  friend ERBS_INLINE MaskOf operator!(MaskOf a) { return {~a.m}; }
  friend ERBS_INLINE unsigned bits(MaskOf a) {
#if defined(__AVX__)
    return unsigned(_mm256_movemask_pd(__m256d(a.m)));
#elif defined(__SSE2__)
    return unsigned(_mm_movemask_pd(__m128d(a.m)));
#else
    unsigned bits = 0;
    for (int i = 0; i < register_size; ++i) bits |= unsigned(a.m[i] & 1) << i;
    return bits;
#endif
  }
  static ERBS_INLINE MaskOf of_bits(unsigned bits) {
    Bits lane;
    for (int i = 0; i < register_size; ++i) lane[i] = 1LL << i;
    return {(lane & (static_cast<long long>(bits) - Bits{})) != 0};
  }
#endif
  friend ERBS_INLINE bool any(MaskOf a) { return bits(a) != 0; }
};

template <>
struct PackOf<register_size> {
  typedef double Register __attribute__((vector_size(8 * register_size)));
  using M = MaskOf<register_size>;
  Register v;

  PackOf() = default;
  ERBS_INLINE PackOf(Register x) : v(x) {}
  ERBS_INLINE PackOf(double x) : v(x - Register{}) {}  // in every lane
  ERBS_INLINE double operator[](int lane) const { return v[lane]; }

  static ERBS_INLINE PackOf load(const double* x) {
    PackOf p;
    __builtin_memcpy(&p.v, x, sizeof p.v);
    return p;
  }
  ERBS_INLINE void store(double* x) const { __builtin_memcpy(x, &v, sizeof v); }
  // Lane l from from[l][i], straight into a register: a store of single numbers followed by a load of the whole register would stall.
  static ERBS_INLINE PackOf gather(const double* const* from, int i) {
#if defined(__AVX512F__)
    return Register{from[0][i], from[1][i], from[2][i], from[3][i], from[4][i], from[5][i], from[6][i], from[7][i]};
#elif defined(__AVX__)
    return Register{from[0][i], from[1][i], from[2][i], from[3][i]};
#else
    return Register{from[0][i], from[1][i]};
#endif
  }

  friend ERBS_INLINE PackOf operator+(PackOf a, PackOf b) { return a.v + b.v; }
  friend ERBS_INLINE PackOf operator-(PackOf a, PackOf b) { return a.v - b.v; }
  friend ERBS_INLINE PackOf operator*(PackOf a, PackOf b) { return a.v * b.v; }
  friend ERBS_INLINE PackOf operator/(PackOf a, PackOf b) { return a.v / b.v; }
  friend ERBS_INLINE PackOf operator-(PackOf a) { return -a.v; }

#if defined(__AVX512F__)
  // The forms without a mask make GCC 12 warn of an uninitialised value.
  friend ERBS_INLINE M operator<(PackOf a, PackOf b) { return {_mm512_cmp_pd_mask(__m512d(a.v), __m512d(b.v), _CMP_LT_OQ)}; }
  friend ERBS_INLINE M operator<=(PackOf a, PackOf b) { return {_mm512_cmp_pd_mask(__m512d(a.v), __m512d(b.v), _CMP_LE_OQ)}; }
  friend ERBS_INLINE M operator>(PackOf a, PackOf b) { return {_mm512_cmp_pd_mask(__m512d(a.v), __m512d(b.v), _CMP_GT_OQ)}; }
  friend ERBS_INLINE M operator>=(PackOf a, PackOf b) { return {_mm512_cmp_pd_mask(__m512d(a.v), __m512d(b.v), _CMP_GE_OQ)}; }
  friend ERBS_INLINE M operator==(PackOf a, PackOf b) { return {_mm512_cmp_pd_mask(__m512d(a.v), __m512d(b.v), _CMP_EQ_OQ)}; }
  friend ERBS_INLINE M operator!=(PackOf a, PackOf b) { return {_mm512_cmp_pd_mask(__m512d(a.v), __m512d(b.v), _CMP_NEQ_UQ)}; }
  friend ERBS_INLINE PackOf select(M m, PackOf a, PackOf b) { return Register(_mm512_mask_blend_pd(m.m, __m512d(b.v), __m512d(a.v))); }
  friend ERBS_INLINE PackOf min(PackOf a, PackOf b) { return Register(_mm512_maskz_min_pd(0xff, __m512d(a.v), __m512d(b.v))); }
  friend ERBS_INLINE PackOf max(PackOf a, PackOf b) { return Register(_mm512_maskz_max_pd(0xff, __m512d(a.v), __m512d(b.v))); }
  friend ERBS_INLINE PackOf sqrt(PackOf a) { return Register(_mm512_maskz_sqrt_pd(0xff, __m512d(a.v))); }
#else
  friend ERBS_INLINE M operator<(PackOf a, PackOf b) { return {a.v < b.v}; }
  friend ERBS_INLINE M operator<=(PackOf a, PackOf b) { return {a.v <= b.v}; }
  friend ERBS_INLINE M operator>(PackOf a, PackOf b) { return {a.v > b.v}; }
  friend ERBS_INLINE M operator>=(PackOf a, PackOf b) { return {a.v >= b.v}; }
  friend ERBS_INLINE M operator==(PackOf a, PackOf b) { return {a.v == b.v}; }
  friend ERBS_INLINE M operator!=(PackOf a, PackOf b) { return {a.v != b.v}; }
  friend ERBS_INLINE PackOf select(M m, PackOf a, PackOf b) { return m.m ? a.v : b.v; }
#if defined(__AVX__)
  friend ERBS_INLINE PackOf min(PackOf a, PackOf b) { return Register(_mm256_min_pd(__m256d(a.v), __m256d(b.v))); }
  friend ERBS_INLINE PackOf max(PackOf a, PackOf b) { return Register(_mm256_max_pd(__m256d(a.v), __m256d(b.v))); }
  friend ERBS_INLINE PackOf sqrt(PackOf a) { return Register(_mm256_sqrt_pd(__m256d(a.v))); }
#elif defined(__SSE2__)
  friend ERBS_INLINE PackOf min(PackOf a, PackOf b) { return Register(_mm_min_pd(__m128d(a.v), __m128d(b.v))); }
  friend ERBS_INLINE PackOf max(PackOf a, PackOf b) { return Register(_mm_max_pd(__m128d(a.v), __m128d(b.v))); }
  friend ERBS_INLINE PackOf sqrt(PackOf a) { return Register(_mm_sqrt_pd(__m128d(a.v))); }
#else
  friend ERBS_INLINE PackOf min(PackOf a, PackOf b) { return a.v < b.v ? a.v : b.v; }
  friend ERBS_INLINE PackOf max(PackOf a, PackOf b) { return a.v > b.v ? a.v : b.v; }
  friend ERBS_INLINE PackOf sqrt(PackOf a) {
    for (int i = 0; i < register_size; ++i) a.v[i] = ::sqrt(a.v[i]);
    return a;
  }
#endif
#endif
  friend ERBS_INLINE PackOf abs(PackOf a) {
    typedef long long Bits __attribute__((vector_size(8 * register_size)));
    return Register(Bits(a.v) & 0x7fffffffffffffffLL);
  }
};

// Two halves side by side.
template <int n>
struct MaskOf {
  using Half = MaskOf<n / 2>;
  Half low, high;

  friend ERBS_INLINE MaskOf operator&(MaskOf a, MaskOf b) { return {a.low & b.low, a.high & b.high}; }
  friend ERBS_INLINE MaskOf operator|(MaskOf a, MaskOf b) { return {a.low | b.low, a.high | b.high}; }
  friend ERBS_INLINE MaskOf operator!(MaskOf a) { return {!a.low, !a.high}; }
  friend ERBS_INLINE unsigned bits(MaskOf a) { return bits(a.low) | bits(a.high) << n / 2; }
  friend ERBS_INLINE bool any(MaskOf a) { return any(a.low | a.high); }
  static ERBS_INLINE MaskOf of_bits(unsigned bits) { return {Half::of_bits(bits), Half::of_bits(bits >> n / 2)}; }
};

template <int n>
struct PackOf {
  using Half = PackOf<n / 2>;
  using M = MaskOf<n>;
  Half low, high;

  PackOf() = default;
  ERBS_INLINE PackOf(Half a, Half b) : low(a), high(b) {}
  ERBS_INLINE PackOf(double x) : low(x), high(x) {}
  ERBS_INLINE double operator[](int lane) const { return lane < n / 2 ? low[lane] : high[lane - n / 2]; }
  static ERBS_INLINE PackOf load(const double* x) { return {Half::load(x), Half::load(x + n / 2)}; }
  ERBS_INLINE void store(double* x) const { low.store(x), high.store(x + n / 2); }
  static ERBS_INLINE PackOf gather(const double* const* from, int i) { return {Half::gather(from, i), Half::gather(from + n / 2, i)}; }

  friend ERBS_INLINE PackOf operator+(PackOf a, PackOf b) { return {a.low + b.low, a.high + b.high}; }
  friend ERBS_INLINE PackOf operator-(PackOf a, PackOf b) { return {a.low - b.low, a.high - b.high}; }
  friend ERBS_INLINE PackOf operator*(PackOf a, PackOf b) { return {a.low * b.low, a.high * b.high}; }
  friend ERBS_INLINE PackOf operator/(PackOf a, PackOf b) { return {a.low / b.low, a.high / b.high}; }
  friend ERBS_INLINE PackOf operator-(PackOf a) { return {-a.low, -a.high}; }
  friend ERBS_INLINE M operator<(PackOf a, PackOf b) { return {a.low < b.low, a.high < b.high}; }
  friend ERBS_INLINE M operator<=(PackOf a, PackOf b) { return {a.low <= b.low, a.high <= b.high}; }
  friend ERBS_INLINE M operator>(PackOf a, PackOf b) { return {a.low > b.low, a.high > b.high}; }
  friend ERBS_INLINE M operator>=(PackOf a, PackOf b) { return {a.low >= b.low, a.high >= b.high}; }
  friend ERBS_INLINE M operator==(PackOf a, PackOf b) { return {a.low == b.low, a.high == b.high}; }
  friend ERBS_INLINE M operator!=(PackOf a, PackOf b) { return {a.low != b.low, a.high != b.high}; }
  friend ERBS_INLINE PackOf select(M m, PackOf a, PackOf b) { return {select(m.low, a.low, b.low), select(m.high, a.high, b.high)}; }
  friend ERBS_INLINE PackOf min(PackOf a, PackOf b) { return {min(a.low, b.low), min(a.high, b.high)}; }
  friend ERBS_INLINE PackOf max(PackOf a, PackOf b) { return {max(a.low, b.low), max(a.high, b.high)}; }
  friend ERBS_INLINE PackOf sqrt(PackOf a) { return {sqrt(a.low), sqrt(a.high)}; }
  friend ERBS_INLINE PackOf abs(PackOf a) { return {abs(a.low), abs(a.high)}; }
};

template <int n>
ERBS_INLINE PackOf<n>& operator+=(PackOf<n>& a, std::type_identity_t<PackOf<n>> b) {
  return a = a + b;
}
template <int n>
ERBS_INLINE PackOf<n>& operator-=(PackOf<n>& a, std::type_identity_t<PackOf<n>> b) {
  return a = a - b;
}
template <int n>
ERBS_INLINE PackOf<n>& operator*=(PackOf<n>& a, std::type_identity_t<PackOf<n>> b) {
  return a = a * b;
}
template <int n>
ERBS_INLINE MaskOf<n>& operator&=(MaskOf<n>& a, MaskOf<n> b) {
  return a = a & b;
}
template <int n>
ERBS_INLINE MaskOf<n>& operator|=(MaskOf<n>& a, MaskOf<n> b) {
  return a = a | b;
}

// The same functions for one number.
ERBS_INLINE double select(bool m, double a, double b) { return m ? a : b; }
ERBS_INLINE double min(double a, double b) { return a < b ? a : b; }
ERBS_INLINE double max(double a, double b) { return a > b ? a : b; }
ERBS_INLINE double abs(double x) { return fabs(x); }
ERBS_INLINE double sqrt(double x) { return ::sqrt(x); }
ERBS_INLINE bool any(bool m) { return m; }

// The mask of a scalar type: `Mask` of packs, bool of numbers.
template <class T>
inline constexpr int lanes_of = 1;
template <>
inline constexpr int lanes_of<Pack> = 8;
template <class T>
using MaskFor = decltype(T() < T());

ERBS_INLINE Pack load(const double* x) { return Pack::load(x); }
ERBS_INLINE void store(double* x, Pack p) { p.store(x); }
template <class T>
ERBS_INLINE T load(const double* x) {
  if constexpr (lanes_of<T> == 1) return *x;
  else return T::load(x);
}
ERBS_INLINE void store(double* x, double p) { *x = p; }
ERBS_INLINE void add_to(double* x, Pack p) { store(x, load(x) + p); }

// A safe divisor in lanes whose quotient is not used.
template <class T>
ERBS_INLINE T nonzero(T x) {
  return select(x > 0, x, 1);
}
// A divisor x >= 0 of a number that is not greater than x: zero over zero gives zero.
template <class T>
ERBS_INLINE T not_quite_zero(T x) {
  return max(x, 1e-300);
}

// Prefetches an object that is read soon.
template <class T>
ERBS_INLINE void prefetch(const T* from) {
  for (long i = 0; i < long(sizeof(T)); i += 64) __builtin_prefetch(reinterpret_cast<const char*>(from) + i);
}

}  // namespace erbs::ERBS_TARGET
