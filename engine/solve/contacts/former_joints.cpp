#include "engine/solve/contacts/former_joints.h"

#include <algorithm>
#include <cmath>

#include "engine/base/count.h"
#include "engine/contact/broad/search.h"
#include "engine/contact/law/frame.h"
#include "engine/joints/cracked/fading.h"
#include "engine/joints/kinematics.h"
#include "engine/joints/response.h"

namespace erbs {
namespace {

constexpr double parted = 0.02;  // of the side of a former joint, and rad
// Of `State::energy.reference`: limit of all differences in stored energy between contacts and the joints they replaced.
constexpr double most_reset = 1.5e-3;

}  // namespace

void FormerJoints::list_pairs() {
  of_pair_.clear();
  for (ContactPair& p : state_.contacts.list.pair) {
    if (p.former_joint) bound(p);  // a push and the fall after it have other masses
    of_pair_.push_back({p.former_joint ? bodies_.first_joint_of(p) : -1, p.bound_share_a, p.bound_share_b});
  }
}

// Rates of a former joint: those of its joints, in the terms of a contact on the same faces (`stability()` of `pair.cpp`).
void FormerJoints::bound(ContactPair& p) {
  const int first = bodies_.first_joint_of(p);
  p.bound_share_a = p.bound_share_b = 0;
  for (int j = first; j < bodies_.end_of_same_parts(first, model_.njoint); ++j) {
    const Joint& joint = model_.joint[z(j)];
    const StiffnessShare share = stiffness_share(state_, j);
    double k[6];
    for (int i = 0; i < 6; ++i) k[i] = (i >= 2 && i < 5 ? share.n : share.s) * joint.type->stiffness[i];
    const double k_rotation = k[3] + k[4] + k[5];
    const auto rate = [&](int b, const Vec3& arm) {
      const ContactBlock& block = bodies_.block[z(b)];
      const Vec3 lever = arm.cross(joint.type->frame.col(2));
      const double across = std::max(k[0], k[1]);
      return (k[2] + across) * block.inverse_mass + k[2] * lever.dot(model_.inverse_inertia[z(b)] * lever) +
             (across * arm.squaredNorm() + k_rotation) * block.inverse_inertia;
    };
    p.bound_share_a += rate(p.a, joint.arm_a);
    p.bound_share_b += rate(p.b, joint.arm_b);
  }
}

// True if the faces of a former joint have left the position in which they were joined.
bool FormerJoints::displaced(const ContactPair& p, int j) const {
  const Joint& joint = model_.joint[z(j)];
  const Mat3 a = bodies_.rotation_of(p.a), b = bodies_.rotation_of(p.b);
  const Vec3 moved =
      (bodies_.block[z(p.b)].u - bodies_.block[z(p.a)].u) + (b * joint.arm_b - joint.arm_b) - (a * joint.arm_a - joint.arm_a);
  if (!(moved.norm() < parted * 2 * std::min(joint.type->half_s, joint.type->half_t))) return true;
  return !p.touching && !((a - b).norm() < parted * std::sqrt(2.0));  // a rocking block rotates and returns to its place
}

// Stiffness to which a former joint softens: that of its bed without bond (fading.h), of displaced faces that of debris if that is lower.
PairLaw FormerJoints::softest(const ContactPair& p, int joint) const {
  const PointLaw& law = law_of(joint);
  const PairLaw debris = bodies_.law(p.a, p.b);
  if (!law.fades()) return p.former_joint == ContactPair::softening || displaced(p, joint) ? debris : p.law;
  PairLaw to = p.law;
  to.kn = law.kn_debonded, to.ks = law.ks_debonded;
  if (displaced(p, joint)) to.kn = std::min(to.kn, debris.kn), to.ks = std::min(to.ks, debris.ks);
  return to;
}

// A former joint has the stiffness of a mortar layer between matching faces. Faces that slide on each other match no more; their stiffness
// falls in small steps to that of debris, if that is lower. Otherwise blocks that drag each other along would limit the step of a collapse.
bool FormerJoints::find_softening(const ContactSettings& settings, const Sleep& sleep, double most, double dt) {
  for (std::size_t i = 0; i < of_pair_.size(); ++i) {
    ContactPair& p = state_.contacts.list.pair[i];
    if (!p.former_joint || sleep.asleep(p.a) || sleep.asleep(p.b)) continue;
    const int joint = of_pair_[i].joint;
    const bool fades = law_of(joint).fades();
    if (fades && !p.touching) soften_open(i);
    if (p.former_joint != 1 || !p.touching) continue;
    const PairLaw to = softest(p, joint);
    if (fades ? to.kn >= p.law.kn && to.ks >= p.law.ks : to.kn >= p.law.kn || to.ks >= p.law.ks) continue;
    p.former_joint = ContactPair::softening;
  }
  return soften(settings, sleep, most, dt);
}

// Faces pressed by a force N store N^2 / (2 kn A). Softer faces at the same pose store less; the difference is lost. The total loss down to
// the stiffness of debris is about the energy stored at the end. If that exceeds `most` (J), the pair waits until it is pressed less.
bool FormerJoints::soften(const ContactSettings& settings, const Sleep& sleep, double most, double dt) {
  constexpr double kept = 0.992;  // of the stiffness, in each call
  bool any = false;
  for (std::size_t i = 0; i < of_pair_.size(); ++i) {
    ContactPair& p = state_.contacts.list.pair[i];
    if (p.former_joint != ContactPair::softening || !p.touching || sleep.asleep(p.a) || sleep.asleep(p.b)) continue;
    ContactBlock a = bodies_.block[z(p.a)], b = bodies_.block[z(p.b)];  // zero velocity: springs only, dashpots stay as they are
    a.v = a.w = b.v = b.w = Vec3::Zero();
    PairResult now;
    ContactPair copy = p;
    if (!pair_force(copy, bodies_.shapes, a, b, settings, 0.0, true, room_, now)) continue;
    const int joint = of_pair_[i].joint;
    const PairLaw to = softest(p, joint);
    const bool fades = law_of(joint).fades();  // then the loss is that of the bed
    if (!fades && (now.elastic + now.tangential) * p.law.kn / to.kn > most) continue;
    const double at_once = fades ? Fading::keeps(dt) : kept;
    const double kn = std::max(to.kn, at_once * p.law.kn) / p.law.kn, ks = std::max(to.ks, at_once * p.law.ks) / p.law.ks;
    p.law.kn *= kn;
    p.law.ks *= ks;
    (fades ? crushing_ : reset_energy_) += (1 - kn) * now.elastic + (1 - ks) * p.tangential;  // not what a pair at rest would store (`now`)
    p.tangential *= ks;
    // The lost part of the force still does half a step of work on the way to the next pose, as friction does.
    p.friction.force += (1 - kn) * (now.wrench.force - copy.friction.force - copy.damping.force);
    p.friction.moment_a += (1 - kn) * (now.wrench.moment_a - copy.friction.moment_a - copy.damping.moment_a);
    p.friction.moment_b += (1 - kn) * (now.wrench.moment_b - copy.friction.moment_b - copy.damping.moment_b);
    any = true;
    const bool done = p.law.kn <= to.kn && p.law.ks <= to.ks;
    if (!state_.joints.share.empty()) note_share(i);
    if (!done) continue;
    p.former_joint = 1;
    if (fades && !displaced(p, joint)) continue;
    p.former_joint = 0;
    p.bound_share_a = p.bound_share_b = 0;
    of_pair_[i] = {};
  }
  return any;
}

// Open faces store nothing: they are as soft at once as they will be.
void FormerJoints::soften_open(std::size_t i) {
  ContactPair& p = state_.contacts.list.pair[i];
  const PairLaw to = softest(p, of_pair_[i].joint);
  if (p.law.kn <= to.kn && p.law.ks <= to.ks) return;
  p.law.kn = to.kn, p.law.ks = to.ks;
  note_share(i);
}

// The joints of pair i have its stiffness now, and so has the bound.
void FormerJoints::note_share(std::size_t i) {
  ContactPair& p = state_.contacts.list.pair[i];
  const int first = of_pair_[i].joint;
  for (int j = first; j < bodies_.end_of_same_parts(first, model_.njoint); ++j) {
    const PointLaw& law = law_of(j);
    state_.joints.share[z(j)] = {p.law.kn / law.kn, p.law.ks / law.ks};
  }
  bound(p);
  of_pair_[i].omega2_a = p.bound_share_a, of_pair_[i].omega2_b = p.bound_share_b;
}

void FormerJoints::forget_displaced() {
  for (std::size_t i = 0; i < of_pair_.size(); ++i) {
    ContactPair& p = state_.contacts.list.pair[i];
    if (!p.former_joint || p.touching || !displaced(p, of_pair_[i].joint)) continue;
    p.former_joint = 0;
    p.bound_share_a = p.bound_share_b = 0;
    p.law = bodies_.law(p.a, p.b);
    p.impact = impact_factor(p.law.restitution);
    of_pair_[i] = {};
  }
}

void FormerJoints::release(std::span<const int> joints) {
  for (std::size_t i = 0; i < joints.size();) {
    const int same_end = bodies_.end_of_same_parts(joints[i], model_.njoint);
    std::size_t end = i + 1;
    while (end < joints.size() && joints[end] < same_end) ++end;
    release_pair(joints.subspan(i, end - i));
    i = end;
  }
}

// Releases the joints of one pair of parts to its contact.
void FormerJoints::release_pair(std::span<const int> joints) {
  const Joint& one = model_.joint[z(joints.front())];
  Vec6 wrench = Vec6::Zero();  // on b
  Vec3 uplift = Vec3::Zero();  // m, by which asperities hold b off a
  double stored = 0;
  for (const int j : joints) {
    uplift = joint_pose(model_, state_, j).frame.col(2) * asperity_lift(model_.laws[z(one.type->law)], state_.joints.memory[z(j)]);
    wrench += Eigen::Map<const Vec6>(&state_.cache.wrench[z(model_.wrench_row_b[z(j)]) * 8]);
    stored += state_.joints.memory[z(j)].elastic;
    state_.joints.memory[z(j)] = JointMemory{};
  }
  const double most = most_reset * state_.energy.reference - std::fabs(state_.energy.reset + reset_energy_);
  const PointLaw& joint_law = model_.laws[z(one.type->law)];
  const int at = find_pair(state_.contacts.list, one.a, one.part_a, one.b, one.part_b);
  if (at < 0) return note_release(joints.front(), stored);
  ContactPair& pair = state_.contacts.list.pair[z(at)];
  pair.former_joint = 1;
  bound(pair);
  const StiffnessShare share = stiffness_share(state_, joints.front());
  pair.law.kn = share.n * joint_law.kn;
  pair.law.ks = share.s * joint_law.ks;
  pair.law.mu = joint_law.mu_residual;
  pair.law.hop = one.hop;
  const ContactBlock &a = bodies_.block[z(pair.a)], &b = bodies_.block[z(pair.b)];
  if (!uplift.isZero(0)) pair.lift = pair.b_is_reference ? Vec3(b.rotation.transpose() * uplift) : Vec3(-(a.rotation.transpose() * uplift));
  note_release(joints.front(), stored - release_to_contact(pair, bodies_.shapes, a, b, wrench, stored, most, room_));
}

void FormerJoints::note_release(int joint, double energy) {
  reset_energy_ += energy;
  releases_.push_back({joint, energy});
}

// Two blocks of one structure without a joint between them are no contact pair; they may overlap when their pair is first listed. Their
// contact then starts like the release of a joint without force.
double FormerJoints::start_fresh(std::span<const int> pairs) {
  double stored = 0;
  for (const int i : pairs) {
    ContactPair& p = state_.contacts.list.pair[z(i)];
    const ContactBlock &a = bodies_.block[z(p.a)], &b = bodies_.block[z(p.b)];
    if (const EdgeAtRest edge = bodies_.edge_of(p); edge.touches && idle_way(edge, pair_frame(p, bodies_.shapes, a, b).pose) > 0) continue;
    stored += release_to_contact(p, bodies_.shapes, a, b, Vec6::Zero(), 0, 0, room_);
  }
  return stored;
}

}  // namespace erbs
