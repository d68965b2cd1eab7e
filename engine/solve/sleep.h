// Debris that has come to rest sleeps, where the scene lets it: no forces between sleepers, no kick, no drift, no pass over them.
//
// A block falls asleep once it has been still for half of the time sqrt(L / g), L its smallest edge: slower than 1e-6 sqrt(g L) at every
// corner and accelerated by less than 1e-4 g there, and everything that touches it likewise, asleep or fixed. Its speed is then zero; the
// kinetic energy that it had is booked (Energy::sleep). Contacts between sleepers, or with what is fixed, keep all that they
// remember, but that the greatest speed of approach is forgotten with time, asleep or not.
// It wakes in the very step in which what pushes it leaves more than 1e-3 g: an awake block lands on it or leans on it by more, its support
// leaves, a driven block moves on; then it is kicked by all that acts on it, contacts at rest included. All wake when gravity less the
// ground's acceleration has changed by 1e-4 g since it was last seen to change, and none sleeps while it does.
// So what sleep changes is what blocks would have crept at less than 1e-6 sqrt(g L), and what a thousandth of their weight would have
// moved. Blocks that have a joint left, blocks that loads act on and driven ones do not sleep.
#pragma once
#include <functional>
#include <span>
#include <vector>

#include "engine/contact/contact.h"
#include "engine/model/model.h"
#include "engine/model/state.h"
#include "engine/solve/integrate.h"

namespace erbs {

class Sleep {
 public:
  Sleep(const Model& model, State& state);

  bool asleep(int b) const { return on_ && state_.rest.asleep[std::size_t(b)] != 0; }

  // Takes the list of pairs as it is now. `involved`: blocks that are loose or in a pair; `evaluate`: what pair i gives as it lies, asked
  // for once while it rests. Speeds of those that have fallen asleep are zero by then.
  void sort(const std::vector<int>& involved, const std::function<PairResult(int i)>& evaluate);
  const std::vector<int>& live() const { return live_; }      // pairs with a block that is awake, in order
  const std::vector<int>& awake() const { return awake_; }    // blocks involved that move by themselves or are driven
  const std::vector<int>& pushed() const { return pushed_; }  // blocks of live pairs
  void add_rates();                                           // again, after the pairs' counts have changed
  template <class F>
  void each_resting(F&& f) const {  // f(i, what it gives): touching pairs at rest
    for (const Resting& one : resting_) f(one.pair, one.result);
  }
  // What pairs at rest leave on a block: a row of eight doubles (force, moment), and their share in the rate of the step (1/s2).
  const double* push(int b) const { return held_.data() + 8 * std::size_t(b); }
  int contacts(int b) const { return contacts_[std::size_t(b)]; }  // at rest, where holds()
  double rate(int b) const { return rate_.empty() ? 0 : rate_[std::size_t(b)]; }
  bool holds() const { return !resting_.empty(); }
  double elastic() const { return elastic_; }  // J, stored in pairs at rest
  int touching() const { return touching_; }   // of them

  // Between forces and drift, `push` being what contacts do to blocks: wakes those that are pressed on, and now and then lets fall asleep
  // those that are still. True where somebody woke or fell asleep: the pairs are to be sorted again before the next step.
  bool turn(const Excitation& e, const double* push, const ContactShapes& shapes, std::span<const ContactBlock> blocks);
  long slept() const { return slept_; }  // steps of blocks, since the start of this Solver

 private:
  struct Resting {
    int a, b, part_a, part_b;
    int pair;  // in the list
    PairResult result;
  };
  struct Motion {
    double speed, acceleration;  // m/s, m/s2, of the corner that has most, at most
  };
  bool rests(const Pair& pair) const;
  bool may_sleep(int b) const;
  void hold(const Resting& one);
  bool wake_all();
  bool wake_pressed(const double* push, std::span<const ContactBlock> blocks);
  bool lay_down(double kick, const double* push, std::span<const ContactBlock> blocks);
  Motion motion_of(int b, const double* push, const ContactBlock& block) const;
  void wake(const std::vector<int>& blocks);
  void put_to_sleep(int b, double kick, const double* push);

  const Model& model_;
  State& state_;
  bool on_ = false;
  double g_ = 0;                      // m/s2
  Vec3 pull_ = Vec3::Zero();          // m/s2, gravity less the ground's acceleration in this step
  std::vector<std::uint8_t> loaded_;  // a load acts on the block [nblock]
  std::vector<int> live_, awake_, pushed_;
  std::vector<Resting> resting_;    // pairs at rest that touch, in order
  Rows held_;                       // N, N m
  std::vector<double> rate_;        // 1/s2 [nblock]
  std::vector<int> contacts_;       // [nblock]
  std::vector<double> reach_;       // m, of the block's farthest corner [nblock]
  std::vector<std::uint8_t> mark_;  // [nblock]
  double elastic_ = 0;
  int touching_ = 0;
  long slept_ = 0;
};

}  // namespace erbs
