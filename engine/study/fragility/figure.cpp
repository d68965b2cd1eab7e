// Figures of a fragility: the probability of collapse over the intensity with its band, and the curves of incremental runs with fractiles.
#include <algorithm>
#include <cmath>
#include <sstream>

#include "engine/record/plot/figure.h"
#include "engine/record/plot/unit.h"
#include "engine/study/fragility/falls.h"
#include "engine/study/fragility/fragility.h"

namespace erbs::study {
namespace {

constexpr std::size_t most_groups = 4;
const char* const colors[] = {"#1f5f8b", "#b5432e", "#2e8b57", "#8a5fa8"};

double highest(const std::vector<Group>& groups) {
  double top = 0;
  for (const Group& group : groups)
    for (const double im : levels_of(group)) top = std::max(top, im);
  return top;
}

plot::Figure sheet(const Sweep& sweep, const std::string& what) {
  plot::Figure figure{900, 640};
  const std::string title = sweep.plan.title.empty() ? sweep.scene.substr(sweep.scene.find_last_of('/') + 1) : sweep.plan.title;
  figure.labels = {{title + ": " + what, "screen 0.5,0.965", "center font ',16' noenhanced"}};
  return figure;
}

plot::Panel panel_of() {
  plot::Panel panel;
  panel.cell = {0, 1, 0, 0.94};
  return panel;
}

void add_fit(plot::Figure& figure, plot::Panel& panel, const Fragility& one, const char* color, double top, const ShownIntensity& shown) {
  std::string rows;
  for (int i = 1; i <= 200; ++i) {
    const double im = top * i / 200;
    rows += fmt::format("{} {} {} {}\n", shown.factor * im, one.fit.probability(im), one.fit.band(im, -1), one.fit.band(im, 1));
  }
  const std::string data = figure.add_rows(rows), name = one.group.empty() ? "" : one.group + ": ";
  panel.series.push_back({data + " using 1:3:4", fmt::format("filledcurves fs transparent solid 0.18 noborder lc rgb '{}'", color), ""});
  panel.series.push_back({data + " using 1:2", fmt::format("lines lw 2.5 lc rgb '{}'", color),
                          fmt::format("{}median {}, dispersion {:.2f}", name, shown.number(one.fit.theta), one.fit.beta)});
}

// Fractions of the stripes, if several runs share an intensity; else each run at 0 or 1.
void add_fractions(plot::Figure& figure, plot::Panel& panel, const Group& group, const char* color, bool titled, double factor) {
  std::string rows;
  for (const double im : levels_of(group)) {
    int runs = 0, collapsed = 0;
    for (const Case& one : group.cases)
      for (const Run& run : one.runs)
        if (run.im == im) ++runs, collapsed += run.collapsed ? 1 : 0;
    rows += fmt::format("{} {}\n", factor * im, double(collapsed) / runs);
  }
  panel.series.push_back({figure.add_rows(rows) + " using 1:2", fmt::format("points pt 7 ps 0.9 lc rgb '{}'", color),
                          titled ? "share of runs that collapse" : ""});
}

// Of the fits of a group the first that found an answer; without one, the first, with its reason.
std::vector<Fragility>::const_iterator best_of(const std::vector<Fragility>& found, const std::string& group) {
  const auto fitted = [&](const Fragility& f) { return f.group == group && f.fit.end == FitEnd::fitted; };
  const auto best = std::find_if(found.begin(), found.end(), fitted);
  return best != found.end() ? best : std::find_if(found.begin(), found.end(), [&](const Fragility& f) { return f.group == group; });
}

// Lines of a sentence that fit into a panel.
std::vector<std::string> folded(const std::string& text) {
  constexpr std::size_t widest = 72;
  std::vector<std::string> lines(1);
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    if (!lines.back().empty() && lines.back().size() + 1 + word.size() > widest) lines.emplace_back();
    lines.back() += (lines.back().empty() ? "" : " ") + word;
  }
  return lines;
}

void draw_probability(const Sweep& sweep, const std::vector<Group>& groups, const std::vector<Fragility>& found,
                      const std::string& ending) {
  plot::Figure figure = sheet(sweep, "collapse, with 95 % confidence");
  plot::Panel panel = panel_of();
  const ShownIntensity shown = shown_intensity(sweep);
  const double top = 1.05 * highest(groups);
  double height = 0.95;  // of the next line of words
  for (std::size_t g = 0; g < std::min(groups.size(), most_groups); ++g) {
    const auto one = best_of(found, groups[g].name);
    if (one != found.end() && one->fit.end == FitEnd::fitted) add_fit(figure, panel, *one, colors[g], top, shown);
    // Intensities that a bisection chose are no sample.
    if (!sweep.plan.bisect) add_fractions(figure, panel, groups[g], colors[g], g == 0, shown.factor);
    if (one != found.end() && !one->words.empty())
      for (const std::string& line : folded(one->words)) {
        panel.labels.push_back(
            {line, fmt::format("graph 0.03, graph {:.3f}", height), fmt::format("left font ',11' tc rgb '{}' noenhanced", colors[g])});
        height -= 0.06;
      }
  }
  panel.x = {shown.label(), fmt::format("[0:{}]", shown.factor * top), "", "", "noenhanced"};
  panel.y = {"probability of collapse", "[-0.02:1.02]"};
  panel.key = "outside bottom center horizontal height 1.6 noenhanced";
  figure.panels = {panel};
  plot::draw(figure, sweep.directory + "/fragility." + ending);
}

// The highest of the runs up to the first collapse of each case.
double highest_capacity(const std::vector<Group>& groups) {
  double top = 0;
  for (const Group& group : groups)
    for (const Case& one : group.cases) {
      const Interval capacity = one.capacity();
      top = std::max(top, std::isfinite(capacity.hi) ? capacity.hi : capacity.lo);
    }
  return top;
}

double largest_damage(const Group& group) {
  double most = 0;
  for (const Case& one : group.cases)
    for (const Run& run : one.runs)
      if (!run.collapsed && std::isfinite(run.damage[0])) most = std::max(most, run.damage[0]);
  return most;
}

// Each case from the origin through its standing runs; a collapse leaves to the right, half way up to its run.
std::string curve_of(const Case& one, double right) {
  std::string rows = "0 0\n";
  double last = 0;
  for (const Run& run : one.runs) {
    if (run.collapsed) return rows + fmt::format("{} {}\n", right, 0.5 * (last + run.im));
    if (std::isfinite(run.damage[0])) rows += fmt::format("{} {}\n", run.damage[0], run.im);
    last = run.im;
  }
  return rows;
}

void draw_curves(const Sweep& sweep, const std::vector<Group>& groups, const std::string& ending) {
  const std::string& damage = sweep.plan.fragility->damage.front();
  plot::Figure figure = sheet(sweep, "incremental dynamic analysis");
  plot::Panel panel = panel_of();
  const ShownIntensity shown = shown_intensity(sweep);
  const std::string columns = fmt::format(" using 1:(${}*{})", 2, shown.factor);
  double right = 0;
  for (const Group& group : groups) right = std::max(right, 1.15 * largest_damage(group));
  if (right <= 0) return;
  bool first = true;
  for (const Group& group : groups)
    for (const Case& one : group.cases) {
      panel.series.push_back(
          {figure.add_rows(curve_of(one, right)) + columns, "linespoints lw 1 pt 7 ps 0.35 lc rgb '#b4b4b4'", first ? "each case" : ""});
      first = false;
    }
  for (std::size_t g = 0; g < std::min(groups.size(), most_groups); ++g) {
    const std::vector<Fractiles> all = fractiles_of(groups[g], 0);
    const std::pair<double Fractiles::*, const char*> lines[] = {
        {&Fractiles::p16, "16 %"}, {&Fractiles::p50, "50 %"}, {&Fractiles::p84, "84 %"}};
    for (int k = 0; k < 3; ++k) {
      std::string rows = "0 0\n";
      double last = 0;
      for (const Fractiles& f : all) {
        const double value = f.*lines[k].first;
        rows += std::isfinite(value) ? fmt::format("{} {}\n", value, f.im) : fmt::format("{} {}\n", right, 0.5 * (last + f.im));
        last = f.im;
        if (!std::isfinite(value)) break;
      }
      panel.series.push_back({figure.add_rows(rows) + columns,
                              fmt::format("lines lw {} dt {} lc rgb '{}'", k == 1 ? 3 : 2, k == 1 ? 1 : k + 2, colors[g]),
                              (groups[g].name.empty() ? "" : groups[g].name + ": ") + lines[k].second});
    }
  }
  const auto& keys = sweep.plan.collect;
  const auto at = std::size_t(std::find(keys.begin(), keys.end(), damage) - keys.begin());
  panel.x = {plot::label_of(at < sweep.collected.size() ? sweep.collected[at] : damage), fmt::format("[0:{}]", right), "", "",
             "noenhanced"};
  panel.y = {shown.label(), fmt::format("[0:{}]", shown.factor * std::min(1.05 * highest(groups), 1.1 * highest_capacity(groups))), "", "",
             "noenhanced"};
  panel.labels.push_back({"a case leaves to the right where it collapses", "graph 0.98, graph 0.04", "right font ',11' tc rgb '#666666'"});
  panel.key = "outside bottom center horizontal height 1.6 noenhanced";
  figure.panels = {panel};
  plot::draw(figure, sweep.directory + "/ida." + ending);
}

}  // namespace

void draw_fragility(const Sweep& sweep, const std::vector<Group>& groups, const std::vector<Fragility>& found) {
  if (std::all_of(groups.begin(), groups.end(), [](const Group& group) { return group.cases.empty(); })) return;  // the words say why
  for (const char* ending : {"svg", "png"}) {
    draw_probability(sweep, groups, found, ending);
    if (!sweep.plan.fragility->damage.empty()) draw_curves(sweep, groups, ending);
    if (sweep.plan.fragility->falls) draw_falls(sweep, groups, ending);
  }
}

}  // namespace erbs::study
