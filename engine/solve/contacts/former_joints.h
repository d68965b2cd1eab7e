// Contacts that replaced joints: the release of joints, and the softening of their contacts to the stiffness of debris.
#pragma once
#include <span>
#include <utility>
#include <vector>

#include "engine/contact/overlap/overlap.h"
#include "engine/model/state.h"
#include "engine/solve/contacts/bodies.h"
#include "engine/solve/contacts/sleep.h"

namespace erbs {

// A joint released to contact.
struct JointRelease {
  int joint;
  double energy;  // J, stored energy lost by the release; negative for a gain
};

class FormerJoints {
 public:
  FormerJoints(const Model& model, State& state, ContactBodies& bodies) : model_(model), state_(state), bodies_(bodies) {}

  void list_pairs();  // after the list of pairs has changed
  // Softens former joints with displaced faces to the stiffness of debris. `find_softening()` searches for displaced faces first. A pair
  // softens only if its total loss of energy will not exceed `most` (J). `dt`: s, since the last call. True if a pair has changed.
  bool find_softening(const ContactSettings& settings, const Sleep& sleep, double most, double dt);
  bool soften(const ContactSettings& settings, const Sleep& sleep, double most, double dt);
  // Faces that have separated and moved are no longer a former joint: their blocks next touch with the stiffness of debris. Separated faces
  // store nothing, so the change costs no energy.
  void forget_displaced();
  // Releases joints, in ascending order, to their contacts, which take over their wrenches and stored energies.
  void release(std::span<const int> joints);
  // Starts new contacts of one structure that overlap without having been a joint, without force. Returns the energy stored in their
  // springs (J).
  double start_fresh(std::span<const int> pairs);
  void add_reset(double energy) { reset_energy_ += energy; }
  void book_release() {  // after the ledger of this step has closed
    state_.energy.reset += std::exchange(reset_energy_, 0.0);
    state_.energy.crushing += std::exchange(crushing_, 0.0);
  }
  std::vector<JointRelease> take_releases() { return std::exchange(releases_, {}); }

  struct FormerJoint {
    int joint = -1;                     // first of the joints that this pair replaced; -1: none
    double omega2_a = 0, omega2_b = 0;  // 1/s2, as `ContactPair::bound_share_a`, `bound_share_b`
  };
  FormerJoint& of_pair(int i) { return of_pair_[std::size_t(i)]; }
  const FormerJoint& of_pair(int i) const { return of_pair_[std::size_t(i)]; }

 private:
  void release_pair(std::span<const int> joints);
  void note_release(int joint, double energy);
  void bound(ContactPair& pair);
  bool displaced(const ContactPair& pair, int joint) const;
  const PointLaw& law_of(int joint) const { return model_.laws[std::size_t(model_.joint[std::size_t(joint)].type->law)]; }
  PairLaw softest(const ContactPair& pair, int joint) const;
  void soften_open(std::size_t i);
  void note_share(std::size_t i);

  const Model& model_;
  State& state_;
  ContactBodies& bodies_;
  OverlapRoom room_;
  std::vector<FormerJoint> of_pair_;
  std::vector<JointRelease> releases_;
  double crushing_ = 0;      // J, lost by beds without bond that soften, booked like the next one
  double reset_energy_ = 0;  // J, set free by the last releases and still contained in the sums of this step
};

}  // namespace erbs
