#include "engine/solve/integrate.h"

#include <algorithm>
#include <cmath>
#include <limits>

// Rotation: implicit midpoint in the body, which keeps |L| and the energy exactly (both are quadratic), with the Cayley map for the
// attitude, which keeps L in the world (Simo and Wong 1991, Int. J. Numer. Meth. Eng. 31, section 4, in its momentum form).

namespace erbs {
namespace {

std::size_t z(int i) { return std::size_t(i); }

KickDrift kick_of(const Model& m, const State& s, const Excitation& e) {
  KickDrift k{};
  k.kick = e.kick;
  k.dt = s.dt;
  k.half_last = 0.5 * s.last_dt;
  k.half_next = 0.5 * s.dt;
  k.first = s.last_dt == 0;
  k.damping = m.damping.mass;
  k.damping_explicit = m.damping_explicit;
  const double f = 0.5 * k.damping * k.kick;
  k.damped_keep = m.damping_explicit ? -k.damping * k.kick : (1 - f) / (1 + f) - 1;
  k.damped_kick = m.damping_explicit ? 0 : 1 / (1 + f) - 1;
  k.gyroscopic = m.analysis.gyroscopic;
  k.shaken = !m.grounds.empty();
  for (int i = 0; i < 3; ++i) k.ground[i] = e.ground[i], k.gravity[i] = e.gravity[i];
  return k;
}

BlockArrays arrays(State& s, const std::vector<BlockConstants>& constants, const Pushes& pushes) {
  return {constants.data(), s.u.data(),      s.v.data(),   s.spin_momentum.data(), s.w.data(),      s.q.data(),
          s.base_u.data(),  s.base_q.data(), s.row.data(), s.wrench.data(),        pushes.contacts, pushes.loads};
}

double power(const State& s, const double* loads, const LoadedBlock& l) {
  const auto load = Eigen::Map<const Vec6>(loads + 8 * l.block);
  return load.head<3>().dot(s.v[z(l.block)]) + load.tail<3>().dot(l.inverse_inertia * s.spin_momentum[z(l.block)]);
}

// The loaded blocks of a chunk.
std::span<LoadedBlock> within(std::span<LoadedBlock> all, int first, int last) {
  const auto before = [](const LoadedBlock& l, int b) { return l.block < b; };
  const auto from = std::lower_bound(all.begin(), all.end(), first * lanes, before),
             to = std::lower_bound(from, all.end(), last * lanes, before);
  return {from, to};
}

void work_before(const Model& m, const State& s, const Pushes& pushes, std::span<LoadedBlock> loaded, BlockSums& sums) {
  sums.external_work += sums.external_after;
  sums.external_absolute += sums.external_absolute_after;
  sums.external_after = sums.external_absolute_after = 0;
  for (LoadedBlock& l : loaded) {
    const Mat3 r = s.q[z(l.block)].toRotationMatrix();
    l.inverse_inertia = r * m.inverse_inertia[z(l.block)] * r.transpose();
    const double work = 0.5 * s.last_dt * power(s, pushes.loads, l);
    sums.external_work += work;
    sums.external_absolute += std::fabs(work);
  }
}

void work_after(const State& s, const Pushes& pushes, std::span<LoadedBlock> loaded, BlockSums& sums) {
  for (const LoadedBlock& l : loaded) {
    const double work = 0.5 * s.dt * power(s, pushes.loads, l);
    sums.external_after += work;
    sums.external_absolute_after += std::fabs(work);
  }
}

void set_constants(const Model& m, const State& s, int b, bool moving, BlockConstants& c) {
  constexpr int row[6] = {0, 1, 2, 1, 0, 0}, column[6] = {0, 1, 2, 2, 2, 1};
  const int l = b % lanes;
  c.moving[l] = moving;
  c.mass[l] = moving ? m.mass[z(b)] : 0;
  c.inverse_mass[l] = moving ? m.inverse_mass[z(b)] : 0;
  c.damped[l] = moving && (m.damping_all || s.grounded[z(b)]);
  for (int i = 0; i < 6; ++i) c.inverse_inertia[i][l] = moving ? m.inverse_inertia[z(b)](row[i], column[i]) : 0;
  c.turn_limit[l] = moving && s.joined[z(b)] ? m.analysis.lazy_rotation * m.analysis.lazy_rotation : std::numeric_limits<double>::infinity();
  c.first_row[l] = moving ? 8 * m.first_row[z(b)] : 0;
  c.rows[l] = moving ? m.first_row[z(b) + 1] - m.first_row[z(b)] : 0;
}

}  // namespace

std::vector<BlockConstants> block_constants(const Model& m, const State& s) {
  std::vector<BlockConstants> out(block_groups(m.nblock));
  for (int b = 0; b < int(out.size()) * lanes; ++b) set_constants(m, s, b, b < m.nblock && m.kind[z(b)] == Kind::moving, out[z(b / lanes)]);
  return out;
}

Vec6 joint_wrench(const Model& m, const State& s, int b) {
  alignas(64) double sum[8] = {};
  for (int row = m.first_row[z(b)]; row < m.first_row[z(b) + 1]; ++row)
    for (int i = 0; i < 6; ++i) sum[i] += s.wrench[z(row) * 8 + z(i)];
  return Eigen::Map<const Vec6>(sum);
}

void advance(const Model& m, State& s, const std::vector<BlockConstants>& constants, const Excitation& e, const Pushes& pushes, int first,
             int last, bool sample, BlockSums& sums) {
  const auto loaded = within(pushes.loaded, first, last);
  if (!loaded.empty()) work_before(m, s, pushes, loaded, sums);
  if (lane_kernels().advance(kick_of(m, s, e), arrays(s, constants, pushes), first, last, sample, sums.work)) sums.broken = true;
  if (!loaded.empty()) work_after(s, pushes, loaded, sums);
  for (double& stale : sums.work.stale) {
    sums.stale = sums.stale || stale > 0;
    stale = 0;
  }
}

void advance_one(const Model& m, State& s, const Excitation& e, const Pushes& pushes, int b, bool sample, BlockSums& sums) {
  const int k = b / lanes, l = b % lanes;
  BlockConstants alone;
  for (int i = 0; i < lanes; ++i) set_constants(m, s, k * lanes + i, i == l, alone);
  BlockArrays group = arrays(s, {}, pushes);
  group.constant = &alone;
  group.u += k, group.v += k, group.momentum += k, group.w += k, group.q += k, group.base_u += k, group.base_q += k;
  group.row += 64L * k;
  if (group.push != nullptr) group.push += 64L * k;
  if (group.load != nullptr) group.load += 64L * k;
  const RowLanes<3> u = *group.u, v = *group.v, momentum = *group.momentum, w = *group.w;
  const RowLanes<4> q = *group.q;
  double row[64];
  std::copy_n(group.row, 64, row);
  LoadedBlock loaded{b, Mat3::Zero()};
  const std::span<LoadedBlock> mine(&loaded, pushes.loads != nullptr ? 1 : 0);
  if (!mine.empty()) work_before(m, s, pushes, mine, sums);
  if (lane_kernels().advance(kick_of(m, s, e), group, 0, 1, sample, sums.work)) sums.broken = true;
  if (!mine.empty()) work_after(s, pushes, mine, sums);
  for (int i = 0; i < lanes; ++i) {
    if (i == l) continue;
    for (int c = 0; c < 3; ++c) group.u->x[c][i] = u.x[c][i], group.v->x[c][i] = v.x[c][i], group.momentum->x[c][i] = momentum.x[c][i], group.w->x[c][i] = w.x[c][i];
    for (int c = 0; c < 4; ++c) group.q->x[c][i] = q.x[c][i];
    std::copy_n(row + 8 * i, 8, group.row + 8 * i);
  }
  sums.stale = sums.stale || sums.work.stale[l] > 0;
  std::fill_n(sums.work.stale, lanes, 0.0);
}

}  // namespace erbs
