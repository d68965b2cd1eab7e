// How many threads a run goes with from moment to moment. A team waits for its slowest in every step: where another program holds one of
// its processors, the whole team goes at half speed or less, and one thread alone is faster. The numbers of a run do not depend on it.
#pragma once

namespace erbs {

class Crew {
 public:
  explicit Crew(int threads);
  int threads() const { return now_; }
  // To be asked often, with the steps that are done: true where the run is to go on with threads() of them, which have just changed.
  bool turns(long step);
  // The same, with the clocks told: s of wall clock and of processor of the whole process.
  bool turns(long step, double wall, double processor);
  void took(double seconds) { cost_ = seconds, wall_ = -1; }  // what the last change cost; what is timed begins after it

 private:
  enum class Phase { together, trial_alone, alone, trial_together };
  void begin(Phase phase, int threads, long step, double wall, double processor);

  const int most_;
  int now_;
  Phase phase_ = Phase::together;
  long step_ = 0;                                 // at the begin of the phase, or of its window
  double wall_ = -1, processor_ = 0;              // s, likewise
  double window_, rate_ = 0, rest_, quiet_until_ = 0, cost_ = 0;  // s; steps/s of the way it went before a trial
};

}  // namespace erbs
