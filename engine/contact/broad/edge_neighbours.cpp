#include "engine/contact/broad/edge_neighbours.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/base/units.h"

namespace erbs {
namespace {

constexpr double at_zero_gap = 1e-9;  // of the other body's bounding radius; smaller gaps and overlaps are round-off
constexpr double least_sine = 0.1;    // of the angle between two planes that form an edge

// Unit normals of the faces that separate the two; none if there is a gap.
std::vector<Vec3> planes_between(const PairFrame& s) {
  const double round_off = at_zero_gap * s.other->reach;
  std::vector<Vec3> between;
  for (const FaceGap& face : face_gaps(s)) {
    if (face.gap > round_off) return {};
    if (face.gap >= -round_off) between.push_back(face.n);
  }
  return between;
}

double extent(const ContactShape& body, const Vec3& n) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Vec3& x : body.vertex) low = std::min(low, n.dot(x)), high = std::max(high, n.dot(x));
  return high - low;
}

}  // namespace

std::vector<FaceGap> face_gaps(const PairFrame& s) {
  const int own = int(s.reference->normal.size()), all = own + int(s.other->normal.size());
  std::vector<FaceGap> out;
  for (int f = 0; f < all; ++f) {
    const Vec3 n = f < own ? s.reference->normal[std::size_t(f)] : Vec3(-(s.pose.rotation * s.other->normal[std::size_t(f - own)]));
    out.push_back({n, distance(*s.reference, *s.other, s.pose, f)});
  }
  return out;
}

double greatest_gap(const PairFrame& s) { return std::ranges::max(face_gaps(s), {}, &FaceGap::gap).gap; }

EdgeAtRest edge_at_rest(const ContactPair& pair, const PairFrame& s, double most) {
  EdgeAtRest edge;
  const std::vector<Vec3> between = planes_between(s);
  Vec3 along = Vec3::Zero(), towards = Vec3::Zero();
  for (std::size_t i = 0; i < between.size(); ++i)
    for (std::size_t k = 0; k < i; ++k) {
      const Vec3 across = between[i].cross(between[k]);
      if (across.norm() > along.norm() + 1e-9) along = across, towards = between[i] + between[k];
    }
  const double sine = along.norm(), inverse_mass = std::max(s.reference_block->inverse_mass, s.other_block->inverse_mass);
  if (!(sine > least_sine) || !(inverse_mass > 0)) return edge;
  along /= sine;
  edge.pose = s.pose;
  double nearest = std::numeric_limits<double>::infinity();
  for (const Vec3& vertex : s.other->vertex) {
    const Vec3 x = s.pose.rotation * vertex;
    if (towards.dot(x) < nearest) nearest = towards.dot(x), edge.at = x;
  }
  const double length = std::min(extent(*s.reference, along), extent(*s.other, s.pose.rotation.transpose() * along));
  // A pressure of at most kn m, on two sides of a strip of this length, m / sine wide.
  edge.movement = std::sqrt(most * standard_g / inverse_mass * sine / (2 * pair.law.kn * length));
  edge.movement -= at_zero_gap * s.other->reach;
  edge.lever = 2 * s.other->reach;
  edge.slowest =
      std::max({1.0, ((edge.at + s.pose.shift).norm() + edge.lever) / s.reference->reach, (edge.at.norm() + edge.lever) / s.other->reach});
  edge.touches = edge.movement > 0;
  return edge;
}

double idle_way(const EdgeAtRest& edge, const PairPose& now) {
  const Vec3 moved = (now.shift - edge.pose.shift) + (now.rotation * (edge.pose.rotation.transpose() * edge.at) - edge.at);
  const double chord = std::sqrt(0.5) * (now.rotation - edge.pose.rotation).norm();
  return (edge.movement - moved.norm() - edge.lever * chord) / edge.slowest;
}

}  // namespace erbs
