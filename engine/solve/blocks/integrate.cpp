#include "engine/solve/blocks/integrate.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/base/count.h"
#include "engine/model/joint_packs.h"

// Rotation: the implicit midpoint rule in the body frame conserves |L| and the energy exactly, since both are quadratic. The Cayley map of
// the attitude conserves L in the world frame (Simo and Wong 1991, Int. J. Numer. Meth. Eng. 31, section 4, momentum form).

namespace erbs {
namespace {

KickDrift kick_of(const Model& m, const State& s, const Excitation& e, bool inertia) {
  KickDrift k{};
  k.kick = e.kick;
  k.dt = s.time.dt;
  k.half_last = 0.5 * s.time.last_dt;
  k.half_next = 0.5 * s.time.dt;
  k.first = s.time.last_dt == 0;
  k.more = 2 * k.half_last / k.kick - 1;
  k.shortens = !inertia || k.first ? 0 : 0.25 * (s.time.last_dt - s.time.dt) / k.kick;
  k.damping = m.damping.mass;
  k.local = m.local_damping;
  k.relaxes = inertia || k.damping > 0 || k.local > 0 || !m.gravity_factor.empty();
  k.damping_explicit = m.damping_explicit;
  const double f = 0.5 * k.damping * k.kick;
  k.damped_keep = m.damping_explicit ? -k.damping * k.kick : (1 - f) / (1 + f) - 1;
  k.damped_kick = m.damping_explicit ? 0 : 1 / (1 + f) - 1;
  k.gyroscopic = m.analysis.gyroscopic;
  k.shaken = !m.grounds.empty();
  for (int i = 0; i < 3; ++i) k.ground[i] = e.ground[i], k.gravity[i] = e.gravity[i];
  return k;
}

BlockArrays arrays(const Model& m, State& s, const std::vector<BlockConstants>& constants, const ExternalForces& external, double* poses) {
  return {constants.data(),
          s.pose.u.data(),
          s.motion.v.data(),
          s.motion.spin_momentum.data(),
          s.motion.w.data(),
          s.pose.q.data(),
          s.cache.ref_u.data(),
          s.cache.ref_q.data(),
          owner_computes(m) ? nullptr : s.cache.pose_row.data(),
          poses,
          s.cache.increment.data(),
          s.cache.owner_sum.data(),
          s.cache.neighbour_force.data(),
          m.owner_schedule.gather_in.data(),
          s.cache.wrench.data(),
          external.contacts,
          external.loads,
          external.load_since,
          external.load_next,
          external.inertia};
}

double power(const State& s, const double* loads, const LoadedBlock& l) {
  const auto load = Eigen::Map<const Vec6>(loads + 8 * l.block);
  return load.head<3>().dot(s.motion.v[z(l.block)]) + load.tail<3>().dot(l.inverse_inertia * s.motion.spin_momentum[z(l.block)]);
}

// The blocks with loads among [first, last).
std::span<LoadedBlock> within(std::span<LoadedBlock> all, int first, int last) {
  const auto before = [](const LoadedBlock& l, int b) { return l.block < b; };
  const auto from = std::lower_bound(all.begin(), all.end(), first, before), to = std::lower_bound(from, all.end(), last, before);
  return {from, to};
}

void work_before(const Model& m, const State& s, const ExternalForces& external, std::span<LoadedBlock> loaded, BlockSums& sums) {
  sums.external_work += sums.external_after;
  sums.external_absolute += sums.external_absolute_after;
  sums.external_after = sums.external_absolute_after = 0;
  for (LoadedBlock& l : loaded) {
    const Mat3 r = s.pose.q[z(l.block)].toRotationMatrix();
    l.inverse_inertia = r * m.inverse_inertia[z(l.block)] * r.transpose();
    const double since = external.load_since ? external.load_since[l.block] : s.time.last_dt;
    const double work = 0.5 * since * power(s, external.loads, l);
    sums.external_work += work;
    sums.external_absolute += std::fabs(work);
  }
}

void work_after(const State& s, const ExternalForces& external, std::span<LoadedBlock> loaded, BlockSums& sums) {
  for (const LoadedBlock& l : loaded) {
    const double next = external.load_next ? external.load_next[l.block] : s.time.dt;
    const double work = 0.5 * next * power(s, external.loads, l);
    sums.external_after += work;
    sums.external_absolute_after += std::fabs(work);
  }
}

void set_constants(const Model& m, const State& s, int b, bool moving, BlockConstants& c) {
  constexpr int row[6] = {0, 1, 2, 1, 0, 0}, column[6] = {0, 1, 2, 2, 2, 1};
  const int l = b % pack_size;
  c.mass[l] = moving ? m.mass[z(b)] : 0;
  if (moving && !s.sleep.asleep.empty() && s.sleep.asleep[z(b)]) moving = false;  // its mass still counts in the potential energy
  c.moving[l] = moving;
  c.inverse_mass[l] = moving ? m.inverse_mass[z(b)] : 0;
  c.gravity_factor[l] = moving ? weight_share(m, b) : 1;
  c.damped[l] = moving && (m.damping_all || s.topology.grounded[z(b)]);
  for (int i = 0; i < 6; ++i) c.inverse_inertia[i][l] = moving ? m.inverse_inertia[z(b)](row[i], column[i]) : 0;
}

void count_wrench_slots(const Model& m, int b, std::vector<BlockConstants>& constants) {
  const std::size_t g = z(b / pack_size);
  constants[g].wrench_slots = m.first_wrench_slot[g + 1] - m.first_wrench_slot[g];
}

}  // namespace

std::vector<BlockConstants> block_constants(const Model& m, const State& s) {
  std::vector<BlockConstants> out(block_groups(m.nblock));
  for (int b = 0; b < int(out.size()) * pack_size; ++b)
    set_constants(m, s, b, b < m.nblock && m.kind[z(b)] == Kind::moving, out[z(b / pack_size)]);
  // Groups on which an intact joint acts. A joint that cracked in this step still counts: its lane has its forces until the next step.
  std::vector<std::uint8_t> intact(out.size(), 0);
  for (int j = 0; j < m.njoint; ++j)
    if (s.joints.stage[z(j)] == JointStage::intact) intact[z(m.joint[z(j)].a / pack_size)] = intact[z(m.joint[z(j)].b / pack_size)] = 1;
  const double* const neighbour_force = owner_computes(m) ? s.cache.neighbour_force.front().x[0] : nullptr;
  for (int b = 0; owner_computes(m) && b < m.nblock; ++b)
    for (int k = m.owner_schedule.first_end[z(b)]; k < m.owner_schedule.first_end[z(b) + 1]; ++k)
      for (int i = 0; i < 6; ++i) intact[z(b / pack_size)] |= neighbour_force[m.owner_schedule.end[z(k)] + pack_size * i] != 0;
  for (int g = 0; g < int(out.size()); ++g) {
    out[z(g)].first_wrench_slot = m.first_wrench_slot[z(g)];
    if (!owner_computes(m)) {
      count_wrench_slots(m, g * pack_size, out);
      continue;
    }
    out[z(g)].first_gather = m.owner_schedule.first_gather[z(g)];
    if (intact[z(g)]) out[z(g)].gathers = m.owner_schedule.first_gather[z(g) + 1] - out[z(g)].first_gather;
  }
  for (int j = 0; j < m.njoint; ++j)
    if (s.joints.stage[z(j)] != JointStage::intact)
      count_wrench_slots(m, m.joint[z(j)].a, out), count_wrench_slots(m, m.joint[z(j)].b, out);
  set_rotation_limits(m, s, out);
  return out;
}

void set_rotation_limits(const Model& m, const State& s, std::vector<BlockConstants>& constants) {
  for (BlockConstants& c : constants) {
    std::fill_n(c.rotation_limit, pack_size, std::numeric_limits<double>::infinity());
    c.carried = !owner_computes(m);
  }
  for (int j = 0; j < m.njoint; ++j) {
    if (s.joints.stage[z(j)] != JointStage::intact) continue;
    for (const int b : {m.joint[z(j)].a, m.joint[z(j)].b}) {
      BlockConstants& c = constants[z(b / pack_size)];
      c.carried = true;
      if (c.moving[b % pack_size] > 0) c.rotation_limit[b % pack_size] = s.cache.lazy_rotation * s.cache.lazy_rotation;
    }
  }
}

void use_wrench_rows(const Model& m, State& s, int b, std::vector<BlockConstants>& constants) {
  count_wrench_slots(m, b, constants);
  if (owner_computes(m)) return;  // no kernel reads pose rows then
  for (int of_group = b / pack_size * pack_size; of_group < std::min((b / pack_size + 1) * pack_size, m.nblock); ++of_group)
    for (int i = 0; i < 6; ++i) s.cache.pose_row[z(8 * of_group + i)] = s.cache.increment[z(b / pack_size)].x[i][of_group % pack_size];
}

std::vector<std::uint8_t> idle_groups(const Model& m, const State& s) {
  if (s.sleep.count == 0) return {};
  std::vector<std::uint8_t> idle(block_groups(m.nblock), 0);
  for (int k = 0; k < int(idle.size()); ++k) {
    int asleep = 0, awake = 0;
    for (int b = k * pack_size; b < std::min((k + 1) * pack_size, m.nblock); ++b) {
      if (m.kind[z(b)] == Kind::fixed) continue;
      ++(s.sleep.asleep[z(b)] ? asleep : awake);
    }
    idle[z(k)] = asleep > 0 && awake == 0;
  }
  return idle;
}

Vec6 joint_wrench(const Model& m, const State& s, int b) {
  alignas(64) double sum[8] = {};
  m.each_wrench_row(b, [&](int row) {
    for (int i = 0; i < 6; ++i) sum[i] += s.cache.wrench[z(row) * 8 + z(i)];
  });
  for (int i = 0; i < 6; ++i) sum[i] += s.cache.owner_sum[z(b / pack_size)].x[i][b % pack_size];
  const double* const neighbour_force = s.cache.neighbour_force.front().x[0];
  for (int k = m.owner_schedule.first_end[z(b)]; k < m.owner_schedule.first_end[z(b) + 1]; ++k)
    for (int i = 0; i < 6; ++i) sum[i] += neighbour_force[m.owner_schedule.end[z(k)] + pack_size * i];
  return Eigen::Map<const Vec6>(sum);
}

namespace {

void gather_outdated(BlockSums& sums) {
  for (double& outdated : sums.work.outdated) {
    sums.outdated = sums.outdated || outdated > 0;
    outdated = 0;
  }
}

}  // namespace

void advance(const Model& m, State& s, const std::vector<BlockConstants>& constants, const Excitation& e, const ExternalForces& external,
             Range groups, bool sample, std::vector<BlockSums>& all, std::span<const std::uint8_t> idle, double* poses) {
  const KickDrift step = kick_of(m, s, e, external.inertia != nullptr);
  const BlockArrays blocks = arrays(m, s, constants, external, poses);
  const StepKernels& kernels = step_kernels();
  const bool summed = sample || step.shaken || step.relaxes || !external.loaded.empty();
  const int piece = summed ? block_grain : std::max(1, groups.last - groups.first);
  for (int first = groups.first; first < groups.last; first += piece) {
    const int last = std::min(first + piece, groups.last);
    BlockSums& sums = all[z(first / block_grain)];
    const auto loaded = within(external.loaded, first * pack_size, last * pack_size);
    if (!loaded.empty()) work_before(m, s, external, loaded, sums);
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
    if (!loaded.empty()) work_after(s, external, loaded, sums);
    gather_outdated(sums);
  }
}

void sum_forces(const Model& m, State& s, const std::vector<BlockConstants>& constants, const Excitation& e, const ExternalForces& external,
                Range groups, VectorPack<6>* out) {
  step_kernels().forces(kick_of(m, s, e, false), arrays(m, s, constants, external, nullptr), groups.first, groups.last, out);
}

BlockGather::BlockGather(const Model& m, State& s, const std::vector<BlockConstants>& constants, const Excitation& e,
                         const ExternalForces& external)
    : model_(m), state_(s), constants_(constants), external_(external), kernels_(step_kernels()), step_(kick_of(m, s, e, false)) {
  constant_.carried = true;
}

void BlockGather::copy_in(int b, int lane) {
  const std::size_t k = z(b / pack_size), to = z(lane);
  const int l = b % pack_size;
  const BlockConstants& c = constants_[k];
  constant_.mass[to] = c.mass[l], constant_.inverse_mass[to] = c.inverse_mass[l];
  constant_.moving[to] = c.moving[l], constant_.damped[to] = c.damped[l];
  constant_.gravity_factor[to] = c.gravity_factor[l];
  for (int i = 0; i < 6; ++i) constant_.inverse_inertia[i][to] = c.inverse_inertia[i][l];
  constant_.rotation_limit[to] = c.rotation_limit[l];
  const State& s = state_;
  const Vec6 wrench = b < model_.nblock ? joint_wrench(model_, s, b) : Vec6(Vec6::Zero());
  for (int i = 0; i < 6; ++i) wrench_.x[i][to] = wrench[i];
  for (int i = 0; i < 3; ++i) {
    u_.x[i][to] = s.pose.u.data()[k].x[i][l];
    v_.x[i][to] = s.motion.v.data()[k].x[i][l];
    momentum_.x[i][to] = s.motion.spin_momentum.data()[k].x[i][l];
    ref_u_.x[i][to] = s.cache.ref_u.data()[k].x[i][l];
  }
  for (int i = 0; i < 4; ++i) {
    q_.x[i][to] = s.pose.q.data()[k].x[i][l];
    ref_q_.x[i][to] = s.cache.ref_q.data()[k].x[i][l];
  }
  if (external_.contacts != nullptr) std::copy_n(external_.contacts + 8 * z(b), 8, contact_wrench_ + 8 * to);
  if (external_.loads != nullptr) std::copy_n(external_.loads + 8 * z(b), 8, load_ + 8 * to);
}

void BlockGather::copy_out(int b, int lane) {
  const std::size_t k = z(b / pack_size), from = z(lane);
  const int l = b % pack_size;
  State& s = state_;
  for (int i = 0; i < 3; ++i) {
    s.pose.u.data()[k].x[i][l] = u_.x[i][from];
    s.motion.v.data()[k].x[i][l] = v_.x[i][from];
    s.motion.spin_momentum.data()[k].x[i][l] = momentum_.x[i][from];
    s.motion.w.data()[k].x[i][l] = w_.x[i][from];
  }
  for (int i = 0; i < 4; ++i) s.pose.q.data()[k].x[i][l] = q_.x[i][from];
  for (int i = 0; i < 6; ++i) s.cache.increment[k].x[i][l] = s.cache.pose_row[8 * z(b) + z(i)] = increment_.x[i][from];
}

template <class F>
void BlockGather::each_loaded(const int* blocks, int count, F&& f) const {
  for (int i = 0; i < count && !external_.loaded.empty(); ++i)
    if (const auto one = within(external_.loaded, blocks[i], blocks[i] + 1); !one.empty())
      f(one, z(int(one.data() - external_.loaded.data())) + 1);
}

void BlockGather::advance(const int* blocks, int count, bool sample, std::vector<BlockSums>& sums) {
  for (int l = 0; l < pack_size; ++l) copy_in(l < count ? blocks[l] : model_.nblock, l);  // unused lanes: the dummy block at rest
  each_loaded(blocks, count, [&](auto one, std::size_t i) { work_before(model_, state_, external_, one, sums[i]); });
  const double *contact_wrench = external_.contacts != nullptr ? contact_wrench_ : nullptr,
               *load = external_.loads != nullptr ? load_ : nullptr;
  const BlockArrays group{&constant_, &u_,         &v_,      &momentum_, &w_,     &q_,     &ref_u_,        &ref_q_, nullptr,
                          nullptr,    &increment_, &wrench_, nullptr,    nullptr, nullptr, contact_wrench, load};
  BlockSums& all = sums.front();
  if (kernels_.advance(step_, group, 0, 1, sample, all.work)) all.broken = true;
  for (int l = 0; l < count; ++l) copy_out(blocks[l], l);
  each_loaded(blocks, count, [&](auto one, std::size_t i) { work_after(state_, external_, one, sums[i]); });
  gather_outdated(all);
}

}  // namespace erbs
