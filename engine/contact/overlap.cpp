#include "engine/contact/overlap.h"

#include <algorithm>
#include <cmath>

namespace erbs {
namespace {

SmallPose small_pose(const PairPose& pose) {
  SmallPose out;
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) out.turn[3 * i + k] = pose.turn(i, k);
    out.shift[i] = pose.shift[i];
  }
  return out;
}

Vec3 vec(const double* x) { return {x[0], x[1], x[2]}; }

// For bodies without overlap: finds a separating feature and returns the distance.
double find_distance(const ContactShape& a, const ContactShape& b, const PairPose& pose, int& separating) {
  if (separating < 0) separating = separating_face_of_other(a, b, pose);
  if (separating < 0) separating = separating_edges(a, b, pose);
  return distance(a, b, pose, separating);
}

}  // namespace

Patch find_overlap(const ContactShape& a, const ContactShape& b, const PairPose& pose, int& separating, OverlapRoom& room, Corners* known) {
  room.fast = false;
  room.apart = distance(a, b, pose, separating);
  if (room.apart >= 0) return {};
  room.fast = a.is_small && b.is_small && !room.only_general;
  if (room.fast) {
    const ClipKernels& kernels = clip_kernels();
    Triangles& t = room.triangles;
    const ClipJob job{&a.small, &b.small, small_pose(pose), &t, known};
    kernels.clip_all(&job, 1);
    separating = t.separating;
    if (!t.overflow) {
      if (t.count == 0) {
        room.apart = find_distance(a, b, pose, separating);
        return {};
      }
      OverlapSums sums;
      kernels.sum(t, sums);
      Patch out;
      out.total = sums.total;
      out.area = sums.area;
      out.force = vec(sums.force);
      out.moment = vec(sums.moment);
      out.deepest = t.deepest;
      finish_patch(vec(sums.pressure), vec(sums.centroid), symmetric(sums.second), out);
      return out;
    }
    room.fast = false;
  }
  if (!find_pieces(a, b, pose, separating, room.pieces)) {
    room.apart = find_distance(a, b, pose, separating);
    return {};
  }
  return elastic_patch(room.pieces);
}

void closing_speeds(OverlapRoom& room, const Vec3& linear, const Vec3& angular, Patch& patch) {
  if (!room.fast) return closing_speeds(room.pieces, linear, angular, patch);
  const Vec3 turning = angular.cross(patch.normal);
  patch.closing = clip_kernels().approach(room.triangles, -patch.normal.dot(linear), turning.data());
}

void damping_wrench(const OverlapRoom& room, const Vec3& normal, double chi, double limit, Vec3& force, Vec3& moment) {
  if (!room.fast) return damping_wrench(room.pieces, normal, chi, limit, force, moment);
  double total = 0, first[3];
  clip_kernels().damp(room.triangles, normal.data(), chi, limit, total, first);
  force = total * normal;
  moment = vec(first).cross(normal);
}

double overlap_energy(const ContactShape& a, const ContactShape& b, const PairPose& pose, OverlapRoom& room) {
  return room.fast ? energy_integral(a, b, pose, room.triangles) : energy_integral(a, b, pose, room.pieces);
}

}  // namespace erbs
