// Balls and boxes that may touch, eight side by side.
#pragma once
#include "engine/contact/law/pair_lanes.h"
#include "engine/contact/law/pair_rows.h"
#include "engine/simd/vec3.h"

namespace erbs::ERBS_TARGET {

// Finds the balls from `from` to `to` that are no farther from `one` than `margin`; returns their number.
static int close_balls(const Balls& all, int from, int to, const double one[4], double margin, int* found) {
  int count = 0;
  for (int k = from; k < to; k += 8) {
    const Pack x = one[0] - load(all.x + k), y = one[1] - load(all.y + k), z = one[2] - load(all.z + k);
    const Pack reach = one[3] + load(all.radius + k) + margin;
    unsigned near = bits(!(x * x + y * y + z * z - reach * reach > 0));
    if (to - k < 8) near &= (1u << (to - k)) - 1;
    for (; near != 0; near &= near - 1) found[count++] = k + __builtin_ctz(near);
  }
  return count;
}

// Returns as bits which of eight boxes no separating axis keeps apart from `one` by the margin. The axes are the three face normals of each
// box and the nine products of their edges.
static unsigned close_boxes(const OrientedBox& one, const OrientedBox* const other[8], double margin) {
  const double* from[8];
  for (int l = 0; l < 8; ++l) from[l] = other[l]->centre;
  PackArray rows[16];
  read(from, 2, rows);
  const Pack3 b = load3(rows + 12), c = load3(rows);
  const Pack3 away{c.x - one.centre[0], c.y - one.centre[1], c.z - one.centre[2]};
  Pack rotation[3][3], size[3][3], d[3], a[3], h[3] = {b.x, b.y, b.z}, over = Pack(-1);
  for (int i = 0; i < 3; ++i) {
    const double* axis = one.rotation + 3 * i;  // column i
    d[i] = axis[0] * away.x + axis[1] * away.y + axis[2] * away.z;
    a[i] = Pack(one.half[i]);
    for (int j = 0; j < 3; ++j) {
      const PackArray* to = rows + 3 + 3 * j;
      rotation[i][j] = axis[0] * load(to[0]) + axis[1] * load(to[1]) + axis[2] * load(to[2]);
      size[i][j] = abs(rotation[i][j]);
    }
  }
  const auto above_zero = [&over](Pack x) { over = max(over, x); };
  for (int i = 0; i < 3; ++i) {
    above_zero(abs(d[i]) - a[i] - (size[i][0] * h[0] + size[i][1] * h[1] + size[i][2] * h[2]) - margin);
    const Pack along = rotation[0][i] * d[0] + rotation[1][i] * d[1] + rotation[2][i] * d[2];
    above_zero(abs(along) - h[i] - (size[0][i] * a[0] + size[1][i] * a[1] + size[2][i] * a[2]) - margin);
  }
  unsigned apart = bits(over > 0);
  if (apart == 0xff) return 0;
  for (int i = 0; i < 3; ++i) {
    const int k = (i + 1) % 3, m = (i + 2) % 3;
    for (int j = 0; j < 3; ++j) {
      const int p = (j + 1) % 3, q = (j + 2) % 3;  // axis = e_i x column j of `rotation`
      const Pack square = rotation[k][j] * rotation[k][j] + rotation[m][j] * rotation[m][j],
                 along = rotation[k][j] * d[m] - rotation[m][j] * d[k];
      const Pack beyond = abs(along) - (size[m][j] * a[k] + size[k][j] * a[m] + size[i][q] * h[p] + size[i][p] * h[q]);
      apart |= bits((square - 1e-12 > 0) & (beyond > 0) & (beyond * beyond - (margin * margin) * square > 0));
    }
  }
  return ~apart & 0xffu;
}

}  // namespace erbs::ERBS_TARGET
