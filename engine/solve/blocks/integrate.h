// Time integration of blocks: simultaneous leapfrog for translation, momentum- and energy-conserving midpoint rule for rotation.
#pragma once
#include <span>
#include <vector>

#include "engine/base/system/team.h"
#include "engine/joints/kernels.h"
#include "engine/model/model.h"
#include "engine/model/state.h"

namespace erbs {

// Actions on all blocks in this step: means over the interval of the kick, exact in impulse.
struct Excitation {
  Vec3 ground = Vec3::Zero();   // m/s2, ground acceleration
  Vec3 gravity = Vec3::Zero();  // m/s2
  double kick = 0;              // s: half the last plus half the next drift
};

// Weight of block b over g times its mass: 1, unless a relaxation has scaled the masses.
inline double weight_share(const Model& m, int b) { return m.gravity_factor.empty() ? 1 : m.gravity_factor[std::size_t(b)]; }

// A block with external loads and its inverse inertia in world axes at the positions of the step.
struct LoadedBlock {
  int block = 0;
  Mat3 inverse_inertia = Mat3::Zero();  // 1/(kg m2)
};

// Sums over one fixed chunk of blocks. Each chunk has its own, so that totals do not depend on the number of threads. The work of a step's
// forces is split at the positions of the step. Half the last drift with the old velocity counts at once; half the next drift with the new
// velocity (`after`) counts when the next step begins. The sums then close exactly at every position (`energy.h`).
struct BlockSums {
  BlockWork work{};
  double external_work = 0, external_after = 0, external_absolute = 0, external_absolute_after = 0;  // J
  bool outdated = false;  // a block with joints rotated beyond the tolerance since its reference pose
  bool broken = false;    // a number is not finite
};

inline constexpr int block_grain = 4;  // groups of eight blocks per chunk

// Masses and inertias as packs, with the flags that follow from the present islands: mass damping and the limit of rotation.
std::vector<BlockConstants> block_constants(const Model& model, const State& state);
// Call when a joint of block b is no longer intact: the group of b then sums wrench rows. Writes the pose rows of the group too, since this
// step may have skipped them.
void use_wrench_rows(const Model& model, State& state, int b, std::vector<BlockConstants>& constants);
// Sets the limit of rotation of blocks with intact joints. Other blocks rotate freely and their `KernelCache::increment` may be out of
// date.
void set_rotation_limits(const Model& model, const State& state, std::vector<BlockConstants>& constants);

// Forces on blocks besides their joints, as rows of eight doubles (force, moment). `contacts`: contact wrenches. `loads`: external loads,
// with their work booked as external. Null means none. `loaded`: the blocks with external loads, in ascending order.
struct ExternalForces {
  const double *contacts = nullptr, *loads = nullptr;
  std::span<LoadedBlock> loaded = {};
  const double *load_since = nullptr, *load_next = nullptr;  // as in `BlockArrays`
  const double* inertia = nullptr;                           // of a coarse inertia, with its work booked there
};

// Integrates groups of blocks: sums wrench rows and external forces, kicks by `e.kick`, drifts by `s.dt`. `sums`: one per chunk of
// `block_grain` groups; a range that needs no sums runs in one piece. `idle`: 1 for each group without motion; empty means none. `poses`:
// the pose rows that `Cracked` reads.
void advance(const Model& model, State& state, const std::vector<BlockConstants>& constants, const Excitation& e,
             const ExternalForces& external, Range groups, bool sample, std::vector<BlockSums>& sums,
             std::span<const std::uint8_t> idle = {}, double* poses = nullptr);

// All forces on the moving blocks of these groups, with their weights (N, N m).
void sum_forces(const Model& model, State& state, const std::vector<BlockConstants>& constants, const Excitation& e,
                const ExternalForces& external, Range groups, VectorPack<6>* out);

// Groups in which every movable block sleeps; empty if none sleeps. Steps skip these groups, except samples (potential energy).
std::vector<std::uint8_t> idle_groups(const Model& model, const State& state);

// Gathers up to eight arbitrary blocks into one pack, for a sequential sweep: each block sees the new poses of blocks before it.
class BlockGather {
 public:
  // One object per sweep: it fixes the external actions of that sweep.
  BlockGather(const Model& model, State& state, const std::vector<BlockConstants>& constants, const Excitation& e,
              const ExternalForces& external);
  // Kick and drift of `blocks[0 .. count)`, `count <= pack_size`, like the free function `advance()`. The first element of `sums` receives
  // all sums except the work of loads. The following elements receive that work, one for each entry of `external.loaded`.
  void advance(const int* blocks, int count, bool sample, std::vector<BlockSums>& sums);

 private:
  void copy_in(int b, int lane);
  void copy_out(int b, int lane);
  template <class F>
  void each_loaded(const int* blocks, int count, F&& f) const;

  const Model& model_;
  State& state_;
  const std::vector<BlockConstants>& constants_;
  const ExternalForces& external_;
  const StepKernels& kernels_;
  KickDrift step_;
  BlockConstants constant_{};
  VectorPack<3> u_{}, v_{}, momentum_{}, w_{}, ref_u_{};
  VectorPack<4> q_{}, ref_q_{};
  VectorPack<6> wrench_{}, increment_{};
  alignas(64) double contact_wrench_[64] = {}, load_[64] = {};
};

// Resultant of a block's joints: force, moment.
Vec6 joint_wrench(const Model& model, const State& state, int b);

}  // namespace erbs
