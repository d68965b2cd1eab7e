// The kernels of contact (clip.h, pair_lanes.h), compiled once for each instruction set.
#include "engine/contact/broad/box_kernel.h"
#include "engine/contact/law/pair_law.h"
#include "engine/contact/law/track_kernel.h"
#include "engine/contact/overlap/clip.h"
#include "engine/contact/overlap/fragments.h"
#include "engine/contact/overlap/integrals.h"
#include "engine/contact/overlap/known_corners.h"

namespace erbs::ERBS_TARGET {
namespace {

void clip_all(const ClipTask* task, int count) {
  ClipFragments all;
  Pack vertex[8][3];
  int cut[8], cuts = 0;
  for (int l = 0; l < count; ++l) {
    place_bodies(task[l], vertex[l]);
    if (task[l].known != nullptr && task[l].known->count > 0 && by_corners(task[l], vertex[l], *task[l].known)) continue;
    list_faces(task[l], vertex[l], cuts, all);
    cut[cuts++] = l;
  }
  if (cuts == 0) return;
  cut_all(all);
  find_nearest(all);
  split_by_nearest_face(all);
  append_all(all, cuts);
  for (int k = 0; k < cuts; ++k) {
    const ClipTask& one = task[cut[k]];
    if (one.known != nullptr) store_corners(one, vertex[cut[k]], all, k, *one.known);
  }
}

void clip(const SmallShape& a, const SmallShape& b, const SmallPose& pose, Triangles& out) {
  const ClipTask task{&a, &b, pose, &out};
  clip_all(&task, 1);
}

}  // namespace

const ClipKernels clip_kernels{ERBS_TARGET_NAME, clip, clip_all, sum, closing_speeds, damp};
const PairKernels pair_kernels{track,         gather_pairs<Pack>, patch<Pack>,      dashpot<Pack>,
                               lagging<Pack>, springs<Pack>,      return_map<Pack>, finish<Pack>,
                               write,         close_balls,        close_boxes};

}  // namespace erbs::ERBS_TARGET
