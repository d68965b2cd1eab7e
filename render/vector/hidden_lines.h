// Line drawings: a projection of exact geometry to the plane of a picture, and the parts of lines that no face hides.
#pragma once
#include <optional>
#include <vector>

#include "engine/scene/scene.h"

namespace erbs::render {

// A point of the picture. Nearness grows towards the eye and is affine in the picture along straight lines and over plane faces: 1/depth in
// perspective, -depth where the projection is parallel.
struct Seen {
  Eigen::Vector2d at{0, 0};  // px, from the left and from the top
  double near = 0;           // 1/m in perspective, else m
};

// The camera of a line drawing. The picture between `top` and `bottom` (px) is what its angle of view covers.
class Projection {
 public:
  Projection(const Camera& camera, bool parallel, int width, int height, double top, double bottom);
  Vec3 in_camera(const Vec3& world) const;  // m: right, up, depth
  Seen see(const Vec3& in_camera) const;    // depth at least least_depth(), unless parallel
  // Nearness of the plane n.x = d in camera coordinates, as coefficients of x, y (px) and 1.
  Vec3 nearness(const Vec3& n, double d) const;
  bool parallel() const { return parallel_; }
  double pixels_per_metre() const { return focus_ / distance_; }  // at the target
  double least_depth() const { return 0.02 * distance_; }         // m; what is nearer is not drawn
  const Vec3& eye() const { return eye_; }
  const Vec3& back() const { return back_; }  // unit, from the target to the eye
  // Difference of nearness over a length `eps` (m) towards the eye, at this nearness.
  double nearness_of(double eps, double near) const { return parallel_ ? eps : eps * near * near; }
  double depth_of(double near) const { return parallel_ ? -near : 1 / near; }  // m

 private:
  Vec3 eye_, right_, up_, back_;
  bool parallel_;
  double focus_, distance_, middle_x_, middle_y_;  // px; m; px
};

// A visible part of a line.
struct Piece {
  Eigen::Vector2d from{0, 0}, to{0, 0};  // px
};

// Opaque convex faces in a picture, and what they leave of lines.
class HiddenLines {
 public:
  // eps: m; a face hides only what lies deeper below it than this.
  HiddenLines(const Projection& projection, int width, int height, double eps);
  // A convex face by its corners in space. Faces of one `body` (not negative) do not hide lines of that body.
  void add_face(const std::vector<Vec3>& corners, int body);
  // Visible parts of the line from p to q; `lift`: m, further depth below a face at which it is still seen.
  std::vector<Piece> visible(const Vec3& p, const Vec3& q, int body, double lift = 0) const;
  // The face that is seen at a point of the picture (px).
  struct Sight {
    double near = 0;    // as of Seen
    double facing = 1;  // cosine between its normal and the direction to the eye
  };
  std::optional<Sight> sight(const Eigen::Vector2d& at) const;

 private:
  struct Face {
    std::vector<Eigen::Vector2d> corners;  // px, turning one way: inside is where all crosses are positive
    Vec3 nearness{0, 0, 0};
    int body = -1;
    double facing = 1;
  };
  std::vector<int> faces_near(const Eigen::Vector2d& p, const Eigen::Vector2d& q) const;
  Projection projection_;
  int columns_, rows_;
  double eps_;
  std::vector<Face> faces_;
  std::vector<std::vector<int>> cells_;  // indices of the faces that touch a cell of the picture [rows*columns]
};

}  // namespace erbs::render
