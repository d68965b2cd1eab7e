#include "engine/solve/sequential/sequential.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "engine/base/count.h"
#include "engine/base/random.h"
#include "engine/joints/intact/intact.h"
#include "engine/joints/kinematics.h"
#include "engine/joints/response.h"
#include "engine/laws/yield.h"
#include "engine/model/joint_packs.h"

namespace erbs {
namespace {

void shuffle(std::vector<int>& order, std::uint64_t seed, std::uint64_t step) {
  Random random{Random{seed}.next() ^ step};
  for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random.next() % i]);  // Fisher and Yates; bias 1e-15
}

void colour(const Model& m, std::vector<int>& order) {
  std::vector<std::vector<int>> neighbours(z(m.nblock));
  for (const Joint& j : m.joint) neighbours[z(j.a)].push_back(j.b), neighbours[z(j.b)].push_back(j.a);
  std::vector<int> colour_of(z(m.nblock), -1);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return neighbours[z(a)].size() > neighbours[z(b)].size(); });
  for (const int b : order) {
    std::vector<bool> taken(neighbours[z(b)].size() + 1);
    for (const int other : neighbours[z(b)])
      if (const int c = colour_of[z(other)]; c >= 0 && c < int(taken.size())) taken[z(c)] = true;
    colour_of[z(b)] = int(std::find(taken.begin(), taken.end(), false) - taken.begin());
  }
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return colour_of[z(a)] < colour_of[z(b)]; });
}

void write(Rows& rows, int row, const Vec3& force, const Vec3& moment) {
  for (int i = 0; i < 3; ++i) rows[z(row) * 8 + z(i)] = force[i], rows[z(row) * 8 + 3 + z(i)] = moment[i];
}

// Wrenches on both ends of joint j from its resultant f, as in `reference.cpp`.
void write_wrench(const Model& m, State& s, int j, const JointPose& pose, const double resultant[6]) {
  const Vec3 force = pose.frame * Vec3(resultant[0], resultant[1], resultant[2]),
             moment = pose.frame * Vec3(resultant[3], resultant[4], resultant[5]);
  const Vec3 arm_a = 0.5 * (pose.sum + pose.apart), arm_b = 0.5 * (pose.sum - pose.apart);
  write(s.cache.wrench, m.wrench_row_a[z(j)], force, arm_a.cross(force) + moment);
  write(s.cache.wrench, m.wrench_row_b[z(j)], -force, -(arm_b.cross(force) + moment));
}

bool in_contact(const State& s, int j) { return s.joints.stage[z(j)] == JointStage::contact; }

// True if joint j may be beyond its limits: the bound of the elastic kernel, for one joint.
bool may_yield_now(const Model& m, int j, const double gap[6]) {
  const JointType& type = *m.joint[z(j)].type;
  return scalar::face_bound(scalar::yield_limits(m.laws[z(type.law)]), gap, type.half_s, type.half_t, type.radius) > 0;
}

}  // namespace

std::vector<int> sweep_order(const Model& model, std::uint64_t seed, std::uint64_t step) {
  std::vector<int> order(z(model.nblock));
  std::iota(order.begin(), order.end(), 0);
  if (model.analysis.order == "random") shuffle(order, seed, step);
  else if (model.analysis.order == "coloured") colour(model, order);
  return order;
}

