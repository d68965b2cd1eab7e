#include "engine/solve/sound.h"

#include <algorithm>
#include <limits>

#include "engine/model/batches.h"
#include "engine/solve/joint_geometry.h"

namespace erbs {
namespace {

std::size_t z(int i) { return std::size_t(i); }

// Sum of k_i e_i e_i over the axes e_i of the joint's frame, k_i against rotation about it.
void set_bending_stiffness(const JointBatch& B, int from, double out[6][lanes], int to) {
  constexpr int row[6] = {0, 1, 2, 1, 0, 0}, column[6] = {0, 1, 2, 2, 2, 1};
  for (int i = 0; i < 6; ++i) {
    out[i][to] = 0;
    for (int axis = 0; axis < 3; ++axis)
      out[i][to] += B.stiffness[3 + axis][from] * B.frame[3 * axis + row[i]][from] * B.frame[3 * axis + column[i]][from];
  }
}

void fill(const JointBatch& B, int nothing, SoundBatch& out) {
  out.used = 0;
  for (int l = 0; l < lanes; ++l) {
    set_sound_lane(B, l, out, l);
    out.used += B.row_a[l] != nothing;
  }
}

}  // namespace

void set_sound_lane(const JointBatch& B, int from, SoundBatch& out, int to) {
  for (int i = 0; i < 3; ++i) {
    out.gap[i][to] = out.turn[i][to] = 0;
    for (int axis = 0; axis < 3; ++axis) {
      out.gap[i][to] += B.frame[3 * axis + i][from] * B.q[axis][from];
      out.turn[i][to] += B.frame[3 * axis + i][from] * B.q[3 + axis][from];
    }
    out.arm_a[i][to] = 0.5 * (B.sum[i][from] + (B.apart[i][from] - out.gap[i][to]));
    out.arm_b[i][to] = 0.5 * (B.sum[i][from] - (B.apart[i][from] - out.gap[i][to]));
    out.normal[i][to] = B.frame[6 + i][from];
  }
  out.shear[to] = B.stiffness[0][from];
  out.across[to] = B.stiffness[2][from] - B.stiffness[0][from];
  set_bending_stiffness(B, from, out.bend, to);
  out.open_limit[to] = B.open_limit[from];
  out.slip_limit[to] = B.slip_limit[from];
  out.slip_slope[to] = B.slip_slope[from];
  out.close_limit[to] = B.close_limit[from];
  out.radius[to] = B.radius[from];
  out.a[to] = 8 * B.a[from];
  out.b[to] = 8 * B.b[from];
  out.row_a[to] = 8 * B.row_a[from];
  out.row_b[to] = 8 * B.row_b[from];
}

void clear_sound_lane(const Model& m, SoundBatch& out, int lane) {
  for (auto* field : {out.gap, out.turn, out.arm_a, out.arm_b, out.normal})
    for (int i = 0; i < 3; ++i) field[i][lane] = 0;
  for (auto& k : out.bend) k[lane] = 0;
  out.shear[lane] = out.across[lane] = out.slip_slope[lane] = out.radius[lane] = 0;
  out.open_limit[lane] = out.slip_limit[lane] = out.close_limit[lane] = std::numeric_limits<double>::infinity();
  out.a[lane] = out.b[lane] = 8 * m.nblock;
  out.row_a[lane] = out.row_b[lane] = 8 * 2 * m.njoint;
}

Sound::Sound(const Model& model, State& state) : model_(model), state_(state) {
  if (model.analysis.kernel == "reference" || model.analysis.solver == "sequential") return;  // have their own
  const int count = sound_batches(model);
  if (model.dashpots) damped_.resize(z(count));
  else batch_.resize(z(count)), looked_at_.resize(z(count));
  for (int k = 0; k < count; ++k) {
    const JointBatch batch = sound_batch(model, state, k);
    if (model.dashpots) damped_[z(k)] = batch;
    else fill(batch, 2 * model.njoint, batch_[z(k)]);
  }
}

void Sound::update(const std::vector<int>& joints) {
  JointBatch eight;
  int fresh[lanes], count = 0;
  const auto take = [&] {
    set_lanes(model_, state_, fresh, count, eight);
    for (int l = 0; l < count; ++l) set_sound_lane(eight, l, batch_[z(fresh[l] / lanes)], fresh[l] % lanes);
    count = 0;
  };
  for (const int j : joints) {
    if (state_.place[z(j)] != j) continue;
    if (!damped_.empty()) set_lane(model_, state_, j, damped_[z(j / lanes)], j % lanes);
    if (batch_.empty()) continue;
    looked_at_[z(j / lanes)].reset();
    fresh[count++] = j;
    if (count == lanes) take();
  }
  if (count > 0) take();
}

void Sound::leave(int j) {
  if (!damped_.empty()) clear_lane(model_, damped_[z(j / lanes)], j % lanes);
  if (batch_.empty()) return;
  looked_at_[z(j / lanes)].reset();
  clear_sound_lane(model_, batch_[z(j / lanes)], j % lanes);
  --batch_[z(j / lanes)].used;
}

// A joint that may be past a limit. What it answers is changed only where it cracks.
void Sound::look_closer(int k, bool sample, JointSums& sums) {
  JointLanes o;
  const LaneKernels& kernels = lane_kernels();
  if (!looked_at_[z(k)]) looked_at_[z(k)] = std::make_unique<JointBatch>(sound_batch(model_, state_, k));
  const JointBatch& B = *looked_at_[z(k)];
  kernels.elastic(B, state_.row.data(), o);
  bool changed = false;
  for (int l = 0; l < lanes; ++l) {
    const int j = k * lanes + l;
    if (!(o.near[l] > 0) || j >= model_.njoint || state_.place[z(j)] != j) continue;
    double q[6], f[6], stored = 0;
    for (int i = 0; i < 6; ++i) q[i] = o.q[i][l], stored += 0.5 * o.f[i][l] * o.q[i][l];
    joint_by_points(model_, state_, j, q, f, sums, &B);
    if (state_.tier[z(j)] == Tier::intact) continue;
    changed = true;
    for (int i = 0; i < 6; ++i) o.f[i][l] = f[i];
    if (sample) sums.energy.elastic += state_.memory[z(j)].elastic - stored;
  }
  if (changed) kernels.wrenches(B, o, state_.wrench.data());
}

int Sound::forces(int first, int last, const LaneKernels& kernels, double* stored, int* near) {
  return kernels.sound(batch_.data(), first, last, state_.row.data(), state_.wrench.data(), stored, near);
}

void Sound::forces(Range batches, bool sample, std::vector<JointSums>& all) {
  constexpr int most = 32 * batch_grain;
  int near[most];
  const LaneKernels& kernels = lane_kernels();
  const int piece = sample ? batch_grain : most;  // only energies are summed
  for (int first = batches.first; first < batches.last; first += piece) {
    alignas(64) double stored[lanes] = {};
    const int count = forces(first, std::min(first + piece, batches.last), kernels, sample ? stored : nullptr, near);
    if (sample) {
      double& elastic = all[z(first / batch_grain)].energy.elastic = 0;
      for (const double e : stored) elastic += e;
    }
    for (int i = 0; i < count; ++i) look_closer(near[i], sample, all[z(near[i] / batch_grain)]);
  }
}

}  // namespace erbs
