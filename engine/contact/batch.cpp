#include "engine/contact/batch.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "engine/contact/friction.h"
#include "engine/contact/view.h"

namespace erbs {
namespace {

constexpr int lift_row = 50;  // row of `Pair::lift`
static_assert(offsetof(Pair, tangential) == 30 * sizeof(double) && offsetof(Pair, lift) == lift_row * sizeof(double));
static_assert(sizeof(Pair) >= 8 * pair_rows * sizeof(double));
static_assert(sizeof(ContactBlock) == 8 * block_rows * sizeof(double));
static_assert(offsetof(PairResult, elastic) == 8 * result_rows * sizeof(double));

Vec3 vec(const Lane* x, int l) { return {x[0][l], x[1][l], x[2][l]}; }

// Pose for the overlap, lift included.
PairPose pose_of(const PairLanes& w, int l) {
  PairPose pose;
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) pose.turn(i, k) = w.turn[3 * i + k][l];
  pose.shift = vec(w.shift, l) + vec(w.p + lift_row, l);
  return pose;
}

void fill(const PairJob* job, int count, PairLanes& w) {
  for (int l = 0; l < 8; ++l) {
    const PairJob& j = job[l < count ? l : 0];
    const bool swapped = j.bodies.swapped;
    w.pair[l] = &j.pair->law.kn;
    w.reference[l] = (swapped ? j.b : j.a)->u.data();
    w.other[l] = (swapped ? j.a : j.b)->u.data();
    w.swapped[l] = swapped;
    w.crowd[l] = j.crowd;
  }
}

// Overlaps of the pairs. Returns as bits the pairs without an overlap or with too many pieces.
unsigned overlaps(const PairJob* job, int count, PairLanes& w, Triangles* triangles) {
  const ClipKernels& kernels = clip_kernels();
  ClipJob clips[8];
  for (int l = 0; l < count; ++l) {
    const PairBodies& bodies = job[l].bodies;
    clips[l].a = &bodies.reference->small, clips[l].b = &bodies.other->small;
    clips[l].out = &triangles[l], clips[l].known = &job[l].pair->corners;
    for (int i = 0; i < 9; ++i) clips[l].pose.turn[i] = w.turn[i][l];
    for (int i = 0; i < 3; ++i) clips[l].pose.shift[i] = w.shift[i][l] + w.p[lift_row + i][l];
  }
  kernels.clip_all(clips, count);
  unsigned left_out = 0;
  for (int l = 0; l < 8; ++l) {
    Triangles& t = triangles[l];
    if (l < count && !t.overflow && t.count > 0) {
      kernels.sum(t, w.sums[l]);
      w.deepest[l] = t.deepest;
    } else {
      w.sums[l] = {};
      w.deepest[l] = w.closing[l] = 0;
      left_out |= static_cast<unsigned>(l < count) << l;
    }
  }
  return left_out;
}

// Return map of one pair, for a patch without size or pressure.
void bear(PairLanes& w, int l) {
  Patch patch;
  patch.area = w.area[l];
  patch.centroid = vec(w.centroid, l);
  const double second[6] = {w.second[0][l], w.second[1][l], w.second[2][l], w.second[3][l], w.second[4][l], w.second[5][l]};
  patch.second = symmetric(second);
  const double gyration = w.p[28][l];
  const Bearing bearing{w.most[l], w.radius[l], 0, gyration * gyration, vec(w.lever, l)};
  const Borne held = borne(bearing, patch, {vec(w.springs, l), w.torsion[l]}, {vec(w.dashpots, l), w.dashpot_torsion[l]});
  for (int i = 0; i < 3; ++i) w.springs[i][l] = held.springs.force[i];
  w.torsion[l] = held.springs.torsion;
  w.share[l] = held.share;
  w.slips[l] = held.slips;
}

// From the poses of eight pairs to the trial forces of their friction springs. Returns as bits the pairs left out.
unsigned up_to_springs(const PairJob* job, int count, const PairSettings& set, PairLanes& w, Triangles* triangles) {
  const ClipKernels& clips = clip_kernels();
  const PairKernels& kernels = pair_kernels();
  fill(job, count, w);
  kernels.place(w);
  unsigned left_out = overlaps(job, count, w, triangles);
  kernels.patch(w, set);
  for (int l = 0; l < count; ++l) {
    if (!(w.total[l] > 0)) left_out |= 1u << l;
    if ((left_out >> l & 1u) != 0) continue;
    const double turning[3] = {w.turning[0][l], w.turning[1][l], w.turning[2][l]};
    w.closing[l] = clips.approach(triangles[l], w.along[l], turning);
  }
  kernels.dashpot(w, set);
  for (int l = 0; l < 8; ++l) {
    double total = 0, first[3] = {};
    const double normal[3] = {w.normal[0][l], w.normal[1][l], w.normal[2][l]};
    if (l < count && (left_out >> l & 1u) == 0) clips.damp(triangles[l], normal, w.chi[l], w.limit[l], total, first);
    w.damping[0][l] = total;
    for (int i = 0; i < 3; ++i) w.damping[1 + i][l] = first[i];
  }
  kernels.springs(w, set);
  return left_out;
}

void write_back(const PairJob* job, int count, unsigned left_out, const PairLanes& w) {
  alignas(64) double nowhere[8 * pair_rows];
  double *pair[8], *result[8];
  for (int l = 0; l < 8; ++l) {
    const bool is_in = l < count && (left_out >> l & 1u) == 0;
    pair[l] = is_in ? &job[l].pair->law.kn : nowhere;
    result[l] = is_in ? job[l].result->wrench.force.data() : nowhere;
  }
  pair_kernels().write(w.p, pair_rows, pair);
  pair_kernels().write(w.result, result_rows, result);
  for (int l = 0; l < count; ++l) {
    if ((left_out >> l & 1u) != 0) continue;
    job[l].pair->touching = 1;
    job[l].result->touching = true;
  }
}

}  // namespace

