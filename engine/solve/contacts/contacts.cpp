#include "engine/solve/contacts/contacts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/model/build/add_joints.h"

namespace erbs {
namespace {

constexpr double parted = 0.02;  // of the side of a former joint, and rad
// Of `State::energy.reference`: limit of all differences in stored energy between contacts and the joints they replaced.
constexpr double most_reset = 1.5e-3;
std::size_t z(int i) { return std::size_t(i); }

// End of the joints that connect the same two parts as joint `first`, at most `end`.
int end_of_same_parts(const Model& model, int first, int end) {
  const Joint& one = model.joint[z(first)];
  int last = first + 1;
  while (last < end && model.joint[z(last)].a == one.a && model.joint[z(last)].b == one.b && model.joint[z(last)].part_a == one.part_a &&
         model.joint[z(last)].part_b == one.part_b)
    ++last;
  return last;
}

double largest_inverse_inertia(const Mat3& inverse) {
  // Gershgorin's bound by rows, exact for a block along its principal axes.
  return inverse.cwiseAbs().rowwise().sum().maxCoeff();
}

}  // namespace

Contacts::Contacts(const Model& model, State& state, int threads)
    : model_(model), state_(state), sleep_(model, state), limit_(model, state) {
  thread_pairs_.resize(z(threads));
  fastest_.resize(z(threads));
  fastest_loose_.resize(z(threads));
  first_pair_.assign(z(threads) + 1, 0);
  first_pair_.back() = std::numeric_limits<int>::max();
  room_.resize(z(threads));
  if (state.contacts.start.empty()) {
    state.contacts.start.reserve(state.u.size());
    for (std::size_t b = 0; b < state.u.size(); ++b) state.contacts.start.push_back(state.u[b]);
  }
  if (state.contacts.u.empty()) {
    std::vector<double> thickness;
    each_contact_part(model, [&](int, const Polyhedron& part) { thickness.push_back(contact_shape(part).thickness); });
    state.contacts.margin = suggested_margin(std::move(thickness));
  }
  list_involved();
}

void Contacts::initialise() {
  if (!blocks_.empty()) return;
  std::vector<std::vector<Polyhedron>> parts(z(model_.nblock));
  each_contact_part(model_, [&](int b, const Polyhedron& part) { parts[z(b)].push_back(part); });
  for (std::size_t i = 0; i < room_.size(); ++i) batch_.push_back(std::make_unique<PairBatch>());
  blocks_.resize(z(model_.nblock));
  const std::size_t groups = block_groups(model_.nblock);
  last_u_.resize(groups);
  for (std::size_t g = 0; g < groups; ++g) last_u_[g] = state_.u.data()[g];
  SeparationState& separation = state_.separation;
  if (separation.q.size() == 0) separation.q = state_.q;
  for (std::vector<double>* x : {&reach_, &spin_, &travel_, &travel_ahead_}) x->assign(groups * pack_size, 0.0);
  separation.rotation_travel.resize(groups * pack_size, 0.0);
  omega2_.assign(z(model_.nblock), 0.0);
  impact_omega2_.assign(z(model_.nblock), 0.0);
  state_.contacts.contact_count.resize(z(model_.nblock));
  for (int b = 0; b < model_.nblock; ++b) {
    ContactBlock& block = blocks_[z(b)];
    block.rest = model_.rest[z(b)];
    block.inverse_mass = model_.inverse_mass[z(b)];
    block.inverse_inertia = largest_inverse_inertia(model_.inverse_inertia[z(b)]);
    const Mat3 axes = contact_axes(parts[z(b)]);
    block.inverse_tensor = axes.transpose() * model_.inverse_inertia[z(b)] * axes;
    if (axes == Mat3::Identity()) continue;
    set_axes(b, axes);
    for (Polyhedron& part : parts[z(b)])
      for (Vec3& v : part.vertices) v = axes.transpose() * v;
  }
  shapes_ = contact_shapes(parts, blocks_);
  for (std::size_t i = 0; i < shapes_.of.size(); ++i) {
    double& reach = reach_[z(shapes_.block[i])];
    reach = std::max(reach, shapes_.part(i).reach);
  }
  update_all_poses(true);
  thinnest_ = *std::ranges::min_element(model_.smallest_edge);
  neighbours_.resize(z(model_.nblock));
  for (int j = 0; j < model_.njoint; ++j) {
    const auto key = pair_key(model_.joint[z(j)].a, model_.joint[z(j)].b);
    if (!pair_keys_.empty() && pair_keys_.back() == key) continue;
    pair_keys_.push_back(key);
    of_pair_.push_back(j);
    neighbours_[z(model_.joint[z(j)].a)].push_back(model_.joint[z(j)].b);
    neighbours_[z(model_.joint[z(j)].b)].push_back(model_.joint[z(j)].a);
  }
}

void Contacts::set_axes(int b, const Mat3& axes) {
  axes_.resize(block_groups(model_.nblock));
  Axes& group = axes_[z(b / pack_size)];
  for (int l = 0; l < pack_size && !group.any; ++l)
    for (int i = 0; i < 3; ++i) group.row.x[4 * i][l] = 1;
  group.any = true;
  for (int i = 0; i < 9; ++i) group.row.x[i][b % pack_size] = axes(i / 3, i % 3);
}

Mat3 Contacts::axes_of(int b) const {
  Mat3 axes = Mat3::Identity();
  if (axes_.empty() || !axes_[z(b / pack_size)].any) return axes;
  for (int i = 0; i < 9; ++i) axes(i / 3, i % 3) = axes_[z(b / pack_size)].row.x[i][b % pack_size];
  return axes;
}

Mat3 Contacts::rotation_of(int b) const {
  const Mat3& rotation = blocks_[z(b)].rotation;
  return axes_.empty() || !axes_[z(b / pack_size)].any ? rotation : Mat3(rotation * axes_of(b).transpose());
}

void Contacts::add_to_group(std::vector<BlockGroup>& groups, int b) {
  if (groups.empty() || groups.back().group != b / pack_size) groups.push_back({b / pack_size, 0, {}});
  groups.back().which |= 1u << b % pack_size;
  groups.back().is_in[b % pack_size] = 1;
}

void Contacts::update_poses(BlockGroup blocks, MaxSpeed& fastest) {
  const std::size_t g = z(blocks.group), first = g * pack_size;
  BlockPosePack at{};
  at.u = state_.u.data()[g].x, at.q = state_.q.data()[g].x, at.v = state_.v.data()[g].x, at.w = state_.w.data()[g].x;
  at.last_u = last_u_[g].x, at.last_q = state_.separation.q.data()[g].x;
  at.reach = &reach_[first], at.rotation_travel = &state_.separation.rotation_travel[first], at.spin = &spin_[first];
  at.travel = &travel_[first], at.travel_ahead = &travel_ahead_[first];
  at.axes = !axes_.empty() && axes_[g].any ? axes_[g].row.x : nullptr;
  for (int l = 0; l < pack_size; ++l) at.row[l] = (blocks.which >> l & 1u) != 0 ? blocks_[first + z(l)].u.data() : nullptr;
  pair_kernels().track(at, blocks.which, look_ahead * 1.5 * std::max(state_.dt, state_.last_dt), fastest.speed);
}

// Updates the poses of all blocks; sleepers keep their pose unless `sleepers` is set.
void Contacts::update_all_poses(bool sleepers) {
  MaxSpeed any;  // unused: `track()` and `prepare()` find the greatest speed
  std::vector<BlockGroup> all;
  for (int b = 0; b < model_.nblock; ++b)
    if (sleepers || !sleep_.asleep(b)) add_to_group(all, b);
  for (const BlockGroup& blocks : all) update_poses(blocks, any);
}

// After a search nothing is known about the listed pairs.
void Contacts::rebuild_lists() {
  state_.separation.pair.clear();
  std::fill(state_.separation.rotation_travel.begin(), state_.separation.rotation_travel.end(), 0.0);
  list_involved();
}

void Contacts::list_involved() {
  std::vector<std::uint8_t> in(state_.loose.begin(), state_.loose.end());
  for (const ContactPair& p : state_.contacts.pair) in[z(p.a)] = in[z(p.b)] = 1;
  involved_.clear();
  unsorted_ = cache_outdated_ = true;
  for (int b = 0; b < model_.nblock; ++b)
    if (in[z(b)]) involved_.push_back(b);
  jointed_.clear();
  former_joints_.clear();
  pair_bounds_.clear();
  edge_of_pair_.clear();
  edges_.clear();
  if (!active()) return;
  initialise();
  for (int j = 0; j < model_.njoint; ++j)
    if (state_.stage[z(j)] != JointStage::contact) jointed_.push_back(pair_key(model_.joint[z(j)].a, model_.joint[z(j)].b));
  find_former_joints();
  for (const ContactPair& p : state_.contacts.pair) {
    pair_bounds_.push_back({p.a, p.b});
    const EdgeAtRest edge = edge_of(p);
    edge_of_pair_.push_back(edge.touches ? int(edges_.size()) : -1);
    if (edge.touches) edges_.push_back(edge);
  }
  state_.separation.pair.resize(pair_bounds_.size());
}

void Contacts::find_former_joints() {
  former_joints_.clear();
  for (const ContactPair& p : state_.contacts.pair)
    former_joints_.push_back({p.former_joint ? former_joint_of(p) : -1, p.bound_share_a, p.bound_share_b});
}

// First of the joints that a contact pair has replaced.
int Contacts::former_joint_of(const ContactPair& p) const {
  const auto at = std::lower_bound(pair_keys_.begin(), pair_keys_.end(), pair_key(p.a, p.b));
  int first = of_pair_[std::size_t(at - pair_keys_.begin())];
  while (model_.joint[z(first)].part_a != p.part_a || model_.joint[z(first)].part_b != p.part_b)
    first = end_of_same_parts(model_, first, model_.njoint);
  return first;
}

// Rates of a former joint: those of its joints, in the terms of a contact on the same faces (`stability()` of `pair.cpp`).
void Contacts::bound_former_joint(ContactPair& p) {
  const int first = former_joint_of(p);
  p.bound_share_a = p.bound_share_b = 0;
  for (int j = first; j < end_of_same_parts(model_, first, model_.njoint); ++j) {
    const Joint& joint = model_.joint[z(j)];
    const double *k = joint.type->stiffness, k_rotation = k[3] + k[4] + k[5];
    const auto rate = [&](int b, const Vec3& arm) {
      const ContactBlock& block = blocks_[z(b)];
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
bool Contacts::displaced(const ContactPair& p, int j) const {
  const Joint& joint = model_.joint[z(j)];
  const Mat3 a = rotation_of(p.a), b = rotation_of(p.b);
  const Vec3 moved = (blocks_[z(p.b)].u - blocks_[z(p.a)].u) + (b * joint.arm_b - joint.arm_b) - (a * joint.arm_a - joint.arm_a);
  if (!(moved.norm() < parted * 2 * std::min(joint.type->half_s, joint.type->half_t))) return true;
  return !p.touching && !((a - b).norm() < parted * std::sqrt(2.0));  // a rocking block rotates and returns to its place
}

// A former joint has the stiffness of a mortar layer between matching faces. Faces that slide on each other match no more; their stiffness
// falls in small steps to that of debris, if that is lower. Otherwise blocks that drag each other along would limit the step of a collapse.
void Contacts::find_softening(double most) {
  for (std::size_t i = 0; i < former_joints_.size(); ++i) {
    ContactPair& p = state_.contacts.pair[i];
    if (p.former_joint != 1 || !p.touching || sleep_.asleep(p.a) || sleep_.asleep(p.b) || !displaced(p, former_joints_[i].joint)) continue;
    const PairLaw to = law(p.a, p.b);
    if (to.kn >= p.law.kn || to.ks >= p.law.ks) continue;
    p.former_joint = ContactPair::softening;
  }
  soften_former_joints(most);
}

// Faces pressed by a force N store N^2 / (2 kn A). Softer faces at the same pose store less; the difference is lost. The total loss down to
// the stiffness of debris is about the energy stored at the end. If that exceeds `most` (J), the pair waits until it is pressed less.
void Contacts::soften_former_joints(double most) {
  constexpr double at_once = 0.992;  // of the stiffness, in each call
  for (std::size_t i = 0; i < former_joints_.size(); ++i) {
    ContactPair& p = state_.contacts.pair[i];
    if (p.former_joint != ContactPair::softening || !p.touching || sleep_.asleep(p.a) || sleep_.asleep(p.b)) continue;
    ContactBlock a = blocks_[z(p.a)], b = blocks_[z(p.b)];  // zero velocity: springs only, dashpots stay as they are
    a.v = a.w = b.v = b.w = Vec3::Zero();
    PairResult now;
    ContactPair copy = p;
    if (!pair_force(copy, shapes_, a, b, settings_, 0.0, true, room_.front(), now)) continue;
    const PairLaw to = law(p.a, p.b);
    if ((now.elastic + now.tangential) * p.law.kn / to.kn > most) continue;
    const double kn = std::max(to.kn, at_once * p.law.kn) / p.law.kn, ks = std::max(to.ks, at_once * p.law.ks) / p.law.ks;
    p.law.kn *= kn;
    p.law.ks *= ks;
    p.tangential *= ks;
    reset_energy_ += (1 - kn) * now.elastic + (1 - ks) * now.tangential;
    // The lost part of the force still does half a step of work on the way to the next pose, as friction does.
    p.friction.force += (1 - kn) * (now.wrench.force - copy.friction.force);
    p.friction.moment_a += (1 - kn) * (now.wrench.moment_a - copy.friction.moment_a);
    p.friction.moment_b += (1 - kn) * (now.wrench.moment_b - copy.friction.moment_b);
    cache_outdated_ = true;
    if (p.law.kn > to.kn || p.law.ks > to.ks) continue;
    p.former_joint = 0;
    p.bound_share_a = p.bound_share_b = 0;
    former_joints_[i] = {};
  }
}

// Faces that have separated and moved are no longer a former joint: their blocks next touch with the stiffness of debris. Separated faces
// store nothing, so the change costs no energy.
void Contacts::forget_former_joints() {
  for (std::size_t i = 0; i < former_joints_.size(); ++i) {
    ContactPair& p = state_.contacts.pair[i];
    if (!p.former_joint || p.touching || !displaced(p, former_joints_[i].joint)) continue;
    p.former_joint = 0;
    p.bound_share_a = p.bound_share_b = 0;
    p.law = law(p.a, p.b);
    p.impact = impact_factor(p.law.restitution);
    former_joints_[i] = {};
  }
}

PairLaw Contacts::law(int a, int b) const {
  return pair_law(model_.materials[z(model_.material[z(a)])], model_.materials[z(model_.material[z(b)])]);
}

void Contacts::mark_released(int j) {
  state_.stage[z(j)] = JointStage::contact;
  state_.loose[z(model_.joint[z(j)].a)] = model_.kind[z(model_.joint[z(j)].a)] != Kind::fixed;
  state_.loose[z(model_.joint[z(j)].b)] = model_.kind[z(model_.joint[z(j)].b)] != Kind::fixed;
}

std::vector<int> Contacts::release_joints(Cracked& cracked) {
  std::vector<int> released;
  if (cracked.none_ready_for_contact()) return released;
  int first = 0;
  while (first < model_.njoint && !(state_.stage[z(first)] == JointStage::cracked && cracked.ready_for_contact(first))) ++first;
  if (first == model_.njoint) return released;
  for (int j = 0; j < model_.njoint;) {
    // Joints of one pair of blocks are adjacent. They are released together, once none is intact and one is beyond its range.
    int end = j + 1;
    while (end < model_.njoint && model_.joint[z(end)].a == model_.joint[z(j)].a && model_.joint[z(end)].b == model_.joint[z(j)].b) ++end;
    bool any = false, holds = false;
    for (int k = j; k < end; ++k) {
      any = any || (state_.stage[z(k)] == JointStage::cracked && cracked.ready_for_contact(k));
      holds = holds || state_.stage[z(k)] == JointStage::intact;
    }
    if (any && !holds)
      for (int k = j; k < end; ++k)
        if (state_.stage[z(k)] == JointStage::cracked) released.push_back(k);
    j = end;
  }
  if (released.empty()) return released;
  cracked.store();
  for (const int j : released) mark_released(j);
  initialise();
  list_involved();
  // All poses, because the last update depends on when this run was started or resumed.
  update_all_poses(true);
  state_.contacts.valid = false;
  std::vector<int> fresh;
  reset_energy_ += search(
      state_.contacts, shapes_, blocks_, state_.loose, jointed_, [this](int a, int b) { return law(a, b); }, {}, &fresh);
  for (std::size_t i = 0; i < released.size();) {
    const int same_end = end_of_same_parts(model_, released[i], model_.njoint);
    std::size_t end = i + 1;
    while (end < released.size() && released[end] < same_end) ++end;
    release_pair(&released[i], &released[i] + (end - i));
    i = end;
  }
  std::erase_if(fresh, [this](int i) { return state_.contacts.pair[z(i)].former_joint != 0; });
  reset_energy_ -= start_fresh(fresh);
  rebuild_lists();
  return released;
}

// Releases the joints [first, last) of one pair of parts to its contact, which takes over their wrench and stored energy.
void Contacts::release_pair(const int* first, const int* last) {
  const Joint& one = model_.joint[z(*first)];
  Vec6 wrench = Vec6::Zero();  // on b
  double stored = 0;
  for (const int* j = first; j < last; ++j) {
    wrench += Eigen::Map<const Vec6>(&state_.wrench[z(model_.wrench_row_b[z(*j)]) * 8]);
    stored += state_.memory[z(*j)].elastic;
    state_.memory[z(*j)] = JointMemory{};
  }
  const double most = most_reset * state_.energy.reference - std::fabs(state_.energy.reset + reset_energy_);
  const PointLaw& joint_law = model_.laws[z(one.type->law)];
  const int at = find_pair(state_.contacts, one.a, one.part_a, one.b, one.part_b);
  if (at < 0) return note_release(*first, stored);
  ContactPair& pair = state_.contacts.pair[z(at)];
  pair.former_joint = 1;
  bound_former_joint(pair);
  pair.law.kn = joint_law.kn;
  pair.law.ks = joint_law.ks;
  pair.law.mu = joint_law.mu_residual;
  cache_outdated_ = true;
  note_release(*first,
               stored - release_to_contact(pair, shapes_, blocks_[z(pair.a)], blocks_[z(pair.b)], wrench, stored, most, room_.front()));
}

void Contacts::note_release(int joint, double energy) {
  reset_energy_ += energy;
  releases_.push_back({joint, energy});
}

// Two blocks of one structure without a joint between them are no contact pair; they may overlap when their pair is first listed. Their
// contact then starts like the release of a joint without force. Returns the energy stored in the springs (J).
double Contacts::start_fresh(const std::vector<int>& fresh) {
  double stored = 0;
  for (const int i : fresh) {
    ContactPair& p = state_.contacts.pair[z(i)];
    const ContactBlock &a = blocks_[z(p.a)], &b = blocks_[z(p.b)];
    if (const EdgeAtRest edge = edge_of(p); edge.touches && idle_way(edge, pair_frame(p, shapes_, a, b).pose) > 0) continue;
    stored += release_to_contact(p, shapes_, a, b, Vec6::Zero(), 0, 0, room_.front());
  }
  return stored;
}

void Contacts::book_release() { state_.energy.reset += std::exchange(reset_energy_, 0.0); }

void Contacts::activate_loose_blocks() {
  bool changed = false;
  const double far = 0.5 * state_.contacts.margin;
  for (int b = 0; b < model_.nblock; ++b) {
    if (model_.kind[z(b)] == Kind::fixed || state_.loose[z(b)]) continue;
    if (state_.grounded[z(b)] && (state_.u[z(b)] - state_.contacts.start[z(b)]).squaredNorm() < far * far) continue;
    if (model_.kind[z(b)] == Kind::driven && state_.grounded[z(b)] && state_.u[z(b)].norm() < far) continue;
    state_.loose[z(b)] = 1;
    changed = true;
  }
  if (!changed) return;
  state_.contacts.valid = false;
  list_involved();
}

}  // namespace erbs
