// The cameras that a movie asks for.
#include <algorithm>

#include "engine/base/error.h"
#include "engine/base/text.h"
#include "render/movie/movie.h"
#include "render/run/framing.h"

namespace erbs::render {
namespace {

Camera own_camera(const Movie& movie, const Stage& stage) {
  Camera camera;
  camera.name = "own";
  camera.eye = *movie.eye;
  camera.target = movie.target.value_or(stage.building.center());
  camera.fov = movie.fov * pi / 180;
  const Vec3 back = camera.eye - camera.target;
  if (!(back.norm() > 1e-9)) throw Error("--eye and --target are the same point, so that the camera looks nowhere; move one of them");
  if (back.cross(camera.up).norm() < 1e-6 * back.norm()) camera.up = Vec3(0, 1, 0);
  return camera;
}

// A list of names with commas between them. A name may hold commas itself: the longest that is known comes first.
std::vector<std::string> names_in(const std::string& list, const std::vector<Camera>& known) {
  std::vector<std::string> names;
  for (std::size_t at = 0; at <= list.size();) {
    std::size_t end = std::min(list.find(',', at), list.size());
    for (const Camera& camera : known) {
      const std::size_t here = at + camera.name.size();
      const bool whole =
          here <= list.size() && list.compare(at, camera.name.size(), camera.name) == 0 && (here == list.size() || list[here] == ',');
      if (whole) end = std::max(end, here);
    }
    names.push_back(list.substr(at, end - at));
    at = end + 1;
  }
  return names;
}

}  // namespace

std::vector<Camera> chosen_cameras(const Run& run, const Stage& stage, const Movie& movie, double aspect) {
  if (movie.camera) return {*movie.camera};
  if (movie.eye) return {own_camera(movie, stage)};
  if (!movie.path.empty()) {
    Camera moving;
    moving.name = "path";
    moving.fov = movie.fov * pi / 180;
    return {moving};
  }
  std::vector<Camera> all = run.cameras.empty() ? choose_cameras(stage, aspect) : run.cameras;
  if (movie.cameras.empty()) return movie.split ? all : std::vector<Camera>{all.front()};
  const std::size_t own = all.size();
  for (const Camera& one : elevations(stage, aspect)) all.push_back(one);
  std::vector<Camera> chosen;
  std::vector<std::string> names;
  for (const std::string& list : movie.cameras)
    for (const std::string& name : names_in(list, all)) names.push_back(name);
  for (const std::string& name : names) {
    const std::size_t before = chosen.size();
    for (std::size_t i = 0; i < all.size(); ++i)
      if ((name == "all" && i < own) || all[i].name == name) chosen.push_back(all[i]);
    if (chosen.size() > before) continue;
    std::string known;
    for (const Camera& c : all) known += (known.empty() ? " " : ", ") + c.name;
    throw Error("--camera " + shown(name, 60) + " is none of this run's:" + known + " (or all)");
  }
  return chosen;
}

std::size_t cameras_of(const Run& run, const Movie& movie) { return chosen_cameras(run, set_stage({}, {}), movie, 1).size(); }

void fit_cameras(std::vector<Camera>& cameras, const Run& run, const Stage& stage, const MotionScene& drawn, double aspect,
                 const std::vector<double>& times, const std::function<MotionFrame(double)>& frame) {
  std::vector<Framing> framings;
  for (const Camera& camera : cameras) framings.emplace_back(camera, camera.eye - camera.target, stage, aspect, 0.02);
  for (const double t : times) {
    Eigen::Isometry3d position = Eigen::Isometry3d::Identity();
    if (!stage.positions.empty()) position = table_position(stage, levelling(run.gravity, t));
    for (const Vec3& corner : visible_corners(drawn, stage, frame(t)))
      for (Framing& framing : framings) framing.add(position * corner);
  }
  for (std::size_t k = 0; k < cameras.size(); ++k) cameras[k] = framings[k].camera();
}

}  // namespace erbs::render
