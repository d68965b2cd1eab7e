#include "engine/solve/integrate.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/model/batches.h"

// Rotation: the implicit midpoint rule in the body frame conserves |L| and the energy exactly, since both are quadratic. The Cayley map of
// the attitude conserves L in the world frame (Simo and Wong 1991, Int. J. Numer. Meth. Eng. 31, section 4, momentum form).

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

BlockArrays arrays(const Model& m, State& s, const std::vector<BlockConstants>& constants, const Pushes& pushes, double* poses) {
  return {constants.data(),
          s.u.data(),
          s.v.data(),
          s.spin_momentum.data(),
          s.w.data(),
          s.q.data(),
          s.base_u.data(),
          s.base_q.data(),
          keepers(m) ? nullptr : s.row.data(),
          poses,
          s.shift.data(),
          s.kept.data(),
          s.given.data(),
          m.kept.taken.data(),
          s.wrench.data(),
          pushes.contacts,
          pushes.loads};
}

double power(const State& s, const double* loads, const LoadedBlock& l) {
  const auto load = Eigen::Map<const Vec6>(loads + 8 * l.block);
  return load.head<3>().dot(s.v[z(l.block)]) + load.tail<3>().dot(l.inverse_inertia * s.spin_momentum[z(l.block)]);
}

// The blocks with loads among [first, last).
std::span<LoadedBlock> within(std::span<LoadedBlock> all, int first, int last) {
  const auto before = [](const LoadedBlock& l, int b) { return l.block < b; };
  const auto from = std::lower_bound(all.begin(), all.end(), first, before), to = std::lower_bound(from, all.end(), last, before);
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
  c.mass[l] = moving ? m.mass[z(b)] : 0;
  if (moving && !s.rest.asleep.empty() && s.rest.asleep[z(b)]) moving = false;  // its mass still counts in the potential energy
  c.moving[l] = moving;
  c.inverse_mass[l] = moving ? m.inverse_mass[z(b)] : 0;
  c.damped[l] = moving && (m.damping_all || s.grounded[z(b)]);
  for (int i = 0; i < 6; ++i) c.inverse_inertia[i][l] = moving ? m.inverse_inertia[z(b)](row[i], column[i]) : 0;
}

void sum_rows(const Model& m, int b, std::vector<BlockConstants>& constants) {
  const std::size_t g = z(b / lanes);
  constants[g].slots = m.first_slot[g + 1] - m.first_slot[g];
}

}  // namespace

std::vector<BlockConstants> block_constants(const Model& m, const State& s) {
  std::vector<BlockConstants> out(block_groups(m.nblock));
  for (int b = 0; b < int(out.size()) * lanes; ++b) set_constants(m, s, b, b < m.nblock && m.kind[z(b)] == Kind::moving, out[z(b / lanes)]);
  // Groups on which an intact joint acts. A joint that cracked in this step still counts: its lane has its forces until the next step.
  std::vector<std::uint8_t> sound(out.size(), 0);
  for (int j = 0; j < m.njoint; ++j)
    if (s.tier[z(j)] == Tier::intact) sound[z(m.joint[z(j)].a / lanes)] = sound[z(m.joint[z(j)].b / lanes)] = 1;
  const double* const given = keepers(m) ? s.given.front().x[0] : nullptr;
  for (int b = 0; keepers(m) && b < m.nblock; ++b)
    for (int k = m.kept.first_end[z(b)]; k < m.kept.first_end[z(b) + 1]; ++k)
      for (int i = 0; i < 6; ++i) sound[z(b / lanes)] |= given[m.kept.end[z(k)] + lanes * i] != 0;
  for (int g = 0; g < int(out.size()); ++g) {
    out[z(g)].first_slot = m.first_slot[z(g)];
    if (!keepers(m)) {
      sum_rows(m, g * lanes, out);
      continue;
    }
    out[z(g)].first_taken = m.kept.first_taken[z(g)];
    if (sound[z(g)]) out[z(g)].taken = m.kept.first_taken[z(g) + 1] - out[z(g)].first_taken;
  }
  for (int j = 0; j < m.njoint; ++j)
    if (s.tier[z(j)] != Tier::intact) sum_rows(m, m.joint[z(j)].a, out), sum_rows(m, m.joint[z(j)].b, out);
  let_turn(m, s, out);
  return out;
}

