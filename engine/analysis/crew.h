// Adapts the number of threads while a run goes on. A team waits for its slowest thread in every step. If another program occupies one of
// its processors, the whole team runs at half speed or less, and a single thread is faster. The results do not depend on the number of
// threads.
#pragma once

namespace erbs::analysis {

double seconds();  // s, of a clock that only goes forward

class Crew {
 public:
  explicit Crew(int threads);
  int threads() const { return now_; }
  // Call often, with the number of steps done. True: the run is to continue with threads(), which has just changed.
  bool should_change(long step);
  // The same with clock readings: seconds of wall clock, and of processor time of the whole process.
  bool should_change(long step, double wall, double processor);
  void took(double seconds) { cost_ = seconds, wall_ = -1; }  // cost of the last change; timing restarts after it

 private:
  enum class Phase { together, trial_alone, alone, trial_together };
  void begin(Phase phase, int threads, long step, double wall, double processor);
  double rest() const;  // s, until the next trial

  const int most_;
  int now_;
  Phase phase_ = Phase::together;
  long step_ = 0;                                                 // at the start of the phase, or of its window
  double wall_ = -1, processor_ = 0;                              // s, at the same time
  double window_, rate_ = 0, rest_, quiet_until_ = 0, cost_ = 0;  // s; rate_: steps/s before the trial
};

}  // namespace erbs::analysis
