#include "engine/study/fragility/falls.h"

#include <algorithm>

#include "engine/base/units.h"
#include "engine/record/format/csv.h"
#include "engine/record/format/json.h"
#include "engine/record/plot/figure.h"
#include "engine/study/fragility/fragility.h"

namespace erbs::study {
namespace {

constexpr std::size_t most_lines = 10;

std::array<double, 2> mean_vector(const Falls& falls) {
  std::array<double, 2> sum{0, 0};
  for (const auto& [x, y] : falls.towards) sum[0] += x, sum[1] += y;
  for (double& s : sum) s /= double(falls.towards.size());
  return sum;
}

// Dark to bright, from the lowest intensity to the highest.
std::string color_of(std::size_t i, std::size_t n) {
  const double t = n > 1 ? double(i) / double(n - 1) : 0.5;
  const auto mix = [&](double a, double b, double c) { return int(t < 0.5 ? a + 2 * t * (b - a) : b + (2 * t - 1) * (c - b)); };
  return fmt::format("#{:02x}{:02x}{:02x}", mix(24, 190, 250), mix(30, 50, 170), mix(120, 110, 40));
}

// Intensities that a bisection chose differ from run to run: they are one sample then.
std::vector<Falls> drawn_lines(const std::vector<Group>& groups) {
  std::vector<Falls> all = falls_of(groups), out;
  if (all.size() <= most_lines) return all;
  for (Falls& one : all) {
    if (out.empty() || out.back().group != one.group) out.push_back({one.group, 0, 0, 0, {}, {}});
    Falls& sum = out.back();
    sum.runs += one.runs;
    sum.collapsed += one.collapsed;
    sum.times.insert(sum.times.end(), one.times.begin(), one.times.end());
    sum.towards.insert(sum.towards.end(), one.towards.begin(), one.towards.end());
  }
  for (Falls& one : out) std::sort(one.times.begin(), one.times.end());
  out.resize(std::min(out.size(), most_lines));
  return out;
}

std::string title_of(const Falls& falls, const ShownIntensity& shown) {
  std::string text = falls.group;
  if (falls.im > 0) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", shown.words, shown.number(falls.im));
  return fmt::format("{}{}{} of {} fall", text, text.empty() ? "" : ": ", falls.collapsed, falls.runs);
}

// Share of all runs that have fallen by a time, as steps up to the right edge.
std::string steps_of(const Falls& falls, double right) {
  std::string rows = "0 0\n";
  double share = 0;
  for (const double t : falls.times) {
    rows += fmt::format("{} {}\n", t, share);
    share += 1.0 / falls.runs;
    rows += fmt::format("{} {}\n", t, share);
  }
  return rows + fmt::format("{} {}\n", right, share);
}

plot::Panel times_panel(plot::Figure& figure, const std::vector<Falls>& lines, const ShownIntensity& shown) {
  plot::Panel panel;
  panel.cell = {0, 0.58, 0.02, 0.92};
  double right = 0;
  for (const Falls& one : lines)
    if (!one.times.empty()) right = std::max(right, 1.08 * one.times.back());
  for (std::size_t i = 0; i < lines.size(); ++i)
    panel.series.push_back({figure.add_rows(steps_of(lines[i], right)) + " using 1:2",
                            fmt::format("lines lw 2.5 lc rgb '{}'", color_of(i, lines.size())), title_of(lines[i], shown)});
  panel.x = {"time of collapse [s]", fmt::format("[0:{}]", right)};
  panel.y = {"share of runs that have fallen", "[-0.02:1.02]"};
  panel.key = "at graph 0.5,-0.16 top center horizontal maxcols 3 Left reverse samplen 2 font ',11' noenhanced";
  panel.axes = plot::AxesBox{0.08, 0.555, 0.27, 0.9};
  return panel;
}

// The plan from above: a ring for each intensity, the highest outside, and a point on it for the direction of each fall.
plot::Panel compass(plot::Figure& figure, const std::vector<Falls>& lines) {
  plot::Panel panel;
  const double high = 0.74, wide = high * figure.height / figure.width;
  panel.cell = {0.58, 1, 0, 0.92};
  panel.axes = plot::AxesBox{0.79 - wide / 2, 0.79 + wide / 2, 0.1, 0.1 + high};
  panel.settings = "unset border\nunset xtics\nunset ytics\nunset grid\n";
  const auto radius = [&](std::size_t i) { return 0.3 + 0.7 * double(i + 1) / double(lines.size()); };
  for (std::size_t i = 0; i < lines.size(); ++i) {
    std::string ring, points;
    for (int k = 0; k <= 120; ++k) {
      const double angle = 2 * pi * k / 120;
      ring += fmt::format("{} {}\n", radius(i) * std::cos(angle), radius(i) * std::sin(angle));
    }
    for (const auto& [x, y] : lines[i].towards) points += fmt::format("{} {}\n", radius(i) * x, radius(i) * y);
    panel.series.push_back({figure.add_rows(ring) + " using 1:2", "lines lw 0.7 lc rgb '#bbbbbb'", ""});
    if (!points.empty())
      panel.series.push_back(
          {figure.add_rows(points) + " using 1:2", fmt::format("points pt 7 ps 0.9 lc rgb '{}'", color_of(i, lines.size())), ""});
  }
  panel.x = {"", "[-1.25:1.25]"}, panel.y = {"", "[-1.25:1.25]"};
  panel.labels = {{"+x", "first 1.16,0", "center"},
                  {"-x", "first -1.16,0", "center"},
                  {"+y", "first 0,1.14", "center"},
                  {"-y", "first 0,-1.14", "center"},
                  {"direction in plan; outer rings: higher intensity", "graph 0.5,-0.04", "center font ',11'"}};
  return panel;
}

}  // namespace

double Falls::mean_direction() const {
  if (towards.empty()) return std::nan("");
  const auto [x, y] = mean_vector(*this);
  return std::atan2(y, x) * 180 / pi;
}

double Falls::concentration() const {
  if (towards.empty()) return std::nan("");
  const auto [x, y] = mean_vector(*this);
  return std::hypot(x, y);
}

std::array<double, 4> quarters(const Falls& falls) {
  std::array<double, 4> out{0, 0, 0, 0};
  for (const auto& [x, y] : falls.towards) out[std::fabs(x) >= std::fabs(y) ? (x > 0 ? 0 : 2) : (y > 0 ? 1 : 3)] += 1;
  for (double& share : out) share /= std::max(1.0, double(falls.towards.size()));
  return out;
}

std::vector<Falls> falls_of(const std::vector<Group>& groups) {
  std::vector<Falls> out;
  for (const Group& group : groups)
    for (const double im : levels_of(group)) {
      Falls falls{group.name, im, 0, 0, {}, {}};
      for (const Case& one : group.cases)
        for (const Run& run : one.runs) {
          if (run.im != im) continue;
          ++falls.runs;
          if (!run.collapsed) continue;
          ++falls.collapsed;
          if (std::isfinite(run.time)) falls.times.push_back(run.time);
          if (std::isfinite(run.direction[0]) && std::isfinite(run.direction[1])) falls.towards.push_back(run.direction);
        }
      std::sort(falls.times.begin(), falls.times.end());
      out.push_back(std::move(falls));
    }
  return out;
}

void write_falls(const Sweep& sweep, const std::vector<Group>& groups) {
  std::string text = csv_line({"group", unit_of_im(sweep), "runs", "collapsed", "time16_s", "time50_s", "time84_s", "with_direction",
                               "mean_direction_deg", "concentration", "share_plus_x", "share_plus_y", "share_minus_x", "share_minus_y"});
  const auto cell = [](double x) { return std::isfinite(x) ? fmt::format("{}", x) : std::string(); };
  for (const Falls& falls : falls_of(groups)) {
    std::vector<std::string> row{falls.group, cell(falls.im), std::to_string(falls.runs), std::to_string(falls.collapsed)};
    for (const double share : {0.16, 0.5, 0.84}) row.push_back(falls.times.empty() ? "" : cell(fractile(falls.times, share)));
    row.push_back(std::to_string(falls.towards.size()));
    row.push_back(cell(falls.mean_direction()));
    row.push_back(cell(falls.concentration()));
    for (const double share : quarters(falls)) row.push_back(falls.towards.empty() ? "" : cell(share));
    text += csv_line(row);
  }
  write_text_atomically(sweep.directory + "/falls.csv", text);
}

void draw_falls(const Sweep& sweep, const std::vector<Group>& groups, const std::string& ending) {
  const std::vector<Falls> lines = drawn_lines(groups);
  if (std::all_of(lines.begin(), lines.end(), [](const Falls& one) { return one.times.empty(); })) return;
  plot::Figure figure{1080, 620};
  const std::string title = sweep.plan.title.empty() ? sweep.scene.substr(sweep.scene.find_last_of('/') + 1) : sweep.plan.title;
  figure.labels = {{title + ": time and direction of collapse", "screen 0.5,0.955", "center font ',16' noenhanced"}};
  figure.panels.push_back(times_panel(figure, lines, shown_intensity(sweep)));
  figure.panels.push_back(compass(figure, lines));
  plot::draw(figure, sweep.directory + "/falls." + ending);
}

}  // namespace erbs::study
