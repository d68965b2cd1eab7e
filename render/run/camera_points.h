// The camera of a picture from points marked in it.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "engine/scene/scene.h"

namespace erbs::render {

struct MarkedPoint {
  Vec3 at = Vec3::Zero();  // m, of the scene
  double u = 0, v = 0;     // px, from the left and from the top
};

// "x,y,z:u,v; x,y,z:u,v; ...". Error that names the part which is malformed, or for fewer than four points.
std::vector<MarkedPoint> marked_points(const std::string& text);

struct FoundCamera {
  Camera camera;
  double residual = 0;  // px, root mean square distance of the marked points from where the camera sees them
};

// A pinhole camera with square pixels, whose axis passes through the middle of the picture: position, rotation, and the angle of view where
// `fov` (rad) does not give it. Least squares of the distances in the picture by Levenberg and Marquardt (Marquardt 1963), from 72 starts
// around the points; the best end wins. Four points give eight equations for at most seven unknowns. Error for points on one line, and
// where no start ends with all points before the camera.
FoundCamera camera_from(const std::vector<MarkedPoint>& points, int width, int height, std::optional<double> fov);

}  // namespace erbs::render
