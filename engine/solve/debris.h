// What happens once blocks come loose: joints are handed over to contact, loose blocks meet new neighbours, and the time step
// follows the contacts. An intact structure does not come here: what contacts need is made when the first block comes loose.
#pragma once
#include <span>
#include <vector>

#include "engine/contact/batch.h"
#include "engine/contact/broad.h"
#include "engine/contact/edge_neighbours.h"
#include "engine/model/model.h"
#include "engine/model/state.h"
#include "engine/solve/contact_limit.h"
#include "engine/solve/cracked.h"
#include "engine/solve/sleep.h"

namespace erbs {

// Where a contact took over from a joint, or a bed took another stiffness: what is stored less than before.
struct HandOver {
  int joint;
  double energy;  // J
};

class Debris {
 public:
  Debris(const Model& model, State& state, int threads);

  bool active() const { return !involved_.empty() || !state_.debris.pair.empty(); }
  // Joints that are spent (joint_kernel.h) go over to contact; returns them. Called between forces and drift: the wrench and the
  // stored energy of this step are still the joint's, those of the next one the contact's.
  std::vector<int> hand_over_joints(Cracked& cracked);
  // Since the last call.
  std::vector<HandOver> take_handed() { return std::exchange(handed_, {}); }
  // Beds that lie on each other no longer as their joint lay get the stiffness of debris; called at the same place: the first finds them
  // as well. What each loses is at most `most` (J).
  void find_softening(double most);
  void soften_beds(double most);
  // Once the ledger of this step is settled: books what the last hand-over set free.
  void book_hand_over();
  // Blocks that hang on nothing fixed, or have moved far from where they stood, may meet new neighbours.
  void loosen();
  // Poses of the blocks from `first` to `last` that a drift has just moved. Each thread its own.
  void follow(int thread, int first, int last);
  // Before the forces of a step: other poses, and now and then a look whether a new search is due.
  void prepare();
  // Forces of the pairs of this thread; afterwards gather() sums them on one thread in the order of the pairs.
  void forces(int thread, bool sample);
  void gather(double* push, bool sample);
  // Then: lets blocks fall asleep and wakes sleepers (sleep.h). True where the set of those asleep has changed.
  bool sleep(const Excitation& now, const double* push);
  // The step that joints and contacts allow now (s), no longer than the run may take.
  double allowed_dt() const { return allowed_; }
  // ... and what touches alone, without what may land next (s): the step that was taken is judged by it.
  double borne_dt() const;
  // 1/s, over the step that what opens and closes next allows (event_bound.h); `budget` (J) is that of the next forces()
  double haste() const { return haste_; }
  void set_step(double budget, const Interlock& interlock) { settings_.event_budget = budget, settings_.interlock = interlock; }
  double elastic() const { return elastic_; }  // J, stored in contacts at the last sample
  int touching() const { return touching_; }
  long slept() const { return sleep_.slept(); }  // steps of blocks asleep, likewise
  long touched() const { return touched_; }      // pairs, summed over the steps of this Solver

 private:
  static constexpr double round_off = 1e-9;  // of a distance and of the way behind: more than sums of some 1e6 steps lose

  void wake();
  void open(int j);
  void hand_over_pair(const int* first, const int* last);
  void note_hand_over(int joint, double energy);
  double start_fresh(const std::vector<int>& fresh);
  void list_involved();
  void list_anew();
  void find_beds();
  int bed_joint(const Pair& pair) const;
  void count_bed(Pair& pair);
  void count();
  double limit() const;                    // s, the step that contacts and joints bear, ...
  double unless_it_rubs(double dt) const;  // s, ... and patches that slip
  void ask_elsewhere();
  double crowd(int a, int b) const;  // pair_force()
  void share_out();
  struct Active;
  double add_up(std::span<const Active> active, double* push, bool sample);
  void land(int i, double landing_a, double landing_b, bool touching);
  void foresee_touching(int thread);
  void limit_passing();
  bool displaced(const Pair& pair, int joint) const;
  void part_beds();
  // Eight blocks side by side; of them those marked.
  struct Eight {
    int group;
    unsigned which;
    double is_in[lanes] = {};  // 1 for those marked, else 0
  };
  struct alignas(64) Fastest {
    double speed[lanes] = {};  // m/s, of many groups, lane by lane
  };
  void set_axes(int b, const Mat3& axes);  // contact_axes()
  Mat3 axes_of(int b) const;
  Mat3 rotation(int b) const;              // from rest, where it was placed last
  static void mark(std::vector<Eight>& groups, int b);
  void place(Eight blocks, Fastest& fastest);
  void place_all(bool sleepers);
  void look();
  bool keeps_apart(int i);
  EdgeAtRest edge_of(const Pair& pair) const;
  double idle(int i) const;
  void note_apart(int i, double distance);
  void sort();
  void find_still();
  PairLaw law(int a, int b) const;

