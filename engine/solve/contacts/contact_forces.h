// Forces of contact pairs, by threads. The share of a thread does not change results, since pairs are summed in their order.
#pragma once
#include <memory>
#include <span>
#include <vector>

#include "engine/contact/law/pair_batch.h"
#include "engine/model/state.h"
#include "engine/solve/contacts/bodies.h"
#include "engine/solve/contacts/motion_bounds.h"

namespace erbs {

class ContactForces {
 public:
  // Results of a thread in this step, in the order of the pairs.
  struct Force {
    int pair;
    PairResult result;
  };
  struct SeparatedPair {
    int pair;
    double apart, impact_omega2_a, impact_omega2_b, event_rate;  // as in `PairResult`
  };
  struct ThreadPairs {
    std::vector<int> at;                   // pairs to evaluate
    std::vector<Force> forces;             // pairs with forces
    std::vector<SeparatedPair> separated;  // separated pairs
    double cost = 0;                       // s, of a pair, mean of the last steps
  };

  ContactForces(const Model& model, State& state, const ContactBodies& bodies, MotionBounds& motion, int threads);
  void list_pairs();                        // after the list of pairs has changed
  void mark_changed() { changed_ = true; }  // the laws of some pairs have changed
  void prepare();                           // before the forces of a step
  void set(double budget);
  void share_fast(std::span<const int> fast);  // between the threads, for the steps within a macro step
  // Forces of this thread's share of the `live` pairs.
  void evaluate(int thread, std::span<const int> live, bool sample);
  // Books the work of friction and dashpots of slow pairs, from their kick in the last step to their next one.
  void book_after_kick(std::span<const int> live);
  // Slow pairs act once in a macro step (model/levels.h).
  bool slow(int i) const { return slow_[std::size_t(i)] != 0; }
  void set_slow(int i, bool slow) { state_.contacts.list.pair[std::size_t(i)].slow = slow_[std::size_t(i)] = std::uint8_t(slow); }
  void balance_threads();  // for the next step
  std::span<const ThreadPairs> results() const { return thread_pairs_; }
  const ContactSettings& settings() const { return settings_; }

 private:
  void find_due(ThreadPairs& found, std::span<const int> mine);
  bool evaluate_one(int i, bool sample, OverlapRoom& room, PairResult& result);
  void foresee_touching(ThreadPairs& found);
  static void note_cost(ThreadPairs& found, double seconds);
  double idle(int i);
  PairInterval interval(bool slow) const;
  double contact_count(int a, int b) const;  // number of contacts for the dashpots of `pair_force()`

  struct PairCache {
    PairBodies bodies;
    bool known = false, fits = false;  // fits: `fits_pack()`
    int axis = -1;                     // `cached_axis()`
  };
  State& state_;
  const ContactBodies& bodies_;
  MotionBounds& motion_;
  ContactSettings settings_;
  std::vector<PairCache> cache_;  // per pair, data that a step reads first
  bool changed_ = true;
  std::vector<std::uint8_t> slow_;                 // per pair, as in `ContactPair`
  std::vector<std::uint8_t> edge_known_;           // per pair: found once it is asked for
  std::vector<EdgeAtRest> edge_;                   // per pair
  std::vector<int> first_pair_, first_fast_;       // first pair of each thread; balances their times; the same within a macro step
  std::vector<ThreadPairs> thread_pairs_;          // per thread
  std::vector<OverlapRoom> room_;                  // per thread
  std::vector<std::unique_ptr<PairBatch>> batch_;  // per thread
};

}  // namespace erbs
