// Contacts between blocks: release of joints to contact, search for new neighbours of loose blocks, contact forces, and their bound on the
// time step. An intact structure needs nothing of this: storage is allocated when the first block is loose.
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

// A joint released to contact.
struct HandOver {
  int joint;
  double energy;  // J, stored energy lost by the release; negative for a gain
};

class Debris {
 public:
  Debris(const Model& model, State& state, int threads);

  bool active() const { return !involved_.empty() || !state_.debris.pair.empty(); }
  // Releases joints without bond and beyond their range (`joint_spent()`) to contact and returns them. Called between forces and drift:
  // this step still has the wrench and stored energy of the joint, the next step has those of the contact.
  std::vector<int> hand_over_joints(Cracked& cracked);
  // Since the last call.
  std::vector<HandOver> take_handed() { return std::exchange(handed_, {}); }
  // Soften former joints with displaced faces to the stiffness of debris; called at the same place. `find_softening()` searches for
  // displaced faces first. A pair softens only if its total loss of energy will not exceed `most` (J).
  void find_softening(double most);
  void soften_beds(double most);
  // Books the energy of the last releases, after the ledger of this step has closed.
  void book_hand_over();
  // Marks blocks as loose, so that they may find new neighbours: blocks without a path of joints to a support, or far from their start.
  void loosen();
  // Updates the poses of blocks [first, last) after their drift; each thread has its own range.
  void follow(int thread, int first, int last);
  // Before the forces of a step: the remaining poses, and every few steps the check whether a new search is necessary.
  void prepare();
  // Forces of this thread's pairs. Afterwards `gather()` sums them on one thread, in the order of the pairs.
  void forces(int thread, bool sample);
  void gather(double* push, bool sample);
  // Afterwards: puts blocks to sleep and wakes sleepers (`sleep.h`). True if the set of sleepers has changed.
  bool sleep(const Excitation& now, const double* push);
  // s, time step that joints and contacts now allow, at most `Model::dt_most`.
  double allowed_dt() const { return allowed_; }
  // s, time step that the present contacts allow, without coming impacts; the last step is judged by it.
  double borne_dt() const;
  // 1/s, event rate: one over the step that the next openings and closings allow (`event_bound.h`). `budget` (J): of the next `forces()`.
  double haste() const { return haste_; }
  void set_step(double budget, const Interlock& interlock) { settings_.event_budget = budget, settings_.interlock = interlock; }
  double elastic() const { return elastic_; }  // J, stored in contacts at the last sample
  int touching() const { return touching_; }
  long slept() const { return sleep_.slept(); }  // steps of sleeping blocks, since the start of this Solver
  long touched() const { return touched_; }      // touching pairs, summed over the steps of this Solver

