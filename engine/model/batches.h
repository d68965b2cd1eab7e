// Joints in lanes: which batch holds which joint. Sound joints lie in the order of their number; a joint that cracks moves to a
// batch of joints that have cracked, one that is handed over to contact leaves its lane empty.
#pragma once
#include "engine/model/model.h"
#include "engine/model/state.h"

namespace erbs {

inline int sound_batches(const Model& model) { return (model.njoint + lanes - 1) / lanes; }

void set_batches(const Model& model, State& state);  // every joint sound, in its place
int add_empty_batch(const Model& model, State& state);  // its number
void move_joint(const Model& model, State& state, int j, int lane);  // lane: batch * lanes + lane, or -1 to take it out for good

}  // namespace erbs
