// Curves of run folders: choice of columns, spectra, envelope, thinning, and the figure of several runs.
#include "engine/record/results/curves.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>

#include "engine/base/error.h"
#include "engine/base/units.h"
#include "engine/record/plot/unit.h"
#include "engine/record/results/curve_figure.h"
#include "tests/support/folder.h"

using namespace erbs;

namespace {

CsvTable table_of(const std::vector<std::string>& names) {
  CsvTable table;
  table.names = names;
  table.columns.assign(names.size(), {0, 1, 2});
  table.text.resize(names.size());
  return table;
}

HistoryCurve sine(double amplitude, double frequency) {
  HistoryCurve curve{"run", "time_s", "floor_ax_m_s2", {}, {}};
  for (int i = 0; i < 4000; ++i) {
    curve.x.push_back(0.005 * i);
    curve.y.push_back(amplitude * std::sin(2 * pi * frequency * curve.x.back()));
  }
  return curve;
}

std::size_t highest(const HistoryCurve& curve) { return std::size_t(std::max_element(curve.y.begin(), curve.y.end()) - curve.y.begin()); }

}  // namespace

TEST_CASE("columns are chosen by name, beginning or pattern", "[plot]") {
  const CsvTable table = table_of({"time_s", "top_ux_m", "top_ux_m_s2", "top_uy_m", "base_fx_N"});
  CHECK(choose_columns(table, "top_ux_m") == std::vector<int>{1});  // a whole name is no beginning
  CHECK(choose_columns(table, "top_u") == std::vector<int>{1, 2, 3});
  CHECK(choose_columns(table, "*_m") == std::vector<int>{1, 3});
  CHECK(choose_columns(table, "top_u?_m") == std::vector<int>{1, 3});
  CHECK_THROWS_WITH(choose_columns(table, "top_vx_m"), Catch::Contains("did you mean \"top_ux_m\"") && Catch::Contains("--list"));
  CHECK_THROWS_AS(choose_columns(table, ""), Error);
  CHECK_THROWS_AS(choose_columns(table, "?"), Error);
  CHECK_THROWS_WITH(choose_columns(table, "*a*a*a*a*a*"), Catch::Contains("simpler"));
}

TEST_CASE("columns name their units", "[plot]") {
  CHECK(plot::unit_of("time_s") == "s");
  CHECK(plot::unit_of("v_m_s") == "m_s");
  CHECK(plot::unit_of("mortar_damage") == "");
  CHECK(plot::words_of("base_fx_N") == "base fx");
  CHECK(std::string(plot::shown_unit(*plot::find_unit("N"), 2e3).name) == "kN");
  CHECK(std::string(plot::shown_unit(*plot::find_unit("m"), 0).name) == "µm");
}

TEST_CASE("a span of time is two numbers in order", "[plot]") {
  CHECK(time_span_of("2:4.5").to == 4.5);
  for (const char* wrong : {"4:2", "2", ":", "1:", "nan:2", "1:inf", "1:2:3", "a:b"}) {
    INFO(wrong);
    CHECK_THROWS_WITH(time_span_of(wrong), Catch::Contains("try 2:4.5"));
  }
}

TEST_CASE("the spectrum of a sine has its amplitude and frequency", "[plot]") {
  const HistoryCurve s = amplitude_spectrum(sine(3, 2.5));
  CHECK(s.x[highest(s)] == Approx(2.5).margin(0.02));  // a bin is 1/82 s
  CHECK(s.y[highest(s)] == Approx(3).epsilon(0.02));   // the peak may lie between two bins
  CHECK(s.x.front() > 0);
  HistoryCurve other = sine(1, 1);
  other.x_name = "top_ux_m";
  CHECK_THROWS_WITH(amplitude_spectrum(other), Catch::Contains("--x"));
}

TEST_CASE("the response spectrum resonates at the period of the ground", "[plot]") {
  // Twenty seconds at resonance with 5 % damping: amplitude 1 / (2 * 0.05) times the ground's, reached to exp(-0.05 w t).
  const HistoryCurve r = response_curve(sine(1, 2.5), 0.05);
  CHECK(r.x[highest(r)] == Approx(0.4).epsilon(0.03));  // periods are spaced by 2.3 %
  CHECK(r.y[highest(r)] == Approx(10).epsilon(0.03));
  CHECK(r.y.front() == Approx(1).epsilon(0.05));  // a stiff oscillator follows the ground
  HistoryCurve other = sine(1, 1);
  other.y_name = "top_ux_m";
  CHECK_THROWS_WITH(response_curve(other, 0.05), Catch::Contains("_m_s2"));
}

TEST_CASE("an envelope is the running maximum", "[plot]") {
  CHECK(envelope_of({1, -3, 2, -2, 4}) == std::vector<double>{1, 3, 3, 3, 4});
  CHECK(envelope_of({}).empty());
}

TEST_CASE("a thinned curve keeps its peaks and its order", "[plot]") {
  HistoryCurve curve = sine(1, 3);
  curve.y[1717] = 50;
  curve.y[2121] = -70;
  const HistoryCurve thin = thinned(curve, 200);
  CHECK(thin.x.size() <= 260);
  CHECK(thin.y[highest(thin)] == 50);
  CHECK(*std::min_element(thin.y.begin(), thin.y.end()) == -70);
  CHECK(std::is_sorted(thin.x.begin(), thin.x.end()));
  CHECK(thin.x.front() == curve.x.front());
  CHECK(thin.x.back() == curve.x.back());
  CHECK(thinned(curve, 1000000).y == curve.y);
}

TEST_CASE("rows of both files are joined where their times agree", "[plot]") {
  const test::Folder dir;
  std::ofstream(dir.file("histories.csv")) << "time_s,a_m\n0,1\n1,2\n2,3\n";
  std::ofstream(dir.file("energy.csv")) << "time_s,kinetic_J\n0,4\n1,nan\n";  // ended between the two files
  const CsvTable table = read_columns(dir.path.string());
  CHECK(table.names == std::vector<std::string>{"time_s", "a_m", "kinetic_J"});
  CHECK(table.rows() == 2);
  CHECK(curve_of(table, 0, 1, {}).y == std::vector<double>{1, 2});
  CHECK_THROWS_WITH(curve_of(table, 0, 2, {}), Catch::Contains("kinetic_J is not finite at 1 s") && Catch::Contains("--time"));
  CHECK_THROWS_WITH(curve_of(table, 0, 1, {5, 6}), Catch::Contains("last from 0 s to 1 s"));
}

TEST_CASE("runs over each other share axes, units share panels, and no two curves look alike", "[plot]") {
  std::vector<HistoryCurve> curves;
  for (const char* run : {"first", "it's \\ $HOME"})
    for (const char* name : {"top_ux_m", "base_fx_N"}) curves.push_back({run, "time_s", name, {0, 1}, {0, 0.02}});
  const plot::Figure figure = curve_figure(curves, CurveKind::history, "");
  REQUIRE(figure.panels.size() == 2);
  for (const plot::Panel& panel : figure.panels) {
    REQUIRE(panel.series.size() == 2);
    CHECK(panel.x.range == "[0:1]");
    CHECK(panel.series[0].look != panel.series[1].look);
  }
  CHECK(figure.panels[0].y.label == "top ux [mm]");
  CHECK(figure.panels[1].x.label == "time [s]");
  CHECK(plot::script_of(figure).find("title 'it''s \\ $HOME: base fx'") != std::string::npos);
  curves.assign(36, curves.front());
  CHECK_THROWS_WITH(curve_figure(curves, CurveKind::history, ""), Catch::Contains("choose fewer"));
}