PairBodies bodies_of(const Pair& p, const ContactShapes& shapes) {
  const ContactShape &a = shape_of(shapes, p.a, p.part_a), &b = shape_of(shapes, p.b, p.part_b);
  return p.b_is_reference ? PairBodies{&b, &a, true} : PairBodies{&a, &b, false};
}

bool goes_in_lanes(const Pair& pair, const PairBodies& bodies) {
  if (!pair.touching || pair.separating >= 0) return false;
  return bodies.reference->small.faces > 0 && bodies.other->small.faces > 0;  // `small` is read next, by clipping
}

unsigned pair_forces(const PairJob* job, int count, const ContactSettings& settings, double dt, bool want_energy, Batch& batch) {
  const PairSettings set{dt,
                         settings.memory,
                         settings.reference_speed,
                         settings.settling,
                         settings.settling_tangential,
                         surely_within,
                         settings.interlock.slow,
                         settings.interlock.rate,
                         slender,
                         flat_face};
  unsigned left_out[2] = {};
  const int of[2] = {std::min(count, 8), std::max(count - 8, 0)};
  for (int k = 0; k < 2; ++k) {
    if (of[k] > 0) left_out[k] = up_to_springs(job + 8 * k, of[k], set, batch.lanes[k], batch.triangles);
    else std::fill_n(batch.lanes[k].total, 8, 0.0);  // no patches
    for (int l = 0; l < of[k] && want_energy; ++l) {
      if ((left_out[k] >> l & 1u) != 0) continue;
      const PairJob& one = job[8 * k + l];
      const PairBodies& bodies = one.bodies;
      one.result->elastic =
          one.pair->law.kn * energy_integral(*bodies.reference, *bodies.other, pose_of(batch.lanes[k], l), batch.triangles[l]);
    }
  }
  pair_kernels().bear(batch.lanes[0], batch.lanes[1]);
  for (int k = 0; k < 2; ++k) {
    PairLanes& w = batch.lanes[k];
    const PairJob* jobs = job + 8 * k;
    const auto stays = [&](int l) { return (left_out[k] >> l & 1u) == 0; };
    if (of[k] == 0) continue;
    for (int l = 0; l < of[k]; ++l)
      if (stays(l) && !(w.holds[l] > 0)) bear(w, l);
    pair_kernels().finish(w, set);
    write_back(jobs, of[k], left_out[k], w);
  }
  return left_out[0] | left_out[1] << 8;
}

}  // namespace erbs
