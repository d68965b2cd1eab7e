// The order of loads of a push, without a structure: steps, bracket, path there and back, and the machine of displacement control.
#include <catch2/catch.hpp>
#include <cmath>

#include "engine/analysis/quasi_static/push_path.h"

using namespace erbs;
using namespace erbs::analysis;

namespace {

// Follows the path of a structure that stands up to `capacity`; returns the number of attempts.
int follow(LoadPath& path, double capacity) {
  int attempts = 0;
  for (; !path.done() && attempts < 1000; ++attempts)
    if (std::abs(path.next()) <= capacity) path.found();
    else path.failed();
  return attempts;
}

}  // namespace

TEST_CASE("a push brackets the capacity as narrowly as asked", "[push]") {
  for (const double capacity : {0.0003, 0.0151, 0.2, 0.37361, 1.7}) {
    for (const double bracket : {0.02, 0.002, 1e-4}) {
      PushSettings push;
      push.kind = "pushover", push.bracket = bracket;
      LoadPath path(push);
      const int attempts = follow(path, capacity);
      CAPTURE(capacity, bracket, attempts);
      REQUIRE(path.above);
      CHECK(path.at <= capacity);
      CHECK(*path.above > capacity);
      CHECK(*path.above - path.at <= bracket * *path.above + 1e-15);
      CHECK(attempts < capacity / 0.01 + 25);
    }
  }
}

// A structure that sways half a step beyond where it comes to rest falls too early under long steps.
TEST_CASE("a push tries a load again that failed from afar", "[push]") {
  for (const double capacity : {0.0151, 0.1425, 0.37361, 1.7}) {
    for (const double bracket : {0.02, 0.002, 1e-4}) {
      for (const double sway : {0.3, 1.}) {
        PushSettings push;
        push.kind = "pushover", push.bracket = bracket, push.step = 0.02;
        LoadPath path(push);
        int attempts = 0;
        for (; !path.done() && attempts < 1000; ++attempts)
          if (path.next() + sway * (path.next() - path.at) <= capacity) path.found();
          else path.failed();
        CAPTURE(capacity, bracket, sway, attempts);
        REQUIRE(path.above);
        CHECK(path.at <= capacity);
        CHECK(*path.above - path.at <= bracket * *path.above + 1e-15);
        CHECK(capacity - path.at <= (1 + 2 * sway) * bracket * *path.above + 1e-15);
        CHECK(attempts < capacity / 0.02 + 25 + 50 * sway);
      }
    }
  }
}

TEST_CASE("a push that never fails ends at its last load", "[push]") {
  PushSettings push;
  push.kind = "pushover", push.up_to = 0.055, push.step = 0.02;
  LoadPath path(push);
  CHECK(follow(path, 10) == 3);
  CHECK_FALSE(path.above);
  CHECK(path.at == 0.055);
}

TEST_CASE("a path there and back visits its loads in turn", "[push]") {
  PushSettings push;
  push.kind = "tilt", push.path = {-0.1, 0.05}, push.step = 0.04, push.up_to = 0.5;
  LoadPath path(push);
  std::vector<double> visited;
  while (!path.done() && visited.size() < 100) visited.push_back(path.next()), path.found();
  const std::vector<double> first{-0.04, -0.08, -0.1, -0.06, -0.02, 0.02, 0.05};
  for (std::size_t i = 0; i < first.size(); ++i) CHECK(visited[i] == Approx(first[i]).margin(1e-12));
  CHECK(visited.back() == 0.5);
}

TEST_CASE("a structure that falls on the way back is bracketed there", "[push]") {
  PushSettings push;
  push.kind = "tilt", push.path = {-0.3}, push.step = 0.04;
  LoadPath path(push);
  follow(path, 0.17);
  REQUIRE(path.above);
  CHECK(path.at < 0);
  CHECK(*path.above < -0.17);
  CHECK(path.at - *path.above <= 0.002 * 0.18);
}

TEST_CASE("the machine passes a peak and goes on behind it", "[push]") {
  // Multiplier over displacement: up to .3 at 1 mm, then down to zero at .4 m, from there or, where a bond breaks, from half of it.
  const double left = GENERATE(1.0, 0.5), up = 300, down = left * 0.3 / 0.399;
  PushSettings push;
  push.kind = "pushover", push.control = "displacement", push.displacement = GENERATE(0.02, 0.2);
  MachinePath machine(push, 2);
  double peak = 0;
  int states = 0;
  while (!machine.done() && states < 1000) {
    const double k = machine.stiffness, to = machine.next();
    double u = k * to / (k + up);  // where the machine and the structure agree
    if (u > 0.001 || machine.displacement > 0.001) u = (k * to - 0.4 * down) / (k - down);
    if (machine.goes_too_far(u)) {
      machine.repeat(u);
      continue;
    }
    machine.found(u);
    CHECK(machine.multiplier == Approx(u > 0.001 ? down * (0.4 - u) : up * u).margin(1e-9));
    peak = std::max(peak, machine.multiplier);
    ++states;
  }
  CAPTURE(left, push.displacement);
  CHECK(machine.displacement == Approx(push.displacement).epsilon(1e-3));
  CHECK(peak <= 0.3 + 1e-9);
  CHECK(peak > 0.3 * (1 - push.bracket));
  CHECK(states < 150);
}

