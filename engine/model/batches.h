// Joints in lanes: which batch holds which joint. Sound joints lie in the order of their number; what their batches hold follows from
// the poses of the last refresh and is not kept in the State (sound_batch of joint_geometry.h makes one). A joint that cracks moves
// to a batch of State::batch, one that is handed over to contact leaves its lane empty.
#pragma once
#include "engine/model/model.h"
#include "engine/model/state.h"

namespace erbs {

// Sets Joint::kept_by_b. Eight blocks side by side go through the joints they keep in rounds, the first of each, then the second: as many
// as the busiest of them keeps. Few rounds in all mean few empty lanes.
void choose_keepers(Model& model);
// Sound joints are computed in the lanes of the blocks that keep them (sound.h).
inline bool keepers(const Model& model) {
  return model.analysis.kernel != "reference" && model.analysis.solver != "sequential" && !model.dashpots;
}
inline int sound_batches(const Model& model) { return (model.njoint + lanes - 1) / lanes; }

void set_places(const Model& model, State& state);      // every joint sound, in its place
int add_empty_batch(const Model& model, State& state);  // its index in State::batch
void clear_lane(const Model& model, JointBatch& batch, int lane);
void set_constants(const Model& model, int j, JointBatch& batch, int lane);  // all of joint j that no refresh changes

}  // namespace erbs
