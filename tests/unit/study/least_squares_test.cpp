// Least squares over a box, on problems whose answer is known.
#include "engine/study/calibrate/least_squares.h"

#include <catch2/catch.hpp>
#include <cmath>

using namespace erbs::study;

namespace {

using Model = std::function<Residuals(const Shares&)>;

struct Counted {
  Model model;
  int runs = 0;
  Minimum solve(std::size_t n, const LeastSquares& how = {}) {
    return least_squares(
        n,
        [this](const std::vector<Shares>& points) {
          std::vector<Residuals> out;
          for (const Shares& point : points) {
            for (const double share : point) REQUIRE((share >= 0 && share <= 1));
            out.push_back(model(point));
            ++runs;
          }
          return out;
        },
        how);
  }
};

}  // namespace

TEST_CASE("least squares of a line: the answer and the deviations of linear theory", "[calibrate]") {
  // y = a + b x at x = 0 ... 9 with residues +-e: a and b by the normal equations.
  std::vector<double> y;
  for (int i = 0; i < 10; ++i) y.push_back(0.3 + 0.05 * i + (i % 2 == 0 ? 0.01 : -0.01));
  double sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (int i = 0; i < 10; ++i) sx += i, sy += y[std::size_t(i)], sxx += i * i, sxy += i * y[std::size_t(i)];
  const double b = (10 * sxy - sx * sy) / (10 * sxx - sx * sx), a = (sy - b * sx) / 10;
  Counted line{[&](const Shares& p) {
    std::vector<double> r;
    for (int i = 0; i < 10; ++i) r.push_back(p[0] + 0.2 * p[1] * i - y[std::size_t(i)]);
    return Residuals(r);
  }};
  const Minimum found = line.solve(2, {1e-7, 100});
  REQUIRE(found.found);
  CHECK(found.converged);
  CHECK(found.best[0] == Approx(a).epsilon(1e-5));
  CHECK(0.2 * found.best[1] == Approx(b).epsilon(1e-5));
  const double s2 = found.sum / 8, det = 10 * sxx - sx * sx;
  CHECK(found.deviation[0] == Approx(std::sqrt(s2 * sxx / det)).epsilon(1e-4));
  CHECK(0.2 * found.deviation[1] == Approx(std::sqrt(s2 * 10 / det)).epsilon(1e-4));
}

TEST_CASE("least squares finds a bent valley, a minimum at an end, and one among several", "[calibrate]") {
  Counted valley{[](const Shares& p) {  // Rosenbrock 1960, its minimum at (1, 1) of [-2, 2]^2
    const double x = 4 * p[0] - 2, y = 4 * p[1] - 2;
    return Residuals({{10 * (y - x * x), 1 - x}});
  }};
  const Minimum bent = valley.solve(2, {1e-6, 200});
  CHECK(bent.best[0] == Approx(0.75).margin(1e-3));
  CHECK(bent.best[1] == Approx(0.75).margin(2e-3));
  for (const double target : {-0.5, 1.5}) {
    Counted end{[=](const Shares& p) { return Residuals({{p[0] - target, 0.1}}); }};
    CHECK(end.solve(1).best[0] == (target < 0 ? 0 : 1));
  }
  Counted waves{[](const Shares& p) { return Residuals({{std::sin(12 * p[0]) + 1, 2 * (p[0] - 0.9)}}); }};  // least near .91, others at .39
  CHECK(waves.solve(1, {1e-4, 50}).best[0] == Approx(0.91).margin(0.01));
}

TEST_CASE("least squares passes over runs without an answer, and says that none has one", "[calibrate]") {
  Counted holes{[](const Shares& p) -> Residuals {
    if (p[0] < 0.5) return std::nullopt;
    return std::vector<double>{p[0] - 0.7, p[0] - 0.7};
  }};
  CHECK(holes.solve(1).best[0] == Approx(0.7).margin(1e-3));
  Counted nothing{[](const Shares&) -> Residuals { return std::nullopt; }};
  CHECK_FALSE(nothing.solve(1).found);
  CHECK(nothing.runs == 9);
  Counted flat{[](const Shares&) { return Residuals({{1.0, 2.0, 3.0}}); }};
  const Minimum unmoved = flat.solve(2);
  CHECK(std::isinf(unmoved.deviation[0]));
  CHECK(flat.runs < 200);
  // As many params as residuals: each is found, and nothing tells how well.
  Counted exact{[](const Shares& p) { return Residuals({{p[0] - 0.3, p[1] - 0.6}}); }};
  const Minimum both = exact.solve(2);
  CHECK(both.best[1] == Approx(0.6).margin(1e-3));
  CHECK((std::isnan(both.deviation[0]) && std::isnan(both.deviation[1])));
}
