#include "engine/solve/cracked.h"

#include <algorithm>
#include <cmath>

#include "engine/model/batches.h"
#include "engine/solve/joint_geometry.h"

namespace erbs {
namespace {

std::size_t z(int i) { return std::size_t(i); }

// Beds bear and stick, upright joints hang open and slide freely: eight of a kind seldom need the other's arithmetic.
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

bool Cracked::Group::empty() const {
  return std::all_of(joint, joint + lanes, [](int j) { return j < 0; });
}

Cracked::Cracked(const Model& model, State& state) : model_(model), state_(state) {
  const int sound = sound_batches(model);
  // Batches that a stopped run left: the same joint in the same lane, so that sums go on in the same order.
  for (int k = 0; k < int(state.batch.size()); ++k) {
    group_.push_back({});
    group_.back().law = -1, group_.back().batch = k;
    std::fill_n(group_.back().joint, lanes, -1);
  }
  for (int j = 0; j < model.njoint; ++j) {
    const int at = state.place[z(j)] - sound * lanes;
    if (at < 0) continue;
    Group& group = group_[z(at / lanes)];
    const Joint& joint = model.joint[z(j)];
    if (group.law < 0) group = empty_group(joint, group.batch);
    fill(group, at % lanes, j);
  }
  if (model.analysis.kernel == "reference" || model.analysis.solver == "sequential") return;
  for (int j = 0; j < model.njoint; ++j)
    if (state.tier[z(j)] == Tier::cracked && state.place[z(j)] < sound * lanes) take(j);
}

void Cracked::clear(Group& group, int l) const {
  group.joint[l] = -1;
  group.crushed[l] = nullptr;
  group.face_corner[l] = nullptr;
  for (int i = 0; i < 6; ++i) group.lane.q[i][l] = group.lane.f[i][l] = 0;
  group.lane.stored[l] = 0;
  group.lane.least_damage[l] = 1;
  for (auto* corners : {&group.corner, &group.loop, &group.watch})
    for (CornerLanes& c : *corners) c.s[l] = c.t[l] = 0;
  for (CellLanes& c : group.cell) c.s[l] = c.t[l] = c.ss[l] = c.st[l] = c.tt[l] = 0;
  group.face.bend_s[l] = group.face.bend_t[l] = group.face.twist[l] = 0;
  for (int i = 0; i < 6; ++i) group.lane.drag[i][l] = 0;
  for (SpotLanes& p : group.spot) p.s[l] = p.t[l] = p.weight[l] = 0;
  for (SlipLanes& p : group.slip) p.s[l] = p.t[l] = 0;
  for (auto* x : {group.common.s, group.common.t, group.common.turn, group.common.apart, group.common.stored, group.common.stale}) x[l] = 0;
  for (BondLanes& p : group.bond) p.secant[l] = p.reach[l] = 0, p.damage[l] = 1;  // nothing to hold
  group.look_for_bonds(model_.laws[z(group.law)]);
}

void Cracked::fill(Group& group, int l, int j) {
  const Joint& joint = model_.joint[z(j)];
  const JointMemory& memory = state_.memory[z(j)];
  group.joint[l] = j;
  if (model_.laws[z(joint.type->law)].fc > 0)
    group.crushed[l] = &state_.crushed[z(j)], group.face_corner[l] = model_.corner[z(joint.type->first_corner)].data();
  for (int i = 0; i < 6; ++i) group.lane.q[i][l] = memory.q[i], group.lane.f[i][l] = memory.f[i];
  group.lane.stored[l] = memory.elastic;
  group.lane.least_damage[l] = 1;
  group.common.stale[l] = 1;
  if (model_.dashpots_cracked)
    for (int i = 0; i < 6; ++i) group.lane.drag[i][l] = state_.viscous[6 * z(j) + z(i)];
  for (int i = 0; i < joint.type->corners; ++i) {
    const auto& c = model_.corner[z(joint.type->first_corner + i)];
    group.corner[z(i)].s[l] = c.x(), group.corner[z(i)].t[l] = c.y();
  }
  group.face.bend_s[l] = joint.type->face[0], group.face.bend_t[l] = joint.type->face[1], group.face.twist[l] = joint.type->face[2];
  const int first = model_.cell[z(joint.type->first_place)].first;
  for (int i = 0; i < int(group.loop.size()); ++i) {
    const auto &c = model_.cell_corner[z(first + i)], &w = model_.cell_watch[z(first + i)];
    group.loop[z(i)].s[l] = c.x(), group.loop[z(i)].t[l] = c.y();
    if (!group.watch.empty()) group.watch[z(i)].s[l] = w.x(), group.watch[z(i)].t[l] = w.y();
  }
  for (int i = 0; i < joint.type->points; ++i) {
    const Point& from = model_.point[z(joint.type->first_place + i)];
    const PointHistory& h = state_.history[z(joint.first_point + i)];
    const Cell& cell = model_.cell[z(joint.type->first_place + i)];
    CellLanes& k = group.cell[z(i)];
    k.s[l] = cell.s, k.t[l] = cell.t, k.ss[l] = cell.ss, k.st[l] = cell.st, k.tt[l] = cell.tt;
    SpotLanes& p = group.spot[z(i)];
    p.s[l] = from.s, p.t[l] = from.t, p.weight[l] = from.weight;
    group.slip[z(i)].s[l] = h.slip_s, group.slip[z(i)].t[l] = h.slip_t;
    BondLanes& b = group.bond[z(i)];
    b.damage[l] = h.damage, b.secant[l] = h.secant, b.reach[l] = h.reach;
    if (!model_.laws[z(joint.type->law)].dry) group.lane.least_damage[l] = std::min(group.lane.least_damage[l], h.damage);
  }
  group.look_for_bonds(model_.laws[z(joint.type->law)]);
}

Cracked::Group Cracked::empty_group(const Joint& joint, int batch) const {
  Group group{};
  group.law = joint.type->law, group.points = joint.type->points, group.corners = joint.type->corners, group.batch = batch,
  group.bears = bears(model_, joint);
  group.spot.resize(z(group.points));
  group.slip.resize(z(group.points));
  group.bond.resize(z(group.points));
  group.corner.resize(z(group.corners));
  group.cell.resize(z(group.points));
  group.first.push_back(0);
  for (int i = joint.type->first_place; i < joint.type->first_place + joint.type->points; ++i)
    group.first.push_back(group.first.back() + model_.cell[z(i)].corners);
  group.loop.resize(z(group.first.back()));
  if (joint.type->inset) group.watch.resize(group.loop.size());
  for (int l = 0; l < lanes; ++l) clear(group, l);
  return group;
}

bool Cracked::fits(const Group& group, const Joint& joint) const {
  if (group.law != joint.type->law || group.points != joint.type->points || group.corners != joint.type->corners ||
      group.watch.empty() == joint.type->inset || group.bears != bears(model_, joint))
    return false;
  for (int i = 0; i < joint.type->points; ++i)
    if (group.first[z(i + 1)] - group.first[z(i)] != model_.cell[z(joint.type->first_place + i)].corners) return false;
  return true;
}

int Cracked::find_lane(const Joint& joint) {
  for (int g = 0; g < groups(); ++g) {
    Group& group = group_[z(g)];
    const int* free = std::find(group.joint, group.joint + lanes, -1);
    if (free != group.joint + lanes && fits(group, joint)) return g * lanes + int(free - group.joint);
  }
  group_.push_back(empty_group(joint, add_empty_batch(model_, state_)));
  return (groups() - 1) * lanes;
}

void Cracked::take(int j) {
  const Joint& joint = model_.joint[z(j)];
  const int at = find_lane(joint);
  Group& group = group_[z(at / lanes)];
  fill(group, at % lanes, j);
  state_.place[z(j)] = (sound_batches(model_) + group.batch) * lanes + at % lanes;
  set_lane(model_, state_, j, state_.batch[z(group.batch)], at % lanes);
}

void Cracked::drop(int j) {
  const int at = state_.place[z(j)] - sound_batches(model_) * lanes;
  if (at >= 0) {
    clear(group_[z(at / lanes)], at % lanes);
    clear_lane(model_, state_.batch[z(at / lanes)], at % lanes);
  }
  state_.place[z(j)] = -1;
  state_.memory[z(j)] = JointMemory{};
  if (model_.dashpots_cracked) std::fill_n(&state_.viscous[6 * z(j)], 6, 0.0);
  for (const int row : {model_.row_a[z(j)], model_.row_b[z(j)]}) std::fill_n(&state_.wrench[z(row) * 8], 8, 0.0);
}

void Cracked::forces(int first, int last, bool sample, JointSums& sums) {
  const LaneKernels& kernels = lane_kernels();
  const double* rows = state_.row.data();
  double* wrench_rows = state_.wrench.data();
  if (sample) sums.energy.elastic = 0;
  for (int g = first; g < last; ++g) {
    Group& group = group_[z(g)];
    if (group.empty()) continue;
    const JointBatch& batch = state_.batch[z(group.batch)];
    CrackedLanes& lane = group.lane;
    alignas(64) double rate[lanes];
    const bool damped = model_.dashpots_cracked && state_.last_dt > 0;
    for (int l = 0; damped && l < lanes; ++l)
      rate[l] = group.joint[l] >= 0 ? model_.joint[z(group.joint[l])].viscous_cracked / state_.last_dt : 0;
    const CrackedShape shape{group.corners,
                             group.points,
                             &group.face,
                             group.corner.data(),
                             group.spot.data(),
                             group.cell.data(),
                             group.first.data(),
                             group.loop.data(),
                             damped ? rate : nullptr,
                             group.watch.empty() ? group.loop.data() : group.watch.data(),
                             group.crushed,
                             group.face_corner};
    const PointLaw& law = model_.laws[z(group.law)];
    if (group.bare) {
      kernels.rub(law, batch, shape, group.slip.data(), group.common, lane, rows, wrench_rows);
    } else {
      kernels.respond(law, batch, shape, group.slip.data(), group.bond.data(), lane, rows, wrench_rows);
      std::fill_n(group.common.stale, lanes, 1.0);
      group.bare = std::all_of(lane.least_damage, lane.least_damage + lanes, [](double damage) { return damage >= 1; });
    }
    sums.energy.friction += total(lane.friction);
    sums.energy.fracture += total(lane.fracture);
    sums.energy.crushing += total(lane.crushing);
    sums.energy.damping += total(lane.damping);
    if (sample) sums.energy.elastic += total(lane.stored);
    for (int l = 0; l < lanes; ++l) {
      if (lane.error[l] > sums.largest_error) sums.largest_error = lane.error[l], sums.worst_joint = group.joint[l];
    }
  }
}

void Cracked::store() {
  for (const Group& group : group_) {
    for (int l = 0; l < lanes; ++l) {
      const int j = group.joint[l];
      if (j < 0) continue;
      JointMemory& memory = state_.memory[z(j)];
      for (int i = 0; i < 6; ++i) memory.q[i] = group.lane.q[i][l], memory.f[i] = group.lane.f[i][l];
      memory.elastic = group.lane.stored[l];
      if (model_.dashpots_cracked)
        for (int i = 0; i < 6; ++i) state_.viscous[6 * z(j) + z(i)] = group.lane.drag[i][l];
      PointHistory* h = &state_.history[z(model_.joint[z(j)].first_point)];
      for (int i = 0; i < group.points; ++i) {
        const SlipLanes& p = group.slip[z(i)];
        const BondLanes& b = group.bond[z(i)];
        h[i] = {p.s[l], p.t[l], b.damage[l], b.secant[l], b.reach[l]};
      }
    }
  }
}

bool Cracked::spent(int j) const {
  const int at = state_.place[z(j)] - sound_batches(model_) * lanes;
  if (at < 0) return joint_spent(model_, state_, j);
  const CrackedLanes& lane = group_[z(at / lanes)].lane;
  if (lane.least_damage[at % lanes] < 1) return false;
  double q[6];
  for (int i = 0; i < 6; ++i) q[i] = lane.q[i][at % lanes];
  return beyond_its_faces(model_.joint[z(j)], q);
}

}  // namespace erbs
