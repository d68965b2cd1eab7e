#include "render/vector/hidden_lines.h"

#include <algorithm>
#include <cmath>

namespace erbs::render {
namespace {

constexpr double cell_size = 12;  // px

using Stretch = std::pair<double, double>;

// Cuts [from, to] out of disjoint spans.
void subtract(std::vector<Stretch>& spans, double from, double to) {
  std::vector<Stretch> left;
  for (const auto& [a, b] : spans) {
    if (to <= a || from >= b) {
      left.emplace_back(a, b);
      continue;
    }
    if (from > a) left.emplace_back(a, from);
    if (to < b) left.emplace_back(to, b);
  }
  spans = std::move(left);
}

// Narrows [low, high] to where value + slope * s > 0.
void keep_positive(double value, double slope, double& low, double& high) {
  if (slope == 0) {
    if (value <= 0) high = low - 1;
  } else if (slope > 0) low = std::max(low, -value / slope);
  else high = std::min(high, -value / slope);
}

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

}  // namespace

Projection::Projection(const Camera& camera, bool parallel, int width, int height, double top, double bottom)
    : eye_(camera.eye), parallel_(parallel), distance_((camera.eye - camera.target).norm()) {
  back_ = (camera.eye - camera.target).normalized();
  right_ = camera.up.cross(back_);
  if (right_.norm() < 1e-6) right_ = Vec3(0, 1, 0).cross(back_);
  if (right_.norm() < 1e-6) right_ = Vec3(1, 0, 0);
  right_.normalize();
  up_ = back_.cross(right_);
  const double free = height - top - bottom;
  focus_ = 0.5 * free / std::tan(0.5 * camera.fov);
  middle_x_ = 0.5 * width, middle_y_ = top + 0.5 * free;
}

Vec3 Projection::in_camera(const Vec3& world) const {
  const Vec3 v = world - eye_;
  return {v.dot(right_), v.dot(up_), -v.dot(back_)};
}

Seen Projection::see(const Vec3& p) const {
  const double scale = focus_ / (parallel_ ? distance_ : p.z());
  return {{middle_x_ + scale * p.x(), middle_y_ - scale * p.y()}, parallel_ ? -p.z() : 1 / p.z()};
}

Vec3 Projection::nearness(const Vec3& n, double d) const {
  // With x = (px - middle_x) depth / focus: n.(x/depth, y/depth, 1) = d / depth. Where parallel, x = (px - middle_x) distance / focus.
  const double scale = parallel_ ? distance_ / focus_ : 1 / focus_;
  const Vec3 in_px(n.x() * scale, -n.y() * scale, 0);
  const double rest = -in_px.x() * middle_x_ - in_px.y() * middle_y_;
  if (parallel_) return Vec3(in_px.x(), in_px.y(), rest - d) / n.z();
  return Vec3(in_px.x(), in_px.y(), rest + n.z()) / d;
}

HiddenLines::HiddenLines(const Projection& projection, int width, int height, double eps)
    : projection_(projection),
      columns_(static_cast<int>(width / cell_size) + 1),
      rows_(static_cast<int>(height / cell_size) + 1),
      eps_(eps),
      cells_(static_cast<std::size_t>(columns_ * rows_)) {}

void HiddenLines::add_face(const std::vector<Vec3>& world, int body) {
  std::vector<Vec3> corners;
  for (const Vec3& p : world) corners.push_back(projection_.in_camera(p));
  if (!projection_.parallel()) {  // what lies before the least depth is cut off
    const double least = projection_.least_depth();
    std::vector<Vec3> cut;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Vec3 &p = corners[i], &q = corners[(i + 1) % corners.size()];
      if (p.z() >= least) cut.push_back(p);
      if ((p.z() >= least) != (q.z() >= least)) cut.push_back(p + (least - p.z()) / (q.z() - p.z()) * (q - p));
    }
    corners = std::move(cut);
  }
  if (corners.size() < 3) return;
  Vec3 n = Vec3::Zero(), middle = Vec3::Zero();
  for (std::size_t i = 0; i < corners.size(); ++i) n += corners[i].cross(corners[(i + 1) % corners.size()]), middle += corners[i];
  if (!(n.norm() > 0)) return;
  n.normalize();
  middle /= static_cast<double>(corners.size());
  Face face;
  face.body = body;
  double area = 0;
  for (const Vec3& p : corners) face.corners.push_back(projection_.see(p).at);
  for (std::size_t i = 0; i < corners.size(); ++i) area += 0.5 * cross(face.corners[i], face.corners[(i + 1) % corners.size()]);
  if (!(std::fabs(area) > 1e-4)) return;  // seen from its edge; not finite
  if (area < 0) std::reverse(face.corners.begin(), face.corners.end());
  face.nearness = projection_.nearness(n, n.dot(middle));
  face.facing = std::fabs(projection_.parallel() ? n.z() : n.dot(middle.normalized()));
  if (!face.nearness.allFinite()) return;
  Eigen::AlignedBox2d box;
  for (const Eigen::Vector2d& p : face.corners) box.extend(p);
  const auto column = [&](double x) {
    return static_cast<int>(std::clamp(std::floor(x / cell_size), -1.0, static_cast<double>(columns_)));
  };
  const auto row = [&](double y) { return static_cast<int>(std::clamp(std::floor(y / cell_size), -1.0, static_cast<double>(rows_))); };
  const int index = static_cast<int>(faces_.size());
  for (int y = std::max(0, row(box.min().y())); y <= std::min(rows_ - 1, row(box.max().y())); ++y)
    for (int x = std::max(0, column(box.min().x())); x <= std::min(columns_ - 1, column(box.max().x())); ++x)
      cells_[static_cast<std::size_t>(y * columns_ + x)].push_back(index);
  faces_.push_back(std::move(face));
}

