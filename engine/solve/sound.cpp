#include "engine/solve/sound.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/model/batches.h"
#include "engine/solve/joint_geometry.h"

namespace erbs {
namespace {

std::size_t z(int i) { return std::size_t(i); }

// Packs of more bytes than this do not stay in the cache. Measured for 951, 9,700, 15,000 and 29,900 blocks (0.5, 5, 7.7, 15 MB): prefetch
// of the fourth pack ahead costs 1 % and 3 %, and saves 7 % and 30 % of a step. The processor's own prefetch ends at every page.
constexpr std::size_t near_bytes = 6 << 20;
constexpr int batches_ahead = 4;

// Minus twice the sum of k_i e_i e_i^T over the axes e_i of the joint frame; k_i is the stiffness against rotation about e_i.
void set_bending_stiffness(const JointBatch& B, int from, double out[6][lanes], int to) {
  constexpr int row[6] = {0, 1, 2, 1, 0, 0}, column[6] = {0, 1, 2, 2, 2, 1};
  for (int i = 0; i < 6; ++i) {
    out[i][to] = 0;
    for (int axis = 0; axis < 3; ++axis)
      out[i][to] -= 2 * B.stiffness[3 + axis][from] * B.frame[3 * axis + row[i]][from] * B.frame[3 * axis + column[i]][from];
  }
}

}  // namespace

void set_sound_lane(const JointBatch& B, int from, SoundBatch& out, SoundLaw& law, int to, bool turned) {
  const double sign = turned ? -1 : 1;
  for (int i = 0; i < 3; ++i) {
    out.gap[i][to] = sign * B.gap[i][from];
    out.turn[i][to] = 0.5 * sign * B.turn[i][from];
    out.normal[i][to] = sign * B.frame[6 + i][from];
    (turned ? out.arm_b : out.arm_a)[i][to] = B.arm_a[i][from];
    (turned ? out.arm_a : out.arm_b)[i][to] = B.arm_b[i][from];
  }
  set_bending_stiffness(B, from, out.bend, to);
  law.shear[to] = -B.stiffness[0][from];
  law.across[to] = B.stiffness[0][from] - B.stiffness[2][from];
  law.open_limit[to] = B.open_limit[from];
  law.slip_limit[to] = B.slip_limit[from];
  law.slip_slope[to] = B.slip_slope[from];
  law.close_limit[to] = B.close_limit[from];
  law.diameter[to] = 2 * B.radius[from];
}

void clear_sound_lane(SoundBatch& out, SoundLaw& law, int lane) {
  for (auto* field : {out.gap, out.turn, out.arm_a, out.arm_b, out.normal})
    for (int i = 0; i < 3; ++i) field[i][lane] = 0;
  for (auto& k : out.bend) k[lane] = 0;
  law.shear[lane] = law.across[lane] = law.slip_slope[lane] = law.diameter[lane] = 0;
  law.open_limit[lane] = law.slip_limit[lane] = law.close_limit[lane] = std::numeric_limits<double>::infinity();
}

Sound::Sound(const Model& model, State& state) : model_(model), state_(state), carried_(std::pow(model.analysis.lazy_rotation, 3)) {
  if (model.analysis.kernel == "reference" || model.analysis.solver == "sequential") return;  // these have their own
  if (model.dashpots) {
    for (int k = 0; k < sound_batches(model); ++k) damped_.push_back(sound_batch(model, state, k));
    return;
  }
  const KeptLanes& kept = model.kept;
  batch_.resize(kept.other.size());
  ahead_ = batch_.size() * sizeof(SoundBatch) > near_bytes ? batches_ahead : 0;
  looked_at_.resize(batch_.size());
  closer_.assign(batch_.size(), nullptr);
  near_.resize(batch_.size() + 1);
  for (int k = 0; k < int(batch_.size()); ++k) {
    int joints[lanes];
    joints_in_place(k, joints);
    const JointBatch batch = batch_of(model, state, joints);
    SoundBatch& out = batch_[z(k)];
    SoundLaw law;
    for (int l = 0; l < lanes; ++l)
      if (joints[l] >= 0) set_sound_lane(batch, l, out, law, l, model.joint[z(joints[l])].kept_by_b), ++out.used;
      else clear_sound_lane(out, law, l);
    out.law = &*law_.insert(law).first;
    out.other = kept.other[z(k)];
  }
  for (int g = 0; g + 1 < int(kept.first_batch.size()); ++g) {
    held_.push_back(0);
    for (int k = kept.first_batch[z(g)]; k < kept.first_batch[z(g) + 1]; ++k) held_.back() += batch_[z(k)].used;
    if (held_.back() == 0 && kept.first_batch[z(g)] < kept.first_batch[z(g) + 1]) all_held_ = false;
  }
}

void Sound::joints_in_place(int k, int joints[lanes]) const {
  for (int l = 0; l < lanes; ++l) {
    const int j = model_.kept.joint[z(k * lanes + l)];
    joints[l] = j >= 0 && state_.place[z(j)] == j ? j : -1;
  }
}

// By whole packs: joints without a change give the same bits again.
void Sound::refresh(const std::vector<std::uint8_t>& stale) {
  for (int k = 0; k < int(damped_.size()); ++k) {
    const JointBatch& b = damped_[z(k)];
    bool any = false;
    for (int l = 0; l < lanes; ++l) any = any || stale[z(b.a[l])] || stale[z(b.b[l])];
    if (any) damped_[z(k)] = sound_batch(model_, state_, k);
  }
  for (int k = 0; k < int(batch_.size()); ++k) {
    int joints[lanes];
    joints_in_place(k, joints);
    bool any = false;
    for (const int j : joints) any = any || (j >= 0 && (stale[z(model_.joint[z(j)].a)] || stale[z(model_.joint[z(j)].b)]));
    if (any) set_lanes(k);
  }
}

// Geometry of pack k at the reference poses: `set_sound_lane()` for eight lanes at once.
void Sound::set_lanes(int k) {
  int joints[lanes];
  joints_in_place(k, joints);
  JointBatch aside, &geometry = looked_at_[z(k)] ? *looked_at_[z(k)] : aside;
  set_geometry(model_, state_, joints, geometry);
  constexpr double nothing[3] = {};
  SoundLanes lane;
  for (int l = 0; l < lanes; ++l) {
    lane.sign[l] = joints[l] >= 0 && model_.joint[z(joints[l])].kept_by_b ? -1 : 1;
    lane.bending[l] = joints[l] >= 0 ? model_.joint[z(joints[l])].type->stiffness + 3 : nothing;
  }
  lane_kernels().sound_pose(geometry, lane, batch_[z(k)]);
}

void Sound::leave(int j) {
  if (!damped_.empty()) clear_lane(model_, damped_[z(j / lanes)], j % lanes);
  if (batch_.empty()) return;
  const int lane = model_.kept.lane[z(j)], k = lane / lanes;
  looked_at_[z(k)].reset();
  closer_[z(k)] = nullptr;
  SoundBatch& out = batch_[z(k)];
  SoundLaw law = *out.law;
  clear_sound_lane(out, law, lane % lanes);
  out.law = &*law_.insert(law).first;
  --out.used;
  if (--held_[z(model_.keeper(j) / lanes)] == 0) all_held_ = false;
}

// Replaces the elastic force of joint j in the sums of the pass by its force after cracking; its lane transmits it until the next step.
void Sound::take_over(int j, const JointBatch& batch, const JointLanes& before, const JointLanes& now) {
  JointBatch aside = batch;
  for (int l = 0; l < lanes; ++l) aside.row_a[l] = l, aside.row_b[l] = lanes + l;
  alignas(64) double was[2 * 8 * lanes], is[2 * 8 * lanes];
  lane_kernels().wrenches(aside, before, was);
  lane_kernels().wrenches(aside, now, is);
  const bool by_b = model_.joint[z(j)].kept_by_b;
  const int k = model_.kept.lane[z(j)] / lanes, lane = model_.kept.lane[z(j)] % lanes, keeper = model_.keeper(j);
  const int own = 8 * (by_b ? lanes + lane : lane), other = 8 * (by_b ? lane : lanes + lane);
  for (int i = 0; i < 6; ++i) {
    state_.kept[z(keeper / lanes)].x[i][keeper % lanes] += is[own + i] - was[own + i];
    state_.given[z(k)].x[i][lane] = is[other + i];
  }
}

// Evaluates the joints of a pack that may be beyond a limit point by point. The force changes only if a joint cracks.
void Sound::look_closer(int k, bool sample, JointSums& sums) {
  JointLanes o;
  int joints[lanes];
  joints_in_place(k, joints);
  if (!looked_at_[z(k)]) {  // this pack reads the pose rows made below
    looked_at_[z(k)] = std::make_unique<JointBatch>(batch_of(model_, state_, joints));
    for (int l = 0; l < lanes; ++l) looked_at_[z(k)]->a[l] = l, looked_at_[z(k)]->b[l] = lanes + l;
    closer_[z(k)] = looked_at_[z(k)].get();
    closely_.store(true, std::memory_order_relaxed);
  }
  const JointBatch& B = *looked_at_[z(k)];
  alignas(64) double rows[2 * 8 * lanes] = {};
  for (int l = 0; l < lanes; ++l) {
    if (joints[l] < 0) continue;
    const int ends[2] = {model_.joint[z(joints[l])].a, model_.joint[z(joints[l])].b};
    for (int end = 0; end < 2; ++end)
      for (int i = 0; i < 6; ++i) rows[8 * (lanes * end + l) + i] = state_.shift[z(ends[end] / lanes)].x[i][ends[end] % lanes];
  }
  lane_kernels().elastic(B, rows, o);
  for (int l = 0; l < lanes; ++l) {
    const int j = joints[l];
    if (!(o.near[l] > 0) || j < 0) continue;
    double q[6], f[6], stored = 0;
    for (int i = 0; i < 6; ++i) q[i] = o.q[i][l], stored += 0.5 * o.f[i][l] * o.q[i][l];
    joint_by_points(model_, state_, j, q, f, sums, &B, l);
    if (state_.tier[z(j)] == Tier::intact) continue;
    JointLanes cracked = o;
    for (int i = 0; i < 6; ++i) cracked.f[i][l] = f[i];
    take_over(j, B, o, cracked);
    if (sample) sums.energy.elastic += state_.memory[z(j)].elastic - stored;
  }
}

int Sound::forces(int first, int last, const LaneKernels& kernels, double* stored) {
  const int* first_batch = model_.kept.first_batch.data();
  const SoundCloser closer{closely_.load(std::memory_order_relaxed) ? closer_.data() : nullptr, carried_, ahead_};
  return kernels.sound(batch_.data(), closer, first_batch, first, last, state_.shift.data(), state_.kept.data(), state_.given.data(),
                       stored, &near_[z(first_batch[first])]);
}

void Sound::forces(Range groups, bool sample, std::vector<JointSums>& all) {
  const int piece = sample ? grain : std::max(1, groups.last - groups.first);  // only energies need chunks
  const std::vector<int>& first_batch = model_.kept.first_batch;
  for (int first = groups.first; first < groups.last; first += piece) {
    const int last = std::min(first + piece, groups.last);
    double& elastic = all[z(first / grain)].energy.elastic;
    if (sample) elastic = 0;
    for (int from = first, to; from < last; from = to) {
      to = all_held_ ? last : from + 1;
      if (held_[z(from)] < 0) continue;
      while (to < last && held_[z(to)] >= 0) ++to;
      alignas(64) double stored[lanes] = {};
      const int count = forces(from, to, lane_kernels(), sample ? stored : nullptr);
      for (int l = 0; sample && l < lanes; ++l) elastic += stored[l];
      int group = from;
      for (int k = first_batch[z(from)]; k < first_batch[z(from)] + count; ++k) {
        while (first_batch[z(group) + 1] <= near_[z(k)]) ++group;
        look_closer(near_[z(k)], sample, all[z(group / grain)]);
      }
      for (group = from; !all_held_ && group < to; ++group)
        if (held_[z(group)] == 0) held_[z(group)] = -1;
    }
  }
}

void forget_other_kernel(const Model& m, State& s) {
  if (!keepers(m)) {
    std::vector<std::uint8_t> sound(z(m.nblock), 0);
    for (int j = 0; j < m.njoint; ++j)
      if (s.tier[z(j)] == Tier::intact) sound[z(m.joint[z(j)].a)] = sound[z(m.joint[z(j)].b)] = 1;
    for (int b = 0; b < m.nblock; ++b)
      if (!sound[z(b)]) set_row(s, b);
    for (int b = 0; b < m.nblock; ++b)
      for (int i = 0; i < 6; ++i) s.row[z(8 * b + i)] = s.shift[z(b / lanes)].x[i][b % lanes];
    for (auto* sums : {&s.kept, &s.given}) std::fill(sums->begin(), sums->end(), RowLanes<6>{});
    return;
  }
  for (int j = 0; j < m.njoint; ++j)
    for (const int row : {m.row_a[z(j)], m.row_b[z(j)]})
      for (double* x = &s.wrench[8 * z(row)]; s.tier[z(j)] == Tier::intact && x < &s.wrench[8 * z(row)] + 8; ++x)
        if (*x != 0) *x = 0;  // a page of zeros takes no memory until it is written
}

}  // namespace erbs
