// Steps that were longer than their contacts allowed: counted by the Solver, judged in `diagnostics.h`.
#pragma once
#include <algorithm>
#include <array>

namespace erbs {

// A step beyond the limit of a contact that has just closed is shortened at once and costs little energy. A ratio of 1.6 in 0.04 % of the
// steps of a stick-slip block (v10_stick_slip) costs 1e-7; 1.54 in 0.19 % of the steps of a collapse (h25_chaos_of_a_collapse) costs 2e-4.
// A vibration at the limit grows by exp(2 acosh ratio) per step: 4.4-fold at 1.3, 14-fold at 2.
struct StepTooLong {
  double ratio, share;  // step over its limit; share of all steps that may exceed this ratio
};
inline constexpr std::array<StepTooLong, 3> steps_too_long{{{1.05, 1}, {1.3, 1e-2}, {2, 1e-3}}};
inline constexpr double step_slack = steps_too_long[0].ratio;

struct LongSteps {
  std::array<long, 3> count{};  // of steps beyond each ratio of `steps_too_long`
  double worst = 0;             // greatest step over its limit

  void add(double ratio, long steps = 1) {
    for (std::size_t i = 0; i < count.size(); ++i) count[i] += ratio > steps_too_long[i].ratio ? steps : 0;
    worst = std::max(worst, ratio);
  }
};

}  // namespace erbs
