#include "engine/model/build/strength_field.h"

#include <algorithm>
#include <cmath>

#include "engine/base/units.h"

namespace erbs {
namespace {

constexpr int waves_of_field = 512;  // the correlation of one draw errs by 1 / sqrt(512)

Random seeded(const Scatter& scatter, int rule, int joint) {
  Random random{std::uint64_t(scatter.seed)};
  random.state = random.next() ^ std::uint64_t(rule);
  random.state = random.next() ^ std::uint64_t(joint + 1);
  return random;
}

}  // namespace

double normal(Random& random) {
  const double u = 1 - random.uniform();  // above 0
  return std::sqrt(-2 * std::log(u)) * std::cos(2 * pi * random.uniform());
}

double StrengthField::field(const Scatter& scatter, int rule, int joint, const Vec3& x) {
  if (scatter.length <= 0) {
    Random random = seeded(scatter, rule, joint);
    return normal(random);
  }
  std::vector<Wave>& waves = waves_[rule];
  if (waves.empty()) {
    // The transform of exp(-(r / length)^2) is a normal density of wave numbers with the standard deviation sqrt(2) / length.
    Random random = seeded(scatter, rule, -1);
    const double spread = std::sqrt(2.0) / scatter.length;
    for (int i = 0; i < waves_of_field; ++i) {
      const double kx = spread * normal(random), ky = spread * normal(random), kz = spread * normal(random);
      waves.push_back({{kx, ky, kz}, 2 * pi * random.uniform()});
    }
  }
  double sum = 0;
  for (const Wave& wave : waves) sum += std::cos(wave.k.dot(x) + wave.phase);
  return std::sqrt(2.0 / waves_of_field) * sum;
}

int StrengthField::law_of(int rule, int joint, const Vec3& centre) {
  const auto* mortar = std::get_if<Mortar>(&scene_.joint_rules[std::size_t(rule)].law);
  if (mortar == nullptr || mortar->scatter.cv <= 0) return rule;
  const double value = std::clamp(field(mortar->scatter, rule, joint, centre), -farthest, farthest);
  const int rank = int(std::lround(classes * value));
  const auto [at, is_new] = laws_.try_emplace({rule, rank}, int(model_.laws.size()));
  if (is_new) {
    // Lognormal of mean 1: the median is exp(-s^2 / 2), s^2 = ln(1 + cv^2).
    const double s = std::sqrt(std::log1p(mortar->scatter.cv * mortar->scatter.cv));
    model_.laws.push_back(compile(mortar->scaled(std::exp(s * rank / classes - 0.5 * s * s))));
  }
  return at->second;
}

}  // namespace erbs
