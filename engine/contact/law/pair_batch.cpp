#include "engine/contact/law/pair_batch.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "engine/contact/law/frame.h"
#include "engine/contact/law/point_friction.h"

namespace erbs {
namespace {

constexpr int lift_row = 53;  // row of `ContactPair::lift`
static_assert(offsetof(ContactPair, tangential) == 32 * sizeof(double) && offsetof(ContactPair, lift) == lift_row * sizeof(double));
static_assert(sizeof(ContactPair) >= 8 * pair_rows * sizeof(double));
static_assert(sizeof(ContactBlock) == 8 * block_rows * sizeof(double));
static_assert(offsetof(PairResult, elastic) == 8 * result_rows * sizeof(double));

Vec3 vec(const PackArray* x, int l) { return {x[0][l], x[1][l], x[2][l]}; }

// Pose for the overlap, lift included.
PairPose pose_of(const PairPack& w, int l) {
  PairPose pose;
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) pose.rotation(i, k) = w.rotation[3 * i + k][l];
  pose.shift = vec(w.shift, l) + vec(w.p + lift_row, l);
  return pose;
}

void fill(const PairTask* task, int count, PairPack& w) {
  for (int l = 0; l < 8; ++l) {
    const PairTask& j = task[l < count ? l : 0];
    const bool swapped = j.bodies.swapped;
    set_lane(w, l, *j.pair, swapped ? *j.b : *j.a, swapped ? *j.a : *j.b, j.contact_count);
  }
}

// Overlaps of the pairs. Returns as bits the pairs without an overlap or with too many pieces.
unsigned overlaps(const PairTask* task, int count, PairPack& w, Triangles* triangles) {
  const ClipKernels& kernels = clip_kernels();
  ClipTask clips[8];
  for (int l = 0; l < count; ++l) {
    const PairBodies& bodies = task[l].bodies;
    clips[l].a = &bodies.reference->small, clips[l].b = &bodies.other->small;
    clips[l].out = &triangles[l], clips[l].known = &task[l].pair->corners;
    for (int i = 0; i < 9; ++i) clips[l].pose.rotation[i] = w.rotation[i][l];
    for (int i = 0; i < 3; ++i) clips[l].pose.shift[i] = w.shift[i][l] + w.p[lift_row + i][l];
  }
  kernels.clip_all(clips, count);
  unsigned left_out = 0;
  for (int l = 0; l < 8; ++l) {
    Triangles& t = triangles[l];
    if (l < count && !t.overflow && t.count > 0) {
      kernels.sum(t, w.sums[l]);
      w.max_depth[l] = t.max_depth;
    } else {
      w.sums[l] = {};
      w.max_depth[l] = w.closing_speed[l] = 0;
      left_out |= static_cast<unsigned>(l < count) << l;
    }
  }
  return left_out;
}

// From the poses of eight pairs to the trial forces of their friction springs. Returns as bits the pairs left out.
unsigned up_to_springs(const PairTask* task, int count, const PairSettings& set, PairPack& w, Triangles* triangles) {
  const ClipKernels& clips = clip_kernels();
  const PairKernels& kernels = pair_kernels();
  fill(task, count, w);
  kernels.gather_pairs(w);
  unsigned left_out = overlaps(task, count, w, triangles);
  kernels.patch(w, set);
  for (int l = 0; l < count; ++l) {
    if (!(w.total[l] > 0)) left_out |= 1u << l;
    if ((left_out >> l & 1u) != 0) continue;
    const double angular_part[3] = {w.angular_part[0][l], w.angular_part[1][l], w.angular_part[2][l]};
    w.closing_speed[l] = clips.closing_speeds(triangles[l], w.along[l], angular_part);
  }
  kernels.dashpot(w, set);
  for (int l = 0; l < 8; ++l) {
    double total = 0, first[3] = {};
    const double normal[3] = {w.normal[0][l], w.normal[1][l], w.normal[2][l]};
    if (l < count && (left_out >> l & 1u) == 0) clips.damp(triangles[l], normal, w.chi[l], w.limit[l], total, first);
    w.damping[0][l] = total;
    for (int i = 0; i < 3; ++i) w.damping[1 + i][l] = first[i];
  }
  kernels.lagging(w);
  kernels.springs(w, set);
  return left_out;
}

void write_back(const PairTask* task, int count, unsigned left_out, const PairPack& w) {
  alignas(64) double nowhere[8 * pair_rows];
  double *pair[8], *result[8];
  for (int l = 0; l < 8; ++l) {
    const bool is_in = l < count && (left_out >> l & 1u) == 0;
    pair[l] = is_in ? &task[l].pair->law.kn : nowhere;
    result[l] = is_in ? task[l].result->wrench.force.data() : nowhere;
  }
  pair_kernels().write(w.p, pair_rows, pair);
  pair_kernels().write(w.result, result_rows, result);
  for (int l = 0; l < count; ++l) {
    if ((left_out >> l & 1u) != 0) continue;
    task[l].pair->touching = 1;
    task[l].pair->lag = w.lag[l], task[l].pair->blow_age = w.blow_age[l];
    task[l].result->touching = true;
  }
}

}  // namespace

PairBodies bodies_of(const ContactPair& p, const ContactShapes& shapes) {
  const ContactShape &a = shape_of(shapes, p.a, p.part_a), &b = shape_of(shapes, p.b, p.part_b);
  return p.b_is_reference ? PairBodies{&b, &a, true} : PairBodies{&a, &b, false};
}

bool fits_pack(const ContactPair& pair, const PairBodies& bodies) {
  if (!pair.touching || pair.separating_axis >= 0) return false;
  return bodies.reference->small.faces > 0 && bodies.other->small.faces > 0;  // `small` is read next, by clipping
}

unsigned pair_forces(const PairTask* task, int count, const ContactSettings& settings, const PairInterval& interval, bool want_energy,
                     PairBatch& batch) {
  const PairSettings set = pair_settings(settings, interval);
  unsigned left_out[2] = {};
  const int of[2] = {std::min(count, 8), std::max(count - 8, 0)};
  for (int k = 0; k < 2; ++k) {
    if (of[k] > 0) left_out[k] = up_to_springs(task + 8 * k, of[k], set, batch.packs[k], batch.triangles);
    else std::fill_n(batch.packs[k].total, 8, 0.0);  // no patches
    for (int l = 0; l < of[k] && want_energy; ++l) {
      if ((left_out[k] >> l & 1u) != 0) continue;
      const PairTask& one = task[8 * k + l];
      const PairBodies& bodies = one.bodies;
      one.result->elastic =
          one.pair->law.kn * energy_integral(*bodies.reference, *bodies.other, pose_of(batch.packs[k], l), batch.triangles[l]);
    }
  }
  pair_kernels().return_map(batch.packs[0], batch.packs[1]);
  for (int k = 0; k < 2; ++k) {
    PairPack& w = batch.packs[k];
    const PairTask* tasks = task + 8 * k;
    const auto stays = [&](int l) { return (left_out[k] >> l & 1u) == 0; };
    if (of[k] == 0) continue;
    for (int l = 0; l < of[k]; ++l)
      if (stays(l) && !(w.holds[l] > 0)) return_point(w, l);
    pair_kernels().finish(w, set);
    write_back(tasks, of[k], left_out[k], w);
  }
  return left_out[0] | left_out[1] << 8;
}

}  // namespace erbs
