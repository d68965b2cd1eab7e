#include "engine/analysis/crew.h"

#include <algorithm>
#include <ctime>

namespace erbs::analysis {
namespace {

constexpr double sample_every = 0.25, trial_time = 0.15;  // s, ...
constexpr long least_steps = 48;                          // ... and at least so many steps, with their share of searches for contacts
constexpr double least_rest = 2, longest_rest = 30;       // s between two trials with the same outcome
// Share of processor time. A team that spins at its barriers uses all its processors; other programs or sleep took the rest.
constexpr double undisturbed = 0.85;
constexpr double better = 1.05;     // required ratio of speeds for a change
constexpr double least_share = 20;  // least ratio of the time between two trials to the cost of their changes

double clock_seconds(clockid_t clock) {
  timespec now{};
  clock_gettime(clock, &now);
  return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
}

}  // namespace

double seconds() { return clock_seconds(CLOCK_MONOTONIC); }

Crew::Crew(int threads) : most_(threads), now_(threads), window_(sample_every), rest_(least_rest) {}

bool Crew::should_change(long step) { return most_ > 1 && should_change(step, seconds(), clock_seconds(CLOCK_PROCESS_CPUTIME_ID)); }

void Crew::begin(Phase phase, int threads, long step, double wall, double processor) {
  phase_ = phase;
  now_ = threads;
  step_ = step, wall_ = wall, processor_ = processor;
  window_ = phase == Phase::trial_alone || phase == Phase::trial_together ? trial_time : phase == Phase::alone ? rest() : sample_every;
}

double Crew::rest() const { return std::max(rest_, 2 * least_share * cost_); }

bool Crew::should_change(long step, double wall, double processor) {
  if (most_ < 2) return false;
  if (wall_ < 0) begin(phase_, now_, step, wall, processor);
  const double spent = wall - wall_, rate = double(step - step_) / spent;
  if (spent < window_ || step - step_ < least_steps) return false;
  const int before = now_;
  switch (phase_) {
    case Phase::together:
      if (wall < quiet_until_ || processor - processor_ > undisturbed * spent * most_) {
        begin(Phase::together, most_, step, wall, processor);
      } else {
        rate_ = rate;
        begin(Phase::trial_alone, 1, step, wall, processor);
      }
      break;
    case Phase::trial_alone:
      if (rate > better * rate_) {
        begin(Phase::alone, 1, step, wall, processor);
      } else {
        quiet_until_ = wall + rest();
        rest_ = std::min(2 * rest_, longest_rest);
        begin(Phase::together, most_, step, wall, processor);
      }
      break;
    case Phase::alone:
      rate_ = rate;
      begin(Phase::trial_together, most_, step, wall, processor);
      break;
    case Phase::trial_together:
      if (rate > better * rate_) {
        rest_ = least_rest;
        begin(Phase::together, most_, step, wall, processor);
      } else {
        rest_ = std::min(2 * rest_, longest_rest);
        begin(Phase::alone, 1, step, wall, processor);
      }
      break;
  }
  return now_ != before;
}

}  // namespace erbs::analysis
