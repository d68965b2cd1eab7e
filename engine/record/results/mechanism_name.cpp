#include "engine/record/results/mechanism_name.h"

#include <algorithm>
#include <cmath>

#include "engine/base/error.h"
#include "engine/base/units.h"

namespace erbs {
namespace {

constexpr double moves = 0.2;          // of the largest displacement
constexpr double as_one = 0.25;        // residual of a rigid motion, over the motion: one body
constexpr double without_turn = 0.15;  // share of the motion that comes from rotation: sliding
constexpr double thin = 0.5;           // thickness over width of a wall

std::size_t z(int i) { return std::size_t(i); }

// The rigid motion that is nearest to the motion of some blocks, by mass.
struct RigidMotion {
  Vec3 centre = Vec3::Zero(), shift = Vec3::Zero(), turn = Vec3::Zero();
  double residual = 0;  // of the motion, relative
  double turning = 0;   // share of the motion from the rotation about the centre
  Vec3 of(const Vec3& x) const { return shift + turn.cross(x - centre); }
};

RigidMotion rigid_motion(const Model& m, const BlockMotions& motions, const std::vector<int>& blocks) {
  RigidMotion out;
  double mass = 0;
  for (const int b : blocks) mass += m.mass[z(b)], out.centre += m.mass[z(b)] * m.rest[z(b)], out.shift += m.mass[z(b)] * motions.u[z(b)];
  out.centre /= mass, out.shift /= mass;
  Mat3 inertia = Mat3::Zero();
  Vec3 spin = Vec3::Zero();
  for (const int b : blocks) {
    const Vec3 arm = m.rest[z(b)] - out.centre;
    const Mat3 own = m.inertia[z(b)], cross = cross_matrix(arm);
    inertia += own - m.mass[z(b)] * cross * cross;
    spin += own * motions.theta[z(b)] + m.mass[z(b)] * arm.cross(motions.u[z(b)]);
  }
  out.turn = inertia.ldlt().solve(spin);
  double all = 0, rest = 0, turning = 0;
  for (const int b : blocks) {
    const double mb = m.mass[z(b)];
    all += mb * motions.u[z(b)].squaredNorm() + motions.theta[z(b)].dot(m.inertia[z(b)] * motions.theta[z(b)]);
    const Vec3 du = motions.u[z(b)] - out.of(m.rest[z(b)]), dt = motions.theta[z(b)] - out.turn;
    rest += mb * du.squaredNorm() + dt.dot(m.inertia[z(b)] * dt);
    turning += mb * out.turn.cross(m.rest[z(b)] - out.centre).squaredNorm() + out.turn.dot(m.inertia[z(b)] * out.turn);
  }
  out.residual = all > 0 ? std::sqrt(rest / all) : 0;
  out.turning = all > 0 ? std::sqrt(turning / all) : 0;
  return out;
}

// m, extent of blocks along a direction, from their centroids and smallest edges.
double extent(const Model& m, const std::vector<int>& blocks, const Vec3& along) {
  double low = 1e300, high = -1e300;
  for (const int b : blocks)
    for (const Polyhedron& part : m.parts[z(b)])
      for (const Vec3& v : part.vertices) low = std::min(low, v.dot(along)), high = std::max(high, v.dot(along));
  return std::max(0.0, high - low);
}

// Moved joints by the direction of their normal: bed joints lie level, head joints stand.
struct Cracks {
  int beds = 0, heads = 0, slides = 0, hinges = 0;
};
Cracks cracks_of(const Model& m, const Mechanism& joints, const Vec3& up) {
  Cracks out;
  for (const MovedJoint& moved : joints.moved) {
    const double level = std::fabs(m.joint[z(moved.joint)].type->frame.col(2).dot(up));
    (level > 0.7 ? out.beds : out.heads) += 1;
    (moved.kind == Movement::slide ? out.slides : out.hinges) += moved.kind != Movement::part;
  }
  return out;
}

// One body on beds that may be crushed goes down rather than along.
bool sinks(const Model& m, const BlockMotions& motions, const std::vector<int>& blocks, const Vec3& up) {
  Vec3 mean = Vec3::Zero();
  for (const int b : blocks) mean += m.mass[z(b)] * motions.u[z(b)];
  return -mean.dot(up) > 0.7 * mean.norm() && std::any_of(m.laws.begin(), m.laws.end(), [](const PointLaw& law) { return law.crushes(); });
}

}  // namespace

BlockMotions motions_of(const BlockPoses& pose, int nblock) {
  BlockMotions out;
  for (int b = 0; b < nblock; ++b) out.u.push_back(pose.u[z(b)]), out.theta.push_back(rotation_vector(pose.q[z(b)]));
  return out;
}

NamedMechanism name_mechanism(const Model& m, const BlockMotions& motions, const Mechanism& joints, const Vec3& push) {
  NamedMechanism out{"none", "", 0};
  double most = 0, all = 0, moving = 0;
  for (int b = 0; b < m.nblock; ++b)
    if (m.kind[z(b)] == Kind::moving) most = std::max(most, motions.u[z(b)].norm()), all += m.mass[z(b)];
  std::vector<int> blocks;
  for (int b = 0; b < m.nblock; ++b)
    if (m.kind[z(b)] == Kind::moving && motions.u[z(b)].norm() > moves * most && most > 0) blocks.push_back(b), moving += m.mass[z(b)];
  if (blocks.empty()) return out;
  out.moving_share = moving / all;
  const Vec3 up = m.gravity.norm() > 0 ? Vec3(-m.gravity.normalized()) : Vec3::UnitZ();
  const RigidMotion body = rigid_motion(m, motions, blocks);
  const Cracks cracks = cracks_of(m, joints, up);
  const bool stepped = cracks.beds > 1 && cracks.heads > 1;
  if (body.residual < as_one && body.turning < without_turn) {
    out.name = sinks(m, motions, blocks, up) ? "crushing" : "sliding";
  } else if (body.residual < as_one) {
    const Vec3 across = up.cross(push);
    const bool wall = extent(m, blocks, push) < thin * extent(m, blocks, across);
    const bool in_line = std::fabs(body.turn.normalized().dot(across)) > 0.7;
    out.name = wall && in_line ? "overturning out of plane" : stepped && in_line ? "overturning on a stepped crack" : "overturning";
  } else if (cracks.slides > cracks.hinges) {
    out.name = stepped ? "shear along diagonal cracks" : "shear";
  } else {
    out.name = "hinges";
  }
  out.text = fmt::format("{} of {:.0f} % of the mass: {} bed and {} head joints move, {} of them as hinges and {} by sliding", out.name,
                         100 * out.moving_share, cracks.beds, cracks.heads, cracks.hinges, cracks.slides);
  return out;
}

}  // namespace erbs
