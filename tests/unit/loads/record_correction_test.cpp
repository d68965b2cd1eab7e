#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>

#include "engine/base/units.h"
#include "engine/loads/record/components.h"
#include "engine/loads/record/correction.h"
#include "engine/loads/record/record_report.h"
#include "engine/loads/record/spline.h"
#include "tests/support/places.h"
#include "tests/unit/loads/record_input.h"

using namespace erbs;
using Catch::Contains;
using test::mistake_in;
using test::read_text;

namespace {

std::vector<double> steps(int n, double dt) {
  std::vector<double> t;
  for (int i = 0; i < n; ++i) t.push_back(i * dt);
  return t;
}

// Amplitude and phase (rad) of the values at a frequency, over a whole number of cycles in the middle of them.
std::pair<double, double> tone_of(const std::vector<double>& t, const std::vector<double>& values, double f, double from, double to) {
  double c = 0, s = 0;
  int n = 0;
  for (size_t i = 0; i < t.size(); ++i)
    if (t[i] >= from - 1e-9 && t[i] < to - 1e-9)
      c += values[i] * std::cos(2 * pi * f * t[i]), s += values[i] * std::sin(2 * pi * f * t[i]), ++n;
  return {2 * std::hypot(c, s) / n, std::atan2(c, s)};
}

Record el_centro(const std::function<void(Record&)>& set) {
  Record record;
  record.file = test::in_source("/scenes/records/elcentro_1940_ns.csv");
  set(record);
  return read_record(record, {"scene.lua", 7});
}

}  // namespace

TEST_CASE("the band-pass has the amplitude of Butterworth and no phase", "[loads][record]") {
  const double dt = 0.005;
  const auto t = steps(16000, dt);
  for (const int order : {1, 2, 3, 4, 7})
    for (const Band band : {Band{0.5, 0, order}, Band{0, 20, order}, Band{0.5, 20, order}})
      for (const double f : {0.25, 0.5, 1.0, 5.0, 20.0, 40.0}) {
        INFO("order " << order << ", " << band.low << " to " << band.high << " Hz, tone of " << f << " Hz");
        std::vector<double> x;
        for (const double time : t) x.push_back(std::sin(2 * pi * f * time));
        band_pass(dt, x, band, {});
        const auto share = [&](double corner, double sign) {
          return corner > 0 ? 1 / (1 + std::pow(std::tan(pi * f * dt) / std::tan(pi * corner * dt), sign * 2 * order)) : 1;
        };
        // Transients of the ends have decayed at 20 s from either of them: exp(-2 pi .5 .22 20) for the slowest pole.
        const auto [amplitude, phase] = tone_of(t, x, f, 20, 60);
        CHECK(amplitude == Approx(share(band.low, -1) * share(band.high, 1)).epsilon(1e-3).margin(1e-5));
        if (amplitude > 0.01) CHECK(phase == Approx(0).margin(1e-3));
      }
}

TEST_CASE("corners of the band-pass rise and lie below half the sampling rate", "[loads][record]") {
  const std::string text = "0 1\n.01 2\n.02 3\n.03 1\n";
  const auto with = [](double low, double high) { return [=](Record& r) { r.unit = "g", r.low = low, r.high = high; }; };
  CHECK_THAT(mistake_in(text, with(10, 5)), Contains("scene.lua:7") && Contains("do not rise"));
  CHECK_THAT(mistake_in(text, with(5, 5)), Contains("do not rise"));
  CHECK_THAT(mistake_in(text, with(0, 50)), Contains("motion.txt") && Contains("half the sampling rate, 50 Hz") && Contains("high"));
  const std::string rounded = "0 1\n.0099999999 2\n.0199999998 3\n.0299999997 1\n";
  CHECK_THAT(mistake_in(rounded, with(0, 50)), Contains("half the sampling rate"));
  CHECK_THAT(mistake_in(text, with(60, 0)), Contains("half the sampling rate") && Contains("low"));
  CHECK_THAT(mistake_in("0 1\n.01 2\n.03 3\n.04 1\n", with(1, 5)),
             Contains("motion.txt:3") && Contains("t = 0.03 s") && Contains("even step"));
  CHECK_THAT(mistake_in(text, with(1e-6, 5)), Contains("raise it"));
}

