#include "render/run/framing.h"

#include <algorithm>
#include <cmath>

namespace erbs::render {
namespace {

// Whether the convex hull of the points reaches beyond this corner in both directions.
bool reaches_corner(const std::vector<Eigen::Vector2d>& points, const Eigen::Vector2d& corner) {
  for (const Eigen::Vector2d& p : points)
    for (const Eigen::Vector2d& q : points) {
      const Eigen::Vector2d a = p - corner, b = q - corner;
      if (a.minCoeff() > 0) return true;
      // Where x - y changes its sign on the side from p to q, the lesser of both is greatest.
      const double from = a.x() - a.y(), to = b.x() - b.y();
      if (from * to < 0 && (a + from / (from - to) * (b - a)).minCoeff() > 0) return true;
    }
  return false;
}

}  // namespace

Framing::Framing(const Camera& camera, const Vec3& direction, const Stage& stage, double aspect, double spare) : camera_(camera) {
  const Vec3 back = direction.normalized();
  Vec3 right = camera_.up.cross(back);
  if (right.norm() < 1e-6) camera_.up = Vec3::UnitY(), right = camera_.up.cross(back);
  right.normalize();
  axes_ << right.transpose(), back.cross(right).transpose(), back.transpose();
  half_ = std::tan(0.5 * camera_.fov) * Eigen::Vector2d(aspect, 1);
  const Eigen::Vector2d full = Eigen::Vector2d::Ones() - 2 * spare * Eigen::Vector2d(std::min(1.0, 1 / aspect), std::min(1.0, aspect));
  whole_ = beside_ = {-full, full};
  // The axes are little more than half as wide as a legend.
  beside_.min().x() = -full.x() * (1 - 1.1 * stage.legend_width), beside_.max().x() = full.x() * (1 - 2 * stage.legend_width);
  if (beside_.sizes().x() < full.x()) beside_ = whole_;  // in a narrow picture nothing has room beside them
  legend_ = {1 - 2 * stage.legend_width, 1 - 2 * stage.legend_height};
}

void Framing::add(const Vec3& p) {
  if (!p.allFinite()) return;
  points_.push_back(axes_ * p);
  if (points_.size() >= 4096) keep_outermost();
}

// The borders of each window touch the points that are outermost in four directions across its pyramid; the diagonals serve the corner.
void Framing::keep_outermost() {
  std::vector<Vec3> across;
  for (const Eigen::AlignedBox2d& window : {whole_, beside_})
    for (int i = 0; i < 2; ++i)
      for (const Eigen::Vector2d& border : {window.min(), window.max()}) {
        const double sign = border[i] < 0 ? -1 : 1;
        Vec3 out = Vec3::Zero();
        out[i] = sign, out.z() = sign * border[i] * half_[i];
        across.push_back(out);
      }
  for (int i = 0; i < 16; ++i) {
    const Eigen::Vector2d out(std::cos(i * pi / 8) / half_.x(), std::sin(i * pi / 8) / half_.y());
    across.emplace_back(out.x(), out.y(), 1);
  }
  std::vector<Vec3> kept;
  for (const Vec3& out : across)
    kept.push_back(
        *std::max_element(points_.begin(), points_.end(), [&](const Vec3& a, const Vec3& b) { return out.dot(a) < out.dot(b); }));
  points_ = std::move(kept);
}

std::vector<Eigen::Vector2d> Framing::places(const Vec3& eye) const {
  std::vector<Eigen::Vector2d> places;
  for (const Vec3& p : points_) places.push_back((p - eye).head<2>().cwiseQuotient(half_ * (eye.z() - p.z())));
  return places;
}

// Each border of the window bounds the eye by a plane. Both bounds of a side meet at the nearest eye for this side; the further one counts.
Vec3 Framing::eye_of(const Eigen::AlignedBox2d& window) const {
  Eigen::Vector2d least, most;  // borders of the pyramid's sides where the eye's depth is 0
  double front = -HUGE_VAL, rear = HUGE_VAL;
  for (const Vec3& p : points_) front = std::max(front, p.z()), rear = std::min(rear, p.z());
  double back = front + 0.012 * (front - rear) + 1e-3;  // the picture begins a hundredth of the depth before the eye
  const Eigen::Vector2d lower = half_.cwiseProduct(window.min()), upper = half_.cwiseProduct(window.max());
  for (int i = 0; i < 2; ++i) {
    least[i] = HUGE_VAL, most[i] = -HUGE_VAL;
    for (const Vec3& p : points_) {
      least[i] = std::min(least[i], p[i] + lower[i] * p.z());
      most[i] = std::max(most[i], p[i] + upper[i] * p.z());
    }
    back = std::max(back, (most[i] - least[i]) / (upper[i] - lower[i]));
  }
  Vec3 eye(0, 0, back);
  for (int i = 0; i < 2; ++i) {
    double from = most[i] - upper[i] * back, to = least[i] - lower[i] * back;  // between them the points are in the window
    for (int step = 0; step < 50; ++step) {
      eye[i] = 0.5 * (from + to);
      double low = HUGE_VAL, high = -HUGE_VAL;
      for (const Vec3& p : points_) {
        const double at = (p[i] - eye[i]) / (half_[i] * (back - p.z()));
        low = std::min(low, at), high = std::max(high, at);
      }
      (low + high > window.min()[i] + window.max()[i] ? from : to) = eye[i];
    }
  }
  return eye;
}

Camera Framing::camera(const std::optional<Vec3>& target) const {
  if (points_.empty()) return camera_;
  Vec3 eye = eye_of(whole_);
  if (reaches_corner(places(eye), legend_)) eye = eye_of(beside_);
  double front = -HUGE_VAL, rear = HUGE_VAL;
  for (const Vec3& p : points_) front = std::max(front, p.z()), rear = std::min(rear, p.z());
  const double middle = target ? axes_.row(2).dot(*target) : 0.5 * (front + rear);
  Camera out = camera_;
  out.eye = axes_.transpose() * eye;
  out.target = out.eye - (eye.z() - middle) * axes_.row(2).transpose();
  return out;
}

std::vector<Vec3> visible_corners(const MotionScene& drawn, const Stage& stage, const MotionFrame& frame) {
  const Vec3 aside = Vec3::Constant(1.5 * stage.size());
  Eigen::AlignedBox3d near(stage.building.min() - aside, stage.building.max() + aside);
  if (stage.on_ground) near.min().z() = stage.ground_z;
  std::vector<Vec3> corners;
  for (std::size_t b = 0; b < drawn.blocks.size(); ++b) {
    const float* pose = &frame.poses[7 * b];
    const Vec3 centre = Eigen::Map<const Eigen::Vector3f>(pose).cast<double>();
    if (stage.hidden[b] || !near.contains(centre)) continue;
    const Mat3 turn = Eigen::Quaterniond(pose[3], pose[4], pose[5], pose[6]).normalized().toRotationMatrix();
    for (const int part : drawn.blocks[b].parts) {
      const std::vector<float>& v = drawn.shapes[static_cast<std::size_t>(part)].vertices;
      for (std::size_t i = 0; i + 2 < v.size(); i += 3) {
        Vec3 corner = centre + turn * Vec3(v[i], v[i + 1], v[i + 2]);
        if (stage.on_ground) corner.z() = std::max(corner.z(), stage.ground_z);  // the ground hides what is pressed into it
        corners.push_back(corner);
      }
    }
  }
  return corners;
}

namespace {

// Points that must be visible: the building, room on the ground for what falls beside it, and the heap where it lies at the end.
std::vector<Vec3> seen_points(const Stage& stage) {
  std::vector<Vec3> seen, heap;
  const Vec3 size = stage.building.sizes(), aside = 0.14 * size.z() * Vec3(1, 1, 0);
  for (int i = 0; i < 8; ++i) {
    const Vec3 p = stage.building.corner(static_cast<Eigen::AlignedBox3d::CornerType>(i));
    seen.push_back(p);
    if (i < 4) seen.push_back(p + aside.cwiseProduct((p - stage.building.center()).cwiseSign()));  // the lower corners
    if (!stage.heap.isEmpty()) heap.push_back(stage.heap.corner(static_cast<Eigen::AlignedBox3d::CornerType>(i)));
  }
  if (stage.positions.empty()) {
    seen.insert(seen.end(), heap.begin(), heap.end());
    return seen;
  }
  const Vec3 near = 0.4 * stage.size() * Vec3(1, 1, 1);
  const Eigen::AlignedBox3d table = stage.table.intersection({stage.building.min() - near, stage.building.max() + near});
  if (!table.isEmpty())
    for (int i = 0; i < 8; ++i) seen.push_back(table.corner(static_cast<Eigen::AlignedBox3d::CornerType>(i)));
  std::vector<Vec3> turned;
  for (const Eigen::Isometry3d& position : stage.positions)
    for (const Vec3& p : seen) turned.push_back(position * p);
  for (const Vec3& p : heap) turned.push_back(stage.positions.back() * p);
  return turned;
}

Camera framed(const Camera& camera, const Vec3& direction, const Stage& stage, const std::vector<Vec3>& seen, double aspect) {
  Framing framing(camera, direction, stage, aspect, 0.0283);
  for (const Vec3& p : seen) framing.add(p);
  return framing.camera(stage.building.center());
}

// Where a table that turns faces when it leans most: its upper side is seen from there, its lower side from behind. Zero if it stays.
Eigen::Vector2d downhill_of(const Stage& stage) {
  Eigen::Vector2d out = Eigen::Vector2d::Zero();
  for (const Eigen::Isometry3d& at : stage.positions)
    if (const Eigen::Vector2d leans = at.linear().col(2).head<2>(); leans.norm() > out.norm()) out = leans;
  return out;
}

}  // namespace

std::vector<Camera> choose_cameras(const Stage& stage, double aspect) {
  const std::vector<Vec3> seen = seen_points(stage);
  const Eigen::Vector2d downhill = downhill_of(stage);
  std::vector<Camera> cameras;
  for (auto [name, direction] : {std::pair{"corner", Vec3(0.62, -1, 0.34)}, {"side", Vec3(-1, -0.50, 0.42)}}) {
    if (direction.head<2>().dot(downhill) < 0) direction.head<2>() *= -1;
    Camera camera;
    camera.name = name;
    camera.fov = 26 * pi / 180;
    cameras.push_back(framed(camera, direction, stage, seen, aspect));
  }
  return cameras;
}

std::vector<Camera> elevations(const Stage& stage, double aspect) {
  const std::pair<const char*, Vec3> views[] = {
      {"from_-x", {-1, 0, 0}}, {"from_+x", {1, 0, 0}}, {"from_-y", {0, -1, 0}}, {"from_+y", {0, 1, 0}}, {"from_above", {0, 0, 1}}};
  const std::vector<Vec3> seen = seen_points(stage);
  std::vector<Camera> out;
  for (const auto& [name, direction] : views) {
    Camera camera;
    camera.name = name;
    camera.fov = 1.5 * pi / 180;  // from so far that parallel lines stay parallel within 1 %
    out.push_back(framed(camera, direction, stage, seen, aspect));
  }
  return out;
}

}  // namespace erbs::render