// Faces in the cells that the line from p to q passes, each once.
std::vector<int> HiddenLines::faces_near(const Eigen::Vector2d& p, const Eigen::Vector2d& q) const {
  std::vector<int> found;
  const int first = std::clamp(static_cast<int>(std::floor(std::min(p.y(), q.y()) / cell_size)), 0, rows_ - 1);
  const int last = std::clamp(static_cast<int>(std::floor(std::max(p.y(), q.y()) / cell_size)), 0, rows_ - 1);
  for (int y = first; y <= last; ++y) {
    double low = 0, high = 1;  // of the line, within this row
    keep_positive(p.y() - y * cell_size + 1e-6, q.y() - p.y(), low, high);
    keep_positive((y + 1) * cell_size - p.y() + 1e-6, p.y() - q.y(), low, high);
    if (high < low) continue;
    const double x0 = p.x() + low * (q.x() - p.x()), x1 = p.x() + high * (q.x() - p.x());
    const int from = std::clamp(static_cast<int>(std::floor(std::min(x0, x1) / cell_size)), 0, columns_ - 1);
    const int to = std::clamp(static_cast<int>(std::floor(std::max(x0, x1) / cell_size)), 0, columns_ - 1);
    for (int x = from; x <= to; ++x) {
      const std::vector<int>& here = cells_[static_cast<std::size_t>(y * columns_ + x)];
      found.insert(found.end(), here.begin(), here.end());
    }
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

std::optional<HiddenLines::Sight> HiddenLines::sight(const Eigen::Vector2d& at) const {
  if (!(at.x() >= 0 && at.y() >= 0 && at.x() < columns_ * cell_size && at.y() < rows_ * cell_size)) return std::nullopt;
  std::optional<Sight> nearest;
  for (const int index :
       cells_[static_cast<std::size_t>(static_cast<int>(at.y() / cell_size) * columns_ + static_cast<int>(at.x() / cell_size))]) {
    const Face& face = faces_[static_cast<std::size_t>(index)];
    const double near = face.nearness.x() * at.x() + face.nearness.y() * at.y() + face.nearness.z();
    if (nearest && near <= nearest->near) continue;
    bool within = true;
    for (std::size_t i = 0; i < face.corners.size() && within; ++i)
      within = cross(face.corners[(i + 1) % face.corners.size()] - face.corners[i], at - face.corners[i]) >= 0;
    if (within) nearest = Sight{near, face.facing};
  }
  return nearest;
}

std::vector<Piece> HiddenLines::visible(const Vec3& from, const Vec3& to, int body, double lift) const {
  Vec3 a = projection_.in_camera(from), b = projection_.in_camera(to);
  const double least = projection_.least_depth();
  if (!a.allFinite() || !b.allFinite()) return {};
  if (!projection_.parallel()) {
    if (a.z() < least && b.z() < least) return {};
    if (a.z() < least) a += (least - a.z()) / (b.z() - a.z()) * (b - a);
    if (b.z() < least) b += (least - b.z()) / (a.z() - b.z()) * (a - b);
  }
  const Seen p = projection_.see(a), q = projection_.see(b);
  double low = 0, high = 1;  // of the line, within the picture
  const Eigen::Vector2d way = q.at - p.at;
  keep_positive(p.at.x(), way.x(), low, high), keep_positive(columns_ * cell_size - p.at.x(), -way.x(), low, high);
  keep_positive(p.at.y(), way.y(), low, high), keep_positive(rows_ * cell_size - p.at.y(), -way.y(), low, high);
  if (!(high > low)) return {};
  std::vector<Stretch> spans{{low, high}};
  for (const int index : faces_near(p.at + low * way, p.at + high * way)) {
    const Face& face = faces_[static_cast<std::size_t>(index)];
    if (face.body >= 0 && face.body == body) continue;
    double begin = low, end = high;
    for (std::size_t i = 0; i < face.corners.size() && end > begin; ++i) {
      const Eigen::Vector2d &c = face.corners[i], side = face.corners[(i + 1) % face.corners.size()] - c;
      keep_positive(cross(side, p.at - c), cross(side, way), begin, end);
    }
    const Vec3& n = face.nearness;
    const double ahead = n.x() * p.at.x() + n.y() * p.at.y() + n.z() - p.near;
    const double growth = n.x() * way.x() + n.y() * way.y() - (q.near - p.near);
    keep_positive(ahead - projection_.nearness_of(eps_ + lift, std::max(p.near, q.near)), growth, begin, end);
    if (end > begin) subtract(spans, begin, end);
    if (spans.empty()) return {};
  }
  std::vector<Piece> out;
  const double shortest = std::min(0.5, 0.9 / std::max(1e-9, way.norm()));  // a speck of less than a pixel says nothing
  for (const auto& [s, t] : spans)
    if (t - s > shortest) out.push_back({p.at + s * way, p.at + t * way});
  return out;
}

}  // namespace erbs::render
