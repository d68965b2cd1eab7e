// Elastic spectra of codes against their tables and formulas, continuity at corner periods, and wrong input.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "engine/base/error.h"
#include "engine/base/units.h"
#include "engine/loads/spectra/design_spectrum.h"

using namespace erbs;

namespace {

DesignSpectrum en(const std::string& type, const std::string& ground, double ag = 1) {
  DesignSpectrum s;
  s.kind = "EN 1998-1 type " + type, s.ground = ground, s.ag = ag;
  return s;
}

DesignSpectrum tbsc(double SDS, double SD1) {
  DesignSpectrum s;
  s.kind = "TBSC 2018", s.SDS = SDS, s.SD1 = SD1;
  return s;
}

DesignSpectrum table(std::vector<double> T, std::vector<double> Sa, double TC = 0.5) {
  DesignSpectrum s;
  s.kind = "table", s.period = std::move(T), s.acceleration = std::move(Sa), s.TC = TC;
  return s;
}

bool says(const DesignSpectrum& s, const std::string& part) {
  const std::vector<std::string> all = check_spectrum(s);
  return std::any_of(all.begin(), all.end(), [&](const std::string& one) { return one.find(part) != std::string::npos; });
}

}  // namespace

TEST_CASE("the spectra of EN 1998-1 have the values of its tables 3.2 and 3.3", "[spectrum]") {
  struct Row {
    const char *type, *ground;
    double S, TB, TC, TD;
  };
  const std::vector<Row> rows{{"1", "A", 1.0, .15, .4, 2},     {"1", "B", 1.2, .15, .5, 2},   {"1", "C", 1.15, .2, .6, 2},
                              {"1", "D", 1.35, .2, .8, 2},     {"1", "E", 1.4, .15, .5, 2},   {"2", "A", 1.0, .05, .25, 1.2},
                              {"2", "B", 1.35, .05, .25, 1.2}, {"2", "C", 1.5, .1, .25, 1.2}, {"2", "D", 1.8, .1, .3, 1.2},
                              {"2", "E", 1.6, .05, .25, 1.2}};
  for (const Row& r : rows) {
    CAPTURE(r.type, r.ground);
    for (const double ag : {0.5, 3.0}) {
      const DesignSpectrum s = en(r.type, r.ground, ag);
      CHECK(check_spectrum(s).empty());
      CHECK(spectral_acceleration(s, 0) == Approx(ag * r.S));
      CHECK(spectral_acceleration(s, r.TB / 2) == Approx(ag * r.S * 1.75));
      CHECK(spectral_acceleration(s, r.TB) == Approx(2.5 * ag * r.S));
      CHECK(spectral_acceleration(s, r.TC) == Approx(2.5 * ag * r.S));
      CHECK(spectral_acceleration(s, r.TD) == Approx(2.5 * ag * r.S * r.TC / r.TD));
      CHECK(spectral_acceleration(s, 2 * r.TD) == Approx(2.5 * ag * r.S * r.TC / (4 * r.TD)));
      CHECK(spectral_displacement(s, 3 * r.TD) == Approx(2.5 * ag * r.S * r.TC * r.TD / (4 * pi * pi)));
    }
  }
}

TEST_CASE("spectra are continuous at their corner periods", "[spectrum]") {
  for (const DesignSpectrum& s : {en("1", "D"), en("2", "A"), tbsc(0.9, 0.27), tbsc(1.3, 0.6)}) {
    const CornerPeriods corner = corner_periods(s);
    for (const double T : {corner.begin, corner.end, corner.last})
      CHECK(spectral_acceleration(s, T * (1 - 1e-9)) == Approx(spectral_acceleration(s, T * (1 + 1e-9))).epsilon(1e-7));
  }
}

