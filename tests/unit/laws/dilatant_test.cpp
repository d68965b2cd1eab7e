// Uplift of rough faces: closed form away from the mated position, no energy out of nothing on any path, bad input.
#include "engine/laws/dilatant.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "engine/laws/laws.h"
#include "tests/unit/lua/load.h"

using namespace erbs;
using namespace erbs::scalar;
using erbs::lua::mistakes_in;

namespace {

PointLaw rough(double psi, double wear_slip) {
  Dilatant law;
  law.kn = 1e10, law.mu = 0.7, law.psi = psi, law.wear_slip = wear_slip;
  law.complete();
  return compile(law);
}

struct RoughFaces {
  PointLaw law;
  double own[DilatantFace::numbers] = {};
  void slide(double s, double t) { DilatantFace::advance(law, own, InPlane<double>{s, t}, uplift()); }
  double uplift() const { return own[DilatantFace::uplift]; }
};

}  // namespace

TEST_CASE("rough faces rise by tan(psi) slip (1 - slip / 2 wear_slip) in any direction and with any steps") {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> any(0, 1);
  for (int i = 0; i < 200; ++i) {
    const double psi = 0.05 + 0.5 * any(random), wear_slip = 1e-4 + 1e-2 * any(random), angle = 6.28 * any(random);
    RoughFaces faces{rough(psi, wear_slip)};
    double slip = 0;
    while (slip < 1.5 * wear_slip) {
      slip += wear_slip * 0.3 * any(random);
      faces.slide(slip * std::cos(angle), slip * std::sin(angle));
      const double worn_slip = std::min(slip, wear_slip), paper = std::tan(psi) * worn_slip * (1 - worn_slip / (2 * wear_slip));
      CHECK(faces.uplift() == Approx(paper).epsilon(1e-12));
    }
  }
}

TEST_CASE("uplift takes less than the work of friction on any path") {
  std::mt19937 random(2);
  std::normal_distribution<double> any;
  for (int i = 0; i < 200; ++i) {
    RoughFaces faces{rough(0.6, 5e-3)};  // tan 0.684, mu 0.7
    double s = 0, t = 0;
    for (int k = 0; k < 100; ++k) {
      const double ds = 5e-4 * any(random), dt = 5e-4 * any(random), before = faces.uplift();
      s += ds, t += dt;
      faces.slide(s, t);
      CHECK(std::fabs(faces.uplift() - before) <= 0.7 * std::hypot(ds, dt));
    }
  }
}

TEST_CASE("a dilation angle beyond friction is refused, with its place and the remedy") {
  const auto with = [](const std::string& psi) {
    return "joint{ law = dilatant{ kn = 1e10, mu = .5, psi = " + psi + "*deg, wear_slip = 2*mm } }";
  };
  CHECK(mistakes_in(with("20")).empty());
  const auto mistakes = mistakes_in(with("40"));
  REQUIRE(mistakes.size() == 1);
  CHECK_THAT(mistakes[0], Catch::Contains("scene.lua:6") && Catch::Contains("not below mu") && Catch::Contains("smaller psi"));
}

TEST_CASE("faces that have slid by 5 % of their side, or have no asperities, may go over to contact") {
  const double half_s = 0.2, half_t = 0.1;
  RoughFaces faces{rough(0.3, 1)};
  const double joined[6] = {0.0099, 0, -1e-6, 0, 0, 0}, slid[6] = {0.0101, 0, -1e-6, 0, 0, 0};
  CHECK(DilatantFace::released(faces.law, faces.own, joined, half_s, half_t) == 0);
  CHECK(DilatantFace::released(faces.law, faces.own, slid, half_s, half_t) == 1);
  const RoughFaces plain{rough(0, 1)};
  CHECK(DilatantFace::released(plain.law, plain.own, joined, half_s, half_t) == 1);
}
