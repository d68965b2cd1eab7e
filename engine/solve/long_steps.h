// Steps that were longer than what touched in them bore, as counted by the Solver and judged in trust.h.
#pragma once
#include <algorithm>
#include <array>

namespace erbs {

// A step past the limit of what has just closed is shortened at once, and costs little: by 1.6 in 0.04 % of the steps of a block that
// stutters (v10_stick_slip) 1e-7 of the energy, by 1.54 in 0.19 % of those of a collapse (h25_chaos_of_a_collapse) 2e-4. What vibrates at
// the limit grows by exp(2 acosh ratio) a step: 4.4-fold at 1.3, 14-fold at 2.
struct StepTooLong {
  double ratio, share;  // of the limit, more than; of the steps that were, more than may be
};
inline constexpr std::array<StepTooLong, 3> steps_too_long{{{1.05, 1}, {1.3, 1e-2}, {2, 1e-3}}};
inline constexpr double step_slack = steps_too_long[0].ratio;

struct LongSteps {
  std::array<long, 3> count{};  // past each ratio of steps_too_long
  double worst = 0;             // over the limit

  void add(double ratio, long steps = 1) {
    for (std::size_t i = 0; i < count.size(); ++i) count[i] += ratio > steps_too_long[i].ratio ? steps : 0;
    worst = std::max(worst, ratio);
  }
};

}  // namespace erbs
