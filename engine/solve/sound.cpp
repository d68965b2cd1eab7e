#include "engine/solve/sound.h"

#include <algorithm>
#include <limits>

#include "engine/model/batches.h"
#include "engine/solve/joint_geometry.h"

namespace erbs {
namespace {

std::size_t z(int i) { return std::size_t(i); }

// Minus twice the sum of k_i e_i e_i over the axes e_i of the joint's frame, k_i against rotation about it.
void set_bending_stiffness(const JointBatch& B, int from, double out[6][lanes], int to) {
  constexpr int row[6] = {0, 1, 2, 1, 0, 0}, column[6] = {0, 1, 2, 2, 2, 1};
  for (int i = 0; i < 6; ++i) {
    out[i][to] = 0;
    for (int axis = 0; axis < 3; ++axis)
      out[i][to] -= 2 * B.stiffness[3 + axis][from] * B.frame[3 * axis + row[i]][from] * B.frame[3 * axis + column[i]][from];
  }
}

}  // namespace

void set_sound_lane(const JointBatch& B, int from, SoundBatch& out, int to, bool turned) {
  const double sign = turned ? -1 : 1;
  for (int i = 0; i < 3; ++i) {
    out.gap[i][to] = sign * B.gap[i][from];
    out.turn[i][to] = 0.5 * sign * B.turn[i][from];
    out.normal[i][to] = sign * B.frame[6 + i][from];
    (turned ? out.arm_b : out.arm_a)[i][to] = B.arm_a[i][from];
    (turned ? out.arm_a : out.arm_b)[i][to] = B.arm_b[i][from];
  }
  out.shear[to] = -B.stiffness[0][from];
  out.across[to] = B.stiffness[0][from] - B.stiffness[2][from];
  set_bending_stiffness(B, from, out.bend, to);
  out.open_limit[to] = B.open_limit[from];
  out.slip_limit[to] = B.slip_limit[from];
  out.slip_slope[to] = B.slip_slope[from];
  out.close_limit[to] = B.close_limit[from];
  out.diameter[to] = 2 * B.radius[from];
  out.b[to] = 8 * (turned ? B.a : B.b)[from];
  out.row_b[to] = 8 * (turned ? B.row_a : B.row_b)[from];
}

void clear_sound_lane(const Model& m, SoundBatch& out, int lane) {
  for (auto* field : {out.gap, out.turn, out.arm_a, out.arm_b, out.normal})
    for (int i = 0; i < 3; ++i) field[i][lane] = 0;
  for (auto& k : out.bend) k[lane] = 0;
  out.shear[lane] = out.across[lane] = out.slip_slope[lane] = out.diameter[lane] = 0;
  out.open_limit[lane] = out.slip_limit[lane] = out.close_limit[lane] = std::numeric_limits<double>::infinity();
  out.b[lane] = 8 * m.nblock;
  out.row_b[lane] = 8 * m.spare_row();
}

Sound::Sound(const Model& model, State& state) : model_(model), state_(state) {
  if (model.analysis.kernel == "reference" || model.analysis.solver == "sequential") return;  // have their own
  if (model.dashpots) {
    for (int k = 0; k < sound_batches(model); ++k) damped_.push_back(sound_batch(model, state, k));
    return;
  }
  deal_lanes();
  batch_.resize(joint_.size() / lanes);
  looked_at_.resize(batch_.size());
  stale_.resize(batch_.size());
  near_.resize(batch_.size() + 1);
  for (int k = 0; k < int(batch_.size()); ++k) {
    int joints[lanes];
    joints_in_place(k, joints);
    const JointBatch batch = batch_of(model, state, joints);
    for (int l = 0; l < lanes; ++l)
      if (joints[l] >= 0) set_sound_lane(batch, l, batch_[z(k)], l, model.joint[z(joints[l])].kept_by_b), ++batch_[z(k)].used;
      else clear_sound_lane(model, batch_[z(k)], l);
  }
}

// Of each group as many batches as the busiest of its blocks keeps joints.
void Sound::deal_lanes() {
  std::vector<int> kept(z(model_.nblock), 0), batches(block_groups(model_.nblock), 0);
  for (int j = 0; j < model_.njoint; ++j) {
    const int b = model_.keeper(j);
    batches[z(b / lanes)] = std::max(batches[z(b / lanes)], ++kept[z(b)]);
  }
  for (const int count : batches) first_batch_.push_back(first_batch_.back() + count);
  joint_.assign(z(first_batch_.back() * lanes), -1);
  lane_.resize(z(model_.njoint));
  std::fill(kept.begin(), kept.end(), 0);
  for (int j = 0; j < model_.njoint; ++j) {
    const int b = model_.keeper(j);
    lane_[z(j)] = (first_batch_[z(b / lanes)] + kept[z(b)]++) * lanes + b % lanes;
    joint_[z(lane_[z(j)])] = j;
  }
}

void Sound::joints_in_place(int k, int joints[lanes]) const {
  for (int l = 0; l < lanes; ++l) {
    const int j = joint_[z(k * lanes + l)];
    joints[l] = j >= 0 && state_.place[z(j)] == j ? j : -1;
  }
}

// By whole batches: what does not change is found again to the same bits.
void Sound::refresh(const std::vector<std::uint8_t>& stale) {
  for (int k = 0; k < int(damped_.size()); ++k) {
    const JointBatch& b = damped_[z(k)];
    bool any = false;
    for (int l = 0; l < lanes; ++l) any = any || stale[z(b.a[l])] || stale[z(b.b[l])];
    if (any) damped_[z(k)] = sound_batch(model_, state_, k);
  }
  for (int g = 0; g < int(first_batch_.size()) - 1; ++g)
    for (int k = first_batch_[z(g)]; k < first_batch_[z(g) + 1]; ++k) {
      const SoundBatch& batch = batch_[z(k)];
      bool any = false;
      for (int l = 0; l < lanes; ++l)  // a lane without a joint has the block at rest
        any = any || stale[z(batch.b[l] / 8)] || (batch.b[l] != 8 * model_.nblock && stale[z(g * lanes + l)]);
      if (batch.used > 0 && any) set_lanes(k);
    }
}

// The geometry of batch k as it is at the last refresh, eight lanes at a time what set_sound_lane does in one.
void Sound::set_lanes(int k) {
  int joints[lanes];
  joints_in_place(k, joints);
  JointBatch geometry;
  set_geometry(model_, state_, joints, geometry);
  constexpr double nothing[3] = {};
  SoundLanes lane;
  for (int l = 0; l < lanes; ++l) {
    lane.sign[l] = joints[l] >= 0 && model_.joint[z(joints[l])].kept_by_b ? -1 : 1;
    lane.bending[l] = joints[l] >= 0 ? model_.joint[z(joints[l])].type->stiffness + 3 : nothing;
  }
  lane_kernels().sound_pose(geometry, lane, batch_[z(k)]);
  stale_[z(k)] = 1;
}

void Sound::leave(int j) {
  if (!damped_.empty()) clear_lane(model_, damped_[z(j / lanes)], j % lanes);
  if (batch_.empty()) return;
  const int k = lane_[z(j)] / lanes;
  looked_at_[z(k)].reset();
  clear_sound_lane(model_, batch_[z(k)], lane_[z(j)] % lanes);
  --batch_[z(k)].used;
}

// Joint j answers otherwise than the pass has it. Until the next step its keeper's end is part of what the keeper sums up.
void Sound::take_over(int j, int lane, const JointBatch& batch, const JointLanes& before, const JointLanes& now) {
  JointBatch aside = batch;
  for (int l = 0; l < lanes; ++l) aside.row_a[l] = l, aside.row_b[l] = lanes + l;
  alignas(64) double was[2 * 8 * lanes], is[2 * 8 * lanes];
  lane_kernels().wrenches(aside, before, was);
  lane_kernels().wrenches(aside, now, is);
  const bool by_b = model_.joint[z(j)].kept_by_b;
  const int keeper = model_.keeper(j), own = 8 * (by_b ? lanes + lane : lane), other = 8 * (by_b ? lane : lanes + lane);
  for (int i = 0; i < 6; ++i) {
    state_.kept[z(keeper / lanes)].x[i][keeper % lanes] += is[own + i] - was[own + i];
    state_.wrench[8 * z((by_b ? model_.row_a : model_.row_b)[z(j)]) + z(i)] = is[other + i];
  }
}

// A joint that may be past a limit. What it answers is changed only where it cracks.
void Sound::look_closer(int k, bool sample, JointSums& sums) {
  JointLanes o;
  int joints[lanes];
  joints_in_place(k, joints);
  if (!looked_at_[z(k)]) looked_at_[z(k)] = std::make_unique<JointBatch>(batch_of(model_, state_, joints));
  else if (stale_[z(k)]) set_geometry(model_, state_, joints, *looked_at_[z(k)]);
  stale_[z(k)] = 0;
  const JointBatch& B = *looked_at_[z(k)];
  lane_kernels().elastic(B, state_.row.data(), o);
  for (int l = 0; l < lanes; ++l) {
    const int j = joints[l];
    if (!(o.near[l] > 0) || j < 0) continue;
    double q[6], f[6], stored = 0;
    for (int i = 0; i < 6; ++i) q[i] = o.q[i][l], stored += 0.5 * o.f[i][l] * o.q[i][l];
    joint_by_points(model_, state_, j, q, f, sums, &B, l);
    if (state_.tier[z(j)] == Tier::intact) continue;
    JointLanes cracked = o;
    for (int i = 0; i < 6; ++i) cracked.f[i][l] = f[i];
    take_over(j, l, B, o, cracked);
    if (sample) sums.energy.elastic += state_.memory[z(j)].elastic - stored;
  }
}

int Sound::forces(int first, int last, const LaneKernels& kernels, double* stored) {
  return kernels.sound(batch_.data(), first_batch_.data(), first, last, state_.row.data(), state_.wrench.data(), state_.kept.data(), stored,
                       &near_[z(first_batch_[z(first)])]);
}

void Sound::forces(Range groups, bool sample, std::vector<JointSums>& all) {
  const int piece = sample ? grain : std::max(1, groups.last - groups.first);  // only energies are summed
  for (int first = groups.first; first < groups.last; first += piece) {
    alignas(64) double stored[lanes] = {};
    const int count = forces(first, std::min(first + piece, groups.last), lane_kernels(), sample ? stored : nullptr);
    if (sample) {
      double& elastic = all[z(first / grain)].energy.elastic = 0;
      for (const double e : stored) elastic += e;
    }
    int group = first;
    for (int i = first_batch_[z(first)]; i < first_batch_[z(first)] + count; ++i) {
      while (first_batch_[z(group) + 1] <= near_[z(i)]) ++group;
      look_closer(near_[z(i)], sample, all[z(group / grain)]);
    }
  }
}

void forget_other_kernel(const Model& m, State& s) {
  if (!keepers(m)) return std::fill(s.kept.begin(), s.kept.end(), RowLanes<6>{});
  for (int j = 0; j < m.njoint; ++j)
    if (s.tier[z(j)] == Tier::intact) std::fill_n(&s.wrench[8 * z((m.joint[z(j)].kept_by_b ? m.row_b : m.row_a)[z(j)])], 8, 0.0);
}

}  // namespace erbs
