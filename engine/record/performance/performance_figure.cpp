#include "engine/record/performance/performance_figure.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/base/error.h"
#include "engine/base/text.h"
#include "engine/base/units.h"
#include "engine/record/plot/unit.h"

namespace erbs {
namespace {

// Okabe and Ito 2008; the lines differ in dash and width as well, for grey print.
constexpr const char *blue = "#0072b2", *orange = "#d55e00", *black = "#000000", *grey = "#8a8a8a";

// What all series of the sheet share.
struct Scale {
  double length = 1;    // shown units per m
  std::string unit;     // of the length
  double x = 0, y = 0;  // ends of the axes: shown units, g

  std::string row(double displacement, double acceleration) const {
    return fmt::format("{:.8g} {:.8g}\n", displacement * length, acceleration / standard_g);
  }
};

// The elastic spectrum, or the one reduced by the ductility `mu` (Vidic, Fajfar and Fischinger 1994, as Fajfar 2000, eqs. 9 to 13).
std::string spectrum_rows(const DesignSpectrum& spectrum, double mu, const Scale& scale) {
  const double corner = corner_periods(spectrum).end, longest = std::min(20.0, last_period(spectrum));
  std::string rows;
  for (double period = 0; period <= longest; period += std::max(0.002, 0.005 * period)) {
    const double reduction = period < corner ? 1 + (mu - 1) * period / corner : mu;
    const double acceleration = spectral_acceleration(spectrum, period) / reduction;
    const double displacement = mu * acceleration * period * period / (4 * pi * pi);
    rows += scale.row(displacement, acceleration);
    if (displacement * scale.length > 1.1 * scale.x) break;
  }
  return rows;
}

std::string curve_rows(const Performance& p, const PerformancePoint& point, const Scale& scale) {
  std::string rows;
  for (std::size_t i = 0; i < p.D.size(); ++i) rows += scale.row(p.D[i], point.A[i]);
  return rows;
}

struct PeriodLine {
  double period;  // s
  std::string name;
};

// Lines of equal period from the origin to the edge of the panel, with their names there. Names that would run into each other are written
// to either side at the upper edge, and one behind the other at the right edge.
void add_periods(plot::Panel& panel, std::vector<PeriodLine> lines, const Scale& scale) {
  std::ranges::sort(lines, {}, &PeriodLine::period);
  const auto slope = [&](const PeriodLine& l) { return 4 * pi * pi / (l.period * l.period) / (standard_g * scale.length); };  // g per unit
  const auto end = [&](const PeriodLine& l) { return std::min(scale.x, scale.y / slope(l)); };
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const double x = end(lines[i]), y = slope(lines[i]) * x;
    const bool at_right = x > scale.x * (1 - 1e-9);
    const bool behind = at_right && i > 0 && end(lines[i - 1]) > x * (1 - 1e-9) && slope(lines[i - 1]) * x - y < 0.06 * scale.y;
    const auto near = [&](std::size_t other) { return other < lines.size() && std::fabs(end(lines[other]) - x) < 0.25 * scale.x; };
    const char* look = at_right      ? "right offset -0.4,0.7"
                       : near(i + 1) ? "right offset 0.5,0.6"
                       : near(i - 1) ? "left offset -0.5,0.6"
                                     : "center offset 0,0.6";
    const double along = behind ? 0.8 : 1;  // of the line
    panel.lines.push_back(fmt::format("from first 0,0 to first {:.6g},{:.6g} nohead back lw 0.8 dt (4,4) lc rgb '{}'", x, y, grey));
    panel.labels.push_back(
        {lines[i].name, fmt::format("first {:.6g},{:.6g}", along * x, along * y), fmt::format("{} font ',11' tc rgb '#5a5a5a'", look)});
  }
}

plot::Panel panel_of(plot::Figure& figure, const Performance& p, const PerformancePoint& point, const DesignSpectrum& spectrum,
                     const std::string& name, const Scale& scale) {
  plot::Panel panel;
  panel.x = {fmt::format("displacement of the oscillator [{}]", scale.unit), fmt::format("[0:{:.6g}]", scale.x)};
  panel.y = {"acceleration [g]", fmt::format("[0:{:.6g}]", scale.y)};
  panel.key = "at graph 0.5,-0.19 center top Left reverse samplen 2.4 spacing 1.15";
  const TargetDisplacement& o = point.oscillator;
  const BilinearCurve& b = point.bilinear;
  panel.labels.push_back({name, "graph 0.5,1.115", "center font ',14'"});
  panel.series.push_back(
      {figure.add_rows(spectrum_rows(spectrum, 1, scale)), fmt::format("lines lw 2.2 lc rgb '{}'", blue), "elastic spectrum"});
  if (o.q > 1)
    panel.series.push_back({figure.add_rows(spectrum_rows(spectrum, o.ductility, scale)),
                            fmt::format("lines lw 1.8 dt (9,5) lc rgb '{}'", blue), fmt::format("reduced, ductility {:.3g}", o.ductility)});
  panel.series.push_back({figure.add_rows(curve_rows(p, point, scale)), fmt::format("linespoints lw 1.4 pt 7 ps 0.35 lc rgb '{}'", black),
                          "states of the push"});
  const std::string bilinear =
      scale.row(0, 0) + scale.row(b.yield_displacement, b.yield_acceleration) + scale.row(b.end, b.yield_acceleration);
  panel.series.push_back({figure.add_rows(bilinear), fmt::format("lines lw 2.6 lc rgb '{}'", orange), "bilinear curve"});
  if (o.target > b.end)
    panel.series.push_back({figure.add_rows(scale.row(b.end, b.yield_acceleration) + scale.row(o.target, b.yield_acceleration)),
                            fmt::format("lines lw 1.6 dt (3,4) lc rgb '{}'", orange)});
  const double height = std::min(b.yield_acceleration, o.target * 4 * pi * pi / (o.period * o.period));
  panel.series.push_back({figure.add_rows(scale.row(o.target, height)), fmt::format("points pt 7 ps 1.3 lc rgb '{}'", orange),
                          fmt::format("{} {:.3g} {}", point.within_curve ? "performance point" : "demand, beyond the curve:",
                                      o.target * scale.length, scale.unit)});
  panel.lines.push_back(fmt::format("from first {0:.6g},0 to first {0:.6g},{1:.6g} nohead lw 1 dt (2,3) lc rgb '{2}'",
                                    o.target * scale.length, height / standard_g, orange));
  std::vector<PeriodLine> periods{{o.period, fmt::format("T* = {:.3g} s", o.period)}};
  const CornerPeriods corner = corner_periods(spectrum);
  for (const double period : {corner.end, corner.last})
    if (period > 0 && std::fabs(period / o.period - 1) > 0.15) periods.push_back({period, fmt::format("{:.3g} s", period)});
  add_periods(panel, std::move(periods), scale);
  return panel;
}

}  // namespace

