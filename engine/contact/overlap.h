// The overlap of two bodies: found, summed and damped the fast way where both are small (clip.h), the general way otherwise
// (narrow.h). Both give the same to round-off.
#pragma once
#include "engine/contact/clip.h"
#include "engine/contact/narrow.h"

namespace erbs {

// Room that is used again from call to call, one per thread.
struct OverlapRoom {
  Triangles triangles;
  Pieces pieces;
  bool fast = false;          // which of the two holds the overlap found last
  bool only_general = false;  // for tests: the general way for all
  double apart = 0;           // m, distance of the bodies asked for last, at least; below zero where not known
};

// The elastic patch; its total is 0 where the bodies do not overlap. `separating` caches what keeps them apart (narrow.h), `known`
// its corners (clip.h).
Patch find_overlap(const ContactShape& a, const ContactShape& b, const PairPose& pose, int& separating, OverlapRoom& room,
                   Corners* known = nullptr);

// As in narrow.h, of the overlap found last.
void closing_speeds(OverlapRoom& room, const Vec3& linear, const Vec3& angular, Patch& patch);
void damping_wrench(const OverlapRoom& room, const Vec3& normal, double chi, double limit, Vec3& force, Vec3& moment);
// E / kn (m4) of the same bodies.
double overlap_energy(const ContactShape& a, const ContactShape& b, const PairPose& pose, OverlapRoom& room);

}  // namespace erbs
