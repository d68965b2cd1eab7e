#include "render/run/stage.h"

#include <algorithm>
#include <cmath>

namespace erbs::render {
namespace {

Eigen::AlignedBox3d box_of(const MotionScene& scene, const MotionBlock& block) {
  Eigen::AlignedBox3d box;
  for (int part : block.parts) {
    const std::vector<float>& v = scene.shapes[static_cast<std::size_t>(part)].vertices;
    for (std::size_t i = 0; i + 2 < v.size(); i += 3) box.extend(block.rest + Vec3(v[i], v[i + 1], v[i + 2]));
  }
  if (box.isEmpty()) box.extend(block.rest);
  return box;
}

// The ground: a fixed block with a level top that extends far beyond everything on it.
bool is_ground(const MotionBlock& block, const Eigen::AlignedBox3d& box, const MotionScene& scene, const Eigen::AlignedBox3d& rest) {
  if (!block.fixed || rest.isEmpty()) return false;
  for (int part : block.parts) {
    const std::vector<float>& v = scene.shapes[static_cast<std::size_t>(part)].vertices;
    int at_top = 0;
    for (std::size_t i = 2; i < v.size(); i += 3) at_top += block.rest.z() + v[i] > box.max().z() - 1e-6 * box.sizes().norm() ? 1 : 0;
    if (at_top < 3) return false;
  }
  const Vec3 own = box.sizes(), free = rest.sizes();
  const double base = std::max(free.x(), free.y());
  return own.x() > free.x() + 0.5 * base && own.y() > free.y() + 0.5 * base && box.max().z() < rest.center().z();
}

// Extent of most block centroids: along each axis, all but the outermost 2 % on each side.
Eigen::AlignedBox3d heap_of(const MotionFrame& frame, const std::vector<bool>& hidden) {
  Eigen::AlignedBox3d heap(Vec3::Zero(), Vec3::Zero());
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> at;
    for (std::size_t b = 0; b < hidden.size(); ++b)
      if (const float x = frame.poses[7 * b + static_cast<std::size_t>(axis)]; !hidden[b] && std::isfinite(x))
        at.push_back(static_cast<double>(x));
    if (at.empty()) return {};
    std::sort(at.begin(), at.end());
    const std::size_t out = at.size() / 50;
    heap.min()[axis] = at[out];
    heap.max()[axis] = at[at.size() - 1 - out];
  }
  return heap;
}

// The plate that turns: the fixed blocks or, of a ground, the part near the building, a fifth of the building's size wider than what lies
// on it. It is drawn as far as anything slides; that the building keeps its height in pictures, this does not lift it.
void set_table(Stage& stage, const MotionScene& scene, const std::vector<Eigen::AlignedBox3d>& boxes,
               const std::vector<MotionFrame>& some_frames) {
  Eigen::AlignedBox3d fixed, used = stage.reach;
  for (std::size_t b = 0; b < boxes.size(); ++b)
    if (scene.blocks[b].fixed && stage.hidden[b] == stage.on_ground) fixed.extend(boxes[b]);
  if (fixed.isEmpty()) fixed = stage.building;
  stage.table = stage.footing = fixed;
  if (!stage.on_ground) return;
  for (const MotionFrame& f : some_frames)
    for (std::size_t b = 0; b < boxes.size(); ++b) {
      const Vec3 at(f.poses[7 * b], f.poses[7 * b + 1], f.poses[7 * b + 2]), half = Vec3::Constant(0.5 * boxes[b].sizes().norm());
      if (!stage.hidden[b] && at.allFinite() && at.z() > stage.ground_z) used.extend(Eigen::AlignedBox3d(at - half, at + half));
    }
  const Vec3 aside = 0.2 * stage.size() * Vec3(1, 1, 0);
  const auto plate = [&](const Eigen::AlignedBox3d& below) {
    Eigen::AlignedBox3d box = Eigen::AlignedBox3d(below.min() - aside, below.max() + aside).intersection(fixed);
    box.max().z() = stage.ground_z;
    box.min().z() = stage.ground_z - 0.03 * stage.size();
    for (int i = 0; i < 2; ++i)
      if (!(box.sizes()[i] > 0)) box.min()[i] = fixed.min()[i], box.max()[i] = fixed.max()[i];
    return box;
  };
  stage.table = plate(used), stage.footing = plate(stage.reach);
}

}  // namespace