Sequential::Sequential(const Model& model, State& state)
    : model_(model),
      state_(state),
      centred_(model.analysis.variant == "centred"),
      plain_(model.analysis.kernel == "reference"),
      first_end_(z(model.nblock) + 1, 0),
      lane_(z(model.njoint)),
      broken_(z(model.nblock), 0) {
  for (int b = 0; b < model.nblock; ++b)
    if (model.kind[z(b)] == Kind::driven) driven_.push_back(b);
  for (const Joint& j : model.joint) ++first_end_[z(j.a) + 1], ++first_end_[z(j.b) + 1];
  std::partial_sum(first_end_.begin(), first_end_.end(), first_end_.begin());
  end_.resize(2 * z(model.njoint));
  std::vector<int> next(first_end_.begin(), first_end_.end() - 1);
  for (int j = 0; j < model.njoint; ++j)
    for (const int b : {model.joint[z(j)].a, model.joint[z(j)].b}) end_[z(next[z(b)]++)] = j;
  for (int b = 0; b < model.nblock; ++b) {
    first_neighbour_.push_back(int(neighbour_.size()));
    for (int k = first_end_[z(b)]; k < first_end_[z(b) + 1]; ++k) {
      const Joint& joint = model.joint[z(end_[z(k)])];
      const int other = joint.a == b ? joint.b : joint.a;
      const auto mine = neighbour_.begin() + first_neighbour_.back();
      if (model.kind[z(other)] == Kind::moving && std::find(mine, neighbour_.end(), other) == neighbour_.end()) neighbour_.push_back(other);
    }
  }
  first_neighbour_.push_back(int(neighbour_.size()));
  for (int b = 0; b < model.nblock; ++b) {
    first_pack_.push_back(int(pack_.size()));
    int taken = 0;
    for (int k = first_end_[z(b)]; k < first_end_[z(b) + 1] && model.kind[z(b)] != Kind::fixed; ++k) {
      const int j = end_[z(k)];
      if (state.joints.stage[z(j)] != JointStage::intact || plain_) {
        ++broken_[z(b)];
        continue;
      }
      if (taken++ % pack_size == 0) {
        pack_.emplace_back();
        ends_.emplace_back();
        pack_.back().law = &law_.emplace_back();
        for (int l = 0; l < pack_size; ++l) clear_lane(int(pack_.size() - 1) * pack_size + l);
        joint_.resize(pack_.size() * pack_size, -1);
      }
      const int lane = (int(pack_.size()) - 1) * pack_size + (taken - 1) % pack_size;
      joint_[z(lane)] = j;
      ++pack_.back().used;
      (model.joint[z(j)].a == b ? lane_[z(j)].of_a : lane_[z(j)].of_b) = lane;
    }
  }
  first_pack_.push_back(int(pack_.size()));
  may_yield_.resize(pack_.size() + 1);
  std::vector<int> all(z(model.njoint));
  std::iota(all.begin(), all.end(), 0);
  update(all);
  schedule_blocks();
}

// Schedules each block in the round after the last of its neighbours that precede it.
void Sequential::schedule_blocks() {
  const std::vector<int> order = sweep_order(model_, std::uint64_t(model_.analysis.seed), std::uint64_t(state_.time.step));
  level_.assign(z(model_.nblock), -1);
  round_.assign(1, 0);
  for (const int b : order) {
    if (model_.kind[z(b)] != Kind::moving) continue;
    int last = -1;
    for (int k = first_neighbour_[z(b)]; k < first_neighbour_[z(b) + 1]; ++k) last = std::max(last, level_[z(neighbour_[z(k)])]);
    level_[z(b)] = last + 1;
    if (last + 3 > int(round_.size())) round_.push_back(0);
    ++round_[z(last) + 2];
  }
  std::partial_sum(round_.begin(), round_.end(), round_.begin());
  order_.resize(z(round_.back()));
  next_ = round_;
  for (const int b : order)
    if (level_[z(b)] >= 0) order_[z(next_[z(level_[z(b)])]++)] = b;
}

void Sequential::update_reference(const std::vector<std::uint8_t>& outdated) {
  std::vector<int> joints;
  for (int j = 0; j < model_.njoint; ++j)
    if (!in_contact(state_, j) && (outdated[z(model_.joint[z(j)].a)] || outdated[z(model_.joint[z(j)].b)])) joints.push_back(j);
  update(joints);
}

void Sequential::update(const std::vector<int>& joints) {
  JointPack one;
  for (const int j : joints) {
    if (lane_[z(j)].of_a < 0 && lane_[z(j)].of_b < 0) continue;
    set_lane(model_, state_, j, one, 0);
    for (const int lane : {lane_[z(j)].of_a, lane_[z(j)].of_b})
      if (lane >= 0) {
        set_intact_lane(one, 0, pack_[z(lane / pack_size)], law_[z(lane / pack_size)], lane % pack_size);
        IntactEnds& ends = ends_[z(lane / pack_size)];
        ends.a[lane % pack_size] = 8 * one.a[0], ends.wrench_row_a[lane % pack_size] = 8 * one.wrench_row_a[0];
        ends.b[lane % pack_size] = 8 * one.b[0], ends.wrench_row_b[lane % pack_size] = 8 * one.wrench_row_b[0];
      }
  }
}

