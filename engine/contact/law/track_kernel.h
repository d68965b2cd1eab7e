// Poses of eight blocks side by side, as pairs read them.
#pragma once
#include "engine/contact/law/pair_lanes.h"
#include "engine/contact/law/pair_rows.h"
#include "engine/simd/transpose.h"
#include "engine/simd/vec3.h"

namespace erbs::ERBS_TARGET {

static void track(const BlockPosePack& g, unsigned marked, double soon, PackArray& fastest) {
  const Mask which = Mask::of_bits(marked);
  alignas(64) double nowhere[8 * block_rows];
  const Pack3 u = load3(g.u), v = load3(g.v), w = load3(g.w), moved = u - load3(g.last_u);
  Pack q[4], square{};
  for (int i = 0; i < 4; ++i) {
    q[i] = load(g.q[i]);
    const Pack last = load(g.last_q[i]), change = q[i] - last;
    square += change * change;
    store(g.last_q[i], select(which, q[i], last));
  }
  for (int i = 0; i < 3; ++i) store(g.last_u[i], select(which, load(g.u[i]), load(g.last_u[i])));
  // A rotation by an angle moves a point at distance 1 by 2 sin(angle / 2). The quaternions differ by at least half of that,
  // 2 sin(angle / 4).
  const Pack reach = load(g.reach), rotated = reach * (2 * sqrt(square)), spin = reach * sqrt(dot(w, w)), speed = sqrt(dot(v, v));
  const Pack rotation_travel = select(which, rotated, Pack(0)) + load(g.rotation_travel),
             travel = select(which, sqrt(dot(moved, moved)) + rotated, Pack(0)) + load(g.travel);
  store(g.rotation_travel, rotation_travel);
  store(g.travel, travel);
  store(g.spin, select(which, spin, load(g.spin)));
  store(g.travel_ahead, select(which, travel + soon * (speed + spin), load(g.travel_ahead)));
  store(fastest, max(select(which, speed, Pack(0)), load(fastest)));
  Mat3<Pack> t = rotation_of(Quat<Pack>{q[0], q[1], q[2], q[3]});
  if (g.axes != nullptr) {
    const Mat3<Pack> axes = transposed(Mat3<Pack>{load3(g.axes), load3(g.axes + 3), load3(g.axes + 6)});
    for (Pack3& row : t.row) row = axes * row;
  }
  const Pack first[8] = {u.x, u.y, u.z, t.row[0].x, t.row[1].x, t.row[2].x, t.row[0].y, t.row[1].y};
  const Pack second[8] = {t.row[2].y, t.row[0].z, t.row[1].z, t.row[2].z, v.x, v.y, v.z, w.x};
  Pack row[8];
  double* to[8];
  for (int l = 0; l < 8; ++l) to[l] = (marked >> l & 1u) != 0 ? g.row[l] : nowhere;
  transpose<8>(first, row);
  for (int l = 0; l < 8; ++l) store(to[l], row[l]);
  transpose<8>(second, row);
  for (int l = 0; l < 8; ++l) store(to[l] + 8, row[l]);
  for (int l = 0; l < 8; ++l) to[l][16] = w.y[l], to[l][17] = w.z[l];
}

}  // namespace erbs::ERBS_TARGET
