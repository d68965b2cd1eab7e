// Intact joints in one pass: displacements of blocks to wrenches, with nothing stored in between.
//
// These are the formulas of kinematics.h in world axes. All vectors are rotated back by m, the mean rotation of the two blocks since the
// reference poses. With half rotations h = th/2, c = h x A (the first-order half rotation of an arm), e = c_b - c_a, s = c_a + c_b,
// G = D_ref + du and d = h_b - h_a, to second order:
//   D = G + 2e - m x (G + e) + d x s,   rho/2 = rho_ref/2 + d - h_a x h_b,   m = h_a + h_b.
// The resultants ks D + (kn - ks) n n.D and B rho are rotated forward by m. They act at A_a + s + G/2 and A_b + s - G/2, the same point of
// space, so that momentum is conserved to round-off. Stiffnesses are stored with reversed sign: they give the resultants on b.
#pragma once
#include "engine/joints/gather.h"
#include "engine/joints/kernels.h"
#include "engine/simd/transpose.h"
#include "engine/simd/vec3.h"

namespace erbs::ERBS_TARGET {

// Bound of yielding in world axes: the opening, slip and closing at the centre, each with the whole relative rotation at the farthest
// corner. `n`: opening at the centre (m).
ERBS_INLINE Pack bound_by_diameter(const IntactConstants& L, Pack3 gap, Pack3 rotation, Pack n) {
  const Pack swing = load(L.diameter) * sqrt(dot(rotation, rotation));
  return yield_bound(limits_of(L), n + swing, swing - n, dot(gap, gap) - n * n, swing);
}

// The closer bound, `face_bound()` of laws/yield.h, with a margin for the error of joints since their reference poses.
ERBS_INLINE Mask corners_may_yield(const JointPack& B, double carried, Pack3 gap, Pack3 rotation, Pack n, Pack3 apart) {
  const auto about = [&](int axis) { return 2 * abs(dot(load3(B.frame + 3 * axis), rotation)); };
  const Pack bend = about(0) * load(B.half_t) + about(1) * load(B.half_s), swing = about(2) * load(B.radius);
  const Pack slip = dot(gap, gap) - n * n;
  const Pack error = carried * (abs(apart.x) + abs(apart.y) + abs(apart.z)) + 1e-6 * (abs(n) + bend + swing + sqrt(max(slip, 0)));
  return yield_bound(limits_of(B), n + bend + error, bend - n + error, slip, swing + error) > 0;
}

// Displacements and half rotations of blocks a, displacements and rotations of blocks b, to the wrenches: `off_a` is subtracted from a,
// `on_b` acts on b. Returns the lanes whose joint may yield.
template <bool energy, bool at_corners>
ERBS_INLINE Mask intact_forces(const IntactPack& B, const JointPack* corner_pack, double carried, const Pack a[6], const Pack b[6],
                               Pack off_a[6], Pack on_b[6], Pack& stored) {
  const Pack3 ha{a[3], a[4], a[5]}, hb{0.5 * b[3], 0.5 * b[4], 0.5 * b[5]}, d = hb - ha, m = ha + hb;
  const Pack3 arm_a = load3(B.arm_a), arm_b = load3(B.arm_b), ca = cross(ha, arm_a), cb = cross(hb, arm_b), e = cb - ca, s = ca + cb;
  const Pack3 G = load3(B.gap) + Pack3{b[0] - a[0], b[1] - a[1], b[2] - a[2]}, w = G + e;
  const Pack3 gap = ((w + e) - cross(m, w)) + cross(d, s);
  const Pack3 rotation = (load3(B.rotation) + d) - cross(ha, hb);
  // One stiffness in all directions of the faces, another across them.
  const IntactConstants& L = *B.law;
  const Pack3 normal = load3(B.normal);
  const Pack across = dot(normal, gap), shear = load(L.shear), more = load(L.across) * across;
  Mask yields = bound_by_diameter(L, gap, rotation, across) > 0;
  if (at_corners && corner_pack != nullptr && any(yields))
    yields &= corners_may_yield(*corner_pack, carried, gap, rotation, across, arm_a - arm_b);
  const Pack3 f = shear * gap + more * normal;
  const Pack3 n = load6(B.bend) * rotation;
  if (energy) stored -= 0.5 * dot(f, gap) + dot(n, rotation);
  const Pack3 force = f + cross(m, f), moment = n + cross(m, n), half = 0.5 * G;
  const Pack3 about_a = cross((arm_a + s) + half, force) + moment, about_b = cross((arm_b + s) - half, force) + moment;
  off_a[0] = on_b[0] = force.x, off_a[1] = on_b[1] = force.y, off_a[2] = on_b[2] = force.z;
  off_a[3] = about_a.x, off_a[4] = about_a.y, off_a[5] = about_a.z;
  on_b[3] = about_b.x, on_b[4] = about_b.y, on_b[5] = about_b.z;
  return yields;
}

// Eight blocks and the joints they own: displacements of the owners are in their lanes, forces on them stay in registers.
template <bool energy, bool at_corners>
ERBS_INLINE int intact_group(IntactPack* pack, const CornerCheck& corner_check, int first, int last, const VectorPack<6>& own,
                             const VectorPack<6>* increment, VectorPack<6>& owner_sum, VectorPack<6>* neighbour_force, double* stored,
                             int* may_yield) {
  Pack a[6], sum[6] = {};
  for (int i = 0; i < 6; ++i) a[i] = i < 3 ? load(own.x[i]) : 0.5 * load(own.x[i]);
  int count = 0;
  for (int k = first; k < last; ++k) {
    const IntactPack& B = pack[k];
    if (corner_check.ahead > 0) prefetch(&B + corner_check.ahead);
    if (B.used <= 0) {
      if (B.used == 0) neighbour_force[k] = {}, pack[k].used = -1;
      continue;
    }
    Pack b[6], off_a[6], on_b[6], energies{};
    gather(increment, B.other, b);
    const JointPack* corner_pack = at_corners ? corner_check.pack[k] : nullptr;
    const Mask yields = intact_forces<energy, at_corners>(B, corner_pack, corner_check.carried, a, b, off_a, on_b, energies);
    for (int i = 0; i < 6; ++i) store(neighbour_force[k].x[i], on_b[i]), sum[i] -= off_a[i];
    if (energy) add_to(stored, energies);
    may_yield[count] = k;
    count += any(yields);
  }
  for (int i = 0; i < 6; ++i) store(owner_sum.x[i], sum[i]);
  return count;
}

template <bool energy, bool at_corners>
static int intact_pass(IntactPack* pack, const CornerCheck& corner_check, const int* first_pack, int first, int last,
                       const VectorPack<6>* increment, VectorPack<6>* owner_sum, VectorPack<6>* neighbour_force, double* stored,
                       int* may_yield) {
  int count = 0;
  for (int g = first; g < last; ++g)
    count += intact_group<energy, at_corners>(pack, corner_check, first_pack[g], first_pack[g + 1], increment[g], increment, owner_sum[g],
                                              neighbour_force, stored, may_yield + count);
  return count;
}

static int intact(IntactPack* pack, const CornerCheck& corner_check, const int* first_pack, int first, int last,
                  const VectorPack<6>* increment, VectorPack<6>* owner_sum, VectorPack<6>* neighbour_force, double* stored,
                  int* may_yield) {
  const auto pass = corner_check.pack == nullptr ? (stored != nullptr ? intact_pass<true, false> : intact_pass<false, false>)
                                                 : (stored != nullptr ? intact_pass<true, true> : intact_pass<false, true>);
  return pass(pack, corner_check, first_pack, first, last, increment, owner_sum, neighbour_force, stored, may_yield);
}

static int intact_ends(const IntactPack* pack, const IntactEnds* ends, int first, int last, const double* rows, double* wrench_rows,
                       int* may_yield) {
  int count = 0;
  for (int k = first; k < last; ++k) {
    const IntactPack& B = pack[k];
    if (B.used == 0) continue;
    Pack a[8], b[8], off_a[8], on_b[8], energies;
    rows_to_pack(rows, ends[k].a, a);
    for (int i = 3; i < 6; ++i) a[i] *= 0.5;
    rows_to_pack(rows, ends[k].b, b);
    const Mask yields = intact_forces<false, false>(B, nullptr, 0, a, b, off_a, on_b, energies);
    for (int i = 0; i < 6; ++i) off_a[i] = -off_a[i];
    off_a[6] = off_a[4], off_a[7] = off_a[5], on_b[6] = on_b[4], on_b[7] = on_b[5];
    pack_to_rows(off_a, wrench_rows, ends[k].wrench_row_a);
    pack_to_rows(on_b, wrench_rows, ends[k].wrench_row_b);
    may_yield[count] = k;
    count += any(yields);
  }
  return count;
}

}  // namespace erbs::ERBS_TARGET