void Sequential::clear_lane(int lane) {
  clear_intact_lane(pack_[z(lane / pack_size)], law_[z(lane / pack_size)], lane % pack_size);
  IntactEnds& ends = ends_[z(lane / pack_size)];
  ends.a[lane % pack_size] = ends.b[lane % pack_size] = 8 * model_.nblock;
  ends.wrench_row_a[lane % pack_size] = ends.wrench_row_b[lane % pack_size] = 8 * model_.spare_wrench_row();
}

// Joint j is no longer intact: removes it from the lanes of its blocks.
void Sequential::leave(int j) {
  for (const int b : {model_.joint[z(j)].a, model_.joint[z(j)].b}) ++broken_[z(b)];
  for (int* lane : {&lane_[z(j)].of_a, &lane_[z(j)].of_b}) {
    if (*lane < 0) continue;
    clear_lane(*lane);
    --pack_[z(*lane / pack_size)].used;
    joint_[z(*lane)] = -1;
    *lane = -1;
  }
}

// Evaluates the law of joint j at the present poses and writes its wrench for both blocks.
void Sequential::update_joint(int j, JointSums& sums) {
  State& s = state_;
  if (in_contact(s, j)) return;
  JointPose pose = joint_pose(model_, s, j);
  JointMemory& memory = s.joints.memory[z(j)];
  const Joint& joint = model_.joint[z(j)];
  const double lift = lift_by_asperities(model_, joint, memory, pose.gap);
  const bool intact = s.joints.stage[z(j)] == JointStage::intact;
  JointEnergy e;
  double resultant[6];
  const bool still = respond(model_, j, intact, memory.gap, pose.gap, past_of(model_, s, j), resultant, e);
  if (still && !plain_) return;
  if (intact && !still) {
    s.joints.stage[z(j)] = JointStage::cracked;
    ++sums.cracked_now;
  }
  double work = 0;
  for (int i = 0; i < 6; ++i) work += 0.5 * (memory.resultant[i] + resultant[i]) * (pose.gap[i] - memory.gap[i]);
  const double error = std::fabs(work - (e.elastic - memory.elastic) - e.friction - e.fracture - e.crushing);
  if (error > sums.largest_error) sums.largest_error = error, sums.worst_joint = j;
  const double across = 0.5 * (memory.resultant[2] + resultant[2]);
  for (int i = 0; i < 6; ++i) memory.gap[i] = pose.gap[i], memory.resultant[i] = resultant[i];
  memory.elastic = e.elastic;
  e.friction += advance_asperities(model_, joint, &s.joints.history[z(joint.first_point)], across, lift, memory);
  s.energy.friction_next += e.friction;
  s.energy.fracture_next += e.fracture;
  s.energy.crushing_next += e.crushing;
  write_wrench(model_, s, j, pose, resultant);
}

// Evaluates the joints in a pack of block b that may be beyond a limit, after b has moved for `moved` seconds. The wrench of a joint that
// stays intact does not change.
void Sequential::check_points(int pack, int b, double moved, JointSums& sums) {
  State& s = state_;
  for (int l = 0; l < pack_size; ++l) {
    const int j = joint_[z(pack * pack_size + l)];
    if (j < 0 || !may_yield_now(model_, j, joint_pose(model_, s, j).gap)) continue;
    const Vec3 u = s.pose.u[z(b)];
    const Quat q = s.pose.q[z(b)];
    s.pose.u[z(b)] = Vec3(u - moved * Vec3(s.motion.v[z(b)]));
    s.pose.q[z(b)] = Quat(rotation(-moved * Vec3(s.motion.w[z(b)])) * q);
    const JointPose before = joint_pose(model_, s, j);
    s.pose.u[z(b)] = u;
    s.pose.q[z(b)] = q;
    JointMemory& memory = s.joints.memory[z(j)];
    memory.elastic = 0;
    for (int i = 0; i < 6; ++i) {
      memory.gap[i] = before.gap[i];
      memory.resultant[i] = model_.joint[z(j)].type->stiffness[i] * before.gap[i];
      memory.elastic += 0.5 * memory.resultant[i] * before.gap[i];
    }
    update_joint(j, sums);
    if (s.joints.stage[z(j)] != JointStage::intact) leave(j);
  }
}

