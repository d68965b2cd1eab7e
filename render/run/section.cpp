// Blocks and joints cut by a plane.
#include <algorithm>
#include <cmath>

#include "engine/base/error.h"
#include "engine/geometry/clip.h"
#include "render/run/excerpt.h"

namespace erbs::render {
namespace {

std::vector<Vec3> part_of(const std::vector<Vec3>& loop, const Vec3& n, double d) {
  std::vector<Vec3> part;
  cut_polygon(
      static_cast<int>(loop.size()), [&](int i) { return loop[static_cast<std::size_t>(i)]; },
      [&](int i) { return n.dot(loop[static_cast<std::size_t>(i)]) - d; }, [&](const Vec3& p, double) { part.push_back(p); });
  return part;
}

// The corner of `shape` within `weld` of p; a new one if there is none.
int corner_at(MotionShape& shape, const Vec3& p, double weld) {
  const int count = static_cast<int>(shape.vertices.size() / 3);
  for (int i = 0; i < count; ++i)
    if ((corner_of(shape, i) - p).norm() <= weld) return i;
  for (int k = 0; k < 3; ++k) shape.vertices.push_back(static_cast<float>(p[k]));
  return count;
}

// The cut face: corners in the plane, anticlockwise seen from the side that is cut away.
std::vector<int> cut_face(const MotionShape& shape, const Vec3& n, double d, double weld) {
  std::vector<int> face;
  Vec3 middle = Vec3::Zero();
  for (int i = 0; 3 * static_cast<std::size_t>(i) < shape.vertices.size(); ++i)
    if (std::abs(n.dot(corner_of(shape, i)) - d) <= weld) face.push_back(i), middle += corner_of(shape, i);
  middle /= static_cast<double>(std::max<std::size_t>(1, face.size()));
  const Vec3 u = n.unitOrthogonal(), v = u.cross(n);  // u, v, -n are right-handed
  const auto angle = [&](int i) { return std::atan2(v.dot(corner_of(shape, i) - middle), u.dot(corner_of(shape, i) - middle)); };
  std::sort(face.begin(), face.end(), [&](int i, int j) { return angle(i) < angle(j); });
  return face;
}

Eigen::AlignedBox3d extent(const MotionScene& scene, const std::vector<bool>& left_out) {
  Eigen::AlignedBox3d box;
  for (std::size_t b = 0; b < scene.blocks.size(); ++b) {
    if (left_out[b]) continue;
    for (int part : scene.blocks[b].parts)
      for (int i = 0; 3 * static_cast<std::size_t>(i) < scene.shapes[static_cast<std::size_t>(part)].vertices.size(); ++i)
        box.extend(scene.blocks[b].rest + corner_of(scene.shapes[static_cast<std::size_t>(part)], i));
  }
  return box;
}

}  // namespace

MotionShape cut_shape(const MotionShape& shape, const Vec3& n, double d) {
  Eigen::AlignedBox3d box;
  double least = HUGE_VAL, most = -HUGE_VAL;
  for (int i = 0; 3 * static_cast<std::size_t>(i) < shape.vertices.size(); ++i) {
    box.extend(corner_of(shape, i));
    least = std::min(least, n.dot(corner_of(shape, i)) - d), most = std::max(most, n.dot(corner_of(shape, i)) - d);
  }
  const double weld = 1e-5 * box.sizes().norm();  // corners are floats
  if (least >= -weld) return shape;
  if (most <= weld) return {};
  MotionShape part;
  for (const std::vector<int>& face : shape.faces) {
    std::vector<Vec3> loop;
    for (int i : face) loop.push_back(corner_of(shape, i));
    std::vector<int> kept;
    for (const Vec3& p : part_of(loop, n, d)) {
      const int i = corner_at(part, p, weld);
      if (std::find(kept.begin(), kept.end(), i) == kept.end()) kept.push_back(i);
    }
    if (kept.size() >= 3) part.faces.push_back(kept);
  }
  if (const std::vector<int> face = cut_face(part, n, d, 2 * weld); face.size() >= 3) part.faces.push_back(face);
  return part;
}

MotionScene cut_scene(const MotionScene& scene, const Section& section, const std::vector<bool>& uncut) {
  const Eigen::AlignedBox3d box = extent(scene, uncut);
  if (!(box.min()[section.axis] < section.at && section.at < box.max()[section.axis]))
    throw Error(fmt::format("--section {0}={1:g} does not meet what is drawn; choose {0} between {2:.4g} and {3:.4g} m",
                            "xyz"[section.axis], section.at, box.min()[section.axis], box.max()[section.axis]));
  const Vec3 n = section.keep * Vec3::Unit(section.axis);
  MotionScene cut = scene;
  for (std::size_t b = 0; b < cut.blocks.size(); ++b) {
    if (uncut[b]) continue;
    const double d = section.keep * section.at - n.dot(cut.blocks[b].rest);
    std::vector<int> parts;
    for (int part : cut.blocks[b].parts)
      if (MotionShape kept = cut_shape(cut.shapes[static_cast<std::size_t>(part)], n, d); !kept.faces.empty())
        parts.push_back(share_shape(cut, std::move(kept)));
    cut.blocks[b].parts = std::move(parts);
  }
  const auto gone = [&](int block) { return cut.blocks[static_cast<std::size_t>(block)].parts.empty(); };
  for (MotionJoint& joint : cut.joints) {
    const double d = section.keep * section.at - n.dot(cut.blocks[static_cast<std::size_t>(joint.a)].rest);
    double most = -HUGE_VAL;
    for (const Vec3& p : joint.polygon) most = std::max(most, n.dot(p) - d);
    const bool lost = gone(joint.a) || gone(joint.b) || most <= 1e-6;
    joint.polygon = lost ? std::vector<Vec3>() : part_of(joint.polygon, n, d);
  }
  return cut;
}

}  // namespace erbs::render
