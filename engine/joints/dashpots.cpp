#include "engine/joints/dashpots.h"

#include "engine/base/count.h"

namespace erbs {
void book_dashpots(State& s, int j, const double f[6], const double dq[6], JointSums& sums) {
  double* last = &s.joints.viscous[6 * z(j)];
  for (int i = 0; i < 6; ++i) {
    sums.energy.damping += 0.5 * (last[i] + f[i]) * dq[i];
    last[i] = f[i];
  }
}

void add_dashpots(const Model& m, State& s, int j, const Mat3& frame, const Vec3& arm_a, const Vec3& arm_b, double force[6],
                  JointSums& sums) {
  const Joint& joint = m.joint[z(j)];
  if (joint.viscous <= 0) return;
  const Vec3 wa = s.motion.w[z(joint.a)], wb = s.motion.w[z(joint.b)];
  const Vec3 apart = Vec3(s.motion.v[z(joint.b)]) + wb.cross(arm_b) - Vec3(s.motion.v[z(joint.a)]) - wa.cross(arm_a);
  const Vec3 rate[2] = {frame.transpose() * apart, frame.transpose() * (wb - wa)};
  double f[6], dq[6];
  for (int i = 0; i < 6; ++i) {
    f[i] = joint.viscous * joint.type->stiffness[i] * rate[i / 3][i % 3];
    dq[i] = s.time.last_dt * rate[i / 3][i % 3];
  }
  if (!m.laws[z(joint.type->law)].has_bond() && f[2] > -force[2]) {
    const double share = std::max(0.0, -force[2]) / f[2];
    for (int i = 2; i < 5; ++i) f[i] *= share;
  }
  const PointLaw& law = m.laws[z(joint.type->law)];
  const double strength = law.c * joint.type->area + law.mu * std::max(0.0, -force[2]);
  const double share = share_of_drag({force[0], force[1]}, {f[0], f[1]}, strength);
  for (const int i : {0, 1, 5}) f[i] *= share;
  for (int i = 0; i < 6; ++i) force[i] += f[i];
  book_dashpots(s, j, f, dq, sums);
}

void add_dashpots(const Model& m, State& s, int k, const JointPack& B, ElasticPack& o, JointSums& sums) {
  for (int l = 0; l < pack_size && k * pack_size + l < m.njoint; ++l) {
    const int j = k * pack_size + l;
    if (s.joints.slot[z(j)] != j || s.joints.stage[z(j)] != JointStage::intact) continue;
    const Vec3 theta(o.theta[0][l], o.theta[1][l], o.theta[2][l]), arm_a(o.arm_a[0][l], o.arm_a[1][l], o.arm_a[2][l]),
        arm_b(o.arm_b[0][l], o.arm_b[1][l], o.arm_b[2][l]);
    const auto to_world = [&](const Vec3& x) { return Vec3(x + theta.cross(x)); };
    Mat3 frame;
    for (int axis = 0; axis < 3; ++axis)
      frame.col(axis) = to_world(Vec3(B.frame[3 * axis][l], B.frame[3 * axis + 1][l], B.frame[3 * axis + 2][l]));
    double f[6];
    for (int i = 0; i < 6; ++i) f[i] = o.resultant[i][l];
    add_dashpots(m, s, j, frame, arm_a, arm_b, f, sums);
    for (int i = 0; i < 6; ++i) o.resultant[i][l] = f[i];
  }
}

}  // namespace erbs
