// Joints that have cracked, eight of one law and size side by side. The point laws' memory lives here while a Solver runs;
// store() writes it back into the State for all who read it there.
#pragma once
#include <cstddef>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "engine/solve/joint_kernel.h"
#include "engine/solve/lanes.h"

namespace erbs {

class Cracked {
 public:
  Cracked(const Model& model, State& state);  // takes in the joints that have cracked already
  int groups() const { return int(group_.size()); }
  void take(int j);  // a joint that has cracked: out of the sound batches
  void drop(int j);  // a joint that was handed over to contact
  // Where blocks are, rows of eight doubles: displacement and attitude, as the drift leaves them; of those that have cracked joints.
  double* poses() { return pose_.empty() ? nullptr : pose_.data(); }
  void take_pose(int b);
  // Wrench rows of groups [first, last); fills sums.energy.elastic when `sample`.
  static constexpr int grain = 8;
  // `budget`: J, for event_bound.h.
  void forces(int first, int last, bool sample, double budget, JointSums& sums, const LaneKernels& kernels = lane_kernels());
  void store();
  bool none_spent() const;  // surely
  // The joint has no bond left, and has moved beyond what its fixed faces can tell (joint_response.h).
  bool spent(int j) const;

 private:
  // Shapes of eight joints side by side. Groups of joints of one type share theirs, which then stays near the processor.
  struct Shapes {
    FaceLanes face;
    std::vector<CornerLanes> corner;
    std::vector<SpotLanes> spot;  // [points], and so is cell
    std::vector<CellLanes> cell;
    std::vector<int> first;                // [points + 1]
    std::vector<CornerLanes> loop, watch;  // of the cells; watch empty where it is loop
  };
  struct alignas(64) Group {
    int law, points, corners;
    int batch;           // in State::batch
    unsigned used = 0;   // lanes, as bits
    bool bears = false;  // joints that gravity presses
    bool beyond = true;  // some may be beyond their faces
    bool bare = true;    // no point of any lane has a bond left
    bool worn = false;   // bonds have changed since the State knew of them
    std::size_t at = 0;  // in memory_
    std::shared_ptr<Shapes> shapes;
    int room = -1;  // at `at`, for points
    // a step reads what stands above, and only of joints that crush or have bonds what follows
    int joint[lanes];             // -1: empty
    CrushedFace* crushed[lanes];  // null without a plateau
    const double* face_corner[lanes];
    const JointType* type = nullptr;  // null: of several
    std::vector<BondLanes> bond;      // [points]
    bool empty() const { return used == 0; }
    void look_for_bonds(const PointLaw& law);
  };
  void set_empty(Group& group, const Joint& joint);
  CrackedLanes& memory_of(const Group& group) { return *reinterpret_cast<CrackedLanes*>(&memory_[group.at]); }
  const CrackedLanes& memory_of(const Group& group) const { return *reinterpret_cast<const CrackedLanes*>(&memory_[group.at]); }
  bool fits(const Group& group, const Joint& joint) const;  // the same law and numbers of everything, and pressed alike
  int find_lane(const Joint& joint);                        // group * lanes + lane, in a new group if need be
  void fill(Group& group, int l, int j);
  void clear(Group& group, int l);
  void set_shape(Shapes& shapes, int l, const JointType& type) const;
  std::shared_ptr<Shapes> shared_shapes(const JointType& type);  // of eight joints of it
  void add_shape(Group& group, int l, const JointType& type);
  void look_at_types(Group& group);
  void put(int j);                            // into a lane of its own
  void set_ends(int j);                       // its lane's blocks, rows and arms
  void copy_ends(const Group& group, int l);  // from its batch
  void take_all(std::vector<int>& joints);    // by types

  const Model& model_;
  State& state_;
  struct alignas(64) Line {
    std::byte of[64];
  };
  std::vector<Group> group_;
  std::vector<Line> memory_;  // of all groups: CrackedLanes and the slips of their points
  Rows pose_;
  std::map<const JointType*, std::shared_ptr<Shapes>> of_type_;
};

}  // namespace erbs
