#include "engine/solve/cracked.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "engine/model/batches.h"

namespace erbs {
namespace {

std::size_t z(int i) { return std::size_t(i); }

// True for joints compressed by gravity. Bed joints are closed and stick; head joints are open and slide freely. A pack of one kind seldom
// needs the arithmetic of the other.
bool bears(const Model& model, const Joint& joint) {
  const Vec3 normal = joint.type->frame.col(2), down = model.gravity.norm() > 0 ? Vec3(model.gravity.normalized()) : Vec3::UnitZ();
  return std::fabs(normal.dot(down)) > 0.5;
}

double total(const double* x) { return ((x[0] + x[1]) + (x[2] + x[3])) + ((x[4] + x[5]) + (x[6] + x[7])); }

}  // namespace

void Cracked::Group::look_for_bonds(const PointLaw& of) {
  bare = of.dry || std::all_of(bond.begin(), bond.end(), [](const BondLanes& b) {
           return std::all_of(b.damage, b.damage + lanes, [](double damage) { return damage >= 1; });
         });
}

Cracked::Cracked(const Model& model, State& state) : model_(model), state_(state) {
  const int sound = sound_batches(model);
  // Groups of a stopped run: each joint returns to its lane, so that sums continue in the same order.
  for (int k = 0; k < int(state.batch.size()); ++k) {
    group_.push_back({});
    group_.back().law = -1, group_.back().batch = k;
    std::fill_n(group_.back().joint, lanes, -1);
  }
  std::vector<int> held;  // in the order of their lanes, in which a step passes through memory
  for (int j = 0; j < model.njoint; ++j)
    if (state.place[z(j)] >= sound * lanes) held.push_back(j);
  std::sort(held.begin(), held.end(), [&](int a, int b) { return state.place[z(a)] < state.place[z(b)]; });
  for (const int j : held) {
    const int at = state.place[z(j)] - sound * lanes;
    Group& group = group_[z(at / lanes)];
    const Joint& joint = model.joint[z(j)];
    if (group.law < 0) set_empty(group, joint);
    fill(group, at % lanes, j);
    set_ends(j);
  }
  if (model.analysis.kernel == "reference" || model.analysis.solver == "sequential") return;
  std::vector<int> joints;
  for (int j = 0; j < model.njoint; ++j)
    if (state.tier[z(j)] == Tier::cracked && state.place[z(j)] < sound * lanes) joints.push_back(j);
  take_all(joints);
}

void Cracked::take_all(std::vector<int>& joints) {
  const auto key = [&](int j) { return std::tuple(model_.joint[z(j)].type->first_place, j); };
  std::sort(joints.begin(), joints.end(), [&](int a, int b) { return key(a) < key(b); });
  for (const int j : joints) put(j);
}

void Cracked::clear(Group& group, int l) {
  group.joint[l] = -1;
  group.crushed[l] = nullptr;
  group.face_corner[l] = nullptr;
  CrackedLanes& lane = memory_of(group);
  lane.viscous[l] = 0;
  for (int i = 0; i < 6; ++i) lane.q[i][l] = lane.f[i][l] = lane.drag[i][l] = 0;
  lane.stored[l] = 0;
  lane.least_damage[l] = 1;
  for (int i = 0; i < group.points; ++i) lane.slip()[i].s[l] = lane.slip()[i].t[l] = lane.slip()[i].bearing[l] = 0;
  CommonLanes& common = lane.common;
  for (auto* x : {common.s, common.t, common.turn, common.apart, common.stored, common.stale}) x[l] = 0;
  for (BondLanes& p : group.bond) p.secant[l] = p.reach[l] = 0, p.damage[l] = 1;  // no bond
  group.look_for_bonds(model_.laws[z(group.law)]);
}

// Writes the shape of one type to lane l of `shapes`, which has the same number of points and corners.
void Cracked::set_shape(Shapes& shapes, int l, const JointType& type) const {
  for (int i = 0; i < type.corners; ++i) {
    const auto& c = model_.corner[z(type.first_corner + i)];
    shapes.corner[z(i)].s[l] = c.x(), shapes.corner[z(i)].t[l] = c.y();
  }
  const Quat frame(type.frame);
  for (int i = 0; i < 4; ++i) shapes.face.frame[i][l] = frame.coeffs()[i];
  for (int i = 0; i < 6; ++i) shapes.face.stiffness[i][l] = type.stiffness[i];
  shapes.face.half_s[l] = type.half_s, shapes.face.half_t[l] = type.half_t, shapes.face.radius[l] = type.radius;
  shapes.face.bend_s[l] = type.face[0], shapes.face.bend_t[l] = type.face[1], shapes.face.twist[l] = type.face[2];
  const int first = model_.cell[z(type.first_place)].first;
  for (int i = 0; i < int(shapes.loop.size()); ++i) {
    const auto &c = model_.cell_corner[z(first + i)], &w = model_.cell_watch[z(first + i)];
    shapes.loop[z(i)].s[l] = c.x(), shapes.loop[z(i)].t[l] = c.y();
    if (!shapes.watch.empty()) shapes.watch[z(i)].s[l] = w.x(), shapes.watch[z(i)].t[l] = w.y();
  }
  for (int i = 0; i < type.points; ++i) {
    const Point& from = model_.point[z(type.first_place + i)];
    const Cell& cell = model_.cell[z(type.first_place + i)];
    CellLanes& k = shapes.cell[z(i)];
    k.s[l] = cell.s, k.t[l] = cell.t, k.ss[l] = cell.ss, k.st[l] = cell.st, k.tt[l] = cell.tt;
    SpotLanes& p = shapes.spot[z(i)];
    p.s[l] = from.s, p.t[l] = from.t, p.weight[l] = from.weight;
  }
}

std::shared_ptr<Cracked::Shapes> Cracked::shared_shapes(const JointType& type) {
  std::shared_ptr<Shapes>& shared = of_type_[&type];
  if (!shared) {
    shared = std::make_shared<Shapes>();
    shared->corner.resize(z(type.corners));
    shared->spot.resize(z(type.points));
    shared->cell.resize(z(type.points));
    shared->first.push_back(0);
    for (int i = type.first_place; i < type.first_place + type.points; ++i)
      shared->first.push_back(shared->first.back() + model_.cell[z(i)].corners);
    shared->loop.resize(z(shared->first.back()));
    if (type.inset) shared->watch.resize(shared->loop.size());
    for (int k = 0; k < lanes; ++k) set_shape(*shared, k, type);
  }
  return shared;
}

// Lanes without a joint may have any shape: they neither move nor transmit a force.
void Cracked::add_shape(Group& group, int l, const JointType& type) {
  if (group.empty()) {
    group.type = &type;
    group.shapes = shared_shapes(type);
  } else if (group.type != &type) {
    if (group.type != nullptr) group.shapes = std::make_shared<Shapes>(*group.shapes);
    group.type = nullptr;
    set_shape(*group.shapes, l, type);
  }
}

void Cracked::fill(Group& group, int l, int j) {
  const Joint& joint = model_.joint[z(j)];
  const JointMemory& memory = state_.memory[z(j)];
  add_shape(group, l, *joint.type);
  CrackedLanes& lane = memory_of(group);
  group.joint[l] = j;
  lane.viscous[l] = joint.viscous_cracked;
  group.used |= 1U << l;
  group.beyond = true;
  if (model_.laws[z(joint.type->law)].fc > 0)
    group.crushed[l] = &state_.crushed[z(j)], group.face_corner[l] = model_.corner[z(joint.type->first_corner)].data();
  for (int i = 0; i < 6; ++i) lane.q[i][l] = memory.q[i], lane.f[i][l] = memory.f[i];
  lane.stored[l] = memory.elastic;
  lane.least_damage[l] = 1;
  lane.common.stale[l] = 1;
  if (model_.dashpots_cracked)
    for (int i = 0; i < 6; ++i) lane.drag[i][l] = state_.viscous[6 * z(j) + z(i)];
  for (int i = 0; i < joint.type->points; ++i) {
    const PointHistory& h = state_.history[z(joint.first_point + i)];
    lane.slip()[i].s[l] = h.slip_s, lane.slip()[i].t[l] = h.slip_t, lane.slip()[i].bearing[l] = h.bearing;
    BondLanes& b = group.bond[z(i)];
    b.damage[l] = h.damage, b.secant[l] = h.secant, b.reach[l] = h.reach;
    if (!model_.laws[z(joint.type->law)].dry) lane.least_damage[l] = std::min(lane.least_damage[l], h.damage);
  }
  group.look_for_bonds(model_.laws[z(joint.type->law)]);
}

void Cracked::set_empty(Group& group, const Joint& joint) {
  Group fresh{};
  fresh.law = joint.type->law, fresh.points = joint.type->points, fresh.corners = joint.type->corners, fresh.batch = group.batch,
  fresh.bears = bears(model_, joint);
  fresh.bond.resize(z(fresh.points));
  fresh.at = group.at, fresh.room = group.room;
  if (fresh.room < fresh.points) {
    fresh.at = memory_.size(), fresh.room = fresh.points;
    memory_.resize(memory_.size() + (sizeof(CrackedLanes) + z(fresh.points) * sizeof(SlipLanes)) / sizeof(Line));
    new (&memory_of(fresh)) CrackedLanes;
    new (memory_of(fresh).slip()) SlipLanes[z(fresh.points)];
  }
  group = std::move(fresh);
  for (int l = 0; l < lanes; ++l) clear(group, l), copy_ends(group, l);
}

bool Cracked::fits(const Group& group, const Joint& joint) const {
  if (group.empty()) return true;
  if (group.law != joint.type->law || group.points != joint.type->points || group.corners != joint.type->corners ||
      group.bears != bears(model_, joint))
    return false;
  if (group.type == joint.type) return true;
  if (group.shapes->watch.empty() == joint.type->inset) return false;
  for (int i = 0; i < joint.type->points; ++i)
    if (group.shapes->first[z(i + 1)] - group.shapes->first[z(i)] != model_.cell[z(joint.type->first_place + i)].corners) return false;
  return true;
}

int Cracked::find_lane(const Joint& joint) {
  int other = -1;
  for (int g = 0; g < groups(); ++g) {
    const Group& group = group_[z(g)];
    const int* free = std::find(group.joint, group.joint + lanes, -1);
    if (free == group.joint + lanes || (other >= 0 && (group.empty() || group.type != joint.type)) || !fits(group, joint)) continue;
    other = g * lanes + int(free - group.joint);
    if (!group.empty() && group.type == joint.type) return other;
  }
  if (other >= 0) return other;
  group_.push_back({});
  group_.back().batch = add_empty_batch(model_, state_);
  set_empty(group_.back(), joint);
  return (groups() - 1) * lanes;
}

void Cracked::put(int j) {
  const Joint& joint = model_.joint[z(j)];
  const int at = find_lane(joint);
  Group& group = group_[z(at / lanes)];
  if (group.empty()) set_empty(group, joint);
  fill(group, at % lanes, j);
  state_.place[z(j)] = (sound_batches(model_) + group.batch) * lanes + at % lanes;
  set_ends(j);
}

void Cracked::set_ends(int j) {
  const Joint& joint = model_.joint[z(j)];
  const int at = state_.place[z(j)] - sound_batches(model_) * lanes;
  JointBatch& batch = state_.batch[z(at / lanes)];
  set_constants(model_, j, batch, at % lanes);
  for (int i = 0; i < 3; ++i) batch.arm_a[i][at % lanes] = joint.arm_a[i], batch.arm_b[i][at % lanes] = joint.arm_b[i];
  copy_ends(group_[z(at / lanes)], at % lanes);
  if (pose_.empty()) {
    pose_.assign(block_groups(model_.nblock) * 8 * lanes, 0.0);
    take_pose(model_.nblock);  // for lanes without a joint
  }
  take_pose(joint.a);
  take_pose(joint.b);
}

void Cracked::copy_ends(const Group& group, int l) {
  const JointBatch& from = state_.batch[z(group.batch)];
  CrackedLanes& to = memory_of(group);
  to.a[l] = from.a[l], to.b[l] = from.b[l], to.row_a[l] = from.row_a[l], to.row_b[l] = from.row_b[l];
  for (int i = 0; i < 3; ++i) to.arm_a[i][l] = from.arm_a[i][l], to.arm_b[i][l] = from.arm_b[i][l];
}

void Cracked::take_pose(int b) {
  if (pose_.empty()) return;
  const Vec3 u = state_.u[z(b)];
  const Quat q = state_.q[z(b)];
  const double row[8] = {u.x(), u.y(), u.z(), q.x(), q.y(), q.z(), q.w(), 0};
  std::copy_n(row, 8, &pose_[8 * z(b)]);
}

void Cracked::take(int j) { put(j); }

// Restores the common type of a group after a joint has left. The lane of the next joint must not depend on joints that have left, since a
// resumed run does not know them.
void Cracked::look_at_types(Group& group) {
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

void Cracked::drop(int j) {
  const int at = state_.place[z(j)] - sound_batches(model_) * lanes;
  if (at >= 0) {
    Group& group = group_[z(at / lanes)];
    group.used &= ~(1U << at % lanes);
    clear(group, at % lanes);
    look_at_types(group);
    clear_lane(model_, state_.batch[z(at / lanes)], at % lanes);
    copy_ends(group, at % lanes);
  }
  state_.place[z(j)] = -1;
  state_.memory[z(j)] = JointMemory{};
  if (model_.dashpots_cracked) std::fill_n(&state_.viscous[6 * z(j)], 6, 0.0);
  for (const int row : {model_.row_a[z(j)], model_.row_b[z(j)]}) std::fill_n(&state_.wrench[z(row) * 8], 8, 0.0);
}

void Cracked::forces(int first, int last, bool sample, double budget, JointSums& sums, const LaneKernels& kernels) {
  const double* poses = pose_.data();
  double* wrench_rows = state_.wrench.data();
  if (sample) sums.energy.elastic = 0;
  const bool damped = model_.dashpots_cracked && state_.last_dt > 0;
  const double per_step = damped ? 1 / state_.last_dt : 0;
  CrackedSums done{};
  const Interlock interlock = interlock_now(model_, state_);
  for (int g = first; g < last; ++g) {
    Group& group = group_[z(g)];
    if (group.empty()) continue;
    CrackedLanes& lane = memory_of(group);
    const Shapes& shapes = *group.shapes;
    const PointLaw& law = model_.laws[z(group.law)];
    const CrackedShape shape{group.corners,      group.points,       group.used,
                             double(g),          &shapes.face,       shapes.corner.data(),
                             shapes.spot.data(), shapes.cell.data(), shapes.first.data(),
                             shapes.loop.data(), per_step,           shapes.watch.empty() ? shapes.loop.data() : shapes.watch.data(),
                             group.crushed,      group.face_corner,    budget,
                             law.interlock ? interlock : Interlock{}};
    if (group.bare) {
      group.beyond = kernels.rub(law, shape, lane, poses, wrench_rows, done);
    } else {
      group.beyond = kernels.respond(law, shape, group.bond.data(), lane, poses, wrench_rows, done);
      std::fill_n(lane.common.stale, lanes, 1.0);
      group.worn = true;
      group.bare = std::all_of(lane.least_damage, lane.least_damage + lanes, [](double damage) { return damage >= 1; });
    }
    if (sample) sums.energy.elastic += total(lane.stored);
  }
  sums.energy.friction += total(done.friction);
  sums.energy.fracture += total(done.fracture);
  sums.energy.crushing += total(done.crushing);
  sums.energy.damping += total(done.damping);
  for (int l = 0; l < lanes; ++l)
    if (done.error[l] > sums.largest_error)
      sums.largest_error = done.error[l], sums.worst_joint = group_[std::size_t(done.worst[l])].joint[l];
  sums.haste = std::max(sums.haste, *std::max_element(done.haste, done.haste + lanes));
}

void Cracked::store() {
  for (Group& group : group_) {
    if (group.empty()) continue;
    const bool worn = std::exchange(group.worn, false);
    const CrackedLanes& lane = memory_of(group);
    for (int l = 0; l < lanes; ++l) {
      const int j = group.joint[l];
      if (j < 0) continue;
      JointMemory& memory = state_.memory[z(j)];
      for (int i = 0; i < 6; ++i) memory.q[i] = lane.q[i][l], memory.f[i] = lane.f[i][l];
      memory.elastic = lane.stored[l];
      if (model_.dashpots_cracked)
        for (int i = 0; i < 6; ++i) state_.viscous[6 * z(j) + z(i)] = lane.drag[i][l];
      PointHistory* h = &state_.history[z(model_.joint[z(j)].first_point)];
      for (int i = 0; i < group.points; ++i) {
        h[i].slip_s = lane.slip()[i].s[l], h[i].slip_t = lane.slip()[i].t[l], h[i].bearing = lane.slip()[i].bearing[l];
        if (!worn) continue;
        const BondLanes& b = group.bond[z(i)];
        h[i].damage = b.damage[l], h[i].secant = b.secant[l], h[i].reach = b.reach[l];
      }
    }
  }
}

bool Cracked::none_spent() const {
  return keepers(model_) && std::none_of(group_.begin(), group_.end(), [](const Group& group) { return group.beyond && !group.empty(); });
}

bool Cracked::spent(int j) const {
  const int at = state_.place[z(j)] - sound_batches(model_) * lanes;
  if (at < 0) return !keepers(model_) && joint_spent(model_, state_, j);  // a joint that cracked in this step enters a group after it
  const Group& group = group_[z(at / lanes)];
  if (!group.beyond) return false;
  const CrackedLanes& lane = memory_of(group);
  if (lane.least_damage[at % lanes] < 1) return false;
  double q[6];
  for (int i = 0; i < 6; ++i) q[i] = lane.q[i][at % lanes];
  return beyond_its_faces(model_.joint[z(j)], q);
}

}  // namespace erbs