void let_turn(const Model& m, const State& s, std::vector<BlockConstants>& constants) {
  for (BlockConstants& c : constants) {
    std::fill_n(c.turn_limit, lanes, std::numeric_limits<double>::infinity());
    c.carried = !keepers(m);
  }
  for (int j = 0; j < m.njoint; ++j) {
    if (s.tier[z(j)] != Tier::intact) continue;
    for (const int b : {m.joint[z(j)].a, m.joint[z(j)].b}) {
      BlockConstants& c = constants[z(b / lanes)];
      c.carried = true;
      if (c.moving[b % lanes] > 0) c.turn_limit[b % lanes] = m.analysis.lazy_rotation * m.analysis.lazy_rotation;
    }
  }
}

void go_by_rows(const Model& m, State& s, int b, std::vector<BlockConstants>& constants) {
  sum_rows(m, b, constants);
  if (keepers(m)) return;  // no kernel reads pose rows then
  for (int of_group = b / lanes * lanes; of_group < std::min((b / lanes + 1) * lanes, m.nblock); ++of_group)
    for (int i = 0; i < 6; ++i) s.row[z(8 * of_group + i)] = s.shift[z(b / lanes)].x[i][of_group % lanes];
}

std::vector<std::uint8_t> idle_groups(const Model& m, const State& s) {
  if (s.rest.count == 0) return {};
  std::vector<std::uint8_t> idle(block_groups(m.nblock), 0);
  for (int k = 0; k < int(idle.size()); ++k) {
    int asleep = 0, awake = 0;
    for (int b = k * lanes; b < std::min((k + 1) * lanes, m.nblock); ++b) {
      if (m.kind[z(b)] == Kind::fixed) continue;
      ++(s.rest.asleep[z(b)] ? asleep : awake);
    }
    idle[z(k)] = asleep > 0 && awake == 0;
  }
  return idle;
}

Vec6 joint_wrench(const Model& m, const State& s, int b) {
  alignas(64) double sum[8] = {};
  m.each_row(b, [&](int row) {
    for (int i = 0; i < 6; ++i) sum[i] += s.wrench[z(row) * 8 + z(i)];
  });
  for (int i = 0; i < 6; ++i) sum[i] += s.kept[z(b / lanes)].x[i][b % lanes];
  const double* const given = s.given.front().x[0];
  for (int k = m.kept.first_end[z(b)]; k < m.kept.first_end[z(b) + 1]; ++k)
    for (int i = 0; i < 6; ++i) sum[i] += given[m.kept.end[z(k)] + lanes * i];
  return Eigen::Map<const Vec6>(sum);
}

namespace {

void gather_stale(BlockSums& sums) {
  for (double& stale : sums.work.stale) {
    sums.stale = sums.stale || stale > 0;
    stale = 0;
  }
}

}  // namespace

void advance(const Model& m, State& s, const std::vector<BlockConstants>& constants, const Excitation& e, const Pushes& pushes,
             Range groups, bool sample, std::vector<BlockSums>& all, std::span<const std::uint8_t> idle, double* poses) {
  const KickDrift step = kick_of(m, s, e);
  const BlockArrays blocks = arrays(m, s, constants, pushes, poses);
  const LaneKernels& kernels = lane_kernels();
  const bool summed = sample || step.shaken || step.damping > 0 || !pushes.loaded.empty();
  const int piece = summed ? block_grain : std::max(1, groups.last - groups.first);
  for (int first = groups.first; first < groups.last; first += piece) {
    const int last = std::min(first + piece, groups.last);
    BlockSums& sums = all[z(first / block_grain)];
    const auto loaded = within(pushes.loaded, first * lanes, last * lanes);
    if (!loaded.empty()) work_before(m, s, pushes, loaded, sums);
    if (idle.empty() || sample) {
      if (kernels.advance(step, blocks, first, last, sample, sums.work)) sums.broken = true;
    } else {
      for (int from = first; from < last; ++from) {
        if (idle[z(from)]) continue;
        int to = from + 1;
        while (to < last && !idle[z(to)]) ++to;
        if (kernels.advance(step, blocks, from, to, sample, sums.work)) sums.broken = true;
        from = to;
      }
    }
    if (!loaded.empty()) work_after(s, pushes, loaded, sums);
    gather_stale(sums);
  }
}