bool Sequential::rotated_far(int b) const {
  const double *row = &state_.cache.pose_row[z(b) * 8], limit = model_.analysis.lazy_rotation;
  return state_.topology.joined[z(b)] != 0 && !plain_ && row[3] * row[3] + row[4] * row[4] + row[5] * row[5] > limit * limit;
}

// Updates all joints of block b, which has moved for `moved` seconds while its neighbours were fixed.
void Sequential::visit(int b, double moved, JointSums& sums) {
  State& s = state_;
  if (rotated_far(b)) {  // beyond the range of the reference pose
    its_joints_.assign(end_.begin() + first_end_[z(b)], end_.begin() + first_end_[z(b) + 1]);
    set_reference(s, b);
    update(its_joints_);
  }
  if (broken_[z(b)] > 0)
    for (int k = first_end_[z(b)]; k < first_end_[z(b) + 1]; ++k)
      if (plain_ || s.joints.stage[z(end_[z(k)])] == JointStage::cracked) update_joint(end_[z(k)], sums);
  const int candidates = step_kernels().intact_ends(pack_.data(), ends_.data(), first_pack_[z(b)], first_pack_[z(b) + 1],
                                                    s.cache.pose_row.data(), s.cache.wrench.data(), may_yield_.data());
  for (int i = 0; i < candidates; ++i) check_points(may_yield_[z(i)], b, moved, sums);
}

// Writes the wrench of joint j at the present poses; its history does not change.
void Sequential::try_out(int j) {
  State& s = state_;
  const Joint& joint = model_.joint[z(j)];
  JointPose pose = joint_pose(model_, s, j);
  lift_by_asperities(model_, joint, s.joints.memory[z(j)], pose.gap);
  trial_.assign(&s.joints.history[z(joint.first_point)], &s.joints.history[z(joint.first_point)] + joint.type->points);
  CrushedFace crushed = s.joints.crushed.empty() ? CrushedFace{} : s.joints.crushed[z(j)];
  JointEnergy unused;
  double resultant[6];
  respond(model_, j, s.joints.stage[z(j)] == JointStage::intact,
          s.joints.stage[z(j)] == JointStage::intact && !plain_ ? pose.gap : s.joints.memory[z(j)].gap, pose.gap,
          {trial_.data(), s.joints.crushed.empty() ? nullptr : &crushed}, resultant, unused);
  write_wrench(model_, s, j, pose, resultant);
}

// Forces on block b at its pose half a step ahead, at the present velocity.
void Sequential::predict(int b) {
  State& s = state_;
  const Vec3 u = s.pose.u[z(b)];
  const Quat q = s.pose.q[z(b)];
  double row[6];
  std::copy_n(&s.cache.pose_row[8 * z(b)], 6, row);
  s.pose.u[z(b)] = Vec3(u + 0.5 * s.time.dt * Vec3(s.motion.v[z(b)]));
  s.pose.q[z(b)] = Quat(rotation(0.5 * s.time.dt * Vec3(s.motion.w[z(b)])) * q);
  set_pose_row(s, b);
  const bool all = plain_ || rotated_far(b);
  if (all || broken_[z(b)] > 0)
    for (int k = first_end_[z(b)]; k < first_end_[z(b) + 1]; ++k)
      if (all ? !in_contact(s, end_[z(k)]) : s.joints.stage[z(end_[z(k)])] == JointStage::cracked) try_out(end_[z(k)]);
  const int candidates = all ? 0
                             : step_kernels().intact_ends(pack_.data(), ends_.data(), first_pack_[z(b)], first_pack_[z(b) + 1],
                                                          s.cache.pose_row.data(), s.cache.wrench.data(), may_yield_.data());
  for (int i = 0; i < candidates; ++i)
    for (int l = 0; l < pack_size; ++l) {
      const int j = joint_[z(may_yield_[z(i)] * pack_size + l)];
      if (j >= 0 && may_yield_now(model_, j, joint_pose(model_, s, j).gap)) try_out(j);
    }
  s.pose.u[z(b)] = u;
  s.pose.q[z(b)] = q;
  put_pose_row(s, b, row);
}