 private:
  static constexpr double round_off = 1e-9;  // margin, as a share of distance and travel: above the round-off of sums over some 1e6 steps

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
  double limit() const;                    // s, time step that contacts and joints allow, ...
  double unless_it_rubs(double dt) const;  // s, ... and slipping patches
  void ask_elsewhere();
  double crowd(int a, int b) const;  // number of contacts for the dashpots of `pair_force()`
  void share_out();
  struct Active;
  double add_up(std::span<const Active> active, double* push, bool sample);
  void land(int i, double landing_a, double landing_b, bool touching);
  void foresee_touching(int thread);
  void limit_passing();
  bool displaced(const Pair& pair, int joint) const;
  void part_beds();
  // A group of eight blocks and the selected ones among them.
  struct Eight {
    int group;
    unsigned which;
    double is_in[lanes] = {};  // 1 for a selected block, else 0
  };
  struct alignas(64) Fastest {
    double speed[lanes] = {};  // m/s, greatest over many groups, lane by lane
  };
  void set_axes(int b, const Mat3& axes);  // from `contact_axes()`
  Mat3 axes_of(int b) const;
  Mat3 rotation(int b) const;  // from rest to the last update of its pose
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
  ContactShapes shapes_;  // empty until `wake()`, like blocks and axes
  ContactSettings settings_;
  std::vector<ContactBlock> blocks_;
  struct Axes {
    RowLanes<9> row{};  // row-major
    bool any = false;   // some differ from the world axes
  };
  std::vector<Axes> axes_;  // of the shapes at rest, by groups of eight blocks; empty if all are the world axes
  Sleep sleep_;
  std::vector<int> involved_;           // blocks that are loose or listed in a pair
  std::vector<double> fastest_loose_;   // m2/s2, greatest squared speed of an involved block, per thread
  std::vector<Eight> awake_;            // involved blocks that are awake
  std::vector<Eight> placed_;           // moving ones among the blocks of live pairs
  std::vector<Eight> driven_;           // driven ones among these; no drift moves them
  std::vector<std::uint64_t> jointed_;  // pairs of blocks that still have a joint, sorted
  struct Bed {
    int joint = -1;                 // first of the joints that this pair replaced; -1: none
    double rate_a = 0, rate_b = 0;  // 1/s2, as `Pair::counted_a`, `counted_b`
  };
  std::vector<Bed> bed_;  // per pair
  ContactLimit limit_;
  std::vector<double> rate_;     // 1/s2, of contacts beyond the bound of `limit_` [nblock]
  std::vector<double> landing_;  // 1/s2, of the stiffest face that may strike the block next; there is room for only one [nblock]
  double elsewhere_ = 0;         // 1/s2, greatest `on_block()` of blocks without a live pair
  // Conservative motion bound: each block's travel is accumulated, and a separated pair is tested again only when the two travels could
  // have closed its gap (`State::parting`).
  struct Waiting {
    int a = 0, b = 0;
    double until = 0;  // m; no test while `way_soon_[a] + way_soon_[b] < until`
  };
  std::vector<Waiting> waiting_;  // per pair
  std::vector<int> edge_;         // per pair, index into `edges_`; -1: none
  std::vector<EdgeAtRest> edges_;
  std::vector<RowLanes<3>> last_u_;     // m, displacements at the last update of the pose, by groups of eight as in State
  std::vector<double> reach_;           // m, distance of each block's farthest point from its centroid; whole groups, like the arrays below
  std::vector<double> spin_;            // m/s, speed of that point by rotation
  std::vector<double> way_, way_soon_;  // m, travel of each block; the same with the next steps (`BlockLanes`)
  std::vector<Fastest> fastest_;        // m/s, of the blocks that each thread has updated
  double fastest_pair_ = 0;             // m/s, upper bound of the speed of approach of any two blocks
  double thinnest_ = 0;                 // m, thinnest extent of all blocks
  // Results of a thread in this step, in the order of the pairs.
  struct Active {
    int pair;
    PairResult result;
  };
  struct Near {
    int pair;
    double apart, landing_a, landing_b, haste;  // as in `PairResult`
  };
  struct Looked {
    std::vector<int> at;         // pairs to evaluate
    std::vector<Active> active;  // pairs with forces
    std::vector<Near> near;      // separated pairs
  };
  struct Lane {
    PairBodies bodies;
    bool known = false, fits = false;  // fits: `goes_in_lanes()`
    int keeper = -1;                   // `short_keeper()`
  };
  std::vector<Lane> lane_;  // per pair, data that a step reads first
  bool lanes_changed_ = true;
  std::vector<int> first_pair_;                // first pair of each thread; balances the number of evaluations
  std::vector<Looked> looked_;                 // per thread
  std::vector<OverlapRoom> room_;              // per thread
  std::vector<std::unique_ptr<Batch>> batch_;  // per thread
  std::vector<std::uint64_t> pair_keys_;       // pairs of blocks with a joint at rest, sorted, ...
  std::vector<int> of_pair_;                   // ... and the first of their joints
  std::vector<std::vector<int>> neighbours_;   // blocks joined to each block at rest [nblock]
  std::vector<HandOver> handed_;
  double released_ = 0;  // J, set free by the last releases and still contained in the sums of this step
  double allowed_ = 0, elastic_ = 0, haste_ = 0, rubbing_ = 0;
  std::vector<std::uint8_t> still_;  // sleepers with the pose of the last search [nblock]; empty without sleepers
  bool relisted_ = true, unsorted_ = true;
  int touching_ = 0;
  long touched_ = 0;
};

}  // namespace erbs
