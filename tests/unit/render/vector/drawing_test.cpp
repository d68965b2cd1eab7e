// Line drawings: hidden parts of lines against closed forms and against rays, and the SVG of a run.
#include "render/vector/drawing.h"

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>

#include "engine/base/error.h"
#include "engine/base/units.h"
#include "tests/support/folder.h"
#include "tests/support/text_of.h"
#include "tests/unit/render/brick_house.h"

using namespace erbs;
using namespace erbs::render;
namespace fs = std::filesystem;

namespace {

Camera camera_at(const Vec3& eye, const Vec3& target) {
  Camera camera;
  camera.eye = eye, camera.target = target, camera.fov = 40 * pi / 180;
  return camera;
}

double length_of(const std::vector<Piece>& pieces) {
  double sum = 0;
  for (const Piece& p : pieces) sum += (p.to - p.from).norm();
  return sum;
}

using FaceCorners = std::vector<Vec3>;

// Faces of a turned box.
std::vector<FaceCorners> box(const Vec3& at, const Vec3& half, const Quat& turn) {
  std::vector<FaceCorners> faces;
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-1.0, 1.0}) {
      const Vec3 out = side * Vec3::Unit(axis), u = Vec3::Unit((axis + 1) % 3), v = out.cross(u);
      FaceCorners loop;
      for (const auto& [s, t] : {std::pair{1, 1}, {-1, 1}, {-1, -1}, {1, -1}})
        loop.push_back(at + turn * (out + s * u + t * v).cwiseProduct(half));
      faces.push_back(loop);
    }
  return faces;
}

std::size_t count(const std::string& text, const std::string& word) {
  std::size_t n = 0;
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++n;
  return n;
}

}  // namespace

TEST_CASE("a square hides its shadow of a line behind it", "[render][drawing]") {
  const bool parallel = GENERATE(true, false);
  const double behind = GENERATE(0.5, 2.0, 7.0), half = GENERATE(0.2, 0.8);
  const Projection projection(camera_at({0, -10, 0}, {0, 0, 0}), parallel, 800, 600, 0, 0);
  HiddenLines lines(projection, 800, 600, 1e-4);
  lines.add_face({{-half, 0, -half}, {half, 0, -half}, {half, 0, half}, {-half, 0, half}}, 0);
  const double scale = projection.pixels_per_metre(), farther = parallel ? 1 : 10 / (10 + behind);
  const Vec3 left(-2, behind, 0.1), right(2, behind, 0.1);
  CHECK(length_of(lines.visible(left, right, -1)) == Approx(4 * scale * farther - 2 * half * scale).epsilon(1e-9));
  CHECK(lines.visible(left, right, -1).size() == 2);
  CHECK(length_of(lines.visible(left, right, 0)) == Approx(4 * scale * farther).epsilon(1e-9));                // its own body
  CHECK(length_of(lines.visible({-2, -1, 0.1}, {2, -1, 0.1}, -1)) > 4 * scale * 0.999);                        // before it
  CHECK(length_of(lines.visible({-half, 0, 0}, {half, 0, 0}, -1)) == Approx(2 * half * scale).epsilon(1e-9));  // on it
  // A line through the square: its half before it is seen.
  const double seen = length_of(lines.visible({0, -1, 0}, {0, 1, 0.05}, -1));
  CHECK(seen < length_of(lines.visible({0, -1, 0}, {0, 1, 0.05}, 0)));
}

