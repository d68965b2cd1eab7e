#include "engine/contact/overlap/overlap.h"

#include <algorithm>
#include <cmath>

namespace erbs {
namespace {

SmallPose small_pose(const PairPose& pose) {
  SmallPose out;
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) out.rotation[3 * i + k] = pose.rotation(i, k);
    out.shift[i] = pose.shift[i];
  }
  return out;
}

Vec3 vec(const double* x) { return {x[0], x[1], x[2]}; }

// For bodies without overlap: finds a separating feature and returns the distance.
double find_distance(const ContactShape& a, const ContactShape& b, const PairPose& pose, int& separating_axis) {
  if (separating_axis < 0) separating_axis = separating_face_of_other(a, b, pose);
  if (separating_axis < 0) separating_axis = separating_edges(a, b, pose);
  return distance(a, b, pose, separating_axis);
}

}  // namespace

Patch find_overlap(const ContactShape& a, const ContactShape& b, const PairPose& pose, int& separating_axis, OverlapRoom& room,
                   Corners* known) {
  room.fast = false;
  room.apart = distance(a, b, pose, separating_axis);
  if (room.apart >= 0) return {};
  room.fast = a.is_small && b.is_small && !room.only_general;
  if (room.fast) {
    const ClipKernels& kernels = clip_kernels();
    Triangles& t = room.triangles;
    const ClipTask task{&a.small, &b.small, small_pose(pose), &t, known};
    kernels.clip_all(&task, 1);
    separating_axis = t.separating_axis;
    if (!t.overflow) {
      if (t.count == 0) {
        room.apart = find_distance(a, b, pose, separating_axis);
        return {};
      }
      OverlapSums sums;
      kernels.sum(t, sums);
      Patch out;
      out.total = sums.total;
      out.area = sums.area;
      out.force = vec(sums.force);
      out.moment = vec(sums.moment);
      out.max_depth = t.max_depth;
      finish_patch(vec(sums.pressure), vec(sums.centroid), symmetric(sums.second), out);
      return out;
    }
    room.fast = false;
  }
  if (!find_fragments(a, b, pose, separating_axis, room.fragments)) {
    room.apart = find_distance(a, b, pose, separating_axis);
    return {};
  }
  return elastic_patch(room.fragments);
}

void closing_speeds(OverlapRoom& room, const Vec3& linear, const Vec3& angular, Patch& patch) {
  if (!room.fast) return closing_speeds(room.fragments, linear, angular, patch);
  const Vec3 angular_part = angular.cross(patch.normal);
  patch.closing_speed = clip_kernels().closing_speeds(room.triangles, -patch.normal.dot(linear), angular_part.data());
}

double damping(const OverlapRoom& room, const Vec3& normal, double chi, double limit, Vec3& first) {
  if (!room.fast) return damping(room.fragments, normal, chi, limit, first);
  double total = 0;
  clip_kernels().damp(room.triangles, normal.data(), chi, limit, total, first.data());
  return total;
}

double overlap_energy(const ContactShape& a, const ContactShape& b, const PairPose& pose, OverlapRoom& room) {
  return room.fast ? energy_integral(a, b, pose, room.triangles) : energy_integral(a, b, pose, room.fragments);
}

}  // namespace erbs
