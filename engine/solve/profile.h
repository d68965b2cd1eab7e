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

#include "engine/model/levels.h"
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
    measured_ = time.macro % measured_every == 0;
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
  void note(const StepLimit& limit, double dt) { ++limits_[limit], ++noted_, sum_dt_ += dt; }
  void note_levels(const std::array<long, most_levels>& evaluations) {
    for (std::size_t l = 0; l < evaluations.size(); ++l) evaluations_[l] += evaluations[l];
  }
  Profile& operator+=(const Profile& other);

  // s, of the phases if all steps took `all` together.
  std::array<double, std::size_t(Phase::count)> seconds(double all) const;
  long noted() const { return noted_; }
  double mean_dt() const { return noted_ > 0 ? sum_dt_ / double(noted_) : 0; }       // s, of macro steps
  const std::map<StepLimit, long>& limits() const { return limits_; }                // macro steps by what limits them
  const std::array<long, most_levels>& evaluations() const { return evaluations_; }  // of pairs, by level

 private:
  using Clock = std::chrono::steady_clock;
  bool measured_ = false;
  Clock::time_point last_{};
  std::array<double, std::size_t(Phase::count)> phase_s_{};
  std::array<long, most_levels> evaluations_{};
  std::map<StepLimit, long> limits_;
  long noted_ = 0;
  double sum_dt_ = 0;
};

}  // namespace erbs
