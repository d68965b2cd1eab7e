// Exact integrals of products of linear functions over triangles, one of them clamped. T is a number or a pack of eight triangles.
#pragma once
#include "engine/simd/pack.h"

namespace erbs::ERBS_TARGET {

// Adds to i0 and i1 the integrals of f g and f g x over the triangles marked, of area `size` with corners x[corner][axis]. f and g are
// linear between the corner values.
template <class T>
ERBS_INLINE void add_product(const T f[3], const T g[3], const T x[3][3], T size, MaskFor<T> marked, T& i0, T i1[3]) {
  const T sf = f[0] + f[1] + f[2], sg = g[0] + g[1] + g[2], even = sf * sg + f[0] * g[0] + f[1] * g[1] + f[2] * g[2];
  const T twelfth = size / 12, sixtieth = size / 60;
  i0 += select(marked, twelfth * even, T(0));
  for (int k = 0; k < 3; ++k) {
    const T weight = sixtieth * (even + sg * f[k] + sf * g[k] + 2 * f[k] * g[k]);
    for (int i = 0; i < 3; ++i) i1[i] += select(marked, weight * x[k][i], T(0));
  }
}

// The same of f max(g, 0). If the sign of g differs at one corner, the part of that corner is a triangle of its own. If g is negative
// there, max(g, 0) = g + max(-g, 0) leads back to this case.
template <class T>
static void add_ramp(const T f[3], const T g[3], const T x[3][3], T size, MaskFor<T> marked, T& i0, T i1[3]) {
  const MaskFor<T> up[3] = {g[0] > 0, g[1] > 0, g[2] > 0};
  const MaskFor<T> three = up[0] & up[1] & up[2], most = (up[0] & up[1]) | (up[1] & up[2]) | (up[2] & up[0]), two = most & !three,
                   one = (up[0] | up[1] | up[2]) & !most, whole = most & marked, part = (one | two) & marked;
  if (any(whole)) add_product<T>(f, g, x, size, whole, i0, i1);
  if (!any(part)) return;
  // whether the first or the second corner is the lone one
  const MaskFor<T> first = (one & up[0]) | (two & !up[0]), second = (one & up[1]) | (two & !up[1]);
  const auto rotated = [&](T a, T b, T c) { return select(first, a, select(second, b, c)); };
  const T own = rotated(g[0], g[1], g[2]), lone = rotated(f[0], f[1], f[2]);
  T F[3] = {lone}, G[3] = {select(one, own, -own), T(0), T(0)}, X[3][3];
  for (int i = 0; i < 3; ++i) X[0][i] = rotated(x[0][i], x[1][i], x[2][i]);
  for (int k = 1; k < 3; ++k) {
    const int p = k, q = (1 + k) % 3, r = (2 + k) % 3;
    const T share = own / (own - rotated(g[p], g[q], g[r]));
    F[k] = lone + share * (rotated(f[p], f[q], f[r]) - lone);
    for (int i = 0; i < 3; ++i) X[k][i] = X[0][i] + share * (rotated(x[p][i], x[q][i], x[r][i]) - X[0][i]);
    size *= share;
  }
  add_product<T>(F, G, X, size, part, i0, i1);
}

// What the integrals of f s change by where s is clamped to [-1, most]: of f s, then of f s x.
template <class T>
static void clamp_change(const T f[3], const T s[3], const T x[3][3], T size, double most, MaskFor<T> marked, T change[4]) {
  T under[3], over[3], pulled{}, first_pulled[3] = {}, capped{}, first_capped[3] = {};
  for (int k = 0; k < 3; ++k) under[k] = -1 - s[k], over[k] = s[k] - most;
  add_ramp<T>(f, under, x, size, marked, pulled, first_pulled);
  add_ramp<T>(f, over, x, size, marked, capped, first_capped);
  change[0] = pulled - capped;
  for (int i = 0; i < 3; ++i) change[1 + i] = first_pulled[i] - first_capped[i];
}

}  // namespace erbs::ERBS_TARGET
