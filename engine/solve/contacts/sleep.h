// Sleep of debris at rest, if the scene allows it: no forces between sleepers, no kick, no drift, no evaluation.
//
// Falling asleep: a block sleeps once it and all awake blocks touching it have been still for half of the time sqrt(L / g), L the
// smallest edge. Still means slower than 1e-6 sqrt(g L) at every corner and accelerated by less than 1e-4 g there. The block's
// velocity becomes zero, and its kinetic energy is booked (`Energy::sleep`). Contacts between sleepers, or with fixed blocks, do not lose
// their memory; only the peak closing speed decays with time, asleep or not.
//
// Waking: a block wakes in the step in which the forces on it leave more than 1e-3 g. An awake block strikes it or leans on it, its support
// leaves, or a driven block moves on. All forces then act on it, contacts at rest included. All blocks wake when gravity less the ground
// acceleration has changed by 1e-4 g since its last recorded change; no block falls asleep while it changes.
//
// Error: creep slower than 1e-6 sqrt(g L), and motion by a thousandth of a block's weight. Blocks with a joint, blocks with loads and
// driven blocks do not sleep.
#pragma once
#include <functional>
#include <span>
#include <vector>

#include "engine/contact/law/pair.h"
#include "engine/model/model.h"
#include "engine/model/state.h"
#include "engine/solve/blocks/integrate.h"

namespace erbs {

class Sleep {
 public:
  Sleep(const Model& model, State& state);

  bool asleep(int b) const { return on_ && state_.sleep.asleep[std::size_t(b)] != 0; }

  // Takes the present list of pairs. `involved`: blocks that are loose or in a pair. `evaluate(i)`: result of pair i in its present pose,
  // called once while the pair rests. New sleepers have zero velocity already.
  void sort(const std::vector<int>& involved, const std::function<PairResult(int i)>& evaluate);
  const std::vector<int>& live() const { return live_; }                    // pairs with an awake block, in order
  const std::vector<int>& awake() const { return awake_; }                  // involved blocks that are awake, driven ones included
  const std::vector<int>& in_live_pairs() const { return in_live_pairs_; }  // blocks of live pairs, ascending
  void add_omega2();                                                        // again, after an update of the bound
  template <class F>
  void each_resting(F&& f) const {  // f(i, result): touching pairs at rest
    for (const Resting& one : resting_) f(one.pair, one.result);
  }
  // Actions of pairs at rest on a block: a row of eight doubles (force, moment), and a share in the rate of the step (1/s2).
  const double* resting_wrench(int b) const { return resting_wrench_.data() + 8 * std::size_t(b); }
  int contacts(int b) const { return contacts_[std::size_t(b)]; }  // at rest; valid if `has_resting()`
  double omega2(int b) const { return omega2_.empty() ? 0 : omega2_[std::size_t(b)]; }
  bool has_resting() const { return !resting_.empty(); }
  double elastic() const { return elastic_; }  // J, stored in pairs at rest
  int touching() const { return touching_; }   // number of touching pairs at rest

  // Between forces and drift: wakes blocks under a net force and, every few steps, lets still blocks fall asleep. `contact_wrench`: contact
  // wrenches on blocks. True if the set of sleepers has changed: the pairs must be sorted again before the next step.
  bool update(const Excitation& e, const double* contact_wrench, const ContactShapes& shapes, std::span<const ContactBlock> blocks);
  long slept() const { return slept_; }  // steps of sleeping blocks, since the start of this Solver

 private:
  struct Resting {
    int a, b, part_a, part_b;
    int pair;  // index in the list
    PairResult result;
  };
  struct Motion {
    double speed, acceleration;  // m/s, m/s2, upper bounds over all corners
  };
  bool rests(const ContactPair& pair) const;
  bool may_sleep(int b) const;
  void add_resting(const Resting& one);
  bool wake_all();
  bool wake_pressed(const double* contact_wrench, std::span<const ContactBlock> blocks);
  bool try_sleep(double kick, const double* contact_wrench, std::span<const ContactBlock> blocks);
  Motion motion_of(int b, const double* contact_wrench, const ContactBlock& block) const;
  void wake(const std::vector<int>& blocks);
  void put_to_sleep(int b, double kick, const double* contact_wrench);

  const Model& model_;
  State& state_;
  bool on_ = false;
  double g_ = 0;                           // m/s2
  Vec3 effective_gravity_ = Vec3::Zero();  // m/s2, gravity less the ground acceleration in this step
  std::vector<std::uint8_t> loaded_;       // a load acts on the block [nblock]
  std::vector<int> live_, awake_, in_live_pairs_;
  std::vector<Resting> resting_;    // touching pairs at rest, in order
  Rows resting_wrench_;             // N, N m, of these on each block
  std::vector<double> omega2_;      // 1/s2 [nblock]
  std::vector<int> contacts_;       // [nblock]
  std::vector<double> reach_;       // m, distance of the block's farthest corner [nblock]
  std::vector<std::uint8_t> mark_;  // scratch [nblock]
  double elastic_ = 0;
  int touching_ = 0;
  long slept_ = 0;
};

}  // namespace erbs
