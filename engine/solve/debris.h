// What happens once blocks come loose: joints are handed over to contact, loose blocks meet new neighbours, and the time step
// follows the contacts. An intact structure does not come here.
#pragma once
#include <vector>

#include "engine/contact/broad.h"
#include "engine/model/model.h"
#include "engine/model/state.h"
#include "engine/solve/cracked.h"

namespace erbs {

class Debris {
 public:
  Debris(const Model& model, State& state, int threads);

  bool active() const { return !involved_.empty() || !state_.debris.pair.empty(); }
  // Joints that are spent (joint_kernel.h) go over to contact; returns them. Called between forces and drift: the wrench of this
  // step is still the joint's, the next one the contact's.
  std::vector<int> hand_over_joints(Cracked& cracked);
  // Blocks that hang on nothing fixed, or have moved far from where they stood, may meet new neighbours.
  void loosen();
  // Before the forces of a step: poses of the blocks involved, and now and then a look whether a new search is due.
  void prepare();
  // Forces of the pairs of this thread; afterwards gather() sums them on one thread in the order of the pairs.
  void forces(int thread, int threads, bool sample);
  void gather(double* push, bool sample);
  // The step that the contacts allow now (s), no longer than the goal.
  double allowed_dt() const { return allowed_; }
  double elastic() const { return elastic_; }  // J, stored in contacts at the last sample
  int touching() const { return touching_; }

 private:
  void open(int j);
  void list_involved();
  void place(int b);
  PairLaw law(int a, int b) const;

  const Model& model_;
  State& state_;
  ContactShapes shapes_;
  ContactSettings settings_;
  std::vector<ContactBlock> blocks_;
  std::vector<int> involved_;            // blocks that are loose or listed in a pair
  std::vector<std::uint64_t> jointed_;   // pairs of blocks still joined, sorted
  std::vector<double> joint_rate_;       // 1/s2, share of joints in each block's greatest eigenvalue [nblock]
  std::vector<double> rate_;             // 1/s2, joints and contacts [nblock]
  std::vector<PairResult> results_;
  std::vector<OverlapRoom> room_;        // per thread
  std::vector<int> of_pair_;             // joint that first joined a pair of blocks (sorted keys), for its law
  std::vector<std::uint64_t> pair_keys_;
  double allowed_ = 0, elastic_ = 0;
  bool relisted_ = true;
  int touching_ = 0;
};

}  // namespace erbs
