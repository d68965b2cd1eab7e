#include "engine/solve/sound.h"

#include <algorithm>

#include "engine/model/batches.h"

namespace erbs {
namespace {

std::size_t z(int i) { return std::size_t(i); }

// Sum of k_i e_i e_i over the axes e_i of the joint's frame, k_i against rotation about it.
void bending_stiffness(const JointBatch& B, int l, double out[6][lanes]) {
  constexpr int row[6] = {0, 1, 2, 1, 0, 0}, column[6] = {0, 1, 2, 2, 2, 1};
  for (int i = 0; i < 6; ++i) {
    out[i][l] = 0;
    for (int axis = 0; axis < 3; ++axis) out[i][l] += B.stiffness[3 + axis][l] * B.frame[3 * axis + row[i]][l] * B.frame[3 * axis + column[i]][l];
  }
}

void fill(const JointBatch& B, int nothing, SoundBatch& out) {
  out.used = 0;
  for (int l = 0; l < lanes; ++l) {
    for (int i = 0; i < 3; ++i) {
      out.gap[i][l] = out.turn[i][l] = 0;
      for (int axis = 0; axis < 3; ++axis) {
        out.gap[i][l] += B.frame[3 * axis + i][l] * B.q[axis][l];
        out.turn[i][l] += B.frame[3 * axis + i][l] * B.q[3 + axis][l];
      }
      out.arm_a[i][l] = 0.5 * (B.sum[i][l] + (B.apart[i][l] - out.gap[i][l]));
      out.arm_b[i][l] = 0.5 * (B.sum[i][l] - (B.apart[i][l] - out.gap[i][l]));
      out.normal[i][l] = B.frame[6 + i][l];
    }
    out.shear[l] = B.stiffness[0][l];
    out.across[l] = B.stiffness[2][l] - B.stiffness[0][l];
    bending_stiffness(B, l, out.bend);
    out.open_limit[l] = B.open_limit[l];
    out.slip_limit[l] = B.slip_limit[l];
    out.slip_slope[l] = B.slip_slope[l];
    out.close_limit[l] = B.close_limit[l];
    out.radius[l] = B.radius[l];
    out.a[l] = 8 * B.a[l];
    out.b[l] = 8 * B.b[l];
    out.row_a[l] = 8 * B.row_a[l];
    out.row_b[l] = 8 * B.row_b[l];
    out.used += B.row_a[l] != nothing;
  }
}

}  // namespace

Sound::Sound(const Model& model, State& state) : model_(model), state_(state), batch_(z(sound_batches(model))) { update(); }

void Sound::update() {
  for (std::size_t k = 0; k < batch_.size(); ++k) fill(state_.batch[k], 2 * model_.njoint, batch_[k]);
}

void Sound::update(const std::vector<int>& joints) {
  int last = -1;
  for (const int j : joints) {
    const int k = j / lanes;
    if (k == last || state_.place[z(j)] != j) continue;
    fill(state_.batch[z(k)], 2 * model_.njoint, batch_[z(k)]);
    last = k;
  }
}

// A joint that may be past a limit. What it answers is changed only where it cracks.
void Sound::look_closer(int k, bool sample, JointSums& sums) {
  JointLanes o;
  const LaneKernels& kernels = lane_kernels();
  const JointBatch& B = state_.batch[z(k)];
  kernels.elastic(B, state_.row.data(), o);
  bool changed = false;
  for (int l = 0; l < lanes; ++l) {
    const int j = k * lanes + l;
    if (!(o.near[l] > 0) || j >= model_.njoint || state_.place[z(j)] != j) continue;
    double q[6], f[6], stored = 0;
    for (int i = 0; i < 6; ++i) q[i] = o.q[i][l], stored += 0.5 * o.f[i][l] * o.q[i][l];
    joint_by_points(model_, state_, j, q, f, sums);
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

void Sound::forces(int first, int last, bool sample, JointSums& sums) {
  alignas(64) double stored[lanes] = {};
  int near[batch_grain];
  const int count = forces(first, last, lane_kernels(), sample ? stored : nullptr, near);
  if (sample) {
    sums.energy.elastic = 0;
    for (const double e : stored) sums.energy.elastic += e;
  }
  for (int i = 0; i < count; ++i) look_closer(near[i], sample, sums);
}

}  // namespace erbs
