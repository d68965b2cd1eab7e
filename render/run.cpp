#include "render/run.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include "engine/record/json.h"

#include "engine/base/error.h"
#include "render/table.h"

namespace erbs::render {
namespace {

using Json = nlohmann::json;

Vec3 vector_of(const Json& j) { return {j.at(0).get<double>(), j.at(1).get<double>(), j.at(2).get<double>()}; }

GroundRecord strongest_component(const Table& histories) {
  GroundRecord best;
  const int time = histories.find("time_s");
  if (time < 0) return best;
  for (const std::string axis : {"x", "y", "z"}) {
    const int column = histories.find("ground_a" + axis + "_m_s2");
    if (column < 0) continue;
    const std::vector<double>& a = histories.columns[static_cast<std::size_t>(column)];
    double peak = 0;
    for (double value : a) peak = std::max(peak, std::abs(value));
    if (peak > best.peak) best = {axis, histories.columns[static_cast<std::size_t>(time)], a, peak};
  }
  return best;
}

void read_manifest(const Json& j, Run& run) {
  const Json& scene = j.at("scene");
  run.name = scene.value("name", run.name);
  run.title = scene.value("title", run.name);
  if (run.title.empty()) run.title = run.name;
  for (const Json& c : j.value("cameras", Json::array())) {
    Camera camera;
    camera.name = c.value("name", fmt::format("camera{}", run.cameras.size() + 1));
    camera.eye = vector_of(c.at("eye"));
    camera.target = vector_of(c.at("target"));
    if (c.contains("up")) camera.up = vector_of(c.at("up"));
    camera.fov = c.value("fov_rad", camera.fov);
    run.cameras.push_back(camera);
  }
  for (const Json& m : j.value("materials", Json::array())) {
    Paint paint;
    paint.name = m.value("name", "");
    if (m.contains("color")) paint.color = vector_of(m.at("color"));
    run.materials.push_back(paint);
  }
  if (j.contains("energy_gate") && j.at("energy_gate").is_number()) run.energy_gate = j.at("energy_gate").get<double>();
}

}  // namespace

Run read_run(const std::string& dir) {
  const std::filesystem::path folder(dir), manifest = folder / "manifest.json";
  Run run;
  run.dir = dir;
  std::ifstream in(manifest);
  if (!in) throw Error("no manifest.json in it; give the folder of a run, e.g. runs/first", {dir, 0});
  // The folder's own name stands in for a scene's: works for "runs/first/" too.
  run.name = std::filesystem::weakly_canonical(folder).filename().string();
  try {
    read_manifest(Json::parse(in), run);
  } catch (const Json::exception& e) { throw Error(fmt::format("is damaged ({}); run the scene again", e.what()), {manifest.string(), 0}); }
  for (const Camera& c : run.cameras)
    if ((c.eye - c.target).norm() < 1e-9 || c.fov <= 0 || c.fov >= pi)
      throw Error(fmt::format("camera {} looks nowhere; its eye and target must differ and 0 < fov < 180 deg", c.name),
                  {manifest.string(), 0});
  run.record = strongest_component(read_table((folder / "histories.csv").string()));
  return run;
}

}  // namespace erbs::render
