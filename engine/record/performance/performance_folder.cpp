#include "engine/record/performance/performance_folder.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "engine/base/error.h"
#include "engine/record/format/csv.h"

namespace erbs {
namespace {

const std::vector<std::string> shape_columns{"block", "group", "mass_kg", "height_m", "elastic_displacement_m", "peak_displacement_m"};

CsvTable read_file(const std::string& dir, const std::string& name) {
  const auto there = [&](const char* file) { return std::filesystem::is_regular_file(dir + "/" + file); };
  if (!there(name.c_str()) && !there("curve.csv"))
    throw Error(
        "there is no curve.csv: a capacity curve belongs to a push, and this run is a time history; run its scene with analysis{ kind = "
        "\"pushover\" }, which "
        "takes no duration and constant loads only",
        {dir});
  if (!there(name.c_str()))
    throw Error(fmt::format("there is no {} of a pushover; name the folder of a finished run with analysis{{ kind = \"pushover\" }}", name),
                {dir});
  return read_csv(dir + "/" + name);
}

}  // namespace

void write_shape(const std::string& dir, const PushShape& shape) {
  CsvWriter file(dir + "/shape.csv", shape_columns);
  const auto row = [&](const std::string& name, const std::string& group, double mass, double height, double elastic, double peak) {
    file.text_row({name, group, fmt::format("{}", mass), fmt::format("{}", height), fmt::format("{}", elastic), fmt::format("{}", peak)});
  };
  row("monitored point", "monitored point", 0, 0, shape.elastic, shape.peak);
  for (const ShapeBlock& b : shape.blocks) row(b.name, b.group, b.mass, b.height, b.elastic, b.peak);
  file.flush();
}

PushShape read_shape(const std::string& dir) {
  const CsvTable table = read_file(dir, "shape.csv");
  const auto text = [&](const char* name) -> const std::vector<std::string>& { return table.text[std::size_t(table.find(name))]; };
  PushShape shape;
  if (table.names != shape_columns || table.rows() < 2) throw Error("shape.csv is damaged; run the scene again", {dir});
  const std::vector<std::string>&name = text("block"), &group = text("group");
  const std::vector<double>&mass = table.column("mass_kg"), &height = table.column("height_m");
  const std::vector<double>&elastic = table.column("elastic_displacement_m"), &peak = table.column("peak_displacement_m");
  shape.elastic = elastic[0], shape.peak = peak[0];
  for (std::size_t i = 1; i < table.rows(); ++i)
    shape.blocks.push_back({name[i], group.empty() ? "" : group[i], mass[i], height[i], elastic[i], peak[i]});
  return shape;
}

BaseShearCurve read_base_shear_curve(const std::string& dir) {
  const CsvTable table = read_file(dir, "curve.csv"), times = read_file(dir, "histories.csv");
  if (!table.names.empty() && table.names.front() == "multiplier_tan")
    throw Error("this is the curve of a tilt, and a performance point belongs to a pushover; take analysis{ kind = \"pushover\" }", {dir});
  if (times.rows() < table.rows()) throw Error("histories.csv has fewer rows than curve.csv; run the scene again", {dir});
  BaseShearCurve curve;
  if (table.rows() == 0) return curve;
  const std::vector<double>&u = table.column("displacement_m"), &shear = table.column("base_shear_N");
  for (std::size_t i = 0; i < table.rows(); ++i) {
    if (i > 0 && !(u[i] - u[0] > curve.displacement.back())) continue;  // a path to and fro: the backbone alone
    curve.displacement.push_back(u[i] - u[0]);
    curve.shear.push_back(shear[i] - shear[0]);
    curve.multiplier.push_back(table.columns[0][i]);
    curve.time.push_back(times.columns[0][i]);
    if (curve.shear.back() > curve.shear[std::size_t(curve.peak)]) curve.peak = int(curve.shear.size()) - 1;
  }
  return curve;
}

std::string own_performance(const std::string& dir) { return dir + "/performance.json"; }

std::string performance_of_spectrum(const std::string& dir, const DesignSpectrum& spectrum) {
  std::string name = "performance";
  bool between = true;
  for (const char c : spectrum_name(spectrum)) {
    const bool kept = std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '.';
    if (kept && between) name += '_';
    if (kept) name += char(std::tolower(static_cast<unsigned char>(c)));
    between = !kept;
  }
  return dir + "/" + name + ".json";
}

Performance evaluate_performance(const std::string& dir, const PerformanceDemand& demand, const std::string& path) {
  const BaseShearCurve curve = read_base_shear_curve(dir);
  const Performance p = performance_of(curve, read_shape(dir), demand);
  Json json = to_json(p);
  json["oscillator"] = {{"displacement_m", p.D}, {"n2_acceleration_m_s2", p.n2.A}, {"mpp_acceleration_m_s2", p.mpp.A}};
  write_json(path, json);
  return p;
}

}  // namespace erbs