TEST_CASE("a baseline of the same form is removed to round-off, whatever the record", "[loads][record]") {
  const auto t = steps(3000, 0.01);
  for (int degree = 0; degree <= 3; ++degree) {
    std::vector<double> plain, drifted;
    for (const double time : t) {
      plain.push_back(std::sin(7 * time) * std::exp(-0.1 * time) + 0.2 * std::cos(31 * time));
      double drift = 0;
      for (int k = 0; k <= degree; ++k) drift += (k % 2 == 0 ? 0.03 : -0.02) * std::pow(time / 10, k);
      drifted.push_back(plain.back() + drift);
    }
    remove_baseline(t, plain, degree);
    remove_baseline(t, drifted, degree);
    double worst = 0;
    for (size_t i = 0; i < t.size(); ++i) worst = std::max(worst, std::fabs(plain[i] - drifted[i]));
    CHECK(worst < 1e-10);
  }
  std::vector<double> same{1, 2, 3};
  remove_baseline({0, 1, 2}, same, baseline_degree("none"));
  CHECK(same == std::vector<double>{1, 2, 3});
}

TEST_CASE("a baseline brings the ground of El Centro nearer to rest, and the note says so", "[loads][record]") {
  const RecordReport plain = report(el_centro([](Record&) {}));
  const Record corrected = el_centro([](Record& r) { r.baseline = "linear", r.low = 0.1, r.high = 24; });
  CHECK_THAT(corrected.note, Contains("linear baseline") && Contains("zero phase") && Contains("0.1 to 24 Hz"));
  const RecordReport r = report(corrected);
  CHECK(std::fabs(r.pga.value) == Approx(std::fabs(plain.pga.value)).epsilon(0.03));
  CHECK_THAT(corrected.note, Contains(fmt::format("{:.2g} m/s", r.end_velocity)));
  CHECK(std::fabs(r.end_velocity) < 0.1 * std::fabs(r.pgv.value));  // the velocity that the filter would stop beyond the end
  CHECK(std::fabs(report(el_centro([](Record& x) { x.baseline = "linear"; })).end_velocity) < 0.05 * std::fabs(r.pgv.value));
  // Scaling to a peak takes the corrected record.
  CHECK(std::fabs(report(el_centro([](Record& x) { x.baseline = "linear", x.low = 0.1, x.high = 24, x.peak = 2; })).pga.value) ==
        Approx(2));
}

TEST_CASE("a displacement is differentiated twice with the share of a smoothing spline", "[loads][record]") {
  const double dt = 0.005, corner = 20;
  const auto t = steps(4000, dt);
  for (const double f : {0.5, 2.0, 5.0, 10.0, 20.0}) {
    INFO(f << " Hz");
    std::vector<double> u;
    for (const double time : t) u.push_back(0.3 + 0.1 * std::cos(2 * pi * f * time));  // at rest at the start; the offset is no motion
    const Differentiated found = differentiated(t, u, "displacement", corner, {});
    const auto [amplitude, phase] = tone_of(t, found.acceleration, f, 4, 16);
    // For evenly spaced points Q y and R g are products in frequency: q = 2 (1 - cos x) / dt, r = dt (2 + cos x) / 3, x = 2 pi f dt.
    const double x = 2 * pi * f * dt, q = 2 * (1 - std::cos(x)) / dt, r = dt * (2 + std::cos(x)) / 3;
    const double lambda = 1 / (dt * std::pow(2 * pi * corner, 4));
    CHECK(amplitude == Approx(0.1 * q / (r + lambda * q * q)).epsilon(1e-6));
    // Their limit for many points a cycle; the next term is x^2 / 12.
    if (f < 8) CHECK(amplitude == Approx(0.1 * std::pow(2 * pi * f, 2) / (1 + std::pow(f / corner, 4))).epsilon(x * x / 10 + 1e-6));
    CHECK(std::fabs(std::fabs(phase) - pi / 2) < 0.01);
  }
}