Stage set_stage(const MotionScene& scene, const std::vector<MotionFrame>& some_frames) {
  Stage stage;
  std::vector<Eigen::AlignedBox3d> boxes;
  Eigen::AlignedBox3d free, all;
  for (const MotionBlock& block : scene.blocks) {
    boxes.push_back(box_of(scene, block));
    all.extend(boxes.back());
    if (!block.fixed) free.extend(boxes.back());
  }
  bool ground = false;
  stage.hidden.assign(scene.blocks.size(), false);
  for (std::size_t b = 0; b < boxes.size(); ++b) {
    stage.hidden[b] = is_ground(scene.blocks[b], boxes[b], scene, free);
    if (stage.hidden[b]) {
      stage.ground_z = ground ? std::max(stage.ground_z, boxes[b].max().z()) : boxes[b].max().z();
      ground = true;
    } else {
      stage.building.extend(boxes[b]);
    }
  }
  if (stage.building.isEmpty()) stage.building.extend(Vec3(-1, -1, 0)), stage.building.extend(Vec3(1, 1, 1));
  stage.reach = stage.building;
  double lowest = stage.building.min().z();
  for (const MotionFrame& f : some_frames)
    for (std::size_t b = 0; b < boxes.size(); ++b) {
      if (stage.hidden[b]) continue;
      const Vec3 at(f.poses[7 * b], f.poses[7 * b + 1], f.poses[7 * b + 2]);
      const double r = 0.5 * boxes[b].sizes().norm();
      if (!at.allFinite() || (at - stage.building.center()).norm() > 3 * stage.size()) continue;
      stage.reach.extend(Eigen::AlignedBox3d(at - Vec3::Constant(r), at + Vec3::Constant(r)));
      lowest = std::min(lowest, at.z() - 0.5 * boxes[b].sizes().minCoeff());
    }
  if (!ground) stage.ground_z = lowest;
  stage.on_ground = ground;
  set_table(stage, scene, boxes, some_frames);
  if (some_frames.empty()) return stage;
  double radius = 0;  // m, mean of the blocks
  const auto drawn = static_cast<double>(std::ranges::count(stage.hidden, false));
  for (std::size_t b = 0; b < boxes.size(); ++b) radius += stage.hidden[b] ? 0 : 0.5 * boxes[b].sizes().norm() / drawn;
  // Blocks thrown far away are ignored; a view that includes them would show the building too small. What stood above the ground may have
  // fallen to it.
  const double aside = 0.9 * stage.size();
  Eigen::AlignedBox3d near = stage.building, &heap = stage.heap;
  near.min() -= aside * Vec3(1, 1, 0), near.max() += aside * Vec3(1, 1, 0);
  near.min().z() = std::min(near.min().z(), ground ? stage.ground_z : std::max(lowest, near.min().z() - aside));
  heap = heap_of(some_frames.back(), stage.hidden);
  if (heap.isEmpty()) return stage;
  heap = Eigen::AlignedBox3d(heap.min().cwiseMax(near.min()).cwiseMin(near.max()), heap.max().cwiseMin(near.max()).cwiseMax(near.min()));
  heap.min() -= Vec3::Constant(radius), heap.max() += Vec3::Constant(radius);
  if (ground) heap.min().z() = std::max(heap.min().z(), stage.ground_z);
  return stage;
}

Eigen::Isometry3d table_position(const Stage& stage, const Mat3& levelling) {
  const Vec3 middle = stage.footing.center();
  double lowest = HUGE_VAL;
  for (int i = 0; i < 8; ++i)
    lowest = std::min(lowest, (levelling * (stage.footing.corner(static_cast<Eigen::AlignedBox3d::CornerType>(i)) - middle)).z());
  Eigen::Isometry3d position = Eigen::Isometry3d::Identity();
  position.linear() = levelling;
  position.translation() = Vec3(middle.x(), middle.y(), stage.footing.min().z() - lowest) - levelling * middle;
  return position;
}

// A scene has no floor beside its ground: what falls past the table never lands. A floor drawn there would be one that it sinks into.
void turn_table(Stage& stage, const MotionScene& scene, const std::vector<MotionFrame>& some_frames, const std::vector<Mat3>& levelling) {
  std::vector<double> thin;  // m, half the smallest edge of each block
  for (const MotionBlock& block : scene.blocks) thin.push_back(0.5 * box_of(scene, block).sizes().minCoeff());
  stage.floor = stage.table.isApprox(stage.footing);  // a wider table reaches through it
  for (std::size_t i = 0; i < some_frames.size(); ++i) {
    const Eigen::Isometry3d position = table_position(stage, levelling[i]);
    for (std::size_t b = 0; b < thin.size(); ++b) {
      const Vec3 at = position * Eigen::Map<const Eigen::Vector3f>(&some_frames[i].poses[7 * b]).cast<double>();
      if (!stage.hidden[b] && !scene.blocks[b].fixed && at.z() - thin[b] < stage.table.min().z()) stage.floor = false;
    }
    stage.positions.push_back(position);
  }
}

