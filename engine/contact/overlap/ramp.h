// Exact integral of a clamped factor over triangles; `integrals.h` treats eight triangles side by side.
#pragma once

namespace erbs {

// Adds to i0 and i1 the integrals of f max(g, 0) and f max(g, 0) x over the triangle of area dS with corners x[corner][axis]; f and g are
// linear between the corner values. If the sign of g differs at one corner, the part of that corner is a triangle of its own. If g is
// negative there, max(g, 0) = g + max(-g, 0) leads back to this case.
static inline void add_ramp(const double f[3], const double g[3], const double x[3][3], double dS, double& i0, double i1[3]) {
  const int up = (g[0] > 0) + (g[1] > 0) + (g[2] > 0);
  if (up == 0) return;
  const auto add = [&](const double F[3], const double G[3], const double X[3][3], double size) {
    const double sf = F[0] + F[1] + F[2], sg = G[0] + G[1] + G[2], even = sf * sg + F[0] * G[0] + F[1] * G[1] + F[2] * G[2];
    i0 += size / 12 * even;
    for (int k = 0; k < 3; ++k) {
      const double weight = size / 60 * (even + sg * F[k] + sf * G[k] + 2 * F[k] * G[k]);
      for (int i = 0; i < 3; ++i) i1[i] += weight * X[k][i];
    }
  };
  if (up > 1) add(f, g, x, dS);
  if (up == 3) return;
  const double sign = up == 1 ? 1 : -1;
  int lone = 0;
  while ((g[lone] > 0) != (up == 1)) ++lone;
  double F[3] = {f[lone]}, G[3] = {sign * g[lone], 0, 0}, X[3][3], size = dS;
  for (int i = 0; i < 3; ++i) X[0][i] = x[lone][i];
  for (int k = 1; k < 3; ++k) {
    const int to = (lone + k) % 3;
    const double share = g[lone] / (g[lone] - g[to]);
    F[k] = f[lone] + share * (f[to] - f[lone]);
    for (int i = 0; i < 3; ++i) X[k][i] = x[lone][i] + share * (x[to][i] - x[lone][i]);
    size *= share;
  }
  add(F, G, X, size);
}

}  // namespace erbs
