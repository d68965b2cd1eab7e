// Which part of a picture, or of the shadow map, is touched: the rest need not be drawn again for each sample.
#pragma once
#include <vector>

#include "engine/base/vec.h"

namespace erbs::render {

// Pixels from the lower left corner.
struct Region {
  int left = 0, bottom = 0, right = 0, top = 0;  // right and top exclusive
  int width() const { return right - left; }
  int height() const { return top - bottom; }
  bool empty() const { return width() <= 0 || height() <= 0; }
};

// Smaller by `pixels` on each side that is not the border of the picture.
Region inset(const Region& region, int pixels, int width, int height);

struct Sphere {
  Eigen::Vector3f middle;  // m
  float radius;            // m
};

// The image of spheres, through the matrices of a camera, and `margin` pixels around it; the whole picture if one lies about the eye.
Region region_of(const std::vector<Sphere>& spheres, const Eigen::Matrix4f& view, const Eigen::Matrix4f& projection, int width, int height,
                 double margin);

// The distance (m) before the camera at which the nearest of these spheres begins, at least that of the near plane.
double nearest_of(const std::vector<Sphere>& spheres, const Eigen::Matrix4f& view, const Eigen::Matrix4f& projection);

// The image of spheres in an orthographic projection such as the shadow map's, in 0..1 of it.
Eigen::AlignedBox2f box_of(const std::vector<Sphere>& spheres, const Eigen::Matrix4f& projection);

// Where the shadows of spheres lie on level ground, for this direction of the sun (unit).
std::vector<Sphere> fallen_shadows(std::vector<Sphere> spheres, const Eigen::Vector3f& sun, double ground_z);

// The rows and columns of a picture in which rays from the eye rise along `up` (unit): those with sky.
Region rising(const Eigen::Matrix4f& to_world, const Eigen::Vector3f& eye, const Eigen::Vector3f& up, int width, int height);

}  // namespace erbs::render