TEST_CASE("a machine stiffens where the curve falls faster than it is stiff, and is soft again behind it", "[push]") {
  // Up to `peak` with a slope of 1e5 per m, down to .5 at `end`, and flat from there.
  const double peak = GENERATE(0.9, 5.0), end = GENERATE(1e-3, 5e-3, 0.015), up = 1e5, left = 0.5, most = peak / up;
  const double down = (peak - left) / (end - most);
  PushSettings push;
  push.kind = "pushover", push.control = "displacement", push.displacement = 0.02;
  MachinePath machine(push, 2, up);
  const double soft = machine.stiffness;
  int states = 0, attempts = 0;
  for (; !machine.done() && attempts < 5000; ++attempts) {
    const double k = machine.stiffness, to = machine.next();
    double u = k * to / (k + up);
    if (u > most || machine.displacement > most) u = k > down ? (k * to - peak - down * most) / (k - down) : end;
    if (u >= end) u = std::max(end, to - left / k);
    if (machine.goes_too_far(u)) {
      machine.repeat(u);
      continue;
    }
    CHECK(u - machine.displacement <= 0.051 * push.displacement);
    machine.found(u);
    ++states;
    CHECK(machine.multiplier == Approx(u > end ? left : u > most ? peak - down * (u - most) : up * u).margin(1e-9));
  }
  CAPTURE(peak, end, states, attempts);
  CHECK(machine.displacement == Approx(push.displacement).epsilon(1e-3));
  CHECK(machine.stiffness == soft);
  CHECK(attempts < 1000);
}

TEST_CASE("a machine whose structure comes apart brackets the load there", "[push]") {
  // A part that the machine does not hold falls at the multiplier .25; the curve of the monitored point goes on rising.
  for (const double bracket : {0.02, 0.002, 1e-4}) {
    PushSettings push;
    push.kind = "pushover", push.control = "displacement", push.displacement = 0.001, push.bracket = bracket;
    MachinePath machine(push, 2);
    int attempts = 0;
    for (; !machine.done() && attempts < 1000; ++attempts) {
      const double u = machine.stiffness * machine.next() / (machine.stiffness + 1e4);  // a spring of 1e4 per m
      if (machine.load(machine.next(), u) > 0.25) machine.failed();
      else machine.found(u);
    }
    CAPTURE(bracket, attempts);
    CHECK(machine.bracketed());
    CHECK(machine.multiplier <= 0.25);
    CHECK(machine.load(*machine.above, machine.displacement) > 0.25);
    CHECK(machine.load(*machine.above, machine.displacement) < machine.multiplier * (1 + bracket) + 1e-9);
    CHECK(attempts < 60);
  }
}

// The shear triplet: the middle brick is pushed out between two that are held. On paper it yields at 2 c A, less its weight.
TEST_CASE("a push acts on blocks that all lie at one height", "[push]") {
  const std::string triplet = R"(
    material { name = "brick", density = 1800 }
    box { name = "left", size = { .1, .25, .1 }, at = { -.1, 0, 0 }, fixed = true }
    box { name = "mid", size = { .1, .25, .1 }, at = { 0, 0, 0 } }
    box { name = "right", size = { .1, .25, .1 }, at = { .1, 0, 0 }, fixed = true }
    joint { law = mortar { kn = 1e11, ft = .2 * MPa, c = .3 * MPa, mu = .7 } }
    analysis { kind = "pushover", pattern = { { block = "mid", force = { 0, 0, -1000 } } }, up_to = 100, step = 1 }
  )";
  const test::Scratch dir("push_triplet");
  const double weight = 1800 * 0.1 * 0.25 * 0.1 * 9.81, paper = (2 * 0.3e6 * 0.1 * 0.25 - weight) / 1000;
  CHECK(push(triplet, dir.path).metrics.capacity->peak.multiplier == Approx(paper).epsilon(2e-3));
}

// A strip of eight courses under a light cap between smooth guides. Its masses are scaled up to the capacity, and are true in the fall
// after it.
TEST_CASE("the fall after a push has the step that its true masses bear", "[push]") {
  const std::string strip = R"(
    material { name = "s", density = 1800 }
    material { name = "cap", density = 300 }
    ground { size = 10, material = "s" }
    for i = 0, 7 do box { name = "b" .. i, size = { 1, .11, .3 }, at = { 0, 0, i * .3 }, material = "s" } end
    box { name = "cap", size = { 1, .11, .3 }, at = { 0, 0, 2.4 }, material = "cap", group = "cap" }
    box { name = "stop1", size = { 1, .2, .24 }, at = { 0, .11, 2.43 }, fixed = true, group = "stop", material = "cap" }
    box { name = "stop2", size = { 1, .2, .24 }, at = { 0, -.2, 2.43 }, fixed = true, group = "stop", material = "cap" }
    joint { law = dry { kn = 1e12, mu = 2 } }
    joint { law = dry { kn = 1e12, mu = 0 }, between = { "cap", "stop" } }
    analysis { kind = "pushover", direction = "y", monitor = { block = "b4" } }
  )";
  const test::Scratch dir("push_light_cap");
  const Metrics m = push(strip, dir.path).metrics;
  CHECK(m.status == "completed");
  CHECK(m.capacity->peak.multiplier == Approx(0.1194).epsilon(5e-3));
}
