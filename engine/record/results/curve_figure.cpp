#include "engine/record/results/curve_figure.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/base/error.h"
#include "engine/base/text.h"
#include "engine/record/plot/unit.h"

namespace erbs {
namespace {

// Okabe and Ito 2008, seven of eight: their yellow is too pale for a line on white. Seven colours and five patterns have no common
// divisor, so that 35 curves differ; neighbours differ in grey print as well.
constexpr std::array<const char*, 7> colors{"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000"};
constexpr std::array<const char*, 5> dashes{"1", "(14,5)", "(4,4)", "(14,4,3,4)", "(8,3)"};
constexpr std::size_t most_curves = colors.size() * dashes.size();

// Places of a panel, in px.
constexpr double narrow = 95, width = 720, foot = 68, spacing = 26, letter = 8;

struct Group {
  std::string unit;
  std::vector<const HistoryCurve*> curves;
};

// The first and last letters of a text that is longer than `most` bytes.
std::string shortened(const std::string& text, std::size_t most) {
  if (text.size() <= most) return text;
  const auto inside = [&](std::size_t i) { return i < text.size() && (static_cast<unsigned char>(text[i]) & 0xc0) == 0x80; };
  std::size_t end = most / 2, begin = text.size() - most / 2;
  while (inside(end)) --end;
  while (inside(begin)) ++begin;
  return text.substr(0, end) + "…" + text.substr(begin);
}

std::vector<Group> groups_of(const std::vector<HistoryCurve>& curves, CurveKind kind) {
  std::vector<Group> groups;
  std::vector<std::string> keys;
  for (const HistoryCurve& curve : curves) {
    const std::string unit = kind == CurveKind::response ? "m_s2" : plot::unit_of(curve.y_name);
    const std::string key = unit.empty() ? "/" + curve.y_name : unit;
    const std::size_t at = std::size_t(std::find(keys.begin(), keys.end(), key) - keys.begin());
    if (at == keys.size()) keys.push_back(key), groups.push_back({unit, {}});
    groups[at].curves.push_back(&curve);
  }
  return groups;
}

struct Scale {
  double factor = 1;
  std::string unit = "-";
};

template <class Values>
Scale scale_of(const std::vector<const HistoryCurve*>& curves, const std::string& suffix, Values&& values) {
  double peak = 0;
  for (const HistoryCurve* curve : curves)
    for (const double value : values(*curve)) peak = std::max(peak, std::abs(value));
  const plot::Unit* unit = plot::find_unit(suffix);
  if (unit == nullptr) return {};
  const plot::ShownUnit& shown = plot::shown_unit(*unit, peak);
  return {shown.factor, shown.name};
}

std::string axis_label(const Group& group, CurveKind kind, const std::string& unit) {
  if (kind == CurveKind::response) return fmt::format("pseudo-acceleration [{}]", unit);
  const std::string& name = group.curves.front()->y_name;
  const bool one = std::all_of(group.curves.begin(), group.curves.end(), [&](const auto* c) { return c->y_name == name; });
  const plot::Unit* known = plot::find_unit(group.unit);
  const std::string words = one || known == nullptr ? plot::words_of(name) : known->quantity;
  return fmt::format("{}{}{} [{}]", kind == CurveKind::envelope ? "largest " : "", shortened(words, 40),
                     kind == CurveKind::spectrum ? " amplitude" : "", unit);
}

// A range for curves without any; otherwise gnuplot chooses.
std::string range_of(double low, double high, bool from_zero) {
  if (high > low) return from_zero ? "[0:*]" : "";
  const double half = low == 0 ? 1 : 0.1 * std::abs(low);
  return fmt::format("[{:.8g}:{:.8g}]", low - half, high + half);
}

// Letters of the longest number that gnuplot writes beside an axis over this range; it writes 1.05x10^8 for 1.05e+08.
std::size_t letters_of_tics(double low, double high) {
  const double span = high > low ? high - low : std::max(1.0, std::abs(low)), step = std::pow(10, std::floor(std::log10(span / 4)));
  std::size_t most = 0;
  for (const double end : {std::floor(low / step) * step, std::ceil(high / step) * step})
    for (const double tic : {end, end + step / 2}) {
      const std::string text = fmt::format("{:.6g}", tic);
      most = std::max(most, text.size() + (text.find('e') == std::string::npos ? 0 : 2));
    }
  return most;
}

// Room (px) left of the panels: for a label, and for the numbers of the axis with the longest ones.
double room_at_left(const std::vector<Group>& groups) {
  std::size_t most = 0;
  for (const Group& group : groups) {
    const Scale y = scale_of(
        group.curves, group.unit, [](const HistoryCurve& c) -> const auto& { return c.y; });
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (const HistoryCurve* curve : group.curves)
      for (const double value : curve->y) low = std::min(low, value * y.factor), high = std::max(high, value * y.factor);
    if (low <= high) most = std::max(most, letters_of_tics(low, high));
  }
  return std::max(narrow, 47 + letter * double(most));
}

// 1, 2, 5 in each decade: gnuplot alone would name the decades only.
std::string log_tics(double low, double high) {
  std::string tics;
  for (double decade = std::pow(10, std::floor(std::log10(low))); decade <= high; decade *= 10)
    for (const double lead : {1, 2, 5})
      if (lead * decade >= low && lead * decade <= high) tics += fmt::format("{}{:g}", tics.empty() ? "" : ",", lead * decade);
  return "(" + tics + ")";
}

}  // namespace

plot::Figure curve_figure(const std::vector<HistoryCurve>& curves, CurveKind kind, const std::string& note) {
  if (curves.empty()) return {};
  if (curves.size() > most_curves)
    throw Error(
        fmt::format("{} curves are more than a figure can tell apart, which is {}; choose fewer columns", curves.size(), most_curves));
  const std::vector<Group> groups = groups_of(curves, kind);
  const double left = room_at_left(groups);
  std::vector<const HistoryCurve*> all;
  std::vector<std::string> runs, names;
  for (const HistoryCurve& curve : curves) {
    all.push_back(&curve);
    if (std::find(runs.begin(), runs.end(), curve.run) == runs.end()) runs.push_back(curve.run);
  }
  std::size_t longest = 0;
  for (const HistoryCurve& curve : curves) {
    const std::string words = shortened(plot::words_of(curve.y_name), 40);
    names.push_back(runs.size() == 1 ? words : shortened(curve.run, 48) + ": " + words);
    longest = std::max(longest, names.back().size());
  }
  const bool over_log = kind == CurveKind::spectrum || kind == CurveKind::response;
  const std::string& x_name = curves.front().x_name;
  const Scale x = scale_of(
      all, over_log ? "" : plot::unit_of(x_name), [](const HistoryCurve& c) -> const auto& { return c.x; });
  const std::string x_unit = kind == CurveKind::spectrum ? "Hz" : kind == CurveKind::response ? "s" : x.unit;
  double x_low = HUGE_VAL, x_high = -HUGE_VAL;
  for (const HistoryCurve& curve : curves)
    for (const double value : curve.x) x_low = std::min(x_low, value * x.factor), x_high = std::max(x_high, value * x.factor);

  const double head = note.empty() ? 40 : 62;
  std::vector<double> heights;
  double total = head + foot - spacing;
  for (const Group& group : groups) {
    heights.push_back(std::max(groups.size() == 1 ? 400.0 : 210.0, 21.0 * double(group.curves.size()) + 12));
    total += heights.back() + spacing;
  }
  plot::Figure figure{left + width + 70 + letter * double(longest), total};
  figure.settings = "set zeroaxis lc rgb '#b0b0b0' lt 1 lw 0.8\n";
  const std::size_t room = std::size_t((figure.width - left) / letter);
  figure.labels = {{shortened(fmt::format("{}", fmt::join(runs, ", ")), room),
                    fmt::format("screen {:.5f},{:.5f}", left / figure.width, 1 - 20 / total), "left font ',15' tc rgb '#111111'"},
                   {shortened(note, room), fmt::format("screen {:.5f},{:.5f}", left / figure.width, 1 - 43 / total),
                    "left font ',12' tc rgb '#555555'"}};
  double top = head;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const Group& group = groups[g];
    const Scale y = scale_of(
        group.curves, group.unit, [](const HistoryCurve& c) -> const auto& { return c.y; });
    const bool last = g + 1 == groups.size();
    plot::Panel p;
    p.axes = {left / figure.width, (left + width) / figure.width, 1 - (top + heights[g]) / total, 1 - top / total};
    p.key = "at graph 1.015,1 left top Left reverse samplen 3.2 spacing 1.1 noenhanced";
    p.x = {last ? fmt::format("{} [{}]", shortened(plot::words_of(x_name), 60), x_unit) : "",
           x_high > x_low ? fmt::format("[{:.8g}:{:.8g}]", x_low, x_high) : range_of(x_low, x_high, false),
           over_log ? log_tics(x_low, x_high) : "",
           last ? "" : "none",
           "noenhanced",
           over_log};
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (const HistoryCurve* curve : group.curves) {
      const std::size_t i = p.series.size();
      std::string rows;
      const HistoryCurve drawn = thinned(*curve, 6000);
      for (std::size_t k = 0; k < drawn.x.size(); ++k) {
        const double value = drawn.y[k] * y.factor;
        low = std::min(low, value), high = std::max(high, value);
        rows += fmt::format("{:.8g} {:.8g}\n", drawn.x[k] * x.factor, value);
      }
      p.series.push_back({figure.add_rows(rows) + " using 1:2",
                          fmt::format("lines lw 1.6 lc rgb '{}' dashtype {}", colors[i % colors.size()], dashes[i % dashes.size()]),
                          names[std::size_t(curve - curves.data())]});
    }
    p.y = {axis_label(group, kind, y.unit), range_of(low, high, kind != CurveKind::history), "", "", "noenhanced"};
    figure.panels.push_back(p);
    top += heights[g] + spacing;
  }
  return figure;
}

}  // namespace erbs
