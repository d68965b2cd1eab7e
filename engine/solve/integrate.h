// Kick and drift of blocks: simultaneous leapfrog for translation, momentum- and energy-conserving midpoint for rotation.
#pragma once
#include <span>
#include <vector>

#include "engine/base/parallel.h"
#include "engine/model/model.h"
#include "engine/model/state.h"
#include "engine/solve/lanes.h"

namespace erbs {

// What acts on all blocks in this step: means over the kick's interval, exact in impulse.
struct Excitation {
  Vec3 ground = Vec3::Zero();   // m/s2, acceleration of the ground
  Vec3 gravity = Vec3::Zero();  // m/s2
  double kick = 0;              // s: half the last and half the next drift
};

// A block that external loads act on: its inverse inertia in world axes at the step's positions.
struct LoadedBlock {
  int block = 0;
  Mat3 inverse_inertia = Mat3::Zero();  // 1/(kg m2)
};

// Sums over one fixed chunk of blocks; kept apart per chunk, so that totals do not depend on threads. The work of a step's forces
// is split at its positions: half the last drift with the old velocity (counted at once), half the next drift with the new one
// (`after`, counted when the next step is taken). Sums then close exactly at every position: energy.h.
struct BlockSums {
  BlockWork work{};
  double external_work = 0, external_after = 0, external_absolute = 0, external_absolute_after = 0;  // J
  bool stale = false;   // a joined block turned past the tolerance since its refresh
  bool broken = false;  // not a number
};

inline constexpr int block_grain = 4;  // groups of eight blocks to a chunk

// Masses and inertias in lanes; what follows from the state's islands (who is damped, who must not turn far) as it is now.
std::vector<BlockConstants> block_constants(const Model& model, const State& state);
// A joint of block b is sound no more: from now on it reads and writes rows. Those of the group may not have been written in this step.
void go_by_rows(const Model& model, State& state, int b, std::vector<BlockConstants>& constants);
// Blocks that no sound joint holds may turn as they like, and State::shift of them may stand still.
void let_turn(const Model& model, const State& state, std::vector<BlockConstants>& constants);

// What pushes blocks beside their joints: rows of eight doubles (force, moment), `contacts` from contacts and `loads` from external
// loads, whose work is booked as external; null where there are none. `loaded`: the blocks that loads act on, in order.
struct Pushes {
  const double *contacts = nullptr, *loads = nullptr;
  std::span<LoadedBlock> loaded = {};
};

// Groups of blocks: sum their wrench rows and pushes, kick by e.kick, drift by s.dt. `sums`: one for each chunk of block_grain groups of
// all; where nothing is summed the range is one piece. `idle`: of each group, 1 where nothing moves; empty: none. `poses`: what Cracked
// reads of blocks.
void advance(const Model& model, State& state, const std::vector<BlockConstants>& constants, const Excitation& e, const Pushes& pushes,
             Range groups, bool sample, std::vector<BlockSums>& sums, std::span<const std::uint8_t> idle = {}, double* poses = nullptr);

// Groups in which all that could move sleep (Rest); empty where none does. But for samples, which count their height, a step may pass by.
std::vector<std::uint8_t> idle_groups(const Model& model, const State& state);

// Blocks picked from anywhere, up to eight at a time, for a sweep in which each meets those that have gone before it where they have
// arrived.
class Picked {
 public:
  // For one sweep: what acts in it is taken once.
  Picked(const Model& model, State& state, const std::vector<BlockConstants>& constants, const Excitation& e, const Pushes& pushes);
  // Kick and drift of blocks[0 .. count), count <= lanes, as advance() does. `sums`: the first of all, but what loads do is summed
  // up block by block, in the order of pushes.loaded, behind it.
  void advance(const int* blocks, int count, bool sample, std::vector<BlockSums>& sums);

 private:
  void copy_in(int b, int lane);
  void copy_out(int b, int lane);
  template <class F>
  void each_loaded(const int* blocks, int count, F&& f) const;

  const Model& model_;
  State& state_;
  const std::vector<BlockConstants>& constants_;
  const Pushes& pushes_;
  const LaneKernels& kernels_;
  KickDrift step_;
  BlockConstants constant_{};
  RowLanes<3> u_{}, v_{}, momentum_{}, w_{}, base_u_{};
  RowLanes<4> q_{}, base_q_{};
  RowLanes<6> wrench_{}, shift_{};
  alignas(64) double push_[64] = {}, load_[64] = {};
};

// Sum of what a block's joints do to it: force, moment.
Vec6 joint_wrench(const Model& model, const State& state, int b);

}  // namespace erbs
