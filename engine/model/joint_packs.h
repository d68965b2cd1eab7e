// Joints in packs of eight lanes: which batch holds which joint. Intact joints lie in the order of their number. The State does not
// store their batches: the content follows from the poses of the last update of the reference (`intact_pack` in kinematics.h). A joint
// that cracks moves to a batch of JointState::pack; a joint released to contact leaves its lane empty.
#pragma once
#include "engine/model/model.h"
#include "engine/model/state.h"

namespace erbs {

inline constexpr int cracked_chunk = 8;  // packs of cracked joints that one thread works on at a time
inline constexpr int pack_grain = 8;     // packs of intact joints, or joints of the reference kernel, per chunk

// Chooses the owner of each joint, Joint::owned_by_b. A group of eight blocks evaluates its joints in rounds: the first joint of each
// block, then the second. It needs as many rounds as its busiest block owns joints. Few rounds in total mean few empty lanes.
void choose_owners(Model& model);
// Whether intact joints are evaluated in the lanes of their owners (intact.h).
inline bool owner_computes(const Model& model) {
  return model.analysis.kernel != "reference" && model.analysis.solver != "sequential" && !model.dashpots;
}
inline int intact_packs(const Model& model) { return (model.njoint + pack_size - 1) / pack_size; }

void set_slots(const Model& model, State& state);      // all joints intact, each in its own lane
int add_empty_pack(const Model& model, State& state);  // returns its index in JointState::pack
void clear_lane(const Model& model, JointPack& pack, int lane);
// Spare wrench rows, one for each chunk: empty lanes write too, and threads work on several chunks at a time.
inline int cracked_chunks(const Model& model) { return model.njoint / cracked_chunk + 1; }  // at most
inline int spare_row_of_cracked(const Model& model, int group) { return model.spare_wrench_row() + 1 + group / cracked_chunk; }
inline int spare_row_of_intact(const Model& model, int k) {
  return spare_row_of_cracked(model, 0) + cracked_chunks(model) + k / pack_grain;
}
void set_constants(const Model& model, int j, JointPack& pack, int lane);  // data of joint j that no update of the reference changes

}  // namespace erbs
