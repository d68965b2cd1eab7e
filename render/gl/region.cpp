#include "render/gl/region.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace erbs::render {
namespace {

float near_plane(const Eigen::Matrix4f& projection) { return projection(2, 3) / (projection(2, 2) - 1); }

// Of a box in normalised device coordinates, -1..1.
Region pixels_of(const Eigen::AlignedBox2f& box, int width, int height, double margin) {
  if (box.isEmpty()) return {};
  const auto pixel = [&](float at, int size, double aside, bool up) {
    const double x = 0.5 * (static_cast<double>(at) + 1) * size + aside;
    return static_cast<int>(std::clamp(up ? std::ceil(x) : std::floor(x), 0.0, static_cast<double>(size)));
  };
  return {pixel(box.min().x(), width, -margin, false), pixel(box.min().y(), height, -margin, false),
          pixel(box.max().x(), width, margin, true), pixel(box.max().y(), height, margin, true)};
}

}  // namespace

Region inset(const Region& r, int pixels, int width, int height) {
  return {r.left > 0 ? r.left + pixels : 0, r.bottom > 0 ? r.bottom + pixels : 0, r.right < width ? r.right - pixels : width,
          r.top < height ? r.top - pixels : height};
}

Region region_of(const std::vector<Sphere>& spheres, const Eigen::Matrix4f& view, const Eigen::Matrix4f& projection, int width, int height,
                 double margin) {
  const float near = near_plane(projection);
  Eigen::AlignedBox2f box;
  for (const Sphere& s : spheres) {
    const Eigen::Vector4f at = view * s.middle.homogeneous();
    const float ahead = -at.z();
    if (!at.allFinite() || ahead + s.radius < near) continue;
    if (ahead - s.radius < near) return {0, 0, width, height};
    for (int axis = 0; axis < 2; ++axis) {  // the rays that touch the sphere, in the plane of this axis and the view
      const float towards = std::atan2(at[axis], ahead), half = std::asin(s.radius / std::hypot(at[axis], ahead));
      for (const float angle : {towards - half, towards + half}) {
        const float ndc = projection(axis, axis) * std::tan(angle) - projection(axis, 2);
        box.min()[axis] = std::min(box.min()[axis], ndc);
        box.max()[axis] = std::max(box.max()[axis], ndc);
      }
    }
  }
  return pixels_of(box, width, height, margin);
}

double nearest_of(const std::vector<Sphere>& spheres, const Eigen::Matrix4f& view, const Eigen::Matrix4f& projection) {
  const float near = near_plane(projection);
  float nearest = HUGE_VALF;
  for (const Sphere& s : spheres) {
    const float ahead = -(view * s.middle.homogeneous()).z();
    if (std::isfinite(ahead) && ahead + s.radius >= near) nearest = std::min(nearest, ahead - s.radius);
  }
  return static_cast<double>(std::max(nearest, near));
}

Eigen::AlignedBox2f box_of(const std::vector<Sphere>& spheres, const Eigen::Matrix4f& projection) {
  Eigen::AlignedBox2f box;
  const Eigen::Vector2f scale(projection.row(0).head<3>().norm(), projection.row(1).head<3>().norm());
  for (const Sphere& s : spheres) {
    const Eigen::Vector2f at = (projection * s.middle.homogeneous()).head<2>();
    if (!at.allFinite()) continue;
    box.extend(Eigen::Vector2f(at - s.radius * scale));
    box.extend(Eigen::Vector2f(at + s.radius * scale));
  }
  if (box.isEmpty()) return box;
  return {(box.min() + Eigen::Vector2f::Ones()) / 2, (box.max() + Eigen::Vector2f::Ones()) / 2};
}

std::vector<Sphere> fallen_shadows(std::vector<Sphere> spheres, const Eigen::Vector3f& sun, double ground_z) {
  for (Sphere& s : spheres) {
    s.middle -= (s.middle.z() - static_cast<float>(ground_z)) / sun.z() * sun;
    s.radius /= sun.z();
  }
  return spheres;
}

Region rising(const Eigen::Matrix4f& to_world, const Eigen::Vector3f& eye, const Eigen::Vector3f& up, int width, int height) {
  // Along the far plane the rise is linear in the coordinates of the picture: the part that rises is a polygon.
  const std::array<Eigen::Vector2f, 4> corners{Eigen::Vector2f(-1, -1), {1, -1}, {1, 1}, {-1, 1}};
  std::array<float, 4> rise{};
  for (std::size_t i = 0; i < 4; ++i) {
    const Eigen::Vector4f end = to_world * Eigen::Vector4f(corners[i].x(), corners[i].y(), 1, 1);
    rise[i] = (end.head<3>() / end.w() - eye).dot(up);
  }
  Eigen::AlignedBox2f box;
  for (std::size_t i = 0; i < 4; ++i) {
    const std::size_t j = (i + 1) % 4;
    if (rise[i] > 0) box.extend(corners[i]);
    if ((rise[i] > 0) != (rise[j] > 0)) box.extend(Eigen::Vector2f(corners[i] + rise[i] / (rise[i] - rise[j]) * (corners[j] - corners[i])));
  }
  return pixels_of(box, width, height, 1);
}

}  // namespace erbs::render