// The ground of the engine is finite, and so is a wall's foot in a scene without ground. What falls past it never lands: it would sink
// through a plane that goes on. What is pressed into the ground, or has been driven through it, lies within its outline.
void bound_ground(Stage& stage, const MotionScene& scene, const std::vector<MotionFrame>& some_frames) {
  Eigen::AlignedBox3d ground;
  std::vector<double> thin;  // m, half the smallest edge of each block
  for (std::size_t b = 0; b < scene.blocks.size(); ++b) {
    const Eigen::AlignedBox3d box = box_of(scene, scene.blocks[b]);
    thin.push_back(0.5 * box.sizes().minCoeff());
    if (stage.hidden[b]) ground.extend(box);
  }
  const auto above = [&](const Vec3& at) { return stage.on_ground && ground.contains(Vec3(at.x(), at.y(), ground.center().z())); };
  for (const MotionFrame& frame : some_frames)
    for (std::size_t b = 0; b < thin.size(); ++b) {
      const Vec3 at = Eigen::Map<const Eigen::Vector3f>(&frame.poses[7 * b]).cast<double>();
      if (stage.hidden[b] || scene.blocks[b].fixed || !at.allFinite() || above(at)) continue;
      if (at.z() + thin[b] < stage.ground_z) stage.bounded = true;
    }
  if (stage.bounded) stage.floor = false;
  if (!stage.bounded || !stage.on_ground) return;
  stage.table = ground;
  stage.table.max().z() = stage.ground_z, stage.table.min().z() = stage.ground_z - 0.03 * stage.size();
  stage.footing = stage.table;
}

Camera in_scene(const Camera& camera, const Eigen::Isometry3d& position) {
  Camera seen = camera;
  const Eigen::Isometry3d back = position.inverse();
  seen.eye = back * camera.eye, seen.target = back * camera.target, seen.up = back.linear() * camera.up;
  return seen;
}

namespace {

Eigen::Matrix4f world_to_camera(const Vec3& eye, const Vec3& target, const Vec3& up_hint) {
  const Vec3 back = (eye - target).normalized();
  Vec3 right = up_hint.cross(back);
  if (right.norm() < 1e-6) right = Vec3(0, 1, 0).cross(back);
  if (right.norm() < 1e-6) right = Vec3(1, 0, 0);
  right.normalize();
  const Vec3 up = back.cross(right);
  Eigen::Matrix4d m = Eigen::Matrix4d::Identity();
  m.row(0) << right.transpose(), -right.dot(eye);
  m.row(1) << up.transpose(), -up.dot(eye);
  m.row(2) << back.transpose(), -back.dot(eye);
  return m.cast<float>();
}

}  // namespace

View look(const Camera& camera, const Stage& stage, int width, int height, double top, double bottom) {
  View v;
  v.view = world_to_camera(camera.eye, camera.target, camera.up);
  v.eye = camera.eye.cast<float>();
  v.target_distance = static_cast<float>((camera.eye - camera.target).norm());
  const double free = height - top - bottom;
  const double scale = free / height / std::tan(0.5 * camera.fov);  // of the vertical coordinate
  const double reach = (camera.eye - stage.building.center()).norm() + stage.size();
  const double near = 0.02 * v.target_distance, far = 40 * reach;
  Eigen::Matrix4d p = Eigen::Matrix4d::Zero();
  p(0, 0) = scale * height / width;
  p(1, 1) = scale;
  p(1, 2) = -(bottom - top) / height;  // moves the target to the middle of the free part
  p(2, 2) = -(far + near) / (far - near);
  p(2, 3) = -2 * far * near / (far - near);
  p(3, 2) = -1;
  v.projection = p.cast<float>();
  v.pixel = static_cast<float>(2 * std::tan(0.5 * camera.fov) / free);
  return v;
}

Eigen::Vector3f sun_of(const Camera& camera) {
  const Vec3 back = camera.eye - camera.target;
  const double azimuth = std::atan2(back.y(), back.x()) - 32 * pi / 180, height = 48 * pi / 180;
  return Vec3(std::cos(azimuth) * std::cos(height), std::sin(azimuth) * std::cos(height), std::sin(height)).cast<float>();
}

Eigen::Matrix4f shadow_view(const Stage& stage, const Eigen::Vector3f& sun) {
  const Vec3 centre = stage.reach.center(), s = sun.cast<double>();
  const double size = stage.reach.sizes().norm();
  const Eigen::Matrix4d to_sun = world_to_camera(centre + size * s, centre, Vec3(0, 0, 1)).cast<double>();
  Eigen::AlignedBox3d box;
  for (int i = 0; i < 8; ++i) {
    Vec3 p = stage.reach.corner(static_cast<Eigen::AlignedBox3d::CornerType>(i));
    box.extend((to_sun * p.homogeneous()).head<3>());
    p -= s * ((p.z() - stage.ground_z) / s.z());  // the shadow on the ground bounds the depth
    box.extend((to_sun * p.homogeneous()).head<3>());
  }
  const Vec3 half = 0.51 * box.sizes(), mid = box.center();
  Eigen::Matrix4d ortho = Eigen::Matrix4d::Identity();
  for (int k = 0; k < 3; ++k) {
    const double sign = k == 2 ? -1 : 1;
    ortho(k, k) = sign / half[k];
    ortho(k, 3) = -sign * mid[k] / half[k];
  }
  return (ortho * to_sun).cast<float>();
}

}  // namespace erbs::render