Picked::Picked(const Model& m, State& s, const std::vector<BlockConstants>& constants, const Excitation& e, const Pushes& pushes)
    : model_(m), state_(s), constants_(constants), pushes_(pushes), kernels_(lane_kernels()), step_(kick_of(m, s, e)) {
  constant_.carried = true;
}

void Picked::copy_in(int b, int lane) {
  const std::size_t k = z(b / lanes), to = z(lane);
  const int l = b % lanes;
  const BlockConstants& c = constants_[k];
  constant_.mass[to] = c.mass[l], constant_.inverse_mass[to] = c.inverse_mass[l];
  constant_.moving[to] = c.moving[l], constant_.damped[to] = c.damped[l];
  for (int i = 0; i < 6; ++i) constant_.inverse_inertia[i][to] = c.inverse_inertia[i][l];
  constant_.turn_limit[to] = c.turn_limit[l];
  const State& s = state_;
  const Vec6 wrench = b < model_.nblock ? joint_wrench(model_, s, b) : Vec6(Vec6::Zero());
  for (int i = 0; i < 6; ++i) wrench_.x[i][to] = wrench[i];
  for (int i = 0; i < 3; ++i) {
    u_.x[i][to] = s.u.data()[k].x[i][l];
    v_.x[i][to] = s.v.data()[k].x[i][l];
    momentum_.x[i][to] = s.spin_momentum.data()[k].x[i][l];
    base_u_.x[i][to] = s.base_u.data()[k].x[i][l];
  }
  for (int i = 0; i < 4; ++i) {
    q_.x[i][to] = s.q.data()[k].x[i][l];
    base_q_.x[i][to] = s.base_q.data()[k].x[i][l];
  }
  if (pushes_.contacts != nullptr) std::copy_n(pushes_.contacts + 8 * z(b), 8, push_ + 8 * to);
  if (pushes_.loads != nullptr) std::copy_n(pushes_.loads + 8 * z(b), 8, load_ + 8 * to);
}

void Picked::copy_out(int b, int lane) {
  const std::size_t k = z(b / lanes), from = z(lane);
  const int l = b % lanes;
  State& s = state_;
  for (int i = 0; i < 3; ++i) {
    s.u.data()[k].x[i][l] = u_.x[i][from];
    s.v.data()[k].x[i][l] = v_.x[i][from];
    s.spin_momentum.data()[k].x[i][l] = momentum_.x[i][from];
    s.w.data()[k].x[i][l] = w_.x[i][from];
  }
  for (int i = 0; i < 4; ++i) s.q.data()[k].x[i][l] = q_.x[i][from];
  for (int i = 0; i < 6; ++i) s.shift[k].x[i][l] = s.row[8 * z(b) + z(i)] = shift_.x[i][from];
}

template <class F>
void Picked::each_loaded(const int* blocks, int count, F&& f) const {
  for (int i = 0; i < count && !pushes_.loaded.empty(); ++i)
    if (const auto one = within(pushes_.loaded, blocks[i], blocks[i] + 1); !one.empty())
      f(one, z(int(one.data() - pushes_.loaded.data())) + 1);
}

void Picked::advance(const int* blocks, int count, bool sample, std::vector<BlockSums>& sums) {
  for (int l = 0; l < lanes; ++l) copy_in(l < count ? blocks[l] : model_.nblock, l);  // unused lanes: the dummy block at rest
  each_loaded(blocks, count, [&](auto one, std::size_t i) { work_before(model_, state_, pushes_, one, sums[i]); });
  const double *push = pushes_.contacts != nullptr ? push_ : nullptr, *load = pushes_.loads != nullptr ? load_ : nullptr;
  const BlockArrays group{&constant_, &u_,     &v_,      &momentum_, &w_,     &q_,     &base_u_, &base_q_, nullptr,
                          nullptr,    &shift_, &wrench_, nullptr,    nullptr, nullptr, push,     load};
  BlockSums& all = sums.front();
  if (kernels_.advance(step_, group, 0, 1, sample, all.work)) all.broken = true;
  for (int l = 0; l < count; ++l) copy_out(blocks[l], l);
  each_loaded(blocks, count, [&](auto one, std::size_t i) { work_after(state_, pushes_, one, sums[i]); });
  gather_stale(all);
}

}  // namespace erbs