TEST_CASE("visible parts of lines among boxes are those that rays reach", "[render][drawing]") {
  const bool parallel = GENERATE(true, false);
  std::mt19937 random(parallel ? 5 : 6);
  std::uniform_real_distribution<double> any(-1, 1);
  const Camera camera = camera_at({4, -9, 5}, {0, 0, 0});
  const Projection projection(camera, parallel, 640, 480, 0, 0);
  HiddenLines lines(projection, 640, 480, 1e-5);
  std::vector<std::vector<FaceCorners>> boxes;
  for (int k = 0; k < 25; ++k) {
    const Quat turn = Quat(any(random), any(random), any(random), any(random)).normalized();
    boxes.push_back(box(2 * Vec3(any(random), any(random), any(random)), Vec3(0.4, 0.25, 0.15), turn));
    for (const FaceCorners& face : boxes.back()) lines.add_face(face, k);
  }
  const auto covered = [&](const Vec3& p) {  // by the faces between it and the eye; also how nearly
    const Vec3 way = parallel ? Vec3(100 * projection.back()) : Vec3(camera.eye - p);
    bool hidden = false, close = false;
    for (const std::vector<FaceCorners>& body : boxes)
      for (const FaceCorners& face : body) {
        const Vec3 n = (face[1] - face[0]).cross(face[2] - face[0]).normalized();
        const double s = (face[0] - p).dot(n) / way.dot(n);
        if (!(s > 0) || s * way.norm() > 50) continue;
        const Vec3 hit = p + s * way;
        double inside = HUGE_VAL;
        for (std::size_t i = 0; i < face.size(); ++i)
          inside = std::min(inside, n.cross(face[(i + 1) % face.size()] - face[i]).normalized().dot(hit - face[i]));
        close = close || std::fabs(inside) < 0.02;
        hidden = hidden || inside > 0;
      }
    return std::pair(hidden, close);
  };
  int compared = 0;
  for (int k = 0; k < 60; ++k) {
    const Vec3 p = 2.2 * Vec3(any(random), any(random), any(random)), q = 2.2 * Vec3(any(random), any(random), any(random));
    const std::vector<Piece> pieces = lines.visible(p, q, -1);
    for (int i = 1; i < 40; ++i) {
      const Vec3 at = p + (q - p) * i / 40;
      const auto [hidden, close] = covered(at);
      const Eigen::Vector2d px = projection.see(projection.in_camera(at)).at;
      bool seen = false, near_end = false;
      for (const Piece& piece : pieces) {
        const double s = (px - piece.from).dot(piece.to - piece.from) / (piece.to - piece.from).squaredNorm();
        seen = seen || (s >= 0 && s <= 1);
        near_end = near_end || (px - piece.from).norm() < 2 || (px - piece.to).norm() < 2;
      }
      if (close || near_end || px.x() < 0 || px.y() < 0 || px.x() > 640 || px.y() > 480) continue;
      ++compared;
      CHECK(seen != hidden);
    }
  }
  CHECK(compared > 1000);
}

TEST_CASE("the face that is seen at a point is the nearest one, at its angle", "[render][drawing]") {
  const bool parallel = GENERATE(true, false);
  const Projection projection(camera_at({0, -10, 0}, {0, 0, 0}), parallel, 800, 600, 0, 0);
  HiddenLines lines(projection, 800, 600, 1e-4);
  lines.add_face({{-1, 0, -1}, {1, 0, -1}, {1, 0, 1}, {-1, 0, 1}}, 0);
  lines.add_face({{0, 2, -1}, {2, 2, -1}, {2, 2, 1}, {0, 2, 1}}, 1);          // partly behind it
  lines.add_face({{-1, 0, -1}, {-1, 0, 1}, {-1.2, 3, 1}, {-1.2, 3, -1}}, 2);  // a side seen nearly from its edge
  const auto at = [&](const Vec3& p) { return lines.sight(projection.see(projection.in_camera(p)).at); };
  REQUIRE(at({0.5, 0, 0.5}));
  CHECK(projection.depth_of(at({0.5, 0, 0.5})->near) == Approx(10));
  CHECK(at({0.5, 0, 0.5})->facing == Approx(1).margin(0.01));
  REQUIRE(at({1.7, 2, 0.5}));
  CHECK(projection.depth_of(at({1.7, 2, 0.5})->near) == Approx(12));
  CHECK_FALSE(at({-3, 0, 0}));
  if (!parallel) return;
  REQUIRE(at({-1.1, 1.5, 0}));
  CHECK(at({-1.1, 1.5, 0})->facing == Approx(std::sin(std::atan(0.2 / 3))).epsilon(1e-6));
}

