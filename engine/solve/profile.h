// Where the time of a run goes, and what keeps its steps short: `wall_s` of metrics.json and `erbs run --profile`.
//
// One macro step in `measured_every` is measured, a prime number, so that work that is due in every 8th or 64th step counts with its true
// share. The seconds of a phase are its share of all measured time, times the time of solving. Searches are rare and long: each is
// measured.
#pragma once
#include <array>
#include <chrono>
#include <map>
#include <string>
#include <vector>

#include "engine/model/state.h"
#include "engine/solve/contacts/step_limit.h"

namespace erbs {

enum class Phase { contact, joints, integrate, ledger, count };

std::string text(const StepLimit& limit, const Model& model);  // "contacts of south.c03.b04"

class Profile;
// One line per kind of limit, most frequent first: "63 % contacts (south.c03.b04 12 %, ...)".
std::vector<std::string> limit_lines(const Profile& profile, const Model& model);

class Profile {
 public:
  static constexpr int measured_every = 31;  // macro steps

  // At the start of a step; true if this one is measured.
  bool begin(const TimeStep& time) {
    measured_ = time.macro % measured_every == 1;  // not the first step, which prepares
    if (measured_) last_ = Clock::now();
    return measured_;
  }
  // The time since the last lap belongs to this phase, but for `elsewhere` (s).
  void lap(Phase phase, double elsewhere = 0) {
    if (!measured_) return;
    const Clock::time_point now = Clock::now();
    phase_s_[std::size_t(phase)] += std::chrono::duration<double>(now - last_).count() - elsewhere;
    last_ = now;
  }
  bool measured() const { return measured_; }
  // A macro step: what limits its steps, and the pairs that act in every step and once (model/levels.h).
  void note(const StepLimit& limit, const TimeStep& time, int fast, int slow) {
    limits_[limit] += time.substeps, steps_ += time.substeps, ++macro_steps_, sum_dt_ += time.substeps * time.dt;
    fast_ += long(time.substeps) * (time.substeps > 1 ? fast : fast + slow);
    if (time.substeps > 1) slow_ += slow;
  }
  Profile& operator+=(const Profile& other);

  // s, of the phases if all steps took `all` together.
  std::array<double, std::size_t(Phase::count)> seconds(double all) const;
  long steps() const { return steps_; }
  double mean_dt() const { return steps_ > 0 ? sum_dt_ / double(steps_) : 0; }                    // s, of steps
  double mean_macro_dt() const { return macro_steps_ > 0 ? sum_dt_ / double(macro_steps_) : 0; }  // s, of macro steps
  const std::map<StepLimit, long>& limits() const { return limits_; }                             // steps by what limits them
  long fast() const { return fast_; }  // evaluations of pairs that act in every step, ...
  long slow() const { return slow_; }  // ... and of those that act once in a macro step

 private:
  using Clock = std::chrono::steady_clock;
  bool measured_ = false;
  Clock::time_point last_{};
  std::array<double, std::size_t(Phase::count)> phase_s_{};
  std::map<StepLimit, long> limits_;
  long steps_ = 0, macro_steps_ = 0, fast_ = 0, slow_ = 0;
  double sum_dt_ = 0;
};

}  // namespace erbs
