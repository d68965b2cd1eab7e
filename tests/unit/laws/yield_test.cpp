// The yield criterion: on paper, the same for numbers and packs, and its bounds over a face.
#include "engine/laws/yield.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "engine/laws/laws.h"

using namespace erbs;
using namespace erbs::scalar;

namespace {

PointLaw brick_mortar(const char* coupling) {
  Mortar m;
  m.kn = 1e10, m.ks = 4e9, m.ft = 0.1e6, m.c = 0.2e6, m.mu = 0.7, m.fc = 5e6, m.coupling = coupling;
  return m.compile();
}

// Whether a point yields, in stresses, as a text book has it.
bool yields_on_paper(const PointLaw& law, const std::string& coupling, double opening, double slip) {
  const double sigma = law.kn * opening, tau = law.ks * slip;
  if (sigma > law.ft) return true;
  if (sigma <= 0 || coupling == "coulomb") return tau > law.c - law.mu * sigma;
  const double use = sigma / law.ft;
  return tau > (coupling == "linear" ? law.c * (1 - use) : law.c * std::sqrt(1 - use * use));
}

}  // namespace

TEST_CASE("a point yields where a text book says so") {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> any(-1, 1);
  for (const char* coupling : {"coulomb", "linear", "ellipse"}) {
    const PointLaw law = brick_mortar(coupling);
    int yielded = 0;
    for (int i = 0; i < 20000; ++i) {
      const double opening = 2e-5 * any(random), slip = 1e-4 * std::fabs(any(random));
      const bool yields = yields_on_paper(law, coupling, opening, slip);
      CHECK(point_yields(law, opening, slip * slip) == yields);
      yielded += yields;
    }
    CHECK(yielded > 4000);
    CHECK(yielded < 16000);
  }
}

TEST_CASE("a face within its bound has no point that yields") {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> any(-1, 1);
  for (const char* coupling : {"coulomb", "linear", "ellipse", "dry"}) {
    PointLaw law = brick_mortar(coupling[0] == 'd' ? "coulomb" : coupling);
    if (coupling[0] == 'd') law = DryFriction{1e10, 4e9, 0.6}.compile();
    const auto limits = yield_limits(law);
    const double half_s = 0.1, half_t = 0.05, radius = std::hypot(half_s, half_t);
    int within = 0;
    for (int i = 0; i < 20000; ++i) {
      const double gap[6] = {3e-5 * any(random), 3e-5 * any(random), 5e-4 * (any(random) - 0.8),
                             2e-4 * any(random), 2e-4 * any(random), 3e-4 * any(random)};
      if (face_bound(limits, gap, half_s, half_t, radius) > 0) continue;
      ++within;
      for (int k = 0; k < 20; ++k) {
        const double s = half_s * any(random), t = half_t * any(random);
        const double slip_s = gap[0] - gap[5] * t, slip_t = gap[1] + gap[5] * s, opening = gap[2] + gap[3] * t - gap[4] * s;
        CHECK_FALSE(point_yields(law, opening, slip_s * slip_s + slip_t * slip_t));
        CHECK_FALSE(corner_yields(law, opening));
      }
    }
    CHECK(within > 500);
  }
}

TEST_CASE("the bound of the world-axes pass lies above that of the face") {
  // The pass of intact joints puts the whole relative rotation at the farthest corner.
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-1, 1);
  const auto limits = yield_limits(brick_mortar("coulomb"));
  const double half_s = 0.1, half_t = 0.05, radius = std::hypot(half_s, half_t);
  for (int i = 0; i < 20000; ++i) {
    const double gap[6] = {3e-5 * any(random), 3e-5 * any(random), 2e-4 * any(random),
                           2e-4 * any(random), 2e-4 * any(random), 3e-4 * any(random)};
    const double swing = radius * std::sqrt(gap[3] * gap[3] + gap[4] * gap[4] + gap[5] * gap[5]);
    const double by_diameter = yield_bound(limits, gap[2] + swing, swing - gap[2], gap[0] * gap[0] + gap[1] * gap[1], swing);
    if (face_bound(limits, gap, half_s, half_t, radius) > 0) CHECK(by_diameter > 0);
  }
}

TEST_CASE("numbers and packs yield alike, soften alike and slide alike") {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> any(0, 1);
  for (const char* coupling : {"coulomb", "linear", "ellipse"}) {
    PointLaw law = brick_mortar(coupling);
    law.opening_ultimate = 20 * law.opening_peak, law.slip_ultimate = 1e-4, law.mu_residual = 0.5;
    for (int i = 0; i < 500; ++i) {
      double x[6][8];
      for (auto& row : x)
        for (double& value : row) value = any(random);
      const double span = law.opening_ultimate;
      for (int l = 0; l < 8; ++l) x[0][l] *= span, x[1][l] *= x[0][l], x[3][l] *= 500, x[4][l] *= 3e-4, x[5][l] *= 3e-4;
      const auto respond = [&]<class T>(T wide, T opening, T damage, T pressure, T gs, T gt) {
        using scalar::sqrt;
        Bond<T> bond{T(0), T(law.kn), T(law.opening_peak)};
        damage_to(law, bond, damage > 0, damage);
        const MaskFor<T> holds = bond.damage < 1;
        const T sigma = damage_by_opening(law, bond, holds, wide, opening);
        const T weight = T(1e-3), k = law.ks * weight, size = k * sqrt(gs * gs + gt * gt);
        const T cap = bond_shear(law, sigma, bond.damage) * weight + friction_at(law, bond.damage) * pressure;
        SlipReturn<T> slip{{gs, gt}, {T(0), T(0)}, T(0), T(0)};
        return_slip(law, bond, true, MaskFor<T>(size > cap), k, weight, size, cap, pressure, sigma, InPlane<T>{0.9 * gs, 0.9 * gt}, slip);
        // within the limit after softening
        const T after = bond_shear(law, sigma, bond.damage) * weight + friction_at(law, bond.damage) * pressure;
        return std::array<T, 7>{
            bond.damage, bond.secant, slip.elastic.s, slip.plastic.t, slip.friction, slip.fracture, k * sqrt(square(slip.elastic)) - after};
      };
      const auto packs = respond(load(x[0]), load(x[1]), load(x[2]), load(x[3]), load(x[4]), load(x[5]));
      for (int l = 0; l < 8; ++l) {
        const auto one = respond(x[0][l], x[1][l], x[2][l], x[3][l], x[4][l], x[5][l]);
        for (std::size_t k = 0; k < one.size(); ++k) CHECK(one[k] == packs[k][l]);
        CHECK(one[4] >= 0);
        CHECK(one[5] >= -1e-12);
        CHECK(one[6] <= 1e-9);
      }
    }
  }
}