plot::Figure performance_figure(const Performance& p, const DesignSpectrum& spectrum, const std::string& title) {
  Scale scale;
  double length = p.D.back(), acceleration = 0;
  for (const PerformancePoint* point : {&p.n2, &p.mpp}) {
    length = std::max({length, point->oscillator.target, point->bilinear.end});
    acceleration = std::max({acceleration, point->bilinear.yield_acceleration, point->oscillator.demand});
  }
  for (double period = 0; period <= std::min(20.0, last_period(spectrum)); period += 0.005)
    acceleration = std::max(acceleration, spectral_acceleration(spectrum, period));
  const plot::ShownUnit& unit = plot::shown_unit(*plot::find_unit("m"), length);
  scale.length = unit.factor, scale.unit = unit.name;
  scale.x = 1.15 * length * scale.length, scale.y = 1.15 * acceleration / standard_g;
  plot::Figure figure{.width = 1120, .height = 720};
  figure.labels.push_back({title, "screen 0.5,0.965", "center font ',15'"});
  figure.labels.push_back(
      {fmt::format("{}; shape at the {}, {}, Gamma = {:.4g}", p.spectrum, p.shape == "peak" ? "peak" : "first state under load",
                   counted(p.nodes.nodes, "mass node"), p.nodes.gamma),
       "screen 0.5,0.925", "center font ',12'"});
  figure.panels.push_back(panel_of(figure, p, p.n2, spectrum, "N2, EN 1998-1 annex B: A = F*/m*", scale));
  figure.panels.push_back(panel_of(figure, p, p.mpp, spectrum, "mass-proportional pushover: A = V/M", scale));
  for (std::size_t i = 0; i < 2; ++i) {
    const double left = 0.5 * double(i);
    figure.panels[i].cell = {left, left + 0.5, 0, 0.9};
    figure.panels[i].axes = plot::AxesBox{left + 0.085, left + 0.465, 0.29, 0.83};
  }
  return figure;
}

void draw_performance(const std::string& path, const Performance& p, const DesignSpectrum& spectrum, const std::string& title) {
  if (p.trouble.empty()) plot::draw(performance_figure(p, spectrum, title), path);
}

}  // namespace erbs
