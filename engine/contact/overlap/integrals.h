// Sums over the triangles of an overlap (clip.h). Each is made of eight partial sums at any register width, so that all instruction sets
// give the same bits.
#pragma once
#include "engine/contact/overlap/clip.h"
#include "engine/contact/overlap/ramp.h"
#include "engine/simd/permute.h"

namespace erbs::ERBS_TARGET {

// Second moments xx, yy, zz, xy, yz, zx of the triangles, whose sizes are known.
static void sum_second(const Triangles& w, Pack out[6]) {
  Pack xx{}, yy{}, zz{}, xy{}, yz{}, zx{};
  for (int t = 0; t < w.count; t += 8) {
    const Pack twelfth = load(&w.size[t]) * (1.0 / 12);
    Pack x[3], y[3], z[3];  // sums of two corners: Int x x^T dS = dS / 12 sum over the edges
    for (int k = 0; k < 3; ++k) {
      const int m = (k + 1) % 3;
      x[k] = load(&w.corner[k][0][t]) + load(&w.corner[m][0][t]);
      y[k] = load(&w.corner[k][1][t]) + load(&w.corner[m][1][t]);
      z[k] = load(&w.corner[k][2][t]) + load(&w.corner[m][2][t]);
    }
    const auto of = [&](const Pack a[3], const Pack b[3]) { return twelfth * (a[0] * b[0] + a[1] * b[1] + a[2] * b[2]); };
    xx += of(x, x), yy += of(y, y), zz += of(z, z);
    xy += of(x, y), yz += of(y, z), zx += of(z, x);
  }
  out[0] = xx, out[1] = yy, out[2] = zz, out[3] = xy, out[4] = yz, out[5] = zx;
}

// Two passes: the sums of a single one do not fit into the registers.
static void sum(Triangles& w, OverlapSums& out) {
  static_assert(sizeof out == 24 * sizeof(double));  // in the order of its members
  Pack total{}, area{}, max_depth{}, pressure[3] = {}, centroid[3] = {}, force[3] = {}, moment[3] = {};
  for (int t = 0; t < w.count; t += 8) {
    Pack x[3][3], n[3], plane[4], f[3];  // corners; normal of the face of b; plane of the face of a; phi at the corners
    Picks face, nearest;
    two_picks(&w.faces[t], face, nearest);
    for (int i = 0; i < 3; ++i) {
      for (int k = 0; k < 3; ++k) x[k][i] = load(&w.corner[k][i][t]);
      n[i] = pick(w.normal[i], face);
    }
    for (int i = 0; i < 4; ++i) plane[i] = pick(w.plane[i], nearest);
    for (int k = 0; k < 3; ++k) {
      f[k] = max(plane[3] - (plane[0] * x[k][0] + plane[1] * x[k][1] + plane[2] * x[k][2]), Pack(0));
      store(&w.depth[k][t], f[k]);
    }
    max_depth = max(max(max(f[1], f[2]), f[0]), max_depth);
    const Pack *p = x[0], *q = x[1], *r = x[2];
    const Pack a[3] = {q[0] - p[0], q[1] - p[1], q[2] - p[2]}, b[3] = {r[0] - p[0], r[1] - p[1], r[2] - p[2]};
    const Pack dS = 0.5 * (n[0] * (a[1] * b[2] - a[2] * b[1]) + n[1] * (a[2] * b[0] - a[0] * b[2]) + n[2] * (a[0] * b[1] - a[1] * b[0]));
    store(&w.size[t], dS);
    const Pack whole = f[0] + f[1] + f[2], third = dS * (1.0 / 3), twelfth = dS * (1.0 / 12), i0 = third * whole;
    Pack i1[3];
    for (int k = 0; k < 3; ++k) {
      const Pack s = p[k] + q[k] + r[k];
      i1[k] = twelfth * (whole * s + f[0] * p[k] + f[1] * q[k] + f[2] * r[k]);
      centroid[k] += third * s;
    }
    total += i0;
    area += dS;
    for (int k = 0; k < 3; ++k) {
      const int m = (k + 1) % 3, o = (k + 2) % 3;
      pressure[k] += i1[k];
      force[k] -= i0 * n[k];
      moment[k] -= i1[m] * n[o] - i1[o] * n[m];
    }
  }
  Pack second[6];
  sum_second(w, second);
  const Pack sums[24] = {total,     pressure[0], pressure[1], pressure[2], area,      centroid[0], centroid[1], centroid[2],
                         second[0], second[1],   second[2],   second[3],   second[4], second[5],   force[0],    force[1],
                         force[2],  moment[0],   moment[1],   moment[2],   Pack(0),   Pack(0),     Pack(0),     Pack(0)};
  for (int k = 0; k < 24; k += 8) store(&out.total + k, add_up(&sums[k]));
  w.max_depth = -least_of(-max_depth);
}

static double closing_speeds(Triangles& w, double along, const double angular_part[3]) {
  Pack most = Pack(-1e300);
  for (int t = 0; t < w.count; t += 8) {
    for (int c = 0; c < 3; ++c) {
      const Pack v = along + (angular_part[0] * load(&w.corner[c][0][t]) + angular_part[1] * load(&w.corner[c][1][t]) +
                              angular_part[2] * load(&w.corner[c][2][t]));
      store(&w.closing_speed[c][t], v);
      most = max(v, most);
    }
  }
  return -least_of(-most);
}

// Adds what the clamp of s - 1 to [-1, limit - 1] changes on the marked ones of the eight triangles from t on. It acts where a contact lets
// go or an impact is too fast. `along`: the share of their faces of b that presses along the normal of the patch.
static void clamp(const Triangles& w, int t, unsigned marked, Pack along, double chi, double limit, double& total, double first[3]) {
  Pack f[3], s[3], x[3][3], changes[4];
  for (int k = 0; k < 3; ++k) {
    s[k] = chi * load(&w.closing_speed[k][t]);
    f[k] = load(&w.depth[k][t]);
    for (int i = 0; i < 3; ++i) x[k][i] = load(&w.corner[k][i][t]);
  }
  clamp_change<Pack>(f, s, x, along * load(&w.size[t]), limit - 1, Mask::of_bits(marked), changes);
  alignas(64) double change[4][8];
  for (int k = 0; k < 4; ++k) store(change[k], changes[k]);
  for (; marked != 0; marked &= marked - 1) {
    const int l = __builtin_ctz(marked);
    total += change[0][l];
    for (int i = 0; i < 3; ++i) first[i] += change[1 + i][l];
  }
}

static void damp(const Triangles& w, const double normal[3], double chi, double limit, double& total, double first[3]) {
  alignas(64) double share[few], sum[8];
  store(share, max(-(normal[0] * load(w.normal[0]) + normal[1] * load(w.normal[1]) + normal[2] * load(w.normal[2])), Pack(0)));
  Pack sums[8] = {};  // Int phi s and its first moment
  unsigned char clamped[most_triangles / 8 + 1];
  unsigned any = 0;
  for (int t = 0; t < w.count; t += 8) {
    Picks face, nearest;
    two_picks(&w.faces[t], face, nearest);
    const Pack along = pick(share, face), dS = along * load(&w.size[t]);
    Pack s[3], f[3];
    for (int k = 0; k < 3; ++k) {
      s[k] = chi * load(&w.closing_speed[k][t]);
      f[k] = load(&w.depth[k][t]);
    }
    const Pack least = min(min(s[0], s[1]), s[2]), most = max(max(s[0], s[1]), s[2]);
    const unsigned past = bits(((least + 1 < 0) | (most - (limit - 1) > 0)) & (along > 0));
    clamped[t / 8] = static_cast<unsigned char>(past);
    any |= past;
    const Pack sf = f[0] + f[1] + f[2], ss = s[0] + s[1] + s[2], sfs = f[0] * s[0] + f[1] * s[1] + f[2] * s[2], even = sf * ss + sfs;
    sums[0] += (1.0 / 12) * dS * even;
    // Int phi s x over a triangle: products of three linear functions in closed form.
    const Pack part = (1.0 / 60) * dS;
    Pack weight[3];
    for (int k = 0; k < 3; ++k) weight[k] = part * (even + (ss + (s[k] + s[k])) * f[k] + sf * s[k]);
    for (int i = 0; i < 3; ++i)
      sums[1 + i] += weight[0] * load(&w.corner[0][i][t]) + weight[1] * load(&w.corner[1][i][t]) + weight[2] * load(&w.corner[2][i][t]);
  }
  store(sum, add_up(sums));
  total = sum[0];
  for (int k = 0; k < 3; ++k) first[k] = sum[1 + k];
  for (int t = 0; any != 0 && t < w.count; t += 8) {
    if (clamped[t / 8] == 0) continue;
    Picks face, nearest;
    two_picks(&w.faces[t], face, nearest);
    clamp(w, t, clamped[t / 8], pick(share, face), chi, limit, total, first);
  }
}

}  // namespace erbs::ERBS_TARGET
