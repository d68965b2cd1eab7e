#include "engine/record/report/drift.h"

#include <algorithm>
#include <cmath>

#include "engine/base/error.h"
#include "engine/base/spelling.h"
#include "engine/base/text.h"
#include "engine/record/plot/unit.h"

namespace erbs {
namespace {

// The blocks that may move, by level from below, and the height of their support.
struct Levels {
  std::vector<std::vector<int>> blocks;
  double support = 0;  // m
};

bool counts(const MotionBlock& block, const std::string& group) { return !block.fixed && (group.empty() || block.group == group); }

Levels levels_of(const MotionScene& scene, int count, const std::string& group) {
  double low = HUGE_VAL, high = -HUGE_VAL;
  for (const MotionBlock& block : scene.blocks) {
    if (!counts(block, group)) continue;
    for (const int part : block.parts) {
      const std::vector<float>& at = scene.shapes[std::size_t(part)].vertices;
      for (std::size_t i = 2; i < at.size(); i += 3)
        low = std::min(low, block.rest.z() + at[i]), high = std::max(high, block.rest.z() + at[i]);
    }
  }
  if (!(high > low) && !group.empty()) {
    std::vector<std::string> groups;
    for (const MotionBlock& block : scene.blocks)
      if (!block.fixed && std::find(groups.begin(), groups.end(), block.group) == groups.end()) groups.push_back(block.group);
    throw Error(fmt::format("--group {}: no block of this group may move{}", shown(group, 60), did_you_mean(group, groups)));
  }
  if (!(high > low)) throw Error("the run has no block that may move, so that there is no drift; choose another run");
  std::vector<int> order;
  for (std::size_t b = 0; b < scene.blocks.size(); ++b)
    if (counts(scene.blocks[b], group)) order.push_back(int(b));
  const auto z = [&](int b) { return scene.blocks[std::size_t(b)].rest.z(); };
  std::ranges::stable_sort(order, {}, z);
  std::vector<std::vector<int>> courses;
  for (const int b : order) {
    if (courses.empty() || z(b) - z(courses.back().front()) > 1e-3 * (high - low)) courses.emplace_back();
    courses.back().push_back(b);
  }
  const std::size_t together = (courses.size() + std::size_t(count) - 1) / std::size_t(count);
  Levels levels{{}, low};
  for (std::size_t c = 0; c < courses.size(); ++c) {
    if (c % together == 0) levels.blocks.emplace_back();
    levels.blocks.back().insert(levels.blocks.back().end(), courses[c].begin(), courses[c].end());
  }
  return levels;
}

// Mean of the values without a tenth of them, rounded up from three values on, at either end.
double trimmed_mean(std::vector<double>& values) {
  std::sort(values.begin(), values.end());
  const std::size_t cut = values.size() < 3 ? 0 : (values.size() + 9) / 10;
  double sum = 0;
  for (std::size_t i = cut; i < values.size() - cut; ++i) sum += values[i];
  return sum / double(values.size() - 2 * cut);
}

void keep_largest(std::vector<double>& largest, std::size_t i, double value) { largest[i] = std::max(largest[i], std::abs(value)); }

std::string rows_of(const std::vector<double>& x, double factor, const std::vector<double>& y, bool from_ground) {
  std::string rows = from_ground ? "0 0\n" : "";
  for (std::size_t i = 0; i < x.size(); ++i) rows += fmt::format("{:.8g} {:.8g}\n", factor * x[i], y[i]);
  return rows;
}

// About five tics from 0 to `high`: gnuplot's own run into each other in a narrow panel.
std::string tics_to(double high) {
  if (!(high > 0)) return "";
  const double step = high / 5, decade = std::pow(10, std::floor(std::log10(step)));
  for (const double lead : {1, 2, 5})
    if (lead * decade >= step) return fmt::format("0,{:g}", lead * decade);
  return fmt::format("0,{:g}", 10 * decade);
}

}  // namespace

DriftProfile drift_profile(const MotionScene& scene, const std::vector<MotionFrame>& frames, int count, const std::string& group) {
  if (frames.empty()) throw Error("no frame lies within the span of time; choose another with --time");
  const Levels levels = levels_of(scene, count, group);
  const std::size_t n = levels.blocks.size();
  DriftProfile out;
  for (const std::vector<int>& blocks : levels.blocks) {
    double sum = 0;
    for (const int b : blocks) sum += scene.blocks[std::size_t(b)].rest.z() - levels.support;
    out.height.push_back(sum / double(blocks.size()));
    out.between.push_back(0.5 * (out.height.back() + (out.height.size() > 1 ? out.height[out.height.size() - 2] : 0)));
  }
  std::vector<double> values;
  for (int axis = 0; axis < 2; ++axis) {
    out.displacement[std::size_t(axis)].assign(n, 0), out.drift[std::size_t(axis)].assign(n, 0);
    for (const MotionFrame& frame : frames) {
      double below = 0, below_height = 0;
      for (std::size_t i = 0; i < n; ++i) {
        values.clear();
        for (const int b : levels.blocks[i])
          values.push_back(double(frame.poses[std::size_t(7 * b + axis)]) - scene.blocks[std::size_t(b)].rest[axis]);
        const double u = trimmed_mean(values);
        keep_largest(out.displacement[std::size_t(axis)], i, u);
        keep_largest(out.drift[std::size_t(axis)], i, (u - below) / (out.height[i] - below_height));
        below = u, below_height = out.height[i];
      }
    }
  }
  return out;
}

plot::Figure drift_figure(const std::vector<DriftProfile>& profiles, const std::string& note) {
  if (profiles.size() > plot::run_colors.size())
    throw Error(fmt::format("{} runs are more than a figure of drift can tell apart, which is {}; choose fewer", profiles.size(),
                            plot::run_colors.size()));
  double peak = 0, peak_drift = 0;
  std::string names;
  for (const DriftProfile& profile : profiles) {
    for (const auto& along : profile.displacement)
      for (const double u : along) peak = std::max(peak, u);
    for (const auto& along : profile.drift)
      for (const double ratio : along) peak_drift = std::max(peak_drift, ratio);
    names += (names.empty() ? "" : ", ") + profile.run;
  }
  const plot::ShownUnit& unit = plot::shown_unit(*plot::find_unit("m"), peak);
  constexpr double height = 500;
  plot::Figure figure{980, height};
  figure.labels = {{names, fmt::format("screen 0.08,{:.4f}", 1 - 22 / height), "left font ',15' tc rgb '#111111' noenhanced"},
                   {note, fmt::format("screen 0.08,{:.4f}", 1 - 45 / height), "left font ',12' tc rgb '#555555' noenhanced"}};
  double top = 0;  // m; of both panels, so that a height is at the same place
  for (const DriftProfile& profile : profiles) top = std::max(top, profile.height.back());
  for (int kind = 0; kind < 2; ++kind) {
    plot::Panel p;
    p.axes = kind == 0 ? plot::AxesBox{0.08, 0.40, 0.13, 0.87} : plot::AxesBox{0.46, 0.78, 0.13, 0.87};
    p.x = {kind == 0 ? fmt::format("largest displacement [{}]", unit.name) : "largest drift [%]", "[0:*]",
           tics_to(kind == 0 ? peak * unit.factor : 100 * peak_drift)};
    p.y = {kind == 0 ? "height above the support [m]" : "", fmt::format("[0:{:.6g}]", 1.05 * top)};
    if (kind == 1) p.key = "at graph 1.04,1 left top Left reverse samplen 3 spacing 1.1 noenhanced";
    for (std::size_t i = 0; i < profiles.size(); ++i)
      for (std::size_t axis = 0; axis < 2; ++axis) {
        const DriftProfile& of = profiles[i];
        const std::string rows =
            kind == 0 ? rows_of(of.displacement[axis], unit.factor, of.height, true) : rows_of(of.drift[axis], 100, of.between, false);
        const std::string name = profiles.size() > 1 ? of.run + ", " : "";
        p.series.push_back({figure.add_rows(rows) + " using 1:2",
                            fmt::format("linespoints pt {} ps 0.5 lw 1.6 lc rgb '{}' dashtype {}", axis == 0 ? 7 : 6, plot::run_colors[i],
                                        axis == 0 ? "1" : "(6,4)"),
                            name + (axis == 0 ? "along x" : "along y")});
      }
    figure.panels.push_back(p);
  }
  return figure;
}

}  // namespace erbs
