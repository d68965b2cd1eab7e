#include "engine/joints/cracked/cracked.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "engine/base/count.h"
#include "engine/model/joint_packs.h"

namespace erbs {
namespace {

// True for joints compressed by gravity. Bed joints are closed and stick; head joints are open and slide freely. A pack of one kind seldom
// needs the arithmetic of the other.
bool pressed_by_gravity(const Model& model, const Joint& joint) {
  const Vec3 normal = joint.type->frame.col(2), down = model.gravity.norm() > 0 ? Vec3(model.gravity.normalized()) : Vec3::UnitZ();
  return std::fabs(normal.dot(down)) > 0.5;
}

// Numbers of a joint that only its law knows.
int own_numbers(const PointLaw& law) {
  int numbers = 0;
  with_face(law, [&](auto face) {
    static_assert(std::size_t(decltype(face)::numbers) * sizeof(double) <= sizeof(JointMemory::own), "JointMemory::own needs more room");
    numbers = decltype(face)::numbers;
  });
  return numbers;
}

// Whether each joint has lent to a point, for the kernel of joints without a bond.
void find_lent(CrackedPack& lane, int points) {
  std::fill_n(lane.mean_slip.lent, pack_size, 0.0);
  for (int i = 0; i < points; ++i)
    for (int l = 0; l < pack_size; ++l) lane.mean_slip.lent[l] = std::max(lane.mean_slip.lent[l], lane.slip()[i].lent[l]);
}

double total(const double* x) { return ((x[0] + x[1]) + (x[2] + x[3])) + ((x[4] + x[5]) + (x[6] + x[7])); }

}  // namespace

void Cracked::Group::update_debonded(const PointLaw& of) {
  debonded = !of.has_bond() || std::all_of(bond.begin(), bond.end(), [](const BondPack& b) {
    return std::all_of(b.damage, b.damage + pack_size, [](double damage) { return damage >= 1; });
  });
}

Cracked::Cracked(const Model& model, State& state) : model_(model), state_(state) {
  for (const auto& type : model.joint_types) grid_[type.get()] = grid_of(*type);
  const int intact = intact_packs(model);
  // Groups of a stopped run: each joint returns to its lane, so that sums continue in the same order.
  for (int k = 0; k < int(state.joints.pack.size()); ++k) {
    group_.push_back({});
    group_.back().law = -1, group_.back().pack = k;
    std::fill_n(group_.back().joint, pack_size, -1);
  }
  std::vector<int> held;  // in the order of their lanes, in which a step passes through memory
  for (int j = 0; j < model.njoint; ++j)
    if (state.joints.slot[z(j)] >= intact * pack_size) held.push_back(j);
  std::sort(held.begin(), held.end(), [&](int a, int b) { return state.joints.slot[z(a)] < state.joints.slot[z(b)]; });
  for (const int j : held) {
    const int at = state.joints.slot[z(j)] - intact * pack_size;
    Group& group = group_[z(at / pack_size)];
    const Joint& joint = model.joint[z(j)];
    if (group.law < 0) set_empty(group, joint);
    fill(group, at % pack_size, j);
    set_ends(j);
  }
  if (model.analysis.kernel == "reference" || model.analysis.solver == "sequential") return;
  std::vector<int> joints;
  for (int j = 0; j < model.njoint; ++j)
    if (state.joints.stage[z(j)] == JointStage::cracked && state.joints.slot[z(j)] < intact * pack_size) joints.push_back(j);
  take_all(joints);
}

void Cracked::take_all(std::vector<int>& joints) {
  const auto key = [&](int j) { return std::tuple(model_.joint[z(j)].type->first_cell, j); };
  std::sort(joints.begin(), joints.end(), [&](int a, int b) { return key(a) < key(b); });
  for (const int j : joints) put(j);
}

void Cracked::clear(Group& group, int l) {
  group.joint[l] = -1;
  group.crushed[l] = nullptr;
  group.bearing[l] = nullptr;
  CrackedPack& lane = memory_of(group);
  lane.viscous[l] = lane.hop_time[l] = lane.hop_loan[l] = 0;
  lane.share_n[l] = lane.share_s[l] = 1;
  for (int i = 0; i < 6; ++i) lane.gap[i][l] = lane.resultant[i][l] = lane.drag[i][l] = 0;
  lane.stored[l] = 0;
  lane.least_damage[l] = 1;
  for (int i = 0; i < group.points; ++i)
    lane.slip()[i].s[l] = lane.slip()[i].t[l] = lane.slip()[i].mean_pressure[l] = lane.slip()[i].lent[l] = 0;
  for (int i = 0; i < group.own_numbers; ++i) lane.own(group.points)[i][l] = 0;
  MeanSlipPack& mean_slip = lane.mean_slip;
  for (auto* x : {mean_slip.s, mean_slip.t, mean_slip.rotation, mean_slip.apart, mean_slip.stored, mean_slip.outdated, mean_slip.lent})
    x[l] = 0;
  for (BondPack& p : group.bond) p.secant[l] = p.kappa[l] = 0, p.damage[l] = 1;  // no bond
  lane.tension_outdated = 1;
  group.update_debonded(model_.laws[z(group.law)]);
}

void Cracked::fill(Group& group, int l, int j) {
  const Joint& joint = model_.joint[z(j)];
  const JointMemory& memory = state_.joints.memory[z(j)];
  add_shape(group, l, *joint.type);
  CrackedPack& lane = memory_of(group);
  group.joint[l] = j;
  lane.viscous[l] = joint.viscous_cracked;
  lane.hop_time[l] = joint.hop.time, lane.hop_loan[l] = joint.hop.loan;
  set_share(lane, l, j);
  group.used |= 1U << l;
  group.maybe_out_of_range = true;
  const PointLaw& law = model_.laws[z(joint.type->law)];
  if (law.crushes()) {
    const CompressionFace face = compression_face(model_, joint, law.kn);
    group.crushed[l] = &state_.joints.crushed[z(j)], group.bearing[l] = face.points > 0 ? face.point : face.corner;
  }
  for (int i = 0; i < 6; ++i) lane.gap[i][l] = memory.gap[i];
  lane.least_damage[l] = may_release(joint, law, memory) ? 1 : 0;
  for (int i = 0; i < group.own_numbers; ++i) lane.own(group.points)[i][l] = memory.own[i];
  lane.mean_slip.outdated[l] = 1, lane.mean_slip.lent[l] = 0;
  lane.tension_outdated = 1;
  if (model_.dashpots_cracked)
    for (int i = 0; i < 6; ++i) lane.drag[i][l] = state_.joints.viscous[6 * z(j) + z(i)];
  for (int i = 0; i < joint.type->points; ++i) {
    const PointHistory& h = state_.joints.history[z(joint.first_point + i)];
    lane.slip()[i].s[l] = h.slip_s, lane.slip()[i].t[l] = h.slip_t, lane.slip()[i].mean_pressure[l] = h.mean_pressure;
    lane.slip()[i].lent[l] = h.lent, lane.mean_slip.lent[l] = std::max(lane.mean_slip.lent[l], h.lent);
    BondPack& b = group.bond[z(i)];
    b.damage[l] = h.damage, b.secant[l] = h.secant, b.kappa[l] = h.kappa;
    if (law.has_bond()) lane.least_damage[l] = std::min(lane.least_damage[l], h.damage);
  }
  group.update_debonded(law);
}

// Stiffness of joint j, and what depends on it.
void Cracked::set_share(CrackedPack& lane, int l, int j) const {
  const StiffnessShare share = stiffness_share(state_, j);
  const JointMemory& memory = state_.joints.memory[z(j)];
  lane.share_n[l] = share.n, lane.share_s[l] = share.s;
  lane.stored[l] = memory.elastic;
  for (int i = 0; i < 6; ++i) lane.resultant[i][l] = memory.resultant[i];
}

void Cracked::set_share(int j) {
  const int at = lane_of(j);
  if (at >= 0) set_share(memory_of(group_[z(at / pack_size)]), at % pack_size, j);
}

void Cracked::set_empty(Group& group, const Joint& joint) {
  Group fresh{};
  fresh.law = joint.type->law, fresh.points = joint.type->points, fresh.corners = joint.type->corners, fresh.pack = group.pack,
  fresh.pressed_by_gravity = pressed_by_gravity(model_, joint);
  fresh.bond.resize(z(fresh.points));
  fresh.own_numbers = own_numbers(model_.laws[z(fresh.law)]);
  fresh.at = group.at, fresh.room = group.room;
  const std::size_t lines = (sizeof(CrackedPack) + z(fresh.points) * sizeof(SlipPack)) / sizeof(Line) + z(fresh.own_numbers);
  if (fresh.room < lines) {
    fresh.at = memory_.size(), fresh.room = lines;
    memory_.resize(memory_.size() + lines);
    new (&memory_of(fresh)) CrackedPack;
    new (memory_of(fresh).slip()) SlipPack[z(fresh.points)];
  }
  group = std::move(fresh);
  for (int l = 0; l < pack_size; ++l) clear(group, l), copy_ends(group, l);
}

bool Cracked::fits(const Group& group, const Joint& joint) const {
  if (group.empty()) return true;
  if (group.law != joint.type->law || group.points != joint.type->points || group.corners != joint.type->corners ||
      group.pressed_by_gravity != pressed_by_gravity(model_, joint))
    return false;
  if (group.type == joint.type) return true;
  if (group.shapes->tension_loop.empty() == joint.type->inset) return false;
  const CellGrid& grid = grid_.at(joint.type);
  if (group.shapes->rectangles != grid.rectangle || group.shapes->line.size() != z(grid.lines > 0 ? grid.lines + 1 : 0)) return false;
  for (int i = 0; i < joint.type->points; ++i)
    if (group.shapes->first[z(i + 1)] - group.shapes->first[z(i)] != model_.cell[z(joint.type->first_cell + i)].corners) return false;
  return true;
}

int Cracked::lane_of(int j) const { return state_.joints.slot[z(j)] - intact_packs(model_) * pack_size; }

int Cracked::find_lane(const Joint& joint, bool debonded) {
  int other = -1;
  for (int g = 0; g < groups(); ++g) {
    const Group& group = group_[z(g)];
    if (!group.empty() && group.debonded != debonded) continue;
    const int* free = std::find(group.joint, group.joint + pack_size, -1);
    if (free == group.joint + pack_size || (other >= 0 && (group.empty() || group.type != joint.type)) || !fits(group, joint)) continue;
    other = g * pack_size + int(free - group.joint);
    if (!group.empty() && group.type == joint.type) return other;
  }
  if (other >= 0) return other;
  group_.push_back({});
  group_.back().pack = add_empty_pack(model_, state_);
  set_empty(group_.back(), joint);
  return (groups() - 1) * pack_size;
}

void Cracked::put(int j) {
  const Joint& joint = model_.joint[z(j)];
  const auto first = state_.joints.history.begin() + joint.first_point;
  const bool debonded = !model_.laws[z(joint.type->law)].has_bond() ||
                        std::all_of(first, first + joint.type->points, [](const PointHistory& h) { return h.damage >= 1; });
  put(j, find_lane(joint, debonded));
}

void Cracked::put(int j, int at) {
  const Joint& joint = model_.joint[z(j)];
  Group& group = group_[z(at / pack_size)];
  if (group.empty()) set_empty(group, joint);
  fill(group, at % pack_size, j);
  state_.joints.slot[z(j)] = (intact_packs(model_) + group.pack) * pack_size + at % pack_size;
  set_ends(j);
}

void Cracked::set_ends(int j) {
  const Joint& joint = model_.joint[z(j)];
  const int at = lane_of(j);
  JointPack& pack = state_.joints.pack[z(at / pack_size)];
  set_constants(model_, j, pack, at % pack_size);
  for (int i = 0; i < 3; ++i) pack.arm_a[i][at % pack_size] = joint.arm_a[i], pack.arm_b[i][at % pack_size] = joint.arm_b[i];
  copy_ends(group_[z(at / pack_size)], at % pack_size);
  if (pose_.empty()) {
    pose_.assign(block_groups(model_.nblock) * 8 * pack_size, 0.0);
    copy_pose(model_.nblock);  // for lanes without a joint
  }
  copy_pose(joint.a);
  copy_pose(joint.b);
}

void Cracked::copy_ends(const Group& group, int l) {
  const JointPack& from = state_.joints.pack[z(group.pack)];
  CrackedPack& to = memory_of(group);
  to.a[l] = from.a[l], to.b[l] = from.b[l], to.wrench_row_a[l] = from.wrench_row_a[l], to.wrench_row_b[l] = from.wrench_row_b[l];
  if (group.joint[l] < 0) to.wrench_row_a[l] = to.wrench_row_b[l] = spare_row_of_cracked(model_, int(&group - group_.data()));
  for (int i = 0; i < 3; ++i) to.arm_a[i][l] = from.arm_a[i][l], to.arm_b[i][l] = from.arm_b[i][l];
}

void Cracked::copy_pose(int b) {
  if (pose_.empty()) return;
  const Vec3 u = state_.pose.u[z(b)];
  const Quat q = state_.pose.q[z(b)];
  const double row[8] = {u.x(), u.y(), u.z(), q.x(), q.y(), q.z(), q.w(), 0};
  std::copy_n(row, 8, &pose_[8 * z(b)]);
}

void Cracked::take(int j) { put(j); }

// Restores the common type of a group after a joint has left. The lane of the next joint must not depend on joints that have left, since a
// resumed run does not know them.
void Cracked::find_type(Group& group) {
  if (group.type != nullptr || group.empty()) return;
  const JointType* type = nullptr;
  for (const int j : group.joint) {
    if (j < 0) continue;
    if (type != nullptr && model_.joint[z(j)].type != type) return;
    type = model_.joint[z(j)].type;
  }
  group.type = type;
  group.shapes = shared_shapes(*type);
}

void Cracked::vacate(int at) {
  Group& group = group_[z(at / pack_size)];
  group.used &= ~(1U << at % pack_size);
  clear(group, at % pack_size);
  find_type(group);
  clear_lane(model_, state_.joints.pack[z(at / pack_size)], at % pack_size);
  copy_ends(group, at % pack_size);
}

void Cracked::drop(int j) {
  const int at = lane_of(j);
  if (at >= 0) vacate(at);
  state_.joints.slot[z(j)] = -1;
  state_.joints.memory[z(j)] = JointMemory{};
  if (model_.dashpots_cracked) std::fill_n(&state_.joints.viscous[6 * z(j)], 6, 0.0);
  for (const int row : {model_.wrench_row_a[z(j)], model_.wrench_row_b[z(j)]}) std::fill_n(&state_.cache.wrench[z(row) * 8], 8, 0.0);
}

void Cracked::forces(int first, int last, bool sample, double budget, JointSums& sums, const StepKernels& kernels) {
  const double* poses = pose_.data();
  double* wrench_rows = state_.cache.wrench.data();
  if (sample) sums.energy.elastic = 0;
  const bool damped = model_.dashpots_cracked && state_.time.last_dt > 0;
  const double per_step = damped ? 1 / state_.time.last_dt : 0;
  CrackedSums done{};
  const InterlockStep interlock = interlock_step(model_, state_);
  for (int g = first; g < last; ++g) {
    Group& group = group_[z(g)];
    if (group.empty()) continue;
    CrackedPack& lane = memory_of(group);
    const Shapes& shapes = *group.shapes;
    const PointLaw& law = model_.laws[z(group.law)];
    const CrackedShape shape{group.corners,
                             group.points,
                             group.used,
                             double(g),
                             &shapes.face,
                             shapes.overlap_corner.data(),
                             shapes.point.data(),
                             shapes.cell.data(),
                             shapes.first.data(),
                             shapes.cell_loop.data(),
                             per_step,
                             shapes.tension_loop.empty() ? shapes.cell_loop.data() : shapes.tension_loop.data(),
                             group.crushed,
                             group.bearing,
                             budget,
                             law.interlock ? interlock : InterlockStep{},
                             shapes.rectangles,
                             std::max(0, int(shapes.line.size()) - 1),
                             shapes.line.data()};
    if (group.debonded) {
      group.maybe_out_of_range = kernels.friction[law.type](law, shape, lane, poses, wrench_rows, done);
    } else {
      group.maybe_out_of_range = kernels.respond[law.type](law, shape, group.bond.data(), lane, poses, wrench_rows, done);
      std::fill_n(lane.mean_slip.outdated, pack_size, 1.0);
      group.damage_changed = true;
      group.debonded = std::all_of(lane.least_damage, lane.least_damage + pack_size, [](double damage) { return damage >= 1; });
      if (group.debonded) find_lent(lane, group.points);
    }
    if (sample) sums.energy.elastic += total(lane.stored);
  }
  sums.energy.friction += total(done.friction);
  sums.energy.fracture += total(done.fracture);
  sums.energy.crushing += total(done.crushing);
  sums.energy.damping += total(done.damping);
  for (int l = 0; l < pack_size; ++l)
    if (done.error[l] > sums.largest_error)
      sums.largest_error = done.error[l], sums.worst_joint = group_[std::size_t(done.worst[l])].joint[l];
  sums.event_rate = std::max(sums.event_rate, *std::max_element(done.event_rate, done.event_rate + pack_size));
}

void Cracked::store() {
  for (Group& group : group_) {
    if (group.empty()) continue;
    const bool damage_changed = std::exchange(group.damage_changed, false);
    for (int l = 0; l < pack_size; ++l)
      if (group.joint[l] >= 0) store(group, l, damage_changed);
  }
}

void Cracked::store(int j) {
  const int at = lane_of(j);
  if (at >= 0) store(group_[z(at / pack_size)], at % pack_size, true);
}

void Cracked::store(const Group& group, int l, bool damage_changed) {
  const CrackedPack& lane = memory_of(group);
  const int j = group.joint[l];
  JointMemory& memory = state_.joints.memory[z(j)];
  for (int i = 0; i < 6; ++i) memory.gap[i] = lane.gap[i][l], memory.resultant[i] = lane.resultant[i][l];
  memory.elastic = lane.stored[l];
  for (int i = 0; i < group.own_numbers; ++i) memory.own[i] = lane.own(group.points)[i][l];
  if (model_.dashpots_cracked)
    for (int i = 0; i < 6; ++i) state_.joints.viscous[6 * z(j) + z(i)] = lane.drag[i][l];
  PointHistory* h = &state_.joints.history[z(model_.joint[z(j)].first_point)];
  for (int i = 0; i < group.points; ++i) {
    h[i].slip_s = lane.slip()[i].s[l], h[i].slip_t = lane.slip()[i].t[l], h[i].mean_pressure = lane.slip()[i].mean_pressure[l];
    h[i].lent = lane.slip()[i].lent[l];
    if (!damage_changed) continue;
    const BondPack& b = group.bond[z(i)];
    h[i].damage = b.damage[l], h[i].secant = b.secant[l], h[i].kappa = b.kappa[l];
  }
}

bool Cracked::debonded(int j) const {
  const int at = lane_of(j);
  return at >= 0 && memory_of(group_[z(at / pack_size)]).least_damage[at % pack_size] >= 1;
}

bool Cracked::none_ready_for_contact() const {
  return owner_computes(model_) &&
         std::none_of(group_.begin(), group_.end(), [](const Group& group) { return group.maybe_out_of_range && !group.empty(); });
}

bool Cracked::ready_for_contact(int j) const {
  const int at = lane_of(j);
  if (at < 0)
    return !owner_computes(model_) &&
           joint_ready_for_contact(model_, state_, j);  // a joint that cracked in this step enters a group after it
  const Group& group = group_[z(at / pack_size)];
  if (!group.maybe_out_of_range) return false;
  const CrackedPack& lane = memory_of(group);
  if (lane.least_damage[at % pack_size] < 1) return false;
  double gap[6];
  for (int i = 0; i < 6; ++i) gap[i] = lane.gap[i][at % pack_size];
  return out_of_range(model_, model_.joint[z(j)], gap);
}

}  // namespace erbs
