// The rocking reference against closed forms, and against tables computed independently.
#include "engine/analysis/rocking.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "engine/base/units.h"

using namespace erbs;
using namespace erbs::analysis;

namespace {

const RockingBlock wall = homogeneous_block(0.6, 3.0, standard_g), pena = homogeneous_block(0.25, 1.0, standard_g),
                   makris = homogeneous_block(0.4, 1.2, standard_g);

RockingBlock linear(RockingBlock block) {
  block.linear = true;
  return block;
}

// Bands under a sine whose amplitude is the block's own threshold: factors are a / (g tan alpha), linear a / (g alpha).
template <class Sine>
std::vector<OverturningBand> bands(const RockingBlock& block, double w, Criterion criterion, double low, double high, int points) {
  Sine wave;
  wave.amplitude = block.gravity * block.alpha;
  wave.frequency = w * block.p / (2 * pi);
  return overturning_bands(block, wave, criterion, low, high, points, end_time(wave) + 12 / block.p);
}

}  // namespace

TEST_CASE("constants of the blocks", "[rocking]") {
  CHECK(pena.alpha == Approx(0.24498).epsilon(1e-5));
  CHECK(pena.p == Approx(3.77831).epsilon(2e-6));
  CHECK(wall.mu == Approx(0.94231).epsilon(1e-5));
}

TEST_CASE("free rocking: period and decay", "[rocking]") {
  const double phi = 0.5, start = phi * pena.alpha;
  const RockingRun run = rock(linear(pena), {}, {start, 0}, 4);
  CHECK(run.impact.front() == Approx(std::acosh(1 / (1 - phi)) / pena.p).epsilon(1e-9));  // Housner (3)
  double r = 1;
  for (int n = 0; n <= 6; ++n, r *= pena.mu * pena.mu)  // Housner (4)
    CHECK(run.amplitude[std::size_t(n)] / pena.alpha == Approx(1 - std::sqrt(1 - r * (1 - (1 - phi) * (1 - phi)))).epsilon(1e-9));
  const RockingRun exact = rock(wall, {}, {0.05, 0}, 4);
  const double times[] = {0.36644, 1.03926, 1.65970, 2.23377, 2.76645, 3.26182};
  for (std::size_t i = 0; i < 6; ++i) CHECK(exact.impact[i] == Approx(times[i]).margin(5e-5));
}

TEST_CASE("half sine: both criteria in linear theory are closed forms", "[rocking]") {
  for (const double w : {0.5, 1.0, 2.0, 3.0, 5.0, 10.0}) {
    // True overturning: w sin psi - cos psi = exp(-(pi - psi)/w). Alpha at the end: tanh((pi - psi)/w) = w tan psi. Both with a = g alpha /
    // sin psi.
    const auto solve = [](auto f) {
      double low = 1e-4, high = pi / 2;
      for (int i = 0; i < 100; ++i) (f(0.5 * (low + high)) < 0 ? low : high) = 0.5 * (low + high);
      return 1 / std::sin(low);
    };
    const double falls = solve([w](double psi) { return w * std::sin(psi) - std::cos(psi) - std::exp(-(pi - psi) / w); });
    const double at_end = solve([w](double psi) { return w * std::tan(psi) - std::tanh((pi - psi) / w); });
    INFO(w);
    CHECK(bands<HalfSine>(linear(makris), w, Criterion::overturning, 0.5, 40, 200).front().from == Approx(falls).epsilon(1e-6));
    CHECK(bands<HalfSine>(linear(makris), w, Criterion::alpha_at_end, 0.5, 40, 200).front().from == Approx(at_end).epsilon(1e-6));
  }
  const double exact[] = {1.3680, 1.8667, 2.3824};
  for (int w = 1; w <= 3; ++w)
    CHECK(bands<HalfSine>(makris, w, Criterion::overturning, 0.5, 5, 50).front().from == Approx(exact[w - 1]).margin(1e-4));
}

TEST_CASE("full sine: the safe island above the first branch", "[rocking]") {
  struct Row {
    int w;
    double first, island, above;
  };
  for (const Row& row : {Row{1, 1.1739, 1.4650, 1.4679}, Row{3, 1.4823, 3.5947, 3.8184}, Row{5, 3.7107, 6.4042, 7.7134}}) {
    const auto found = bands<FullSine>(makris, row.w, Criterion::overturning, 0.9, 9, 3000);
    INFO(row.w);
    REQUIRE(found.size() >= 2);
    CHECK(found.front().from == Approx(row.first).margin(1e-3));  // sensitive to mu
    CHECK(found.back().from == Approx(row.above).margin(3e-4));
    CHECK(found.back().impacts == 0);
    const OverturningBand& below = found[found.size() - 2];
    CHECK(below.impacts == 1);
    CHECK(below.to == Approx(row.island).margin(3e-4));
  }
  const double branch[] = {1.4183, 2.3499, 3.6312};  // no impact: independent of mu and alpha in linear theory
  for (int w = 1; w <= 3; ++w)
    for (const RockingBlock& block : {makris, pena})
      CHECK(bands<FullSine>(linear(block), w, Criterion::overturning, 0.9, 5, 2000).back().from == Approx(branch[w - 1]).margin(1e-4));
}

TEST_CASE("scale: the same slenderness twice as large is slower by sqrt 2 and falls alike", "[rocking]") {
  const RockingBlock large = homogeneous_block(0.8, 2.4, standard_g);
  CHECK(large.p == Approx(makris.p / std::sqrt(2)));
  CHECK(bands<HalfSine>(large, 2, Criterion::overturning, 0.5, 5, 50).front().from ==
        Approx(bands<HalfSine>(makris, 2, Criterion::overturning, 0.5, 5, 50).front().from).epsilon(1e-7));
}

TEST_CASE("a block below its threshold stays at rest, and a short pulse is not stepped over", "[rocking]") {
  const Wave weak = Pulse{0.99 * standard_g * std::tan(makris.alpha), 1, 0.5}, blow = Pulse{40, 3, 0.05};
  const RockingRun steps_since_limited = rock(makris, {&weak, 1}, {}, 5);
  CHECK(steps_since_limited.impact.empty());
  CHECK(steps_since_limited.theta.back() == 0);
  const RockingRun struck = rock(makris, {&blow, 1}, {}, 5);
  REQUIRE_FALSE(struck.amplitude.empty());
  CHECK(struck.theta[3] < 0);  // the ground moves away under it
}
