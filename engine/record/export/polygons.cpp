// Blocks and joints as polygons with fields, for the formats of ParaView.
#include "engine/record/export/export.h"

#include <algorithm>

namespace erbs {

std::vector<float> damage_of(const ExportedRun& run, const MotionFrame& frame) {
  std::vector<float> broken(run.scene.blocks.size()), area(broken.size());
  for (std::size_t j = 0; j < run.scene.joints.size(); ++j)
    for (int block : {run.scene.joints[j].a, run.scene.joints[j].b}) {
      broken[static_cast<std::size_t>(block)] += run.joint_area[j] * static_cast<float>(frame.damage[j]) / 255.0F;
      area[static_cast<std::size_t>(block)] += run.joint_area[j];
    }
  for (std::size_t b = 0; b < broken.size(); ++b) broken[b] = area[b] > 0 ? broken[b] / area[b] : 0;
  return broken;
}

std::vector<float> velocity_of(const ExportedRun& run, std::size_t at) {
  const std::size_t frames = run.frames.size();
  std::vector<float> velocity(3 * run.scene.blocks.size());
  if (frames < 2) return velocity;
  const std::size_t middle = std::clamp<std::size_t>(at, 1, std::max<std::size_t>(frames - 2, 1));
  const MotionFrame &before = run.frames[middle - 1], &frame = run.frames[middle], &after = run.frames[std::min(middle + 1, frames - 1)];
  const double first = frame.t - before.t, second = after.t - frame.t, whole = first + second, here = run.frames[at].t - frame.t;
  for (std::size_t b = 0; b < run.scene.blocks.size(); ++b)
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t k = 7 * b + i;
      const double rise = (double(frame.poses[k]) - double(before.poses[k])) / first;
      const double next = second > 0 ? (double(after.poses[k]) - double(frame.poses[k])) / second : rise;
      velocity[3 * b + i] = static_cast<float>((rise * second + next * first + 2 * here * (next - rise)) / whole);
    }
  return velocity;
}

Polygons block_polygons(const MotionScene& scene) {
  Polygons out;
  for (std::size_t b = 0; b < scene.blocks.size(); ++b)
    for (const int part : scene.blocks[b].parts) {
      const MotionShape& shape = scene.shapes[static_cast<std::size_t>(part)];
      for (const std::vector<int>& loop : shape.faces) {
        for (const int corner : loop) out.corners.push_back(static_cast<std::int64_t>(out.points) + corner);
        out.ends.push_back(static_cast<std::int64_t>(out.corners.size()));
        out.owner.push_back(static_cast<std::int32_t>(b));
      }
      out.points += shape.vertices.size() / 3;
    }
  return out;
}

std::vector<float> block_points(const MotionScene& scene, const MotionFrame& frame) {
  std::vector<float> points;
  for (std::size_t b = 0; b < scene.blocks.size(); ++b)
    for (const int part : scene.blocks[b].parts) {
      const std::vector<float>& v = scene.shapes[static_cast<std::size_t>(part)].vertices;
      for (std::size_t i = 0; i + 2 < v.size(); i += 3) {
        const Eigen::Vector3f p = placed(frame, static_cast<int>(b), Eigen::Map<const Eigen::Vector3f>(&v[i]));
        points.insert(points.end(), p.data(), p.data() + 3);
      }
    }
  return points;
}

Polygons joint_polygons(const MotionScene& scene) {
  Polygons out;
  for (std::size_t j = 0; j < scene.joints.size(); ++j) {
    const std::size_t corners = scene.joints[j].polygon.size();
    if (corners < 3) continue;
    for (std::size_t i = 0; i < corners; ++i) out.corners.push_back(static_cast<std::int64_t>(out.points++));
    out.ends.push_back(static_cast<std::int64_t>(out.corners.size()));
    out.owner.push_back(static_cast<std::int32_t>(j));
  }
  return out;
}

std::vector<float> joint_points(const MotionScene& scene, const MotionFrame& frame) {
  std::vector<float> points;
  for (const MotionJoint& joint : scene.joints) {
    if (joint.polygon.size() < 3) continue;
    for (const Vec3& corner : joint.polygon) {
      const Eigen::Vector3f p = placed(frame, joint.a, corner.cast<float>());
      points.insert(points.end(), p.data(), p.data() + 3);
    }
  }
  return points;
}

std::vector<JointField> joint_fields(const MotionFrame& frame) {
  std::vector<float> damage;
  for (const std::uint8_t d : frame.damage) damage.push_back(static_cast<float>(d) / 255.0F);
  std::vector<JointField> fields{{"damage", 1, damage}, {"opening_m", 1, frame.opening}};
  if (!frame.normal_stress.empty()) fields.push_back({"normal_stress_Pa", 1, frame.normal_stress});
  if (!frame.shear_stress.empty()) fields.push_back({"shear_stress_Pa", 1, frame.shear_stress});
  if (!frame.force.empty()) fields.push_back({"force_N", 3, frame.force});
  return fields;
}

}  // namespace erbs
