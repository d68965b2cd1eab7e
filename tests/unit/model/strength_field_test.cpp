#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>

#include "engine/model/build/build.h"
#include "tests/unit/lua/load.h"

using namespace erbs;

namespace {

// Towers of small bricks in a row: towers times 20 joints, one above the other.
Scene towers(int count, const std::string& scatter) {
  lua::Script script(lua::quiet());
  const std::string text = fmt::format(R"(
material{{ name = "brick", density = 1800 }}
analysis{{ duration = 1 }}
for k = 1, {} do
  for i = 0, 20 do box{{ name = k .. "_" .. i, size = {{ .1, .1, .1 }}, at = {{ 3 + .3 * k, 0, .1 * i }}, material = "brick", group = "t" .. k, fixed = i == 0 }} end
  joint{{ between = {{ "t" .. k, "t" .. k }}, law = mortar{{ kn = 1e11, ft = 2e5, c = 3e5, mu = .6, Gf1 = 10, Gf2 = 50{} }} }}
end)",
                                       count, scatter);
  return script.load_text(text, "scene.lua", {});
}

// ln of the strength of each joint over its nominal value, with its height and its rule.
struct Strength {
  double ln, z;
  int rule;
};
std::vector<Strength> strengths(const Scene& scene) {
  const Built built = build(scene);
  std::vector<Strength> out;
  for (const Joint& joint : built.model.joint) {
    const PointLaw& law = built.model.laws[std::size_t(joint.type->law)];
    CHECK(law.ft / 2e5 == Approx(law.c / 3e5));
    CHECK(law.opening_ultimate == Approx(2 * 10 / 2e5));  // the opening at which the bond is lost stays
    CHECK(law.kn == 1e11);
    out.push_back({std::log(law.ft / 2e5), built.model.rest[std::size_t(joint.a)].z(), joint.type->rule});
  }
  return out;
}

}  // namespace

TEST_CASE("strengths scatter with mean 1 and the coefficient of variation asked for", "[model][scatter]") {
  for (const double cv : {0.1, 0.3, 0.6}) {
    double sum = 0, square = 0;
    int n = 0;
    for (int seed = 1; seed <= 8; ++seed)
      for (const Strength& one : strengths(towers(10, fmt::format(", scatter = {{ cv = {}, seed = {} }}", cv, seed))))
        sum += std::exp(one.ln), square += std::exp(2 * one.ln), ++n;
    const double mean = sum / n;
    REQUIRE(n == 1600);
    CHECK(mean == Approx(1).margin(4 * cv / 40));
    CHECK(std::sqrt(square / n - mean * mean) == Approx(cv).epsilon(0.15));
  }
}

TEST_CASE("equal seeds give equal strengths, other seeds others, and no scatter one law a rule", "[model][scatter]") {
  const auto all = [](const std::string& text) {
    std::vector<double> out;
    for (const Strength& one : strengths(towers(3, text))) out.push_back(one.ln);
    return out;
  };
  const std::string first = ", scatter = { cv = .3, seed = 5 }";
  CHECK(all(first) == all(first));
  CHECK(all(first) != all(", scatter = { cv = .3, seed = 6 }"));
  for (const double ln : all("")) CHECK(ln == 0);
  CHECK(build(towers(3, "")).model.laws.size() == 3);
}

TEST_CASE("strengths are correlated over the length asked for", "[model][scatter]") {
  const double length = 0.5, s = std::sqrt(std::log1p(0.09));
  double near = 0, far = 0;
  int count_near = 0, count_far = 0;
  for (int seed = 1; seed <= 20; ++seed) {
    const auto all = strengths(towers(5, fmt::format(", scatter = {{ cv = .3, length = {}, seed = {} }}", length, seed)));
    for (const Strength& a : all)
      for (const Strength& b : all) {
        if (a.rule != b.rule) continue;
        const double product = (a.ln / s + s / 2) * (b.ln / s + s / 2), r = b.z - a.z;
        if (std::fabs(r - 0.3) < 1e-6) near += product, ++count_near;
        if (std::fabs(r - 1.5) < 1e-6) far += product, ++count_far;
      }
  }
  // exp(-.36) and exp(-9); some 100 towers with four independent stretches each: 1 / sqrt(400), thrice.
  CHECK(near / count_near == Approx(std::exp(-0.36)).margin(0.17));
  CHECK(far / count_far == Approx(0).margin(0.2));
}
