#include "engine/solve/integrate.h"

#include <algorithm>
#include <cmath>

#include "engine/solve/lanes.h"

// Rotation: implicit midpoint in the body, which keeps |L| and the energy exactly (both are quadratic), with the Cayley map for the
// attitude, which keeps L in the world (Simo and Wong 1991, Int. J. Numer. Meth. Eng. 31, section 4, in its momentum form).

namespace erbs {
namespace {

std::size_t z(int i) { return std::size_t(i); }

// Blocks [first, first + n) into lanes; lanes beyond n, fixed and driven blocks stand still.
void gather(const Model& m, const State& s, const double* push, const double* load, int first, int n, BlockLanes& o) {
  for (int l = 0; l < lanes; ++l) {
    const int b = std::min(first + l, m.nblock - 1);
    const bool moving = l < n && m.kind[z(b)] == Kind::moving;
    o.moving[l] = moving ? 1 : 0;
    o.mass[l] = moving ? m.mass[z(b)] : 0;
    o.inverse_mass[l] = m.inverse_mass[z(b)];
    o.damping[l] = m.damping_all || s.grounded[z(b)] ? m.damping.mass : 0;
    const double* J = m.inverse_inertia[z(b)].data();
    for (int i = 0; i < 9; ++i) o.inverse_inertia[i][l] = J[i];
    Vec6 w = moving ? joint_wrench(m, s, b) : Vec6(Vec6::Zero());
    for (int i = 0; i < 6; ++i) {
      o.load[i][l] = load != nullptr && moving ? load[6 * b + i] : 0;
      w[i] += push[6 * b + i] + o.load[i][l];
    }
    for (int i = 0; i < 3; ++i) {
      o.force[i][l] = w[i];
      o.moment[i][l] = moving ? w[3 + i] : 0;
      o.u[i][l] = s.u[z(b)][i];
      o.v[i][l] = moving ? s.v[z(b)][i] : 0;
      o.momentum[i][l] = moving ? s.spin_momentum[z(b)][i] : 0;
      o.base_u[i][l] = s.base_u[z(b)][i];
    }
    for (int i = 0; i < 4; ++i) o.q[i][l] = s.q[z(b)].coeffs()[i], o.base_q[i][l] = s.base_q[z(b)].coeffs()[i];
  }
}

void scatter(const Model& m, State& s, int first, int n, const BlockLanes& o) {
  for (int l = 0; l < n; ++l) {
    const int b = first + l;
    if (m.kind[z(b)] != Kind::moving) continue;
    double* row = &s.row[z(b) * 8];
    for (int i = 0; i < 3; ++i) {
      s.u[z(b)][i] = o.u[i][l];
      s.v[z(b)][i] = o.v[i][l];
      s.w[z(b)][i] = o.w[i][l];
      s.spin_momentum[z(b)][i] = o.momentum[i][l];
    }
    s.q[z(b)] = Quat(o.q[3][l], o.q[0][l], o.q[1][l], o.q[2][l]);
    for (int i = 0; i < 6; ++i) row[i] = o.row[i][l];
  }
}

void add(const Model& m, const State& s, int first, int n, bool sample, const BlockLanes& o, BlockSums& sums) {
  const double limit = m.analysis.lazy_rotation * m.analysis.lazy_rotation;
  for (int l = 0; l < n; ++l) {
    if (o.moving[l] == 0) continue;
    sums.base_work += o.base0[l];
    sums.base_after += o.base1[l];
    sums.damping += o.damped0[l];
    sums.damping_after += o.damped1[l];
    sums.external_work += o.loaded0[l];
    sums.external_after += o.loaded1[l];
    sums.absolute_work += std::fabs(o.base0[l]) + std::fabs(o.loaded0[l]);
    sums.absolute_after += std::fabs(o.base1[l]) + std::fabs(o.loaded1[l]);
    if (sample) sums.kinetic += o.kinetic[l], sums.height += o.height[l];
    if (!(o.speed[l] < 1e12)) sums.broken = true;
    sums.fastest = std::max(sums.fastest, o.speed[l]);
    if (o.turned[l] > limit && s.joined[z(first + l)]) sums.stale = true;
  }
}

}  // namespace

Vec6 joint_wrench(const Model& m, const State& s, int b) {
  alignas(64) double sum[8] = {};
  for (int row = m.first_row[z(b)]; row < m.first_row[z(b) + 1]; ++row)
    for (int i = 0; i < 8; ++i) sum[i] += s.wrench[z(row) * 8 + z(i)];
  return Eigen::Map<const Vec6>(sum);
}

void advance(const Model& m, State& s, const Excitation& e, const double* push, const double* load, int first, int last, bool sample,
             BlockSums& sums) {
  KickDrift step{e.kick, s.dt, 0.5 * s.last_dt, 0.5 * s.dt, {}, {}, s.last_dt == 0, m.damping_explicit, m.analysis.gyroscopic};
  for (int i = 0; i < 3; ++i) step.ground[i] = e.ground[i], step.gravity[i] = e.gravity[i];
  sums.base_work += sums.base_after;
  sums.external_work += sums.external_after;
  sums.damping += sums.damping_after;
  sums.absolute_work += sums.absolute_after;
  sums.base_after = sums.external_after = sums.damping_after = sums.absolute_after = 0;
  sums.fastest = 0;
  if (sample) sums.kinetic = sums.height = 0;
  BlockLanes blocks;
  const LaneKernels& kernels = lane_kernels();
  for (int at = first; at < last; at += lanes) {
    const int n = std::min(lanes, last - at);
    gather(m, s, push, load, at, n, blocks);
    kernels.advance(step, blocks);
    scatter(m, s, at, n, blocks);
    add(m, s, at, n, sample, blocks, sums);
  }
}

}  // namespace erbs
