#include "engine/contact/law/patch_stiffness.h"

#include <algorithm>

#include "engine/contact/law/frame.h"

namespace erbs {
namespace {

// `second` (m4): about the centroid of the patch, which is at `arm` from that of the block.
Mat6 stiffness_on(const Vec3& arm, const Vec3& n, double normal, const Mat3& second, double kn, double tangential, double torsion) {
  Vec6 along;
  along << n, arm.cross(n);
  Eigen::Matrix<double, 6, 3> across;
  across << Mat3::Identity(), cross_matrix(arm);
  const Mat3 n_cross = cross_matrix(n);
  Mat6 k = normal * along * along.transpose() + tangential * across * (Mat3::Identity() - n * n.transpose()) * across.transpose();
  k.bottomRightCorner<3, 3>() += kn * n_cross * second * n_cross.transpose() + torsion * n * n.transpose();
  return k;
}

}  // namespace

bool patch_stiffness(ContactPair& pair, const ContactShapes& shapes, const ContactBlock& a, const ContactBlock& b, OverlapRoom& room,
                     PatchStiffness& out) {
  const PairFrame s = pair_frame(pair, shapes, a, b);
  int separating_axis = -1;
  const Patch patch =
      find_overlap(*s.reference, *s.other, {s.pose.rotation, s.pose.shift + pair.lift}, separating_axis, room, &pair.corners);
  if (!(patch.total > 0)) return false;
  const Mat3& rotation = s.reference_block->rotation;
  const Vec3 n = rotation * patch.normal, arm = rotation * patch.centroid, arm_reference = rotation * (patch.centroid + s.pose.shift);
  const Mat3 second = rotation * (patch.second - patch.area * patch.centroid * patch.centroid.transpose()) * rotation.transpose();
  const double normal = pair.law.kn * patch.area, tangential = pair.law.ks * std::max(patch.area, pair.area);
  const double gyration = std::max(patch.gyration, pair.gyration), torsion = tangential * gyration * gyration;
  const Mat6 other = stiffness_on(arm, n, normal, second, pair.law.kn, tangential, torsion),
             reference = stiffness_on(arm_reference, n, normal, second, pair.law.kn, tangential, torsion);
  out.on_a = pair.b_is_reference ? other : reference;
  out.on_b = pair.b_is_reference ? reference : other;
  return true;
}

}  // namespace erbs
