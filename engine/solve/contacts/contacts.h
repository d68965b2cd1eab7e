// Contacts between blocks: release of joints to contact, search for new neighbours of loose blocks, contact forces, and their bound on the
// time step. An intact structure needs nothing of this: storage is allocated when the first block is loose.
#pragma once
#include <span>
#include <vector>

#include "engine/contact/broad/edge_neighbours.h"
#include "engine/contact/broad/search.h"
#include "engine/contact/law/pair_batch.h"
#include "engine/joints/cracked/cracked.h"
#include "engine/model/model.h"
#include "engine/model/state.h"
#include "engine/solve/contacts/sleep.h"
#include "engine/solve/contacts/time_step_bound.h"

namespace erbs {

// A joint released to contact.
struct JointRelease {
  int joint;
  double energy;  // J, stored energy lost by the release; negative for a gain
};

class Contacts {
 public:
  Contacts(const Model& model, State& state, int threads);

  bool active() const { return !involved_.empty() || !state_.contacts.pair.empty(); }
  // Releases joints without bond and beyond their range (`joint_ready_for_contact()`) to contact and returns them. Called between forces
  // and drift: this step still has the wrench and stored energy of the joint, the next step has those of the contact.
  std::vector<int> release_joints(Cracked& cracked);
  // Since the last call.
  std::vector<JointRelease> take_releases() { return std::exchange(releases_, {}); }
  // Soften former joints with displaced faces to the stiffness of debris; called at the same place. `find_softening()` searches for
  // displaced faces first. A pair softens only if its total loss of energy will not exceed `most` (J).
  void find_softening(double most);
  void soften_former_joints(double most);
  // Books the energy of the last releases, after the ledger of this step has closed.
  void book_release();
  // Marks blocks as loose, so that they may find new neighbours: blocks without a path of joints to a support, or far from their start.
  void activate_loose_blocks();
  // Updates the poses of blocks [first, last) after their drift; each thread has its own range.
  void track(int thread, int first, int last);
  // Before the forces of a step: the remaining poses, and every few steps the check whether a new search is necessary.
  void prepare();
  // Forces of this thread's pairs. Afterwards `gather()` sums them on one thread, in the order of the pairs.
  void forces(int thread, bool sample);
  void gather(double* contact_wrench, bool sample);
  // Afterwards: puts blocks to sleep and wakes sleepers (`sleep.h`). True if the set of sleepers has changed.
  bool sleep(const Excitation& now, const double* contact_wrench);
  // s, time step that joints and contacts now allow, at most `Model::dt_max`.
  double allowed_dt() const { return allowed_; }
  // s, time step that the present contacts allow, without coming impacts; the last step is judged by it.
  double stable_dt() const;
  // 1/s, event rate: one over the step that the next openings and closings allow (`event_bound.h`). `budget` (J): of the next `forces()`.
  double event_rate() const { return event_rate_; }
  void set_step(double budget, const Interlock& interlock) { settings_.event_budget = budget, settings_.interlock = interlock; }
  double elastic() const { return elastic_; }  // J, stored in contacts at the last sample
  int touching() const { return touching_; }
  long slept() const { return sleep_.slept(); }  // steps of sleeping blocks, since the start of this Solver
  long touched() const { return touched_; }      // touching pairs, summed over the steps of this Solver

 private:
  static constexpr double round_off = 1e-9;  // margin, as a share of distance and travel: above the round-off of sums over some 1e6 steps

  void initialise();
  void mark_released(int j);
  void release_pair(const int* first, const int* last);
  void note_release(int joint, double energy);
  double start_fresh(const std::vector<int>& fresh);
  void list_involved();
  void rebuild_lists();
  void find_former_joints();
  int former_joint_of(const ContactPair& pair) const;
  void bound_former_joint(ContactPair& pair);
  void update_bound();
  double limit() const;                     // s, time step that contacts and joints allow, ...
  double limited_by_slip(double dt) const;  // s, ... and slipping patches
  void bound_elsewhere();
  double contact_count(int a, int b) const;  // number of contacts for the dashpots of `pair_force()`
  void balance_threads();
  struct ContactForce;
  double add_up(std::span<const ContactForce> forces, double* contact_wrench, bool sample);
  void add_impact_bound(int i, double impact_omega2_a, double impact_omega2_b, bool touching);
  void foresee_touching(int thread);
  void limit_passing();
  bool displaced(const ContactPair& pair, int joint) const;
  void forget_former_joints();
  // A group of eight blocks and the selected ones among them.
  struct BlockGroup {
    int group;
    unsigned which;
    double is_in[pack_size] = {};  // 1 for a selected block, else 0
  };
  struct alignas(64) MaxSpeed {
    double speed[pack_size] = {};  // m/s, greatest over many groups, lane by lane
  };
  void set_axes(int b, const Mat3& axes);  // from `contact_axes()`
  Mat3 axes_of(int b) const;
  Mat3 rotation_of(int b) const;  // from rest to the last update of its pose
  static void add_to_group(std::vector<BlockGroup>& groups, int b);
  void update_poses(BlockGroup blocks, MaxSpeed& fastest);
  void update_all_poses(bool sleepers);
  void update();
  bool surely_separated(int i);
  EdgeAtRest edge_of(const ContactPair& pair) const;
  double idle(int i) const;
  void note_separation(int i, double distance);
  void sort();
  void find_still();
  PairLaw law(int a, int b) const;