TEST_CASE("damping changes the plateau, not the acceleration of the ground", "[spectrum]") {
  CHECK(damping_correction(0.05) == Approx(1));
  CHECK(damping_correction(0.1) == Approx(std::sqrt(2.0 / 3)));
  CHECK(damping_correction(0.02) == Approx(std::sqrt(10.0 / 7)));
  CHECK(damping_correction(0.3) == 0.55);
  DesignSpectrum s = en("1", "B", 2);
  s.damping = 0.1;
  CHECK(spectral_acceleration(s, 0) == Approx(2.4));
  CHECK(spectral_acceleration(s, 0.3) == Approx(6 * std::sqrt(2.0 / 3)));
}

TEST_CASE("the spectrum of TBSC 2018 follows section 2.3.4", "[spectrum]") {
  const DesignSpectrum s = tbsc(0.9, 0.27);  // T_A = .06 s, T_B = .3 s
  CHECK(check_spectrum(s).empty());
  for (const auto& [T, share] : {std::pair{0.0, 0.36}, {0.03, 0.63}, {0.06, 0.9}, {0.3, 0.9}, {1.0, 0.27}, {6.0, 0.045}, {12.0, 0.01125}}) {
    CAPTURE(T);
    CHECK(spectral_acceleration(s, T) == Approx(share * standard_g));
  }
}

TEST_CASE("a table is linear between its rows and ends with them", "[spectrum]") {
  const DesignSpectrum s = table({0, 0.1, 0.5, 2}, {3, 7, 7, 1});
  CHECK(check_spectrum(s).empty());
  for (const auto& [T, a] : {std::pair{0.0, 3.0}, {0.05, 5.0}, {0.1, 7.0}, {0.4, 7.0}, {1.25, 4.0}, {2.0, 1.0}})
    CHECK(spectral_acceleration(s, T) == Approx(a));
  CHECK(corner_periods(s).end == 0.5);
  CHECK_THROWS_WITH(spectral_acceleration(s, 2.5), Catch::Contains("2.5") && Catch::Contains("add rows"));
}

TEST_CASE("values of a national annex take the place of the ground type", "[spectrum]") {
  DesignSpectrum s = en("1", "", 1);
  CHECK(says(s, "needs a ground type"));
  s.S = 1.25, s.TB = 0.1, s.TC = 0.45, s.TD = 3;
  CHECK(check_spectrum(s).empty());
  CHECK(spectral_acceleration(s, 3) == Approx(2.5 * 1.25 * 0.45 / 3));
  s.ground = "B", s.S = 0;
  CHECK(spectral_acceleration(s, 0) == Approx(1.2));
}

TEST_CASE("a spectrum with mistakes says what is wrong and how to mend it", "[spectrum][bad_input]") {
  DesignSpectrum falling = en("1", "B");
  falling.TB = 0.7;
  CHECK(says(falling, "TB = 0.7 s, TC = 0.5 s"));
  falling.TB = 0, falling.TD = 0.4;
  CHECK(says(falling, "give TB <= TC < TD"));
  CHECK(says(tbsc(0.1, 0.7), "lies beyond T_L = 6 s"));
  CHECK(says(tbsc(0.9, 0), "add SDS = 0.9"));
  CHECK(says(en("1", "B", 0), "add ag = 0.2*g"));
  CHECK(says(DesignSpectrum{}, "there is no spectrum"));
  CHECK(says(table({0, 0.5, 0.4}, {3, 7, 7}), "growing order"));
  CHECK(says(table({0, 0.5, 0.5}, {3, 7, 7}), "each once"));
  CHECK(says(table({0.1, 0.5}, {3, 7}), "T = 0"));
  CHECK(says(table({0, 0.5}, {0, 0}), "no acceleration"));
  CHECK(says(table({0}, {1}), "two rows"));
  CHECK(says(table({0, 1}, {3, 3}, 0), "add TC"));
  CHECK(says(table({0, 1}, {3, 3}, 2), "beyond the last row"));
  DesignSpectrum mixed = tbsc(0.9, 0.27);
  mixed.ag = 2, mixed.damping = 0.1;
  CHECK(says(mixed, "ag belongs to kind"));
  CHECK(says(mixed, "damping belongs to kind"));
}
