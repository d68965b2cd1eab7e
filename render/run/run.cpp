#include "render/run/run.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "engine/base/error.h"
#include "engine/base/units.h"
#include "engine/record/folder/colors.h"
#include "engine/record/folder/run_folder.h"

namespace erbs::render {
namespace {

// "x", "-y" reads "y", any other direction "22° from x" and, if it is not level, "22° from x, 35° up".
std::string axis_name(const Vec3& d) {
  for (int i = 0; i < 3; ++i)
    if (std::fabs(d[i]) > 0.9995) return std::string(1, "xyz"[i]);
  const double level = std::hypot(d.x(), d.y()), sign = d.x() < 0 ? -1 : 1;
  const std::string along = fmt::format("{:.0f}\u00b0 from x", std::atan2(sign * d.y(), sign * d.x()) * 180 / pi);
  const double up = std::round(sign * std::atan2(d.z(), level) * 180 / pi);
  return up == 0 ? along : fmt::format("{}, {:.0f}\u00b0 {}", along, std::fabs(up), up > 0 ? "up" : "down");
}

// The part of a vector along its principal direction, in which the sum of its squares is greatest.
GroundRecord along_principal(const std::vector<double>& t, const std::vector<Vec3>& values) {
  GroundRecord out;
  Mat3 squares = Mat3::Zero();
  for (const Vec3& value : values) squares += value * value.transpose();
  if (!(squares.trace() > 0)) return out;
  Vec3 direction = Eigen::SelfAdjointEigenSolver<Mat3>(squares).eigenvectors().col(2);
  int largest = 0;
  direction.cwiseAbs().maxCoeff(&largest);
  if (direction[largest] < 0) direction = -direction;
  out.axis = axis_name(direction), out.direction = direction, out.t = t;
  for (const Vec3& value : values) {
    out.a.push_back(value.dot(direction));
    out.peak = std::max(out.peak, std::fabs(out.a.back()));
  }
  return out;
}

// Columns NAMEx_m_s2, NAMEy_m_s2 and NAMEz_m_s2, row by row; what is absent or not finite is zero.
std::vector<Vec3> vectors_of(const CsvTable& histories, const std::string& name) {
  std::vector<Vec3> out(histories.rows(), Vec3::Zero());
  for (int i = 0; i < 3; ++i)
    if (const int column = histories.find(name + "xyz"[i] + "_m_s2"); column >= 0)
      for (std::size_t row = 0; row < out.size(); ++row)
        if (const double value = histories.columns[static_cast<std::size_t>(column)][row]; std::isfinite(value)) out[row][i] = value;
  return out;
}

GravityRecord gravity_of(const std::vector<double>& t, const CsvTable& histories) {
  GravityRecord out;
  const std::vector<Vec3> values = vectors_of(histories, "gravity_a");
  for (std::size_t row = 0; row < values.size(); ++row)
    if (values[row].norm() > 0) out.t.push_back(t[row]), out.g.push_back(values[row]);
  return out;
}

// Rotation vector (degrees) by which gravity leans from the vertical; of the sign that a scene gives to a tilt.
Vec3 lean_of(const Vec3& gravity) {
  const Eigen::AngleAxisd turn(Eigen::Quaterniond::FromTwoVectors(-Vec3::UnitZ(), gravity));
  return turn.angle() * 180 / pi * turn.axis();
}

// First crack (in dry masonry: first joint that opened), and collapse.
std::vector<Mark> first_events(const CsvTable& events, const Run& run, const Manifest& manifest) {
  std::vector<Mark> marks;
  const int time = events.find("time_s"), event = events.find("event");
  if (time < 0 || event < 0) return marks;
  const std::vector<std::string>& what = events.text[static_cast<std::size_t>(event)];
  const auto add = [&](const std::string& kind, const std::string& name) {
    const auto at = std::find(what.begin(), what.end(), kind);
    if (at == what.end()) return false;
    const double t = events.columns[static_cast<std::size_t>(time)][static_cast<std::size_t>(at - what.begin())];
    marks.push_back({t, name, run.multipliers.empty() ? span_of_event(manifest, t) : "at " + clock_text(run, t)});
    return true;
  };
  if (!add("crack", "first crack")) add("open", "first opening");
  add("collapse", "collapse");
  return marks;
}

// "collapse between 1.69 and 1.70 s: gives way between ..."; "" while it stands.
std::string verdict_of(const Json& metrics, const Manifest& manifest) {
  const Json *time = find_key(metrics, "collapse.time_s"), *course = find_key(metrics, "collapse.course");
  if (!time || !time->is_number()) return {};
  const std::string how = course && course->is_string() ? course->get<std::string>() : "";
  return fmt::format("collapse {}{}{}", span_of_event(manifest, time->get<double>()), how.empty() ? "" : ": ", how);
}

Vec3 linear(const Vec3& srgb) { return srgb.cwiseMax(0).cwiseMin(1).array().pow(2.2); }  // the shaders convert back

}  // namespace

Vec3 gravity_at(const GravityRecord& gravity, double t) {
  if (gravity.empty()) return {0, 0, -standard_g};
  const auto after = static_cast<std::size_t>(std::upper_bound(gravity.t.begin(), gravity.t.end(), t) - gravity.t.begin());
  if (after == 0) return gravity.g.front();
  if (after == gravity.t.size()) return gravity.g.back();
  const double s = (t - gravity.t[after - 1]) / (gravity.t[after] - gravity.t[after - 1]);
  return (1 - s) * gravity.g[after - 1] + s * gravity.g[after];
}

Mat3 levelling(const GravityRecord& gravity, double t) {
  return Eigen::Quaterniond::FromTwoVectors(gravity_at(gravity, t), -Vec3::UnitZ()).toRotationMatrix();
}

namespace {

// Decimals of a second that tell recorded frames apart.
int clock_decimals(const Run& run) {
  return run.frame_dt > 0 ? std::clamp(static_cast<int>(std::ceil(-std::log10(run.frame_dt) - 1e-6)), 2, 6) : 2;
}

}  // namespace

std::string clock_text(const Run& run, double t) {
  if (run.multipliers.empty() || !(run.state_dt > 0)) return fmt::format("{:.{}f} s", t, clock_decimals(run));
  const std::size_t last = run.multipliers.size() - 1;
  const double end = static_cast<double>(last) * run.state_dt;
  if (t > end + 0.5 * run.state_dt) return fmt::format("fall + {:.2f} s", t - end);
  const auto state = static_cast<std::size_t>(std::lround(std::max(0.0, t) / run.state_dt));
  double at = std::clamp(t / run.state_dt, 0.0, static_cast<double>(last));
  if (std::fabs(at - std::round(at)) < 0.05) at = std::round(at);  // a picture of the state itself
  const auto below = std::min(static_cast<std::size_t>(at), last > 0 ? last - 1 : 0);
  const double multiplier =
      last > 0 ? std::lerp(run.multipliers[below], run.multipliers[below + 1], at - static_cast<double>(below)) : run.multipliers[0];
  if (run.multiplier_unit == "tan") return fmt::format("state {}: {:.2f}\u00b0", state, std::atan(multiplier) * 180 / pi);
  return fmt::format("state {}: {:.3f}{}", state, multiplier, run.multiplier_unit == "g" ? " g" : "");
}

std::string widest_clock(const Run& run) {
  if (run.multipliers.empty()) {
    std::string zeros = clock_text(run, std::max(run.end, 10.0));
    std::ranges::replace_if(
        zeros, [](unsigned char c) { return std::isdigit(c) != 0; }, '0');
    return zeros;
  }
  return fmt::format("state {}: 0.000 g", run.multipliers.size());
}

Run read_run(const std::string& dir) {
  const std::string manifest = run_file(dir, "manifest.json"), histories = run_file(dir, "histories.csv");
  if (!std::filesystem::exists(dir)) throw Error("no such folder; give the folder of a run, e.g. runs/first", {dir, 0});
  if (!std::filesystem::exists(manifest)) throw Error("no manifest.json in it; give the folder of a run, e.g. runs/first", {dir, 0});
  Manifest m = read_manifest(dir);
  tell_apart(m.materials);
  Run run;
  run.dir = dir;
  run.name = m.scene_name;
  run.identity = identity_of(m);
  run.title = m.title.empty() ? m.scene_name : m.title;
  run.frame_dt = m.frame_dt, run.end = m.duration;
  while (!run.title.empty() && run.title.back() == '.') run.title.pop_back();  // a heading has no full stop
  run.cameras = m.cameras;
  for (const Camera& c : run.cameras)
    if (!((c.eye - c.target).norm() > 1e-9 && c.fov > 0 && c.fov < pi))
      throw Error(fmt::format("camera {} looks nowhere; its eye and target must differ and 0 < fov < 180 deg", c.name), {manifest, 0});
  for (const Material& a : m.materials) run.materials.push_back({a.name, linear(a.color), a.density});
  run.dry = !m.laws.empty() && std::ranges::all_of(m.laws, [](const Json& rule) {
    const Json *none = find_key(rule, "none.value"), *kind = find_key(rule, "law.kind");
    return (none != nullptr && *none == true) || (kind != nullptr && (*kind == "dry" || *kind == "dilatant"));
  });
  if (const Json* tolerance = find_key(m.settings, "analysis.energy_gate.value"); tolerance && tolerance->is_number())
    run.energy_tolerance = tolerance->get<double>();
  if (const std::string metrics = run_file(dir, "metrics.json"); std::filesystem::exists(metrics)) {
    const Json now = read_json(metrics);
    run.status = now.value("status", "");
    run.verdict = verdict_of(now, m);
  }
  if (run.status == "completed") run.status.clear();
  if (std::filesystem::exists(histories)) {
    const CsvTable table = read_csv(histories);
    if (const int time = table.find("time_s"); time >= 0) {
      const std::vector<double>& t = table.columns[static_cast<std::size_t>(time)];
      run.record = along_principal(t, vectors_of(table, "ground_a"));
      run.gravity = gravity_of(t, table);
      std::vector<Vec3> leans;
      for (const Vec3& g : run.gravity.g) leans.push_back(lean_of(g));
      run.tilt = along_principal(run.gravity.t, leans);
      if (run.tilt.axis.empty()) run.gravity = {};  // it never leans
    }
  }
  if (const std::string path = run_file(dir, "curve.csv"); std::filesystem::exists(path)) {
    const CsvTable curve = read_csv(path);
    const std::string first = curve.names.empty() ? "" : curve.names.front(), stem = "multiplier";
    if (first.starts_with(stem)) {
      run.multipliers = curve.columns.front(), run.state_dt = m.frame_dt;
      run.multiplier_unit = first.size() > stem.size() ? first.substr(stem.size() + 1) : "";
      // After the last state the table is tilted further, so that the structure falls: that is no state it stood in.
      const double end = (static_cast<double>(curve.rows()) - 0.5) * run.state_dt;
      run.tilt.peak = 0;
      for (std::size_t i = 0; i < run.tilt.t.size() && run.tilt.t[i] <= end; ++i)
        if (std::fabs(run.tilt.a[i]) > std::fabs(run.tilt.peak)) run.tilt.peak = run.tilt.a[i];
    }
  }
  if (const std::string events = run_file(dir, "events.csv"); std::filesystem::exists(events))
    run.marks = first_events(read_csv(events), run, m);
  return run;
}

}  // namespace erbs::render
