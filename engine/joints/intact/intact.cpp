#include "engine/joints/intact/intact.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/base/count.h"
#include "engine/joints/kinematics.h"
#include "engine/model/joint_packs.h"

namespace erbs {
namespace {

// Packs of more bytes than this do not stay in the cache. Measured for 951, 9,700, 15,000 and 29,900 blocks (0.5, 5, 7.7, 15 MB): prefetch
// of the fourth pack ahead costs 1 % and 3 %, and saves 7 % and 30 % of a step. The processor's own prefetch ends at every page.
constexpr std::size_t near_bytes = 6 << 20;
constexpr int packs_ahead = 4;

// Minus twice the sum of k_i e_i e_i^T over the axes e_i of the joint frame; k_i is the stiffness against rotation about e_i.
void set_bending_stiffness(const JointPack& B, int from, double out[6][pack_size], int to) {
  constexpr int row[6] = {0, 1, 2, 1, 0, 0}, column[6] = {0, 1, 2, 2, 2, 1};
  for (int i = 0; i < 6; ++i) {
    out[i][to] = 0;
    for (int axis = 0; axis < 3; ++axis)
      out[i][to] -= 2 * B.stiffness[3 + axis][from] * B.frame[3 * axis + row[i]][from] * B.frame[3 * axis + column[i]][from];
  }
}

}  // namespace

void set_intact_lane(const JointPack& B, int from, IntactPack& out, IntactConstants& law, int to, bool from_b) {
  const double sign = from_b ? -1 : 1;
  for (int i = 0; i < 3; ++i) {
    out.gap[i][to] = sign * B.gap[i][from];
    out.rotation[i][to] = 0.5 * sign * B.rotation[i][from];
    out.normal[i][to] = sign * B.frame[6 + i][from];
    (from_b ? out.arm_b : out.arm_a)[i][to] = B.arm_a[i][from];
    (from_b ? out.arm_a : out.arm_b)[i][to] = B.arm_b[i][from];
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

void clear_intact_lane(IntactPack& out, IntactConstants& law, int lane) {
  for (auto* field : {out.gap, out.rotation, out.arm_a, out.arm_b, out.normal})
    for (int i = 0; i < 3; ++i) field[i][lane] = 0;
  for (auto& k : out.bend) k[lane] = 0;
  law.shear[lane] = law.across[lane] = law.slip_slope[lane] = law.diameter[lane] = 0;
  law.open_limit[lane] = law.slip_limit[lane] = law.close_limit[lane] = std::numeric_limits<double>::infinity();
}

IntactJoints::IntactJoints(const Model& model, State& state)
    : model_(model), state_(state), carried_(std::pow(model.analysis.lazy_rotation, 3)) {
  if (model.analysis.kernel == "reference" || model.analysis.solver == "sequential") return;  // these have their own
  if (model.dashpots) {
    for (int k = 0; k < intact_packs(model); ++k) damped_.push_back(intact_pack(model, state, k));
    return;
  }
  const OwnerSchedule& schedule = model.owner_schedule;
  pack_.resize(schedule.other.size());
  ahead_ = pack_.size() * sizeof(IntactPack) > near_bytes ? packs_ahead : 0;
  checked_.resize(pack_.size());
  corner_check_.assign(pack_.size(), nullptr);
  may_yield_.resize(pack_.size() + 1);
  for (int k = 0; k < int(pack_.size()); ++k) {
    int joints[pack_size];
    joints_in_slots(k, joints);
    const JointPack pack = pack_of(model, state, joints);
    IntactPack& out = pack_[z(k)];
    IntactConstants law;
    for (int l = 0; l < pack_size; ++l)
      if (joints[l] >= 0) set_intact_lane(pack, l, out, law, l, model.joint[z(joints[l])].owned_by_b), ++out.used;
      else clear_intact_lane(out, law, l);
    out.law = &*law_.insert(law).first;
    out.other = schedule.other[z(k)];
  }
  for (int g = 0; g + 1 < int(schedule.first_pack.size()); ++g) {
    owned_.push_back(0);
    for (int k = schedule.first_pack[z(g)]; k < schedule.first_pack[z(g) + 1]; ++k) owned_.back() += pack_[z(k)].used;
    if (owned_.back() == 0 && schedule.first_pack[z(g)] < schedule.first_pack[z(g) + 1]) all_owned_ = false;
  }
}

void IntactJoints::joints_in_slots(int k, int joints[pack_size]) const {
  for (int l = 0; l < pack_size; ++l) {
    const int j = model_.owner_schedule.joint[z(k * pack_size + l)];
    joints[l] = j >= 0 && state_.joints.slot[z(j)] == j ? j : -1;
  }
}

// By whole packs: joints without a change give the same bits again.
void IntactJoints::update_reference(const std::vector<std::uint8_t>& outdated) {
  for (int k = 0; k < int(damped_.size()); ++k) {
    const JointPack& b = damped_[z(k)];
    bool any = false;
    for (int l = 0; l < pack_size; ++l) any = any || outdated[z(b.a[l])] || outdated[z(b.b[l])];
    if (any) damped_[z(k)] = intact_pack(model_, state_, k);
  }
  for (int k = 0; k < int(pack_.size()); ++k) {
    int joints[pack_size];
    joints_in_slots(k, joints);
    bool any = false;
    for (const int j : joints) any = any || (j >= 0 && (outdated[z(model_.joint[z(j)].a)] || outdated[z(model_.joint[z(j)].b)]));
    if (any) set_pack(k);
  }
}

// Geometry of pack k at the reference poses: `set_intact_lane()` for eight lanes at once.
void IntactJoints::set_pack(int k) {
  int joints[pack_size];
  joints_in_slots(k, joints);
  JointPack aside, &geometry = checked_[z(k)] ? *checked_[z(k)] : aside;
  set_geometry(model_, state_, joints, geometry);
  constexpr double nothing[3] = {};
  IntactInput lane;
  for (int l = 0; l < pack_size; ++l) {
    lane.sign[l] = joints[l] >= 0 && model_.joint[z(joints[l])].owned_by_b ? -1 : 1;
    lane.bending[l] = joints[l] >= 0 ? model_.joint[z(joints[l])].type->stiffness + 3 : nothing;
  }
  step_kernels().intact_geometry(geometry, lane, pack_[z(k)]);
}

void IntactJoints::leave(int j) {
  if (!damped_.empty()) damped_[z(j / pack_size)] = intact_pack(model_, state_, j / pack_size);
  if (pack_.empty()) return;
  const int lane = model_.owner_schedule.lane[z(j)], k = lane / pack_size;
  checked_[z(k)].reset();
  corner_check_[z(k)] = nullptr;
  IntactPack& out = pack_[z(k)];
  IntactConstants law = *out.law;
  clear_intact_lane(out, law, lane % pack_size);
  out.law = &*law_.insert(law).first;
  --out.used;
  if (--owned_[z(model_.owner(j) / pack_size)] == 0) all_owned_ = false;
}

// Replaces the elastic force of joint j in the sums of the pass by its force after cracking; its lane transmits it until the next step.
void IntactJoints::replace_by_cracked(int j, const JointPack& pack, const ElasticPack& before, const ElasticPack& now) {
  JointPack aside = pack;
  for (int l = 0; l < pack_size; ++l) aside.wrench_row_a[l] = l, aside.wrench_row_b[l] = pack_size + l;
  alignas(64) double was[2 * 8 * pack_size], is[2 * 8 * pack_size];
  step_kernels().wrenches(aside, before, was);
  step_kernels().wrenches(aside, now, is);
  const bool by_b = model_.joint[z(j)].owned_by_b;
  const int k = model_.owner_schedule.lane[z(j)] / pack_size, lane = model_.owner_schedule.lane[z(j)] % pack_size, owner = model_.owner(j);
  const int own = 8 * (by_b ? pack_size + lane : lane), other = 8 * (by_b ? lane : pack_size + lane);
  for (int i = 0; i < 6; ++i) {
    state_.cache.owner_sum[z(owner / pack_size)].x[i][owner % pack_size] += is[own + i] - was[own + i];
    state_.cache.neighbour_force[z(k)].x[i][lane] = is[other + i];
  }
}

// Evaluates the joints of a pack that may be beyond a limit point by point. The force changes only if a joint cracks.
void IntactJoints::check_points(int k, bool sample, JointSums& sums) {
  ElasticPack o;
  int joints[pack_size];
  joints_in_slots(k, joints);
  if (!checked_[z(k)]) {  // this pack reads the pose rows made below
    checked_[z(k)] = std::make_unique<JointPack>(pack_of(model_, state_, joints));
    for (int l = 0; l < pack_size; ++l) checked_[z(k)]->a[l] = l, checked_[z(k)]->b[l] = pack_size + l;
    corner_check_[z(k)] = checked_[z(k)].get();
    any_checked_.store(true, std::memory_order_relaxed);
  }
  const JointPack& B = *checked_[z(k)];
  alignas(64) double rows[2 * 8 * pack_size] = {};
  for (int l = 0; l < pack_size; ++l) {
    if (joints[l] < 0) continue;
    const int ends[2] = {model_.joint[z(joints[l])].a, model_.joint[z(joints[l])].b};
    for (int end = 0; end < 2; ++end)
      for (int i = 0; i < 6; ++i)
        rows[8 * (pack_size * end + l) + i] = state_.cache.increment[z(ends[end] / pack_size)].x[i][ends[end] % pack_size];
  }
  step_kernels().elastic(B, rows, o);
  for (int l = 0; l < pack_size; ++l) {
    const int j = joints[l];
    if (!(o.may_yield[l] > 0) || j < 0) continue;
    double gap[6], resultant[6], stored = 0;
    for (int i = 0; i < 6; ++i) gap[i] = o.gap[i][l], stored += 0.5 * o.resultant[i][l] * o.gap[i][l];
    joint_by_points(model_, state_, j, gap, resultant, sums, &B, l);
    if (state_.joints.stage[z(j)] == JointStage::intact) continue;
    ElasticPack cracked = o;
    for (int i = 0; i < 6; ++i) cracked.resultant[i][l] = resultant[i];
    replace_by_cracked(j, B, o, cracked);
    if (sample) sums.energy.elastic += state_.joints.memory[z(j)].elastic - stored;
  }
}

int IntactJoints::forces(int first, int last, const StepKernels& kernels, double* stored) {
  const int* first_pack = model_.owner_schedule.first_pack.data();
  const CornerCheck corner_check{any_checked_.load(std::memory_order_relaxed) ? corner_check_.data() : nullptr, carried_, ahead_};
  return kernels.intact(pack_.data(), corner_check, first_pack, first, last, state_.cache.increment.data(), state_.cache.owner_sum.data(),
                        state_.cache.neighbour_force.data(), stored, &may_yield_[z(first_pack[first])]);
}

void IntactJoints::forces(Range groups, bool sample, std::vector<JointSums>& all) {
  const int piece = sample ? grain : std::max(1, groups.last - groups.first);  // only energies need chunks
  const std::vector<int>& first_pack = model_.owner_schedule.first_pack;
  for (int first = groups.first; first < groups.last; first += piece) {
    const int last = std::min(first + piece, groups.last);
    double& elastic = all[z(first / grain)].energy.elastic;
    if (sample) elastic = 0;
    for (int from = first, to; from < last; from = to) {
      to = all_owned_ ? last : from + 1;
      if (owned_[z(from)] < 0) continue;
      while (to < last && owned_[z(to)] >= 0) ++to;
      alignas(64) double stored[pack_size] = {};
      const int count = forces(from, to, step_kernels(), sample ? stored : nullptr);
      for (int l = 0; sample && l < pack_size; ++l) elastic += stored[l];
      int group = from;
      for (int k = first_pack[z(from)]; k < first_pack[z(from)] + count; ++k) {
        while (first_pack[z(group) + 1] <= may_yield_[z(k)]) ++group;
        check_points(may_yield_[z(k)], sample, all[z(group / grain)]);
      }
      for (group = from; !all_owned_ && group < to; ++group)
        if (owned_[z(group)] == 0) owned_[z(group)] = -1;
    }
  }
}

void forget_other_kernel(const Model& m, State& s) {
  if (!owner_computes(m)) {
    std::vector<std::uint8_t> intact(z(m.nblock), 0);
    for (int j = 0; j < m.njoint; ++j)
      if (s.joints.stage[z(j)] == JointStage::intact) intact[z(m.joint[z(j)].a)] = intact[z(m.joint[z(j)].b)] = 1;
    for (int b = 0; b < m.nblock; ++b)
      if (!intact[z(b)]) set_pose_row(s, b);
    for (int b = 0; b < m.nblock; ++b)
      for (int i = 0; i < 6; ++i) s.cache.pose_row[z(8 * b + i)] = s.cache.increment[z(b / pack_size)].x[i][b % pack_size];
    for (auto* sums : {&s.cache.owner_sum, &s.cache.neighbour_force}) std::fill(sums->begin(), sums->end(), VectorPack<6>{});
    return;
  }
  for (int j = 0; j < m.njoint; ++j)
    for (const int row : {m.wrench_row_a[z(j)], m.wrench_row_b[z(j)]})
      for (double* x = &s.cache.wrench[8 * z(row)]; s.joints.stage[z(j)] == JointStage::intact && x < &s.cache.wrench[8 * z(row)] + 8; ++x)
        if (*x != 0) *x = 0;  // a page of zeros takes no memory until it is written
}

}  // namespace erbs