// J, of all joints at the present poses.
double Sequential::stored() const {
  ElasticPack o;
  double sum = 0;
  for (int k = 0; k < intact_packs(model_); ++k) {
    step_kernels().elastic(intact_pack(model_, state_, k), state_.cache.pose_row.data(), o);
    for (int j = k * pack_size; j < std::min((k + 1) * pack_size, model_.njoint); ++j)
      if (state_.joints.stage[z(j)] == JointStage::intact && !plain_)
        for (int i = 0; i < 6; ++i) sum += 0.5 * o.resultant[i][j % pack_size] * o.gap[i][j % pack_size];
      else if (!in_contact(state_, j)) sum += state_.joints.memory[z(j)].elastic;
  }
  return sum;
}

// Adds the wrench that is about to move block b, of its joints with other moving blocks.
void Sequential::note_momentum(int b) {
  const Vec3 arm = model_.rest[z(b)] - model_.rest.front() + state_.pose.u[z(b)];
  for (int k = first_end_[z(b)]; k < first_end_[z(b) + 1]; ++k) {
    const int j = end_[z(k)];
    const Joint& joint = model_.joint[z(j)];
    if (model_.kind[z(joint.a)] != Kind::moving || model_.kind[z(joint.b)] != Kind::moving) continue;
    const double* row = &state_.cache.wrench[z(joint.a == b ? model_.wrench_row_a[z(j)] : model_.wrench_row_b[z(j)]) * 8];
    const Vec3 f(row[0], row[1], row[2]), m = arm.cross(f) + Vec3(row[3], row[4], row[5]);
    force_ += f;
    moment_ += m;
    forces_ += f.norm();
    moments_ += m.norm();
  }
}

void Sequential::sweep(const Excitation& e, const ExternalForces& external, const std::vector<BlockConstants>& constants, bool sample,
                       JointSums& joints, std::vector<BlockSums>& sums) {
  State& s = state_;
  Energy& ledger = s.energy;
  // Losses of the laws since the start of the last sweep belong to the positions at which this sweep starts.
  joints.energy.friction += std::exchange(ledger.friction_next, 0);
  joints.energy.fracture += std::exchange(ledger.fracture_next, 0);
  joints.energy.crushing += std::exchange(ledger.crushing_next, 0);
  if (s.time.step == 0) {
    for (int j = 0; j < model_.njoint; ++j)
      if (s.joints.stage[z(j)] == JointStage::intact) joint_gap(model_, s, j, s.joints.memory[z(j)].gap);
    for (int b = 0; b < model_.nblock; ++b)
      if (model_.kind[z(b)] == Kind::moving) visit(b, 0, joints);
  }
  for (const int b : driven_) visit(b, s.time.last_dt, joints);
  if (sample) {
    joints.energy.elastic = stored();
    wrench_before_ = s.cache.wrench;
    force_ = moment_ = Vec3::Zero();
    forces_ = moments_ = 0;
  }
  if (model_.analysis.order == "random") schedule_blocks();
  BlockGather blocks(model_, s, constants, e, external);
  for (std::size_t round = 0; round + 1 < round_.size(); ++round)
    for (int first = round_[round]; first < round_[round + 1]; first += pack_size) {
      const int* some = &order_[z(first)];
      const int count = std::min(pack_size, round_[round + 1] - first);
      for (int i = 0; i < count && centred_; ++i) predict(some[i]);
      for (int i = 0; i < count && sample; ++i) note_momentum(some[i]);
      blocks.advance(some, count, sample, sums);
      for (int i = 0; i < count; ++i) visit(some[i], s.time.dt, joints);
    }
}

double Sequential::momentum_residual() const {
  return std::max(forces_ > 0 ? force_.norm() / forces_ : 0, moments_ > 0 ? moment_.norm() / moments_ : 0);
}

}  // namespace erbs
