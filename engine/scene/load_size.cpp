#include "engine/scene/load_size.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <type_traits>

namespace erbs {
namespace {

// Greatest absolute value at many times of the run.
double sampled_peak(const Wave& wave, double duration) {
  constexpr int samples = 1000;
  double most = 0;
  for (int i = 0; i <= samples; ++i) most = std::max(most, std::fabs(value(wave, duration * i / samples)));
  return most;
}

// Greatest absolute value that a wave names, however short its peak is. MpPulse names a velocity and is sampled.
double peak_of(const Wave& wave, double duration) {
  return std::visit(
      [&](const auto& one) {
        using W = std::decay_t<decltype(one)>;
        const auto greatest = [](const std::vector<double>& values) {
          double most = 0;
          for (const double v : values) most = std::max(most, std::fabs(v));
          return most;
        };
        if constexpr (std::is_same_v<W, Table> || std::is_same_v<W, Curve>) return greatest(one.line.values);
        else if constexpr (std::is_same_v<W, Record>) return greatest(one.acceleration.values);
        else if constexpr (std::is_same_v<W, MpPulse>) return sampled_peak(wave, duration);
        else return std::fabs(one.amplitude);
      },
      wave);
}

struct Most {
  double value;
  const char* unit;
};

Most most_of(Load::Kind kind) {
  switch (kind) {
    case Load::Kind::ground:
      return {1e6, "m/s2"};
    case Load::Kind::force:
      return {1e15, "N"};
    case Load::Kind::moment:
      return {1e15, "N m"};
    case Load::Kind::motion:
      return {1e6, "m"};
    default:
      return {1e6, "rad"};
  }
}

}  // namespace

const char* load_word(Load::Kind kind) {
  switch (kind) {
    case Load::Kind::ground:
      return "ground_motion";
    case Load::Kind::force:
      return "force";
    case Load::Kind::moment:
      return "moment";
    case Load::Kind::motion:
      return "motion";
    case Load::Kind::turning:
      return "turning";
    default:
      return "tilt";
  }
}

std::string load_size_mistake(const Load& load, double duration) {
  // More than a turn is an angle in degrees, taken for radians.
  if (load.kind == Load::Kind::tilt) {
    const double angle = sampled_peak(load.wave, duration), turns = angle / (2 * std::numbers::pi);
    if (turns > 1)
      return fmt::format("tilt: its wave reaches {:.4g} rad, {:.3g} turns; angles are in radians: {:.4g} degrees are {:.4g} * deg", angle,
                         turns, angle, angle);
  }
  const auto [most, unit] = most_of(load.kind);
  if (const double peak = peak_of(load.wave, duration); !(peak <= most))
    return fmt::format("{}: its wave reaches {:.4g} {}; at most {:g} {} is allowed: check its units", load_word(load.kind), peak, unit,
                       most, unit);
  return "";
}

}  // namespace erbs
