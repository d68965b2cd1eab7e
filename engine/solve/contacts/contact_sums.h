// Sums over the contact pairs of a step, in the order of the pairs whatever threads have evaluated them: forces on blocks, rates for the
// bound of the time step, and the energy that contacts lose.
//
// A line of memory that one core has written takes as long on its way to another as the sum of its pair. So each thread adds up its own
// blocks, and looks at pairs of another thread only where they act on one of them; the rest of each pair is condensed by the thread that
// has evaluated it.
#pragma once
#include <array>
#include <span>
#include <vector>

#include "engine/base/system/team.h"
#include "engine/model/model.h"
#include "engine/model/state.h"
#include "engine/solve/contacts/contact_bound.h"
#include "engine/solve/contacts/contact_forces.h"
#include "engine/solve/contacts/former_joints.h"
#include "engine/solve/contacts/motion_bounds.h"
#include "engine/solve/contacts/sleep.h"

namespace erbs {

class ContactSums {
 public:
  // What the sums are made of.
  struct Of {
    const Model& model;
    State& state;
    const ContactBodies& bodies;
    const MotionBounds& motion;
    const FormerJoints& former;
    const ContactForces& forces;
    const Sleep& sleep;
    ContactBound& bound;
  };
  ContactSums(const Of& of, int threads) : of_(of), condensed_(std::size_t(threads)) {}

  void list_pairs() { relisted_ = kick_relisted_ = true; }  // all rows start anew in the next step
  // At the start of a macro step. `condense()` by each thread after the forces of its pairs; when all have done so `add_up()` by each
  // thread for its blocks, and `add_totals()` by one of them; then `end()` while it is alone. `kick`: as `contact_wrench`, each pair times
  // its impulse over that of a step, null without levels (model/levels.h).
  void condense(int thread);
  void add_up(Range blocks, const StepLoads& loads, double* contact_wrench, double* kick);
  void add_totals(bool levels, bool sample);
  void end();
  // Within a macro step, on one thread: of the pairs that act in this step, and their blocks.
  void add_up_substep(std::span<const int> blocks, double* kick);

  double elastic() const { return elastic_; }  // J, stored in contacts at the last sample
  // J, of the sample: kinetic energy is that of the last interval of each pair, the kick may be for another one.
  double kinetic_correction() const { return kinetic_correction_; }
  int touching() const { return touching_; }
  long touched() const { return touched_; }  // touching pairs, summed over the steps

 private:
  // Of the pairs of a thread.
  struct alignas(64) Condensed {
    std::vector<std::array<int, 2>> blocks;   // of each pair with forces
    std::vector<std::array<double, 2>> lost;  // J, friction and dashpots of each pair with forces
    ContactBound::Parts parts;
    int touching = 0;
    double penetration = 0;  // depth over the smaller edge of both blocks
  };
  void start_rows(std::span<const int> blocks, double* rows) const;
  void start_all_rows(Range blocks, double* rows) const;
  double kick_share(int i) const;

  Of of_;
  std::vector<Condensed> condensed_;
  bool relisted_ = true, kick_relisted_ = true;
  double elastic_ = 0, kinetic_correction_ = 0;
  int touching_ = 0;
  long touched_ = 0;
};

}  // namespace erbs
