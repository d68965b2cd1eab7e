#include "engine/contact/patch_stiffness.h"

#include <algorithm>

#include "engine/contact/view.h"

namespace erbs {
namespace {

// `second` (m4): about the centroid of the patch, which is at `arm` from that of the block.
Mat6 stiffness_on(const Vec3& arm, const Vec3& n, double normal, const Mat3& second, double kn, double tangential, double torsion) {
  Vec6 along;
  along << n, arm.cross(n);
  Eigen::Matrix<double, 6, 3> across;
  across << Mat3::Identity(), cross_matrix(arm);
  const Mat3 turn = cross_matrix(n);
  Mat6 k = normal * along * along.transpose() + tangential * across * (Mat3::Identity() - n * n.transpose()) * across.transpose();
  k.bottomRightCorner<3, 3>() += kn * turn * second * turn.transpose() + torsion * n * n.transpose();
  return k;
}

}  // namespace

bool patch_stiffness(Pair& pair, const ContactShapes& shapes, const ContactBlock& a, const ContactBlock& b, OverlapRoom& room,
                     PatchStiffness& out) {
  const View s = view_of(pair, shapes, a, b);
  int separating = -1;
  const Patch patch = find_overlap(*s.reference, *s.other, {s.pose.turn, s.pose.shift + pair.lift}, separating, room, &pair.corners);
  if (!(patch.total > 0)) return false;
  const Mat3& turn = s.reference_block->turn;
  const Vec3 n = turn * patch.normal, arm = turn * patch.centroid, arm_reference = turn * (patch.centroid + s.pose.shift);
  const Mat3 second = turn * (patch.second - patch.area * patch.centroid * patch.centroid.transpose()) * turn.transpose();
  const double normal = pair.law.kn * patch.area, tangential = pair.law.ks * std::max(patch.area, pair.area);
  const double gyration = std::max(patch.gyration, pair.gyration), torsion = tangential * gyration * gyration;
  const Mat6 other = stiffness_on(arm, n, normal, second, pair.law.kn, tangential, torsion),
             reference = stiffness_on(arm_reference, n, normal, second, pair.law.kn, tangential, torsion);
  out.on_a = pair.b_is_reference ? other : reference;
  out.on_b = pair.b_is_reference ? reference : other;
  return true;
}

}  // namespace erbs