  const Model& model_;
  State& state_;
  ContactShapes shapes_;  // empty until `initialise()`, like blocks and axes
  ContactSettings settings_;
  std::vector<ContactBlock> blocks_;
  struct Axes {
    VectorPack<9> row{};  // row-major
    bool any = false;     // some differ from the world axes
  };
  std::vector<Axes> axes_;  // of the shapes at rest, by groups of eight blocks; empty if all are the world axes
  Sleep sleep_;
  std::vector<int> involved_;           // blocks that are loose or listed in a pair
  std::vector<double> fastest_loose_;   // m2/s2, greatest squared speed of an involved block, per thread
  std::vector<BlockGroup> awake_;       // involved blocks that are awake
  std::vector<BlockGroup> placed_;      // moving ones among the blocks of live pairs
  std::vector<BlockGroup> driven_;      // driven ones among these; no drift moves them
  std::vector<std::uint64_t> jointed_;  // pairs of blocks that still have a joint, sorted
  struct FormerJoint {
    int joint = -1;                     // first of the joints that this pair replaced; -1: none
    double omega2_a = 0, omega2_b = 0;  // 1/s2, as `ContactPair::bound_share_a`, `bound_share_b`
  };
  std::vector<FormerJoint> former_joints_;  // per pair
  ContactLimit limit_;
  std::vector<double> omega2_;         // 1/s2, of contacts beyond the bound of `limit_` [nblock]
  std::vector<double> impact_omega2_;  // 1/s2, of the stiffest face that may strike the block next; there is room for only one [nblock]
  double elsewhere_ = 0;               // 1/s2, greatest `on_block()` of blocks without a live pair
  // Conservative motion bound: each block's travel is accumulated, and a separated pair is tested again only when the two travels could
  // have closed its gap (`State::separation`).
  struct PairBound {
    int a = 0, b = 0;
    double until = 0;  // m; no test while `travel_ahead_[a] + travel_ahead_[b] < until`
  };
  std::vector<PairBound> pair_bounds_;  // per pair
  std::vector<int> edge_of_pair_;       // per pair, index into `edges_`; -1: none
  std::vector<EdgeAtRest> edges_;
  std::vector<VectorPack<3>> last_u_;  // m, displacements at the last update of the pose, by groups of eight as in State
  std::vector<double> reach_;          // m, distance of each block's farthest point from its centroid; whole groups, like the arrays below
  std::vector<double> spin_;           // m/s, speed of that point by rotation
  std::vector<double> travel_, travel_ahead_;  // m, travel of each block; the same with the next steps (`BlockPosePack`)
  std::vector<MaxSpeed> fastest_;              // m/s, of the blocks that each thread has updated
  double fastest_pair_ = 0;                    // m/s, upper bound of the speed of approach of any two blocks
  double thinnest_ = 0;                        // m, thinnest extent of all blocks
  // Results of a thread in this step, in the order of the pairs.
  struct ContactForce {
    int pair;
    PairResult result;
  };
  struct SeparatedPair {
    int pair;
    double apart, impact_omega2_a, impact_omega2_b, event_rate;  // as in `PairResult`
  };
  struct ThreadPairs {
    std::vector<int> at;                   // pairs to evaluate
    std::vector<ContactForce> forces;      // pairs with forces
    std::vector<SeparatedPair> separated;  // separated pairs
  };
  struct PairCache {
    PairBodies bodies;
    bool known = false, fits = false;  // fits: `fits_pack()`
    int axis = -1;                     // `cached_axis()`
  };
  std::vector<PairCache> cache_;  // per pair, data that a step reads first
  bool cache_outdated_ = true;
  std::vector<int> first_pair_;                    // first pair of each thread; balances the number of evaluations
  std::vector<ThreadPairs> thread_pairs_;          // per thread
  std::vector<OverlapRoom> room_;                  // per thread
  std::vector<std::unique_ptr<PairBatch>> batch_;  // per thread
  std::vector<std::uint64_t> pair_keys_;           // pairs of blocks with a joint at rest, sorted, ...
  std::vector<int> of_pair_;                       // ... and the first of their joints
  std::vector<std::vector<int>> neighbours_;       // blocks joined to each block at rest [nblock]
  std::vector<JointRelease> releases_;
  double reset_energy_ = 0;  // J, set free by the last releases and still contained in the sums of this step
  double allowed_ = 0, elastic_ = 0, event_rate_ = 0, slip_omega2_ = 0;
  std::vector<std::uint8_t> still_;  // sleepers with the pose of the last search [nblock]; empty without sleepers
  bool relisted_ = true, unsorted_ = true;
  int touching_ = 0;
  long touched_ = 0;
};

}  // namespace erbs
