// The energy ledger, a discrete identity of leapfrog. T_n = v- m v+ / 2; the work of a force over a step is the mean of its two end values
// times the mid velocity. For linear springs the sum closes to round-off, so that a residual is an error.
#pragma once
#include <span>

#include "engine/joints/joint_forces.h"
#include "engine/model/model.h"
#include "engine/model/state.h"
#include "engine/solve/blocks/integrate.h"

namespace erbs {

// Closes the ledger of `state.energy` at a sample (all terms filled): residual, its relative size, its largest jump.
//   residual = [T + Ug + Ue] - start + all dissipation - all work; relative to
//   max(1e-12 weight * height, 1e-8 of the elastic energy at the start,
//       largest (T + |dUe|) + Int |work| + dissipation + half the flux of height energy).
void settle(Energy& energy, double floor, double t, int worst_joint);

double dissipated(const Energy& energy);
double worked(const Energy& energy);

// When the ledger closes, and what it then adds up.
class Ledger {
 public:
  Ledger(const Model& model, State& state);

  // True if the ledger closes at this step without being asked to. `contacts`: some are active, whose energy costs as much as their forces.
  bool due(bool contacts);
  bool is_due() const { return due_; }  // in this step
  // Adds the sums of all chunks, which clears them, then closes. `elastic`: J, of contacts. `kinetic`: J, of their levels
  // (`Contacts::kinetic_correction`). `events`: something may open or close.
  void close(std::span<JointSums> joints, std::span<JointSums> cracked, std::span<BlockSums> blocks, double elastic, double kinetic,
             bool events);
  double mass() const { return mass_; }  // kg, of all moving blocks

 private:
  void add(const BlockSums& sums);

  const Model& model_;
  State& state_;
  double floor_ = 0;  // J, least scale of the ledger
  double lift_ = 0;   // J, work that lifts all blocks by a thousandth of the structure's height, or their energy as a driven block moves
  double mass_ = 0;
  bool due_ = false;  // the ledger closes at this step without being asked to
};

}  // namespace erbs
