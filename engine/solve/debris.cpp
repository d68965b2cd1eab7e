#include "engine/solve/debris.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/model/add_joints.h"

namespace erbs {
namespace {

constexpr double parted = 0.02;  // of the side of a former joint, and rad
// Of `State::energy.reference`: limit of all differences in stored energy between contacts and the joints they replaced.
constexpr double most_reset = 1.5e-3;
std::size_t z(int i) { return std::size_t(i); }

// End of the joints that connect the same two parts as joint `first`, at most `end`.
int end_of_bed(const Model& model, int first, int end) {
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

Debris::Debris(const Model& model, State& state, int threads) : model_(model), state_(state), sleep_(model, state), limit_(model, state) {
  looked_.resize(z(threads));
  fastest_.resize(z(threads));
  fastest_loose_.resize(z(threads));
  first_pair_.assign(z(threads) + 1, 0);
  first_pair_.back() = std::numeric_limits<int>::max();
  room_.resize(z(threads));
  if (state.debris.start.empty()) {
    state.debris.start.reserve(state.u.size());
    for (std::size_t b = 0; b < state.u.size(); ++b) state.debris.start.push_back(state.u[b]);
  }
  if (state.debris.u.empty()) {
    std::vector<double> thickness;
    each_contact_part(model, [&](int, const Polyhedron& part) { thickness.push_back(contact_shape(part).thickness); });
    state.debris.margin = suggested_margin(std::move(thickness));
  }
  list_involved();
}

void Debris::wake() {
  if (!blocks_.empty()) return;
  std::vector<std::vector<Polyhedron>> parts(z(model_.nblock));
  each_contact_part(model_, [&](int b, const Polyhedron& part) { parts[z(b)].push_back(part); });
  for (std::size_t i = 0; i < room_.size(); ++i) batch_.push_back(std::make_unique<Batch>());
  blocks_.resize(z(model_.nblock));
  const std::size_t groups = block_groups(model_.nblock);
  last_u_.resize(groups);
  for (std::size_t g = 0; g < groups; ++g) last_u_[g] = state_.u.data()[g];
  Parting& parting = state_.parting;
  if (parting.q.size() == 0) parting.q = state_.q;
  for (std::vector<double>* x : {&reach_, &spin_, &way_, &way_soon_}) x->assign(groups * lanes, 0.0);
  parting.spun.resize(groups * lanes, 0.0);
  rate_.assign(z(model_.nblock), 0.0);
  landing_.assign(z(model_.nblock), 0.0);
  state_.debris.contacts.resize(z(model_.nblock));
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
  place_all(true);
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

void Debris::set_axes(int b, const Mat3& axes) {
  axes_.resize(block_groups(model_.nblock));
  Axes& group = axes_[z(b / lanes)];
  for (int l = 0; l < lanes && !group.any; ++l)
    for (int i = 0; i < 3; ++i) group.row.x[4 * i][l] = 1;
  group.any = true;
  for (int i = 0; i < 9; ++i) group.row.x[i][b % lanes] = axes(i / 3, i % 3);
}

Mat3 Debris::axes_of(int b) const {
  Mat3 axes = Mat3::Identity();
  if (axes_.empty() || !axes_[z(b / lanes)].any) return axes;
  for (int i = 0; i < 9; ++i) axes(i / 3, i % 3) = axes_[z(b / lanes)].row.x[i][b % lanes];
  return axes;
}

Mat3 Debris::rotation(int b) const {
  const Mat3& turn = blocks_[z(b)].turn;
  return axes_.empty() || !axes_[z(b / lanes)].any ? turn : Mat3(turn * axes_of(b).transpose());
}

void Debris::mark(std::vector<Eight>& groups, int b) {
  if (groups.empty() || groups.back().group != b / lanes) groups.push_back({b / lanes, 0, {}});
  groups.back().which |= 1u << b % lanes;
  groups.back().is_in[b % lanes] = 1;
}

void Debris::place(Eight blocks, Fastest& fastest) {
  const std::size_t g = z(blocks.group), first = g * lanes;
  BlockLanes at{};
  at.u = state_.u.data()[g].x, at.q = state_.q.data()[g].x, at.v = state_.v.data()[g].x, at.w = state_.w.data()[g].x;
  at.last_u = last_u_[g].x, at.last_q = state_.parting.q.data()[g].x;
  at.reach = &reach_[first], at.spun = &state_.parting.spun[first], at.spin = &spin_[first];
  at.way = &way_[first], at.way_soon = &way_soon_[first];
  at.axes = !axes_.empty() && axes_[g].any ? axes_[g].row.x : nullptr;
  for (int l = 0; l < lanes; ++l) at.row[l] = (blocks.which >> l & 1u) != 0 ? blocks_[first + z(l)].u.data() : nullptr;
  pair_kernels().follow(at, blocks.which, look_ahead * 1.5 * std::max(state_.dt, state_.last_dt), fastest.speed);
}

// Updates the poses of all blocks; sleepers keep their pose unless `sleepers` is set.
void Debris::place_all(bool sleepers) {
  Fastest any;  // unused: `follow()` and `prepare()` find the greatest speed
  std::vector<Eight> all;
  for (int b = 0; b < model_.nblock; ++b)
    if (sleepers || !sleep_.asleep(b)) mark(all, b);
  for (const Eight& blocks : all) place(blocks, any);
}

// After a search nothing is known about the listed pairs.
void Debris::list_anew() {
  state_.parting.pair.clear();
  std::fill(state_.parting.spun.begin(), state_.parting.spun.end(), 0.0);
  list_involved();
}

void Debris::list_involved() {
  std::vector<std::uint8_t> in(state_.loose.begin(), state_.loose.end());
  for (const Pair& p : state_.debris.pair) in[z(p.a)] = in[z(p.b)] = 1;
  involved_.clear();
  unsorted_ = lanes_changed_ = true;
  for (int b = 0; b < model_.nblock; ++b)
    if (in[z(b)]) involved_.push_back(b);
  jointed_.clear();
  bed_.clear();
  waiting_.clear();
  edge_.clear();
  edges_.clear();
  if (!active()) return;
  wake();
  for (int j = 0; j < model_.njoint; ++j)
    if (state_.tier[z(j)] != Tier::open) jointed_.push_back(pair_key(model_.joint[z(j)].a, model_.joint[z(j)].b));
  find_beds();
  for (const Pair& p : state_.debris.pair) {
    waiting_.push_back({p.a, p.b});
    const EdgeAtRest edge = edge_of(p);
    edge_.push_back(edge.touches ? int(edges_.size()) : -1);
    if (edge.touches) edges_.push_back(edge);
  }
  state_.parting.pair.resize(waiting_.size());
}

void Debris::find_beds() {
  bed_.clear();
  for (const Pair& p : state_.debris.pair) bed_.push_back({p.bed ? bed_joint(p) : -1, p.counted_a, p.counted_b});
}

// First of the joints that a contact pair has replaced.
int Debris::bed_joint(const Pair& p) const {
  const auto at = std::lower_bound(pair_keys_.begin(), pair_keys_.end(), pair_key(p.a, p.b));
  int first = of_pair_[std::size_t(at - pair_keys_.begin())];
  while (model_.joint[z(first)].part_a != p.part_a || model_.joint[z(first)].part_b != p.part_b)
    first = end_of_bed(model_, first, model_.njoint);
  return first;
}

// Rates of a former joint: those of its joints, in the terms of a contact on the same faces (`stability()` of `contact.cpp`).
void Debris::count_bed(Pair& p) {
  const int first = bed_joint(p);
  p.counted_a = p.counted_b = 0;
  for (int j = first; j < end_of_bed(model_, first, model_.njoint); ++j) {
    const Joint& joint = model_.joint[z(j)];
    const double *k = joint.type->stiffness, turning = k[3] + k[4] + k[5];
    const auto rate = [&](int b, const Vec3& arm) {
      const ContactBlock& block = blocks_[z(b)];
      const Vec3 lever = arm.cross(joint.type->frame.col(2));
      const double across = std::max(k[0], k[1]);
      return (k[2] + across) * block.inverse_mass + k[2] * lever.dot(model_.inverse_inertia[z(b)] * lever) +
             (across * arm.squaredNorm() + turning) * block.inverse_inertia;
    };
    p.counted_a += rate(p.a, joint.arm_a);
    p.counted_b += rate(p.b, joint.arm_b);
  }
}

// True if the faces of a former joint have left the position in which they were joined.
bool Debris::displaced(const Pair& p, int j) const {
  const Joint& joint = model_.joint[z(j)];
  const Mat3 a = rotation(p.a), b = rotation(p.b);
  const Vec3 moved = (blocks_[z(p.b)].u - blocks_[z(p.a)].u) + (b * joint.arm_b - joint.arm_b) - (a * joint.arm_a - joint.arm_a);
  if (!(moved.norm() < parted * 2 * std::min(joint.type->half_s, joint.type->half_t))) return true;
  return !p.touching && !((a - b).norm() < parted * std::sqrt(2.0));  // a rocking block rotates and returns to its place
}

// A former joint has the stiffness of a mortar layer between matching faces. Faces that slide on each other match no more; their stiffness
// falls in small steps to that of debris, if that is lower. Otherwise blocks that drag each other along would limit the step of a collapse.
void Debris::find_softening(double most) {
  for (std::size_t i = 0; i < bed_.size(); ++i) {
    Pair& p = state_.debris.pair[i];
    if (p.bed != 1 || !p.touching || sleep_.asleep(p.a) || sleep_.asleep(p.b) || !displaced(p, bed_[i].joint)) continue;
    const PairLaw to = law(p.a, p.b);
    if (to.kn >= p.law.kn || to.ks >= p.law.ks) continue;
    p.bed = Pair::softening;
  }
  soften_beds(most);
}

// Faces pressed by a force N store N^2 / (2 kn A). Softer faces at the same pose store less; the difference is lost. The total loss down to
// the stiffness of debris is about the energy stored at the end. If that exceeds `most` (J), the pair waits until it is pressed less.
void Debris::soften_beds(double most) {
  constexpr double at_once = 0.992;  // of the stiffness, in each call
  for (std::size_t i = 0; i < bed_.size(); ++i) {
    Pair& p = state_.debris.pair[i];
    if (p.bed != Pair::softening || !p.touching || sleep_.asleep(p.a) || sleep_.asleep(p.b)) continue;
    ContactBlock a = blocks_[z(p.a)], b = blocks_[z(p.b)];  // zero velocity: springs only, dashpots stay as they are
    a.v = a.w = b.v = b.w = Vec3::Zero();
    PairResult now;
    Pair copy = p;
    if (!pair_force(copy, shapes_, a, b, settings_, 0.0, true, room_.front(), now)) continue;
    const PairLaw to = law(p.a, p.b);
    if ((now.elastic + now.tangential) * p.law.kn / to.kn > most) continue;
    const double kn = std::max(to.kn, at_once * p.law.kn) / p.law.kn, ks = std::max(to.ks, at_once * p.law.ks) / p.law.ks;
    p.law.kn *= kn;
    p.law.ks *= ks;
    p.tangential *= ks;
    released_ += (1 - kn) * now.elastic + (1 - ks) * now.tangential;
    // The lost part of the force still does half a step of work on the way to the next pose, as friction does.
    p.friction.force += (1 - kn) * (now.wrench.force - copy.friction.force);
    p.friction.moment_a += (1 - kn) * (now.wrench.moment_a - copy.friction.moment_a);
    p.friction.moment_b += (1 - kn) * (now.wrench.moment_b - copy.friction.moment_b);
    lanes_changed_ = true;
    if (p.law.kn > to.kn || p.law.ks > to.ks) continue;
    p.bed = 0;
    p.counted_a = p.counted_b = 0;
    bed_[i] = {};
  }
}

// Faces that have separated and moved are no longer a former joint: their blocks next touch with the stiffness of debris. Separated faces
// store nothing, so the change costs no energy.
void Debris::part_beds() {
  for (std::size_t i = 0; i < bed_.size(); ++i) {
    Pair& p = state_.debris.pair[i];
    if (!p.bed || p.touching || !displaced(p, bed_[i].joint)) continue;
    p.bed = 0;
    p.counted_a = p.counted_b = 0;
    p.law = law(p.a, p.b);
    p.impact = impact_factor(p.law.restitution);
    bed_[i] = {};
  }
}

PairLaw Debris::law(int a, int b) const {
  return pair_law(model_.materials[z(model_.material[z(a)])], model_.materials[z(model_.material[z(b)])]);
}

void Debris::open(int j) {
  state_.tier[z(j)] = Tier::open;
  state_.loose[z(model_.joint[z(j)].a)] = model_.kind[z(model_.joint[z(j)].a)] != Kind::fixed;
  state_.loose[z(model_.joint[z(j)].b)] = model_.kind[z(model_.joint[z(j)].b)] != Kind::fixed;
}

std::vector<int> Debris::hand_over_joints(Cracked& cracked) {
  std::vector<int> opened;
  if (cracked.none_spent()) return opened;
  int first = 0;
  while (first < model_.njoint && !(state_.tier[z(first)] == Tier::cracked && cracked.spent(first))) ++first;
  if (first == model_.njoint) return opened;
  for (int j = 0; j < model_.njoint;) {
    // Joints of one pair of blocks are adjacent. They are released together, once none is intact and one is beyond its range.
    int end = j + 1;
    while (end < model_.njoint && model_.joint[z(end)].a == model_.joint[z(j)].a && model_.joint[z(end)].b == model_.joint[z(j)].b) ++end;
    bool any = false, holds = false;
    for (int k = j; k < end; ++k) {
      any = any || (state_.tier[z(k)] == Tier::cracked && cracked.spent(k));
      holds = holds || state_.tier[z(k)] == Tier::intact;
    }
    if (any && !holds)
      for (int k = j; k < end; ++k)
        if (state_.tier[z(k)] == Tier::cracked) opened.push_back(k);
    j = end;
  }
  if (opened.empty()) return opened;
  cracked.store();
  for (const int j : opened) open(j);
  wake();
  list_involved();
  // All poses, because the last update depends on when this run was started or resumed.
  place_all(true);
  state_.debris.valid = false;
  std::vector<int> fresh;
  released_ += search(
      state_.debris, shapes_, blocks_, state_.loose, jointed_, [this](int a, int b) { return law(a, b); }, {}, &fresh);
  for (std::size_t i = 0; i < opened.size();) {
    const int bed_end = end_of_bed(model_, opened[i], model_.njoint);
    std::size_t end = i + 1;
    while (end < opened.size() && opened[end] < bed_end) ++end;
    hand_over_pair(&opened[i], &opened[i] + (end - i));
    i = end;
  }
  std::erase_if(fresh, [this](int i) { return state_.debris.pair[z(i)].bed != 0; });
  released_ -= start_fresh(fresh);
  list_anew();
  return opened;
}

// Releases the joints [first, last) of one pair of parts to its contact, which takes over their wrench and stored energy.
void Debris::hand_over_pair(const int* first, const int* last) {
  const Joint& one = model_.joint[z(*first)];
  Vec6 wrench = Vec6::Zero();  // on b
  double stored = 0;
  for (const int* j = first; j < last; ++j) {
    wrench += Eigen::Map<const Vec6>(&state_.wrench[z(model_.row_b[z(*j)]) * 8]);
    stored += state_.memory[z(*j)].elastic;
    state_.memory[z(*j)] = JointMemory{};
  }
  const double most = most_reset * state_.energy.reference - std::fabs(state_.energy.reset + released_);
  const PointLaw& joint_law = model_.laws[z(one.type->law)];
  const int at = find_pair(state_.debris, one.a, one.part_a, one.b, one.part_b);
  if (at < 0) return note_hand_over(*first, stored);
  Pair& pair = state_.debris.pair[z(at)];
  pair.bed = 1;
  count_bed(pair);
  pair.law.kn = joint_law.kn;
  pair.law.ks = joint_law.ks;
  pair.law.mu = joint_law.mu_residual;
  lanes_changed_ = true;
  note_hand_over(*first, stored - hand_over(pair, shapes_, blocks_[z(pair.a)], blocks_[z(pair.b)], wrench, stored, most, room_.front()));
}

void Debris::note_hand_over(int joint, double energy) {
  released_ += energy;
  handed_.push_back({joint, energy});
}

// Two blocks of one structure without a joint between them are no contact pair; they may overlap when their pair is first listed. Their
// contact then starts like the release of a joint without force. Returns the energy stored in the springs (J).
double Debris::start_fresh(const std::vector<int>& fresh) {
  double stored = 0;
  for (const int i : fresh) {
    Pair& p = state_.debris.pair[z(i)];
    const ContactBlock &a = blocks_[z(p.a)], &b = blocks_[z(p.b)];
    if (const EdgeAtRest edge = edge_of(p); edge.touches && idle_way(edge, view_of(p, shapes_, a, b).pose) > 0) continue;
    stored += hand_over(p, shapes_, a, b, Vec6::Zero(), 0, 0, room_.front());
  }
  return stored;
}

void Debris::book_hand_over() { state_.energy.reset += std::exchange(released_, 0.0); }

void Debris::loosen() {
  bool changed = false;
  const double far = 0.5 * state_.debris.margin;
  for (int b = 0; b < model_.nblock; ++b) {
    if (model_.kind[z(b)] == Kind::fixed || state_.loose[z(b)]) continue;
    if (state_.grounded[z(b)] && (state_.u[z(b)] - state_.debris.start[z(b)]).squaredNorm() < far * far) continue;
    if (model_.kind[z(b)] == Kind::driven && state_.grounded[z(b)] && state_.u[z(b)].norm() < far) continue;
    state_.loose[z(b)] = 1;
    changed = true;
  }
  if (!changed) return;
  state_.debris.valid = false;
  list_involved();
}

}  // namespace erbs
