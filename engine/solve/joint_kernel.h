// What all joints have in common, sound (sound.h) or cracked (cracked.h): their account, and one of them point by point.
#pragma once
#include <vector>

#include "engine/model/model.h"
#include "engine/model/state.h"
#include "engine/solve/joint_response.h"

namespace erbs {

// What a thread gathers while it goes through its joints, by fixed chunks of batches so that sums do not depend on threads.
struct JointSums {
  JointEnergy energy;        // dissipated so far; elastic: stored now, filled on request
  double largest_error = 0;  // J, of the joints' own energy balance over the step
  int worst_joint = -1;
  int cracked_now = 0;  // joints that lost their soundness in this step
  double haste = 0;     // the greatest of event_bound.h, over the last step
};

// One joint point by point, its own energy balance checked over the step (work of the resultant = stored + dissipated). `batch`: that
// of a sound joint, where it is at hand, and its lane there.
void joint_by_points(const Model& model, State& state, int j, const double q[6], double f[6], JointSums& sums,
                     const JointBatch* batch = nullptr, int lane = 0);

inline constexpr int batch_grain = 8;  // batches, or joints of the reference, to a chunk
// Sound joints with dashpots: writes the wrench rows of batches [first, last) of `batch`, as sound.h does without.
void joint_forces(const Model& model, State& state, const std::vector<JointBatch>& batch, int first, int last, bool sample,
                  JointSums& sums);

// A joint whose faces have moved so far that its fixed overlap polygon no longer tells the truth: slip of 1 % of its side (that much
// of the polygon is wrong), a turn of 0.03 (the gap of a turned face, 2 sin(turn / 2) for turn, errs by turn^3 / 24 of the side,
// 1e-6; the pairing of moment and rotation rate about the mean frame by turn^2 / 12, 8e-5), or faces that are nowhere closer than 0.2 %
// of its side.
bool beyond_its_faces(const Joint& joint, const double q[6]);
// ... and that has no bond left: contact takes over.
bool joint_spent(const Model& model, const State& state, int j);

}  // namespace erbs
