// Cracked joints in packs of eight of one law and size. Their points' history is stored here while a Solver runs; `store()` copies it to
// the State for all other readers.
#pragma once
#include <cstddef>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "engine/joints/joint_forces.h"
#include "engine/joints/kernels.h"
#include "engine/model/joint_packs.h"

namespace erbs {

class Cracked {
 public:
  Cracked(const Model& model, State& state);  // includes the joints that have cracked already
  int groups() const { return int(group_.size()); }
  void take(int j);  // adds a joint that has cracked
  void drop(int j);  // removes a joint released to contact
  // Between two steps: fills the lanes that joints have left, and parts joints without a bond from those with one. Fewer and purer packs
  // cost less; the force of a joint does not depend on its lane.
  void regroup();
  // Pose rows of eight doubles (displacement, attitude) of the blocks with cracked joints, as the drift leaves them.
  double* poses() { return pose_.empty() ? nullptr : pose_.data(); }
  void copy_pose(int b);
  // Groups per chunk.
  static constexpr int grain = cracked_chunk;
  // Writes the wrench rows of groups [first, last); fills `sums.energy.elastic` if `sample`. `budget`: J, for `event_bound.h`.
  void forces(int first, int last, bool sample, double budget, JointSums& sums, const StepKernels& kernels = step_kernels());
  void store();
  void store(int j);                    // the same for one joint
  void set_share(int j);                // after its stiffness has changed in the State (fading.h)
  bool debonded(int j) const;           // no point has a bond left
  bool none_ready_for_contact() const;  // true: certainly no joint can be released
  // True if the joint has no bond left and is beyond the range of its fixed faces (`out_of_range()`).
  bool ready_for_contact(int j) const;

 private:
  // Shapes of the eight joints of a pack. Packs with joints of one type share them, so that they stay in the cache.
  struct Shapes {
    FacePack face;
    std::vector<CornerPack> overlap_corner;
    std::vector<PointPack> point;  // [points], like `cell`
    std::vector<CellPack> cell;
    std::vector<int> first;                           // first corner of each loop [points + 1]
    std::vector<CornerPack> cell_loop, tension_loop;  // of the cells; `tension_loop` is empty if equal to `cell_loop`
    bool rectangles = false;
    std::vector<CornerPack> line;  // of the grid of cells; empty without
  };
  // Shape of the overlap and the cells of a type. Packs mix types only if they agree in `rectangle` and `lines`.
  struct CellGrid {
    bool rectangle = false;  // overlap along s and t, about the centre
    int lines = 0;           // cells between so many lines and one more, along s and t; 0: no such grid
    double s[most_cells_in_line + 1] = {}, t[most_cells_in_line + 1] = {};  // m, of the lines
  };
  struct alignas(64) Group {
    int law, points, corners;
    int pack;                         // index in `JointState::pack`
    unsigned used = 0;                // occupied lanes, as bits
    bool pressed_by_gravity = false;  // joints compressed by gravity
    bool maybe_out_of_range = true;   // some joint may be beyond its faces
    bool debonded = true;             // no point has a bond left
    bool damage_changed = false;      // damage has changed since `store()`
    std::size_t at = 0;               // index in `memory_`
    std::shared_ptr<Shapes> shapes;
    std::size_t room = 0;  // lines that fit there
    int own_numbers = 0;   // of the law (laws/face.h)
    // A step reads the members above. It reads the members below only for joints that crush or have bonds.
    int joint[pack_size];             // -1: empty
    CrushedFace* crushed[pack_size];  // null without a plateau in compression
    const double* bearing[pack_size];
    const JointType* type = nullptr;  // null: several types
    std::vector<BondPack> bond;       // [points]
    bool empty() const { return used == 0; }
    void update_debonded(const PointLaw& law);
  };
  void set_empty(Group& group, const Joint& joint);
  CrackedPack& memory_of(const Group& group) { return *reinterpret_cast<CrackedPack*>(&memory_[group.at]); }
  const CrackedPack& memory_of(const Group& group) const { return *reinterpret_cast<const CrackedPack*>(&memory_[group.at]); }
  bool fits(const Group& group, const Joint& joint) const;  // equal law and numbers, and compressed alike
  int find_lane(const Joint& joint, bool debonded);         // group * lanes + lane; adds a group if necessary
  int lane_of(int j) const;                                 // the same of joint j; negative: in none
  void fill(Group& group, int l, int j);
  void clear(Group& group, int l);
  void store(const Group& group, int l, bool damage_changed);
  void set_share(CrackedPack& lane, int l, int j) const;
  void set_shape(Shapes& shapes, int l, const JointType& type) const;
  std::shared_ptr<Shapes> shared_shapes(const JointType& type);  // for a pack of this type alone
  void add_shape(Group& group, int l, const JointType& type);
  CellGrid grid_of(const JointType& type) const;
  void find_type(Group& group);
  void put(int j);                            // finds a lane and fills it
  void put(int j, int at);                    // fills lane `at`, numbered as in `find_lane()`
  void vacate(int at);                        // empties it
  void move(int j, int to);                   // to another lane
  int fuller_lane(int j, int from) const;     // a free lane before group `from` that suits joint j; -1: none
  void set_ends(int j);                       // blocks, rows and arms of its lane
  void copy_ends(const Group& group, int l);  // from its pack in `JointState::pack`
  void take_all(std::vector<int>& joints);    // sorted by type

  const Model& model_;
  State& state_;
  struct alignas(64) Line {
    std::byte of[64];
  };
  std::vector<Group> group_;
  std::vector<Line> memory_;  // of all groups: `CrackedPack`, the slips of their points, the numbers of their law
  Rows pose_;
  std::map<const JointType*, CellGrid> grid_;
  std::map<const JointType*, std::shared_ptr<Shapes>> of_type_;
};

}  // namespace erbs
