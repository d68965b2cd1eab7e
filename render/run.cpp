#include "render/run.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "engine/base/error.h"
#include "engine/record/run_folder.h"

namespace erbs::render {
namespace {

GroundRecord strongest_component(const CsvTable& histories) {
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

}  // namespace

Run read_run(const std::string& dir) {
  const std::string manifest = run_file(dir, "manifest.json"), histories = run_file(dir, "histories.csv");
  if (!std::filesystem::exists(manifest)) throw Error("no manifest.json in it; give the folder of a run, e.g. runs/first", {dir, 0});
  const Manifest m = read_manifest(dir);
  Run run;
  run.dir = dir;
  run.name = m.scene_name;
  run.title = m.title.empty() ? m.scene_name : m.title;
  while (!run.title.empty() && run.title.back() == '.') run.title.pop_back();  // a heading, no sentence
  run.cameras = m.cameras;
  for (const Camera& c : run.cameras)
    if (!((c.eye - c.target).norm() > 1e-9 && c.fov > 0 && c.fov < pi))
      throw Error(fmt::format("camera {} looks nowhere; its eye and target must differ and 0 < fov < 180 deg", c.name), {manifest, 0});
  for (const Material& a : m.materials) run.materials.push_back({a.name, a.color});
  if (const Json* gate = find_key(m.settings, "analysis.energy_gate.value"); gate && gate->is_number())
    run.energy_gate = gate->get<double>();
  if (std::filesystem::exists(histories)) run.record = strongest_component(read_csv(histories));
  return run;
}

}  // namespace erbs::render
