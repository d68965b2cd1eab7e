// Overlap of two bodies: found, summed and damped by the fast path if both are small (`clip.h`), else by the general path (`general.h`).
// Both give the same to round-off.
#pragma once
#include "engine/contact/overlap/clip.h"
#include "engine/contact/overlap/general.h"

namespace erbs {

// Workspace, used again from call to call; one per thread.
struct OverlapRoom {
  Triangles triangles;
  Fragments fragments;
  bool fast = false;          // the last overlap is in `triangles`, not in `fragments`
  bool only_general = false;  // for tests: the general path for all bodies
  double apart = 0;           // m, lower bound of the distance in the last query; negative if unknown
};

// The elastic patch; its total is 0 if the bodies do not overlap. `separating_axis` caches the separating feature (`general.h`), `known`
// the corners of the overlap (`clip.h`).
Patch find_overlap(const ContactShape& a, const ContactShape& b, const PairPose& pose, int& separating_axis, OverlapRoom& room,
                   Corners* known = nullptr);

// As in `general.h`, for the last overlap.
void closing_speeds(OverlapRoom& room, const Vec3& linear, const Vec3& angular, Patch& patch);
double damping(const OverlapRoom& room, const Vec3& normal, double chi, double limit, Vec3& first);
// E / kn (m4) of the last overlap; the same bodies.
double overlap_energy(const ContactShape& a, const ContactShape& b, const PairPose& pose, OverlapRoom& room);

}  // namespace erbs