TEST_CASE("acceleration, velocity and displacement of one pulse give one motion", "[loads][record]") {
  // u = U (1 - cos w t)^2 / 4 over a cycle: displacement, velocity and acceleration start and end at zero.
  const double U = 0.05, w = 2 * pi * 1.25;
  std::string a = "# a\n", v = a, u = a;
  for (int i = 0; i <= 400; ++i) {
    const double x = w * std::clamp(0.005 * i - 0.4, 0.0, 0.8), c = 1 - std::cos(x), s = std::sin(x);
    u += fmt::format("{:.3f} {:.9e}\n", 0.005 * i, U * c * c / 4);
    v += fmt::format("{:.3f} {:.9e}\n", 0.005 * i, U * w * c * s / 2);
    a += fmt::format("{:.3f} {:.9e}\n", 0.005 * i, U * w * w * (s * s + c * std::cos(x)) / 2);
  }
  const Record from_a = read_text(a, [](Record& r) { r.unit = "m/s2"; });
  for (const auto& [text, quantity] : {std::pair{v, std::string("velocity")}, std::pair{u, std::string("displacement")}}) {
    const Record r = read_text(text, [&, quantity = quantity](Record& x) {
      x.quantity = quantity, x.unit = quantity == "velocity" ? "m/s" : "m", x.smoothing = 40;
    });
    INFO(r.note);
    CHECK_THAT(r.note, Contains(quantity) && Contains("smoothing spline"));
    for (const double time : {0.5, 0.7, 0.8, 1.0, 1.5}) {
      CHECK(value(r, time) == Approx(value(from_a, time)).margin(0.01 * U * w * w));
      CHECK(double_area(r, time) == Approx(double_area(from_a, time)).margin(0.01 * U));
    }
    CHECK(r.acceleration.area.back() == Approx(0).margin(1e-3 * U * w));
  }
  CHECK_THAT(mistake_in(u, [](Record& r) { r.quantity = "displacement", r.unit = "m", r.smoothing = 100; }), Contains("100 Hz"));
}

TEST_CASE("components of a motion have one scale and one time axis", "[loads][record]") {
  const test::Folder folder;
  const auto file = [&](const char* name, const std::string& text) {
    std::ofstream(folder.file(name)) << text;
    return folder.file(name);
  };
  std::array<Record, 3> wanted;
  wanted[0].file = file("x.txt", "0 1\n.01 -4\n.02 1\n");
  wanted[1].file = file("y.txt", "0 1\n.01 2\n.02 1\n.03 0\n");
  wanted[2].file = file("z.txt", "0 .5\n.01 1\n.02 0\n");
  for (Record& r : wanted) r.unit = "m/s2", r.peak = 2;
  const Components strongest = read_components(wanted, "strongest", {"scene.lua", 3});
  CHECK(strongest.of[0].acceleration.values[1] == -2);
  CHECK(strongest.of[1].acceleration.values[1] == 1);
  CHECK(strongest.of[2].acceleration.values[1] == 0.5);
  CHECK_THAT(strongest.note, Contains("peak of x"));
  CHECK(read_components(wanted, "y", {}).of[0].acceleration.values[1] == -4);
  for (Record& r : wanted) r.peak = 0, r.scale = 3;
  CHECK(read_components(wanted, "strongest", {}).of[2].acceleration.values[1] == 3);
  const auto mistake = [&](const std::string& named) {
    try {
      read_components(wanted, named, {"scene.lua", 3});
    } catch (const Error& error) { return std::string(error.what()); }
    return std::string("none");
  };
  wanted[2].file.clear();
  CHECK_THAT(mistake("z"), Contains("scene.lua:3") && Contains("give z"));
  wanted[1].file = file("slow.txt", "0 1\n.02 2\n.04 1\n");
  CHECK_THAT(mistake("strongest"), Contains("scene.lua:3") && Contains("no common time axis") && Contains("0.02"));
  wanted[0].file.clear(), wanted[1].file.clear();
  CHECK_THAT(mistake("strongest"), Contains("no component"));
}
