#include "engine/record/report/report.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <map>

#include "engine/base/error.h"
#include "engine/base/text.h"
#include "engine/record/folder/run_folder.h"
#include "engine/record/format/json.h"
#include "engine/record/report/fill.h"
#include "engine/record/report/pack.h"

namespace erbs {
namespace {

namespace fs = std::filesystem;

CsvTable table_of(const std::string& dir, const char* name) {
  const std::string path = run_file(dir, name);
  if (!fs::exists(path) || fs::file_size(path) == 0) return {};
  return read_csv(path);
}

// Numbers and words of a column as JSON.
Json cell(const CsvTable& table, int column, std::size_t row) {
  if (column < 0) return nullptr;
  const auto c = static_cast<std::size_t>(column);
  if (!table.text[c].empty()) return for_files(table.text[c][row]);
  const double value = table.columns[c][row];
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

// What happens to the structure stays, all of it (lua/page/data.js marks it); what happens to a joint can be much.
void take_events(const CsvTable& table, ReportedRun& run) {
  const char* names[] = {"time_s", "event", "name", "value", "unit"};
  std::size_t common = 0;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    Json event = Json::array();
    for (const char* name : names) event.push_back(cell(table, table.find(name), row));
    bool rare = false;
    for (const char* kind : {"collapse", "fall", "hinge", "slide", "part"}) rare = rare || event[1] == kind;
    if (!rare && ++common > most_events_of_a_page) ++run.events_left_out;
    else run.events.push_back(std::move(event));
  }
}

double rounded(double value) { return std::round(1e6 * value) / 1e6; }  // to 1 um

Json shape_json(const MotionScene& scene, const std::vector<int>& parts) {
  const DrawnTriangles triangles = triangles_of(scene, parts);
  Json vertices = Json::array();
  for (const float v : triangles.vertices) vertices.push_back(rounded(v));
  return {{"vertices", vertices}, {"index", triangles.index}};
}

// Shapes are shared: blocks of equal parts name one.
Json scene_json(const ExportedRun& run) {
  Json shapes = Json::array(), blocks = Json::array(), joints = Json::array();
  std::map<std::vector<int>, std::size_t> known;
  for (std::size_t b = 0; b < run.scene.blocks.size(); ++b) {
    const MotionBlock& block = run.scene.blocks[b];
    const auto [shape, fresh] = known.try_emplace(block.parts, shapes.size());
    if (fresh) shapes.push_back(shape_json(run.scene, block.parts));
    blocks.push_back({for_files(run.name(static_cast<int>(b))), for_files(block.group), block.material, block.fixed ? 1 : 0, shape->second,
                      rounded(block.rest.x()), rounded(block.rest.y()), rounded(block.rest.z())});
  }
  for (const MotionJoint& joint : run.scene.joints) joints.push_back({joint.a, joint.b});
  return {{"shapes", shapes}, {"blocks", blocks}, {"joints", joints}};
}

Json table_json(const CsvTable& table) { return {{"names", table.names}, {"rows", table.rows()}}; }

// Of the curve of a push, as text. `column`: name of its multiplier, which ends with its unit.
std::vector<std::pair<std::string, std::string>> push_answers(const Json& metrics, const std::string& column) {
  std::vector<std::pair<std::string, std::string>> answers;
  const auto add = [&](const char* what, const char* key, double factor, const char* unit) {
    if (const Json* value = find_key(metrics, key); value && value->is_number())
      answers.emplace_back(what, fmt::format("{:.4g}{}", factor * value->get<double>(), unit));
  };
  const bool tilts = column == "multiplier_tan";
  const char* unit = column == "multiplier_g" ? " g" : tilts ? "" : " of the load pattern";
  add(tilts ? "largest tilt" : "", "capacity.angle_deg", 1, " deg");
  add(tilts ? "its tangent" : "largest multiplier of the load", "capacity.multiplier", 1, unit);
  add(tilts ? "tangent without equilibrium" : "multiplier without equilibrium", "capacity.upper", 1, unit);
  add("displacement of the monitored point there", "capacity.displacement_m", 1000, " mm");
  add("base shear there", "capacity.base_shear_N", 1e-3, " kN");
  add("base shear over weight", "capacity.base_shear_over_weight", 100, " %");
  add("performance point (N2), displacement of the monitored point", "capacity.performance.n2.displacement_m", 1000, " mm");
  if (const Json* course = find_key(metrics, "capacity.mechanism_text");
      course && course->is_string() && !course->get<std::string>().empty())
    answers.emplace_back("mechanism", course->get<std::string>());
  return answers;
}

// The multiplier of each state, and its unit: the replay of a push names states in place of times. null for a run that is no push.
Json push_json(const CsvTable& curve) {
  if (curve.names.empty() || !curve.names.front().starts_with("multiplier")) return nullptr;
  const std::string unit = curve.names.front().substr(std::min(curve.names.front().size(), std::string("multiplier_").size()));
  return {{"unit", unit}, {"multipliers", curve.columns.front()}};
}

// A section of the page; "" for a run that is no push.
std::string capacity_html(const ReportedRun& run) {
  if (run.push_curve.names.empty() || (run.push_answers.empty() && run.push_figures.empty())) return "";
  std::string html = "<section aria-labelledby=\"capacity-title\">\n<h2 id=\"capacity-title\">Capacity</h2>\n<div class=\"cards\">\n";
  for (const auto& [what, value] : run.push_answers)
    html += fmt::format("<div class=\"card\"><span class=\"quiet\">{}</span><strong>{}</strong></div>\n", safe_html(what),
                        safe_html(for_files(value)));
  html += "</div>\n<div class=\"columns\">\n";
  for (const auto& [name, svg] : run.push_figures)
    html += fmt::format("<figure class=\"push\"><img alt=\"{0}\" src=\"data:image/svg+xml;base64,{1}\"></figure>\n",
                        name == "curve.svg" ? "Multiplier of the load over the displacement of the monitored point"
                                            : "Capacity and demand, with the performance point",
                        base64(svg));
  return html +
         "</div>\n<p class=\"quiet\">The replay above shows the states of equilibrium one after another, and then the fall, if there is "
         "one.</p>\n</section>\n";
}

}  // namespace

ReportedRun read_reported_run(const std::string& dir) {
  ReportedRun out;
  if (fs::exists(run_file(dir, "manifest.json")) && fs::exists(run_file(dir, "motion.h5"))) {
    const MotionReader reader(dir);
    const std::size_t poses = reader.times().size() * reader.scene().blocks.size();
    out.every = static_cast<int>(std::max<std::size_t>(1, (poses + most_poses_of_a_page - 1) / most_poses_of_a_page));
  }
  const double all = std::numeric_limits<double>::infinity();
  out.run = read_exported_run(dir, -all, all, out.every);
  out.manifest = read_json(run_file(dir, "manifest.json"));
  if (const std::string path = run_file(dir, "metrics.json"); fs::exists(path)) out.metrics = read_json(path);
  const CsvTable histories = table_of(dir, "histories.csv");
  out.history_rows = histories.rows();
  out.histories = thinned(histories);
  out.energy = thinned(table_of(dir, "energy.csv"));
  take_events(table_of(dir, "events.csv"), out);
  if (fs::exists(run_file(dir, "curve.csv"))) {
    for (const char* name : {"curve.svg", "performance.svg"})
      if (const std::string path = run_file(dir, name); fs::exists(path)) out.push_figures.emplace_back(name, whole_text(path));
    out.push_curve = table_of(dir, "curve.csv");
    out.push_answers = push_answers(out.metrics, out.push_curve.names.empty() ? "" : out.push_curve.names.front());
  }
  for (const char* name : {"histories.csv", "energy.csv", "events.csv", "metrics.json", "manifest.json", "curve.csv", "performance.json",
                           "scene.lua", "log.txt", "motion.h5", "studies/report.html"})
    if (fs::exists(run_file(dir, name))) out.files.push_back(name);
  return out;
}

std::string report_html(const ReportedRun& run, const ReportPage& page, const std::string& folder) {
  Json data = scene_json(run.run);
  Json times = Json::array();
  for (const MotionFrame& frame : run.run.frames) times.push_back(frame.t);
  data["times"] = times;
  data["every"] = run.every;
  data["rotation_step"] = rotation_step;
  data["folder"] = for_files(folder);
  data["files"] = run.files;
  data["histories"] = table_json(run.histories);
  data["energy"] = table_json(run.energy);
  data["history_rows"] = run.history_rows;
  data["events"] = run.events;
  data["events_left_out"] = run.events_left_out;
  data["manifest"] = run.manifest;
  for (std::size_t m = 0; m < run.run.manifest.materials.size(); ++m) {
    const Vec3& color = run.run.manifest.materials[m].color;
    data["manifest"]["materials"][m]["color"] = {color.x(), color.y(), color.z()};
  }
  data["metrics"] = run.metrics;
  if (const Json* fell = find_key(run.metrics, "collapse.time_s"); fell && fell->is_number())
    data["collapse_when"] = span_of_event(run.run.manifest, fell->get<double>());
  data["push"] = push_json(run.push_curve);
  const auto packed = [](const std::string& bytes) { return base64(deflated(bytes)); };
  const std::string& title = run.run.manifest.title.empty() ? run.run.manifest.scene_name : run.run.manifest.title;
  return filled(page.html, {{"title", safe_html(for_files(title))},
                            {"style", std::string(page.style)},
                            {"script", std::string(page.script)},
                            {"run", safe_json(data)},
                            {"poses", packed(pose_bytes(run.run.frames, run.run.scene.blocks.size()))},
                            {"damage", packed(damage_bytes(run.run.frames, run.run.scene.joints.size()))},
                            {"histories", packed(column_bytes(run.histories))},
                            {"capacity", capacity_html(run)},
                            {"energy", packed(column_bytes(run.energy))}});
}

}  // namespace erbs
