// Records in a scene: three components by one call, what is done to them, and the intensity of a wave.
#include <catch2/catch.hpp>

#include "tests/unit/lua/bench.h"

using namespace erbs;
using namespace erbs::lua;

namespace {

struct Files : Bench {
  Files() {
    write("x.txt", "0 1\n.01 -4\n.02 1\n.03 0\n");
    write("y.txt", "0 1\n.01 2\n.02 1\n");
    write("z.txt", "0 .5\n.01 1\n.02 0\n");
    write("slow.txt", "0 .5\n.02 1\n.04 0\n");
  }
  Scene load(const std::string& piece) const {
    Script script(quiet());
    return script.load(scene(sound + piece), {});
  }
  std::vector<std::string> mistakes(const std::string& piece) const {
    try {
      load(piece);
    } catch (const Errors& errors) { return errors.messages; }
    return {};
  }
};

}  // namespace

TEST_CASE("three components of a record come by one call", "[lua][record]") {
  const Files files;
  const Scene scene = files.load("ground_records{ x = 'x.txt', y = 'y.txt', z = 'z.txt', unit = 'm/s2', peak = 2 }\n");
  REQUIRE(scene.loads.size() == 3);
  for (int i = 0; i < 3; ++i) CHECK(scene.loads[std::size_t(i)].direction == Vec3::Unit(i));
  CHECK(value(scene.loads[0].wave, 0.01) == -2);
  CHECK(value(scene.loads[1].wave, 0.01) == 1);
  CHECK(value(scene.loads[2].wave, 0.01) == 0.5);
  CHECK(scene.inputs.size() == 4);  // with the scene
  CHECK(mentions(scene.notes, "peak of x"));
  CHECK(mentions(scene.notes, "none accelerates after its end"));  // the ground goes on at its end velocity: it does not rest
  const Scene named = files.load("ground_records{ x = 'x.txt', y = 'y.txt', unit = 'm/s2', peak = 2, of = 'y' }\n");
  REQUIRE(named.loads.size() == 2);
  CHECK(value(named.loads[0].wave, 0.01) == -4);
}

TEST_CASE("mistakes in the components name the line and the remedy", "[lua][record]") {
  const Files files;
  CHECK(mentions(files.mistakes("ground_records{ x = 'x.txt', y = 'slow.txt', unit = 'g' }\n"), "no common time axis"));
  CHECK(mentions(files.mistakes("ground_records{ x = 'x.txt', unit = 'g', of = 'z' }\n"), "give z"));
  CHECK(mentions(files.mistakes("ground_records{ unit = 'g' }\n"), "no component"));
  CHECK(mentions(files.mistakes("ground_records{ x = 'w.txt', unit = 'g' }\n"), "\"w.txt\" is not there"));
  CHECK(mentions(files.mistakes("ground_records{ x = 'x.txt', unit = 'g', file = 'x.txt' }\n"), "unknown key \"file\""));
  CHECK(mentions(files.mistakes("ground_records{ x = 'x.txt', unit = 'g', peak = 1, scale = 2 }\n"), "exclude each other"));
  CHECK(mentions(files.mistakes("ground_records{ x = 'x.txt' }\n"), "unit"));
  CHECK(mentions(files.mistakes("ground_records{ x = 'x.txt', unit = 'g', low = 5, high = 60 }\n"), "half the sampling rate"));
}

TEST_CASE("a peak of zero is no motion, not the motion as recorded", "[lua][record]") {
  const Files files;
  const Scene one = files.load("ground_motion{ wave = record{ file = 'x.txt', unit = 'm/s2', peak = 0 } }\n"),
              all = files.load("ground_records{ x = 'x.txt', y = 'y.txt', unit = 'm/s2', peak = 0 }\n");
  REQUIRE(all.loads.size() == 2);
  for (const Wave& wave : {one.loads[0].wave, all.loads[0].wave, all.loads[1].wave}) CHECK(value(wave, 0.01) == 0);
  CHECK(value(files.load("ground_motion{ wave = record{ file = 'x.txt', unit = 'm/s2' } }\n").loads[0].wave, 0.01) != 0);
}

TEST_CASE("check, log and manifest are told what was done to a record", "[lua][record]") {
  const Files files;
  const Scene scene =
      files.load("ground_motion{ wave = record{ file = 'x.txt', unit = 'm/s2', baseline = 'constant', high = 20 }, direction = 'x' }\n");
  CHECK(mentions(scene.notes, "x.txt: constant baseline"));
  CHECK(mentions(scene.notes, "zero phase"));
  CHECK(mentions(
      files.load("ground_motion{ wave = record{ file = 'x.txt', unit = 'mm', quantity = 'displacement', smoothing = 30 } }\n").notes,
      "smoothing spline"));
  CHECK(files.load("ground_motion{ wave = record{ file = 'x.txt', unit = 'm/s2' } }\n").notes.empty());
}

TEST_CASE("a wave with jumps has its exact spectrum, whenever it starts", "[lua][record]") {
  const Files files;
  const Scene pulses = files.load(
      "for i, d in ipairs{ .001, .01, .1 } do for j, start in ipairs{ -1, 0, .0137, 20 } do\n"
      "  local wave = pulse{ amplitude = 2, duration = d, start = start }\n"
      "  local exact = 4 * math.sin(math.pi * d)\n"  // 2 a sin(pi d / T) for d < T / 2
      "  param('p' .. i .. j, spectral_acceleration{ wave = wave, period = 1, damping = 0 } / exact)\n"
      "end end\n");
  CHECK(pulses.params.size() == 12);
  for (const auto& ratio : pulses.params) CHECK(ratio.value == Approx(1).epsilon(1e-9));
  // 2 cos(4 pi t) for half a second, by a Runge-Kutta of 50,000 steps
  const Scene cosines = files.load(
      "for j, start in ipairs{ 0, 2.013 } do for k, T in ipairs{ .5, 2 } do\n"
      "  local wave = full_cosine{ amplitude = 2, frequency = 2, start = start }\n"
      "  param('c' .. j .. k, spectral_acceleration{ wave = wave, period = T, damping = .05 })\n"
      "end end\n");
  for (const std::size_t i : {0, 2}) CHECK(cosines.params[i].value == Approx(5.004).epsilon(3e-4));
  for (const std::size_t i : {1, 3}) CHECK(cosines.params[i].value == Approx(0.2217).epsilon(3e-4));
}

TEST_CASE("a long step doubles in an undamped oscillator", "[lua][record]") {
  const Files files;
  const Scene scene = files.load(
      "param('sa', spectral_acceleration{ wave = pulse{ amplitude = 3, duration = 5 }, period = .4, damping = 0 })\n"
      "param('late', spectral_acceleration{ wave = table_wave{ times = { 0, 4 }, values = { 3, 3 } }, period = .4, damping = 0 })\n");
  CHECK(scene.params[0].value == Approx(6).epsilon(0.004));  // 40 samples a period
  CHECK(scene.params[1].value == Approx(6).epsilon(0.004));
  CHECK(mentions(files.mistakes("spectral_acceleration{ wave = sine{ amplitude = 1, frequency = 1 }, period = 1 }\n"), "no end"));
}
