#include "engine/solve/linear/joint_operator.h"

#include "engine/base/count.h"
#include "engine/joints/kinematics.h"

namespace erbs {
Freedom freedoms(const Model& m) {
  Freedom f;
  f.first.assign(z(m.nblock) + 1, -1);
  for (int b = 0; b < m.nblock; ++b)
    if (m.kind[z(b)] == Kind::moving) f.first[z(b)] = f.count, f.count += 6;
  return f;
}

Freedom grounded_freedoms(const Model& m, const State& s) {
  Freedom f;
  f.first.assign(z(m.nblock) + 1, -1);
  for (int b = 0; b < m.nblock; ++b)
    if (m.kind[z(b)] == Kind::moving && s.topology.grounded[z(b)]) f.first[z(b)] = f.count, f.count += 6;
  return f;
}

JointOperator::JointOperator(const Model& m, const State& s, const Freedom& f) : model_(m) {
  ends_.reserve(z(m.njoint));
  for (int j = 0; j < m.njoint; ++j) {
    const int a = f.first[z(m.joint[z(j)].a)], b = f.first[z(m.joint[z(j)].b)];
    if (s.joints.stage[z(j)] == JointStage::contact || (a < 0 && b < 0)) continue;
    const JointPose pose = joint_pose(m, s, j);
    ends_.push_back({pose.frame, 0.5 * (pose.sum + pose.apart), 0.5 * (pose.sum - pose.apart), j, a, b});
  }
}

void JointOperator::add(const End& e, const JointForm& form, const VecX& x, VecX& y) {
  Vec3 translation = Vec3::Zero(), rotation = Vec3::Zero();  // of b relative to a
  if (e.b >= 0) {
    const Vec3 w = x.segment<3>(e.b + 3);
    translation = x.segment<3>(e.b) + w.cross(e.arm_b);
    rotation = w;
  }
  if (e.a >= 0) {
    const Vec3 w = x.segment<3>(e.a + 3);
    translation -= x.segment<3>(e.a) + w.cross(e.arm_a);
    rotation -= w;
  }
  const Vec3 q = e.frame.transpose() * translation, r = e.frame.transpose() * rotation;
  const auto& k = form.diagonal;
  const Vec3 force = e.frame * Vec3(k[0] * q.x(), k[1] * q.y(), k[2] * q.z());
  const Vec3 moment = e.frame * Vec3(k[3] * r.x() + form.coupling * r.y(), k[4] * r.y() + form.coupling * r.x(), k[5] * r.z());
  if (e.b >= 0) {
    y.segment<3>(e.b) += force;
    y.segment<3>(e.b + 3) += e.arm_b.cross(force) + moment;
  }
  if (e.a >= 0) {
    y.segment<3>(e.a) -= force;
    y.segment<3>(e.a + 3) -= e.arm_a.cross(force) + moment;
  }
}

RootMass::RootMass(const Model& m, const State& s, const Freedom& f) : of_block_(z(m.nblock), -1) {
  for (int b = 0; b < m.nblock; ++b) {
    if (f.first[z(b)] < 0) continue;
    const Mat3 r = s.pose.q[z(b)].toRotationMatrix();
    const Eigen::SelfAdjointEigenSolver<Mat3> eigen(Mat3(r * m.inertia[z(b)] * r.transpose()));
    of_block_[z(b)] = int(part_.size());
    part_.push_back({f.first[z(b)], 1 / std::sqrt(m.mass[z(b)]), eigen.operatorInverseSqrt()});
  }
}

void RootMass::apply(VecX& x) const {
  for (const Part& p : part_) {
    x.segment<3>(p.first) *= p.translation;
    const Vec3 rotated = p.rotation * x.segment<3>(p.first + 3);
    x.segment<3>(p.first + 3) = rotated;
  }
}

Mat6 RootMass::of(int b) const {
  const Part& p = part_[z(of_block_[z(b)])];
  Mat6 root = Mat6::Zero();
  root.topLeftCorner<3, 3>() = Mat3::Identity() * p.translation;
  root.bottomRightCorner<3, 3>() = p.rotation;
  return root;
}

}  // namespace erbs