TEST_CASE("the width of a crack tells a tenth of a millimetre from one, from ten and from a hundred", "[render][drawing]") {
  double before = crack_width(0);
  CHECK(before > 0.5);
  CHECK(crack_width(-1) == before);
  for (const double opening : {1e-4, 1e-3, 1e-2, 1e-1}) {
    CHECK(crack_width(opening) > before + 0.25);
    before = crack_width(opening);
  }
}

TEST_CASE("a line drawing shows outlines, cracks by state, legend and scale", "[render][drawing]") {
  const test::Folder dir;
  write_brick_house(dir.path.string(), {1.525, 1.83, 40, 3, 0.1});
  const Run run = read_run(dir.path.string());
  const MotionReader reader(dir.path.string());
  Movie movie;
  movie.quiet = true, movie.svg = true;
  movie.cameras = {"corner", "from_-y"};
  movie.stills = {0.0, 1.9};
  REQUIRE(make_drawings(run, reader, movie, std::atomic<bool>{false}));
  const std::string still = test::text_of(dir.path / "frames/from_-y_t0.000s.svg"),
                    later = test::text_of(dir.path / "frames/corner_t1.900s.svg");
  for (const std::string& svg : {still, later}) {
    CHECK(svg.starts_with("<?xml"));
    CHECK(count(svg, "<svg") == 1);
    CHECK(svg.ends_with("</svg>\n"));
    CHECK(count(svg, "<g") == count(svg, "</g>"));
    CHECK(count(svg, "nan") == 0);
    CHECK(svg.find("data-name=\"outlines\"") != std::string::npos);
    CHECK(svg.find("opening of the joint") != std::string::npos);
    CHECK(svg.find(" mm</text>") != std::string::npos);
    CHECK(svg.find(" cm</text>") != std::string::npos);
  }
  CHECK(still.find("data-name=\"open joints\"") == std::string::npos);  // nothing has cracked yet
  CHECK(later.find("data-name=\"open joints\"") != std::string::npos);
  CHECK_THROWS_WITH(make_drawings(run, reader, movie, std::atomic<bool>{false}), Catch::Contains("--force"));
  movie.force = true, movie.stills = {99};
  CHECK_THROWS_WITH(make_drawings(run, reader, movie, std::atomic<bool>{false}), Catch::Contains("not within the run"));
}

TEST_CASE("lines of a wall seen nearly from its edge do not merge to a grey stripe", "[render][drawing]") {
  const test::Folder dir;
  write_brick_house(dir.path.string(), {1.525, 1.83, 40, 3, 0.1});
  const Run run = read_run(dir.path.string());
  const MotionReader reader(dir.path.string());
  const MotionFrame frame = reader.read(0);
  const Show show = prepare_show(reader.scene(), run, {frame});
  Look look;
  look.width = 960, look.height = 600;
  const double x = GENERATE(-1.0, -0.4, 2.2);  // of the eye: walls along y are seen at different angles
  const DrawnInstant instant{run, show, reader.scene(), look, camera_at({x, -9, 1.2}, {0.76, 0.9, 1.2}), false, frame, std::nullopt, {}};
  std::size_t contours = 0;
  for (const LineGroup& group : lines_of(instant)) {
    if (group.name == "outlines") contours += group.pieces.size();
    if (group.name != "edges of faces seen aslant") continue;
    const double apart = 2.6 * look.height / 720;
    std::vector<Piece> upright;  // edges of bricks one beside the other
    for (const Piece& p : group.pieces)
      if (std::fabs(p.to.x() - p.from.x()) < 0.1 * std::fabs(p.to.y() - p.from.y()) && (p.to - p.from).norm() > 2 * apart)
        upright.push_back(p);
    int beside = 0;
    for (const Piece& p : upright)
      for (const Piece& q : upright) {
        const double y = 0.5 * (p.from.y() + p.to.y());
        const bool same_height = (y - q.from.y()) * (y - q.to.y()) < 0;
        const double away = std::fabs(0.5 * (p.from.x() + p.to.x()) - 0.5 * (q.from.x() + q.to.x()));
        beside += &p != &q && same_height && away < 0.8 * apart;
      }
    CHECK(beside <= static_cast<int>(upright.size()) / 20);
  }
  CHECK(contours > 4);
}