  const Model& model_;
  State& state_;
  ContactShapes shapes_;  // empty until wake(), as what follows
  ContactSettings settings_;
  std::vector<ContactBlock> blocks_;
  struct Axes {
    RowLanes<9> row{};  // by row
    bool any = false;   // other than those of the world
  };
  std::vector<Axes> axes_;  // those of the shapes at rest, by groups of eight blocks; empty where all are the world's
  Sleep sleep_;
  std::vector<int> involved_;           // blocks that are loose or listed in a pair
  std::vector<double> fastest_loose_;   // m2/s2, squared speed of the fastest block that each thread has followed
  std::vector<Eight> awake_;            // loose blocks that do not sleep
  std::vector<Eight> placed_;           // those of live pairs that move
  std::vector<Eight> driven_;           // of these those that no drift moves
  std::vector<std::uint64_t> jointed_;  // pairs of blocks still joined, sorted
  struct Bed {
    int joint = -1;                 // first of the joints that this pair took over from, -1: none
    double rate_a = 0, rate_b = 0;  // 1/s2, as counted (Pair)
  };
  std::vector<Bed> bed_;  // of each pair
  ContactLimit limit_;
  std::vector<double> rate_;     // 1/s2, of contacts beyond that [nblock]
  std::vector<double> landing_;  // 1/s2, of the stiffest face that may land on the block next; one face has room for no more
  double elsewhere_ = 0;         // 1/s2, on_block() of blocks that no live pair touches, at most
  // How far each block has come is summed up along its way, so that most pairs that are apart need not even be asked whether their bodies
  // may have met (State::parting).
  struct Waiting {
    int a = 0, b = 0;
    double until = 0;  // m; no look while way_soon_[a] + way_soon_[b] < until
  };
  std::vector<Waiting> waiting_;        // of each pair
  std::vector<int> edge_;               // of each pair, into edges_; -1: none
  std::vector<EdgeAtRest> edges_;
  std::vector<RowLanes<3>> last_u_;     // m, where blocks were when they were placed last, by groups of eight as in State
  std::vector<double> reach_;           // m, of each block's farthest point, to whole groups as what follows
  std::vector<double> spin_;            // m/s, BlockLanes
  std::vector<double> way_, way_soon_;  // m, likewise
  std::vector<Fastest> fastest_;        // m/s, of the blocks that each thread has placed
  double fastest_pair_ = 0;             // m/s, faster than that no two blocks meet
  double thinnest_ = 0;                 // m, of all blocks
  // What a thread found in this step, in the order of the pairs.
  struct Active {
    int pair;
    PairResult result;
  };
  struct Near {
    int pair;
    double apart, landing_a, landing_b, haste;  // as in PairResult
  };
  struct Looked {
    std::vector<int> at;         // pairs that could not be left out
    std::vector<Active> active;  // those with forces
    std::vector<Near> near;      // those apart
  };
  struct Lane {
    PairBodies bodies;
    bool known = false, fits = false;  // goes_in_lanes()
    int keeper = -1;                   // short_keeper()
  };
  std::vector<Lane> lane_;  // of each pair: what a step asks first
  bool lanes_changed_ = true;
  std::vector<int> first_pair_;                // of each thread, so that each has as many to look at as in the step before
  std::vector<Looked> looked_;                 // per thread
  std::vector<OverlapRoom> room_;              // per thread
  std::vector<std::unique_ptr<Batch>> batch_;  // per thread
  std::vector<std::uint64_t> pair_keys_;       // pairs of blocks that are jointed at rest, sorted, ...
  std::vector<int> of_pair_;                   // ... and the first of their joints
  std::vector<std::vector<int>> neighbours_;   // blocks that each is joined to at rest [nblock]
  std::vector<HandOver> handed_;
  double released_ = 0;  // J, set free by the last hand-over and still in this step's sums
  double allowed_ = 0, elastic_ = 0, haste_ = 0, rubbing_ = 0;
  std::vector<std::uint8_t> still_;  // sleepers that lie as at the last search [nblock], empty without
  bool relisted_ = true, unsorted_ = true;
  int touching_ = 0;
  long touched_ = 0;
};

}  // namespace erbs
