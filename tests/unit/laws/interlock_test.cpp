// Interlock of asperities: what friction may take is Coulomb's over some hops, and never below the mean within them.
#include "engine/laws/interlock.h"

#include <catch2/catch.hpp>

#include <cmath>

#include "engine/base/units.h"
#include "engine/laws/slip.h"

using namespace erbs;
using namespace erbs::scalar;

namespace {

constexpr double dt = 1e-5, hop = 4e-3;  // s
// Averaging over 20 hops, a loan of two.
const Interlock<double> lock{.gap = 1e-3, .slow = 1, .loan = 2 * hop, .rate = dt / (20 * hop), .dt = dt, .updates = true};

// A point that slips all the time.
struct Slipping {
  double mean = 0, lent = 0;

  double pressure_for(double stress, double gap = 0, bool slow = true) {
    const double held = interlocked_stress(lock, mean, lent, gap, stress, slow);
    lent = lent_after(lock, lent, stress, held, held);
    return held;
  }
};

}  // namespace

TEST_CASE("friction under a pressure that trembles is Coulomb's in the mean, and keeps to its mean while the faces part", "[interlock]") {
  const double amplitude = GENERATE(0.3, 1.0, 4.0);  // of the pressure: from 1 on the faces part
  Slipping point;
  double pressed = 0, held = 0, least = 1e300, least_unloaded = 1e300;
  for (int i = 0; i < 200'000; ++i) {
    const double stress = 1e4 * std::max(0.0, 1 + amplitude * std::sin(2 * pi * dt / hop * i)), now = point.pressure_for(stress);
    if (i < 100'000) continue;
    pressed += stress, held += now;
    least = std::min(least, now / point.mean);
    if (stress < 0.3 * point.mean) least_unloaded = std::min(least_unloaded, now / point.mean);
  }
  CHECK(held == Approx(pressed).epsilon(1e-3));
  CHECK(least_unloaded > 0.999);
  CHECK(least > 0.75);  // as the pressure comes back to its mean, no more is lent
}

TEST_CASE("what rises presses at once, and what is unloaded for good lets go after a loan", "[interlock]") {
  Slipping point;
  for (int i = 0; i < 100'000; ++i) point.pressure_for(1e4);
  CHECK(point.lent == 0);
  CHECK(point.pressure_for(3e4) == 3e4);
  double beyond = 0;
  for (int i = 0; i < 100'000; ++i) beyond += (point.pressure_for(1e3) - 1e3) * dt;
  CHECK(beyond < 1.05 * lock.loan * 1e4);
  CHECK(beyond > 0.5 * lock.loan * 1e4);
  CHECK(point.pressure_for(1e3) == Approx(1e3).epsilon(0.1));
}

TEST_CASE("faces that slide fast or have parted borrow nothing, and what they owe they pay when they meet", "[interlock]") {
  Slipping point;
  for (int i = 0; i < 100'000; ++i) point.pressure_for(1e4);
  CHECK(point.pressure_for(0, 0, false) == 0);
  CHECK(point.pressure_for(0) == Approx(1e4).epsilon(1e-2));
  const double lent = point.lent;
  CHECK(lent > 0);
  CHECK(point.pressure_for(0, 2 * lock.gap) == 0);
  CHECK(point.lent == lent);
  CHECK(point.pressure_for(3e4) == Approx(3e4 - lent / dt));
  CHECK(point.lent == Approx(0).margin(1e-15));
}

TEST_CASE("hops far apart are Coulomb's in the mean as well", "[interlock]") {
  Slipping point;
  double pressed = 0, held = 0;
  for (int i = 0; i < 200'000; ++i) {
    const int at = i % 1000;  // in touch for 4 ms, in flight for 6 ms
    const double stress = at < 400 ? 1e4 * std::sin(pi * (at + 0.5) / 400) : 0, gap = at < 450 ? 0 : 2 * lock.gap;
    pressed += stress, held += point.pressure_for(stress, gap);
  }
  CHECK(held <= pressed * 1.001);
  CHECK(held > 0.99 * pressed);
}
