#include "render/run/camera_points.h"

#include <charconv>
#include <cmath>

#include "engine/base/error.h"
#include "engine/base/text.h"
#include "engine/base/units.h"

namespace erbs::render {
namespace {

// Rows of `turn`: right, up and back of the camera.
struct Pinhole {
  Vec3 eye = Vec3::Zero();
  Mat3 turn = Mat3::Identity();
  double log_focal = 0;  // of the focal length in px
};

using Step = Eigen::Matrix<double, 7, 1>;

Pinhole moved(const Pinhole& camera, const Step& step) {
  Pinhole next = camera;
  next.eye += step.head<3>();
  const Vec3 rotation = step.segment<3>(3);
  if (rotation.norm() > 0) next.turn = Eigen::AngleAxisd(rotation.norm(), rotation.normalized()).toRotationMatrix() * camera.turn;
  next.log_focal += step[6];
  return next;
}

// Distances in the picture, px. False if a point lies behind the camera.
bool misses(const Pinhole& camera, const std::vector<MarkedPoint>& points, int width, int height, Eigen::VectorXd& miss) {
  miss.resize(2 * Eigen::Index(points.size()));
  const double focal = std::exp(camera.log_focal);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec3 p = camera.turn * (points[i].at - camera.eye);
    if (p.z() > -1e-6) return false;
    miss[2 * Eigen::Index(i)] = 0.5 * width - focal * p.x() / p.z() - points[i].u;
    miss[2 * Eigen::Index(i) + 1] = 0.5 * height + focal * p.y() / p.z() - points[i].v;
  }
  return miss.allFinite();
}

Pinhole start_of(const std::vector<MarkedPoint>& points, int height, double azimuth, double elevation, double focal) {
  Vec3 centre = Vec3::Zero();
  for (const MarkedPoint& p : points) centre += p.at / double(points.size());
  double size = 0;
  for (const MarkedPoint& p : points) size = std::max(size, (p.at - centre).norm());
  Pinhole camera;
  const Vec3 back(std::cos(azimuth) * std::cos(elevation), std::sin(azimuth) * std::cos(elevation), std::sin(elevation));
  camera.eye = centre + 3 * size * focal / height * back;  // the points fill about two thirds of the picture
  camera.turn.row(2) = back;
  camera.turn.row(0) = Vec3::UnitZ().cross(back).normalized();
  camera.turn.row(1) = back.cross(Vec3(camera.turn.row(0)));
  camera.log_focal = std::log(focal);
  return camera;
}

// Root mean square distance (px) at the end; infinite if a start fails.
double refine(Pinhole& camera, const std::vector<MarkedPoint>& points, int width, int height, bool free_focal) {
  Eigen::VectorXd miss, other;
  if (!misses(camera, points, width, height, miss)) return HUGE_VAL;
  const double length = (camera.eye - points.front().at).norm();
  const int unknowns = free_focal ? 7 : 6;
  double damping = 1e-2;
  for (int pass = 0; pass < 200 && damping < 1e12; ++pass) {
    Eigen::MatrixXd slope(miss.size(), unknowns);
    for (int k = 0; k < unknowns; ++k) {
      Step step = Step::Zero();
      step[k] = 1e-6 * (k < 3 ? length : 1);
      if (!misses(moved(camera, step), points, width, height, other)) return HUGE_VAL;
      slope.col(k) = (other - miss) / step[k];
    }
    Eigen::MatrixXd normal = slope.transpose() * slope;
    normal.diagonal() *= 1 + damping;
    Step step = Step::Zero();
    step.head(unknowns) = -normal.ldlt().solve(slope.transpose() * miss);
    const Pinhole next = moved(camera, step);
    if (!misses(next, points, width, height, other) || !(other.squaredNorm() < miss.squaredNorm())) {
      damping *= 4;
      continue;
    }
    const bool done = miss.norm() - other.norm() < 1e-12 * (1 + miss.norm());
    camera = next, miss = other, damping = std::max(1e-12, damping / 6);
    if (done) break;
  }
  return std::sqrt(miss.squaredNorm() / double(points.size()));
}

double number_in(const std::string& text, std::size_t& at, char end, const std::string& part) {
  const std::size_t stop = end == 0 ? text.size() : text.find(end, at);
  double value = NAN;
  if (stop != std::string::npos && at <= text.size()) {
    std::size_t begin = at, last = stop;
    while (begin < last && text[begin] == ' ') ++begin;
    while (last > begin && text[last - 1] == ' ') --last;
    const auto [rest, error] = std::from_chars(text.data() + begin, text.data() + last, value);
    if (error != std::errc() || rest != text.data() + last) value = NAN;
    at = stop + 1;
  }
  if (!std::isfinite(value))
    throw Error(
        fmt::format("--points: {} is no point in m with its place in px; write x,y,z:u,v, such as 0,0,2.5:310,84", shown(part, 60)));
  return value;
}

}  // namespace

std::vector<MarkedPoint> marked_points(const std::string& text) {
  std::vector<MarkedPoint> points;
  for (std::size_t from = 0; from < text.size();) {
    const std::size_t to = std::min(text.find(';', from), text.size());
    const std::string part = text.substr(from, to - from);
    from = to + 1;
    std::size_t at = 0;
    MarkedPoint point;
    point.at.x() = number_in(part, at, ',', part), point.at.y() = number_in(part, at, ',', part);
    point.at.z() = number_in(part, at, ':', part), point.u = number_in(part, at, ',', part);
    point.v = number_in(part, at, 0, part);
    points.push_back(point);
  }
  if (points.size() < 4) throw Error(fmt::format("--points has {} of the four points that a camera takes; mark more", points.size()));
  return points;
}

FoundCamera camera_from(const std::vector<MarkedPoint>& points, int width, int height, std::optional<double> fov) {
  Eigen::MatrixXd spread(3, Eigen::Index(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i) spread.col(Eigen::Index(i)) = points[i].at - points.front().at;
  const Eigen::VectorXd sizes = spread.jacobiSvd().singularValues();
  if (!(sizes[1] > 1e-3 * sizes[0])) throw Error("--points: all points lie on one line, which leaves the camera open; mark others");
  Pinhole best;
  double least = HUGE_VAL;
  for (const double angle : fov ? std::vector<double>{*fov} : std::vector<double>{0.35, 0.6, 1.0})
    for (int azimuth = 0; azimuth < 12; ++azimuth)
      for (const double elevation : {0.1, 0.6}) {
        Pinhole camera = start_of(points, height, azimuth * pi / 6, elevation, 0.5 * height / std::tan(0.5 * angle));
        const double miss = refine(camera, points, width, height, !fov);
        if (miss < least) least = miss, best = camera;
      }
  if (!std::isfinite(least)) throw Error("--points: no camera sees these points in these places; check that each is in m and px");
  FoundCamera found;
  found.residual = least;
  found.camera.name = "points";
  found.camera.eye = best.eye;
  found.camera.target = best.eye - (best.eye - points.front().at).norm() * Vec3(best.turn.row(2));
  found.camera.up = best.turn.row(1);
  found.camera.fov = 2 * std::atan(0.5 * height / std::exp(best.log_focal));
  return found;
}

}  // namespace erbs::render
