#include "engine/record/results/mechanism_name.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <span>

#include "engine/base/count.h"
#include "engine/base/error.h"
#include "engine/base/units.h"

namespace erbs {
namespace {

constexpr double moves = 0.2;          // of the largest displacement
constexpr double as_one = 0.25;        // residual of a rigid motion, over the motion: one body
constexpr double without_turn = 0.15;  // share of the motion that comes from rotation: sliding
constexpr double thin = 0.5;           // thickness over width of a wall
constexpr double takes_part = 0.1;     // share of the mass of a wall that moves
constexpr double level_crack = 0.45;   // rise over run of a crack that is not yet diagonal, and run over rise: 24 degrees

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
  int beds = 0, heads = 0, slides = 0, hinges = 0, parts = 0, parted_beds = 0;
  // Courses that slide on each other, the upper ones further, look like one body that turns; no bed of it opens, heads may part.
  bool only_slide() const { return slides > 0 && hinges == 0 && parted_beds == 0; }
};
bool is_bed(const Model& m, int joint, const Vec3& up) { return std::fabs(m.joint[z(joint)].type->frame.col(2).dot(up)) > 0.7; }

Cracks cracks_of(const Model& m, const Mechanism& joints, const Vec3& up) {
  Cracks out;
  for (const MovedJoint& moved : joints.moved) {
    const bool bed = is_bed(m, moved.joint, up);
    (bed ? out.beds : out.heads) += 1;
    out.parted_beds += bed && moved.kind == Movement::part;
    (moved.kind == Movement::slide ? out.slides : moved.kind == Movement::part ? out.parts : out.hinges) += 1;
  }
  return out;
}

// One body on beds that may be crushed goes down rather than along.
bool sinks(const Model& m, const BlockMotions& motions, const std::vector<int>& blocks, const Vec3& up) {
  Vec3 mean = Vec3::Zero();
  for (const int b : blocks) mean += m.mass[z(b)] * motions.u[z(b)];
  return -mean.dot(up) > 0.7 * mean.norm() && std::any_of(m.laws.begin(), m.laws.end(), [](const PointLaw& law) { return law.crushes(); });
}

// Blocks that move by a share of the largest displacement.
std::vector<int> moving_blocks(const Model& m, const BlockMotions& motions) {
  double most = 0;
  for (int b = 0; b < m.nblock; ++b)
    if (m.kind[z(b)] == Kind::moving) most = std::max(most, motions.u[z(b)].norm());
  std::vector<int> out;
  for (int b = 0; b < m.nblock; ++b)
    if (m.kind[z(b)] == Kind::moving && motions.u[z(b)].norm() > moves * most && most > 0) out.push_back(b);
  return out;
}

double mass_of(const Model& m, const std::vector<int>& blocks) {
  double sum = 0;
  for (const int b : blocks) sum += m.mass[z(b)];
  return sum;
}

// What turns as one body moves little next to its hinge: blocks that follow it count as well.
void add_followers(const Model& m, const BlockMotions& motions, const RigidMotion& body, std::vector<int>& blocks) {
  for (int b = 0; b < m.nblock; ++b) {
    if (m.kind[z(b)] != Kind::moving) continue;
    const Vec3 arm = m.rest[z(b)] - body.centre, u = body.shift + rotation(body.turn) * arm - arm;  // finite: it has moved by half an edge
    const Vec3 du = motions.u[z(b)] - u, dt = motions.theta[z(b)] - body.turn;
    const double all = m.mass[z(b)] * u.squaredNorm() + body.turn.dot(m.inertia[z(b)] * body.turn);
    if (m.mass[z(b)] * du.squaredNorm() + dt.dot(m.inertia[z(b)] * dt) < as_one * as_one * all) blocks.push_back(b);
  }
  std::sort(blocks.begin(), blocks.end());
  blocks.erase(std::unique(blocks.begin(), blocks.end()), blocks.end());
}

// Beds of levels nearly all of which move: there a wall slides or opens from end to end. A diagonal crack takes one or two of a level.
// [njoint]
std::vector<char> beds_from_end_to_end(const Model& m, const Mechanism& joints, const std::vector<char>& inside, const Vec3& up) {
  std::vector<char> moved(z(m.njoint)), out(z(m.njoint));
  for (const MovedJoint& one : joints.moved) moved[z(one.joint)] = 1;
  std::vector<std::pair<double, int>> beds;  // m, height; joint
  for (int j = 0; j < m.njoint; ++j) {
    const Joint& joint = m.joint[z(j)];
    if (inside[z(joint.a)] && inside[z(joint.b)] && is_bed(m, j, up)) beds.emplace_back((m.rest[z(joint.a)] + joint.arm_a).dot(up), j);
  }
  std::sort(beds.begin(), beds.end());
  for (std::size_t first = 0, end = 0; first < beds.size(); first = end) {
    const double one_level = 1e-3 * (beds.back().first - beds.front().first);  // m
    while (end < beds.size() && beds[end].first <= beds[first].first + one_level) ++end;
    const auto level = std::span(beds).subspan(first, end - first);
    const auto moving = std::ranges::count_if(level, [&](const auto& bed) { return moved[z(bed.second)] != 0; });
    for (const auto& bed : level) out[z(bed.second)] = 4 * moving >= 3 * std::ssize(level);
  }
  return out;
}

// Courses that slide on each other, the upper ones further, are no one body. `inside`: blocks that count, with the supports below them.
bool courses_slide(const Model& m, const Mechanism& joints, const Cracks& cracks, const std::vector<char>& inside, const Vec3& up) {
  if (!cracks.only_slide()) return false;
  const std::vector<char> whole = beds_from_end_to_end(m, joints, inside, up);
  const auto found = std::ranges::count_if(joints.moved, [&](const MovedJoint& one) { return whole[z(one.joint)] != 0; });
  return 4 * found >= 3 * cracks.beds;
}

// Whether some crack of a wall, joints that share blocks, climbs through bed and head joints both along and up.
bool has_diagonal_crack(const Model& m, const Mechanism& joints, const std::vector<char>& inside, const Vec3& along, const Vec3& up) {
  const std::vector<char> level = beds_from_end_to_end(m, joints, inside, up);
  std::vector<MovedJoint> own;
  for (const MovedJoint& moved : joints.moved) {
    const Joint& joint = m.joint[z(moved.joint)];
    if (inside[z(joint.a)] && inside[z(joint.b)] && level[z(moved.joint)] == 0) own.push_back(moved);
  }
  // Joints with a block in common belong to one crack.
  std::vector<std::size_t> crack(own.size());
  std::iota(crack.begin(), crack.end(), std::size_t(0));
  const auto root = [&](std::size_t i) {
    while (crack[i] != i) i = crack[i];
    return i;
  };
  std::map<int, std::size_t> of_block;
  for (std::size_t i = 0; i < own.size(); ++i)
    for (const int b : {m.joint[z(own[i].joint)].a, m.joint[z(own[i].joint)].b})
      if (const auto [at, fresh] = of_block.emplace(b, i); !fresh) crack[root(i)] = root(at->second);
  struct Extent {
    double low[2] = {1e300, 1e300}, high[2] = {-1e300, -1e300};
    int beds = 0, heads = 0;
  };
  std::map<std::size_t, Extent> extents;
  for (std::size_t i = 0; i < own.size(); ++i) {
    Extent& e = extents[root(i)];
    const Joint& joint = m.joint[z(own[i].joint)];
    const Vec3 at = m.rest[z(joint.a)] + joint.arm_a;
    const double place[2] = {at.dot(along), at.dot(up)};
    for (int k = 0; k < 2; ++k) e.low[k] = std::min(e.low[k], place[k]), e.high[k] = std::max(e.high[k], place[k]);
    (is_bed(m, own[i].joint, up) ? e.beds : e.heads) += 1;
  }
  return std::any_of(extents.begin(), extents.end(), [](const auto& one) {
    const Extent& e = one.second;
    const double run = e.high[0] - e.low[0], rise = e.high[1] - e.low[1];
    return e.beds > 1 && e.heads > 1 && rise > level_crack * run && run > level_crack * rise;
  });
}

// Joints between the blocks of a wall and to its supports that slide, and that open as hinges.
Cracks cracks_within(const Model& m, const Mechanism& joints, const std::vector<char>& inside, const Vec3& up) {
  Mechanism own;
  for (const MovedJoint& moved : joints.moved)
    if (inside[z(m.joint[z(moved.joint)].a)] || inside[z(m.joint[z(moved.joint)].b)]) own.moved.push_back(moved);
  return cracks_of(m, own, up);
}

}  // namespace

BlockMotions motions_of(const BlockPoses& pose, int nblock) {
  BlockMotions out;
  for (int b = 0; b < nblock; ++b) out.u.push_back(pose.u[z(b)]), out.theta.push_back(rotation_vector(pose.q[z(b)]));
  return out;
}

NamedMechanism name_mechanism(const Model& m, const BlockMotions& motions, const Mechanism& joints, const Vec3& push) {
  NamedMechanism out{"none", "", 0};
  std::vector<int> blocks = moving_blocks(m, motions);
  if (blocks.empty()) return out;
  double all = 0;
  for (int b = 0; b < m.nblock; ++b)
    if (m.kind[z(b)] == Kind::moving) all += m.mass[z(b)];
  const Vec3 up = m.gravity.norm() > 0 ? Vec3(-m.gravity.normalized()) : Vec3::UnitZ();
  const RigidMotion body = rigid_motion(m, motions, blocks);
  if (body.residual < as_one) add_followers(m, motions, body, blocks);
  out.moving_share = mass_of(m, blocks) / all;
  const Cracks cracks = cracks_of(m, joints, up);
  const bool stepped = cracks.beds > 1 && cracks.heads > 1;
  if (cracks.parts > 0 && cracks.hinges + cracks.slides == 0) {
    out.name = "parting";
  } else if ((body.residual < as_one && (body.turning < without_turn || cracks.only_slide())) ||
             courses_slide(m, joints, cracks, std::vector<char>(z(m.nblock), 1), up)) {
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
  out.text = fmt::format("{} of {:.0f} % of the mass: {} bed and {} head joints move, {} of them as hinges and {} by sliding{}", out.name,
                         100 * out.moving_share, cracks.beds, cracks.heads, cracks.hinges, cracks.slides,
                         cracks.parts > 0 ? fmt::format(", {} part", cracks.parts) : "");
  return out;
}

std::vector<WallMechanism> wall_mechanisms(const Model& m, const BlockMotions& motions, const Mechanism& joints, const Vec3& push,
                                           const std::vector<std::string>& group) {
  const Vec3 up = m.gravity.norm() > 0 ? Vec3(-m.gravity.normalized()) : Vec3::UnitZ();
  const Vec3 level = push - push.dot(up) * up;
  if (level.norm() < 0.1) return {};
  const Vec3 along = level.normalized(), across = up.cross(along);
  struct Wall {
    std::string name;
    std::vector<int> blocks, moving;
  };
  std::vector<Wall> walls;
  const std::vector<int> moving = moving_blocks(m, motions);
  for (int b = 0; b < m.nblock; ++b) {
    if (m.kind[z(b)] != Kind::moving || group[z(b)].empty()) continue;
    auto at = std::find_if(walls.begin(), walls.end(), [&](const Wall& wall) { return wall.name == group[z(b)]; });
    if (at == walls.end()) at = walls.insert(walls.end(), {group[z(b)], {}, {}});
    at->blocks.push_back(b);
    if (std::binary_search(moving.begin(), moving.end(), b)) at->moving.push_back(b);
  }
  std::vector<WallMechanism> out;
  for (const Wall& wall : walls) {
    const double thick = extent(m, wall.blocks, along), wide = extent(m, wall.blocks, across), high = extent(m, wall.blocks, up);
    const bool facing = thick < thin * wide && thick < thin * high, in_line = wide < thin * thick && wide < thin * high;
    if (wall.blocks.size() < 4 || !(facing || in_line) || mass_of(m, wall.moving) < takes_part * mass_of(m, wall.blocks)) continue;
    std::vector<char> inside(z(m.nblock));
    for (const int b : wall.blocks) inside[z(b)] = 1;
    const RigidMotion body = rigid_motion(m, motions, wall.moving);
    const Cracks cracks = cracks_within(m, joints, inside, up);
    const bool as_body = body.residual < as_one, turns = body.turning >= without_turn && !cracks.only_slide();
    if (facing) {
      const bool over = std::fabs(body.turn.normalized().dot(across)) > 0.7;
      out.emplace_back(wall.name, as_body && !turns ? "sliding" : as_body && over ? "overturning out of plane" : "bending out of plane");
    } else {
      out.emplace_back(wall.name, has_diagonal_crack(m, joints, inside, along, up) ? "diagonal cracks"
                                  : as_body && !turns                              ? "sliding"
                                  : courses_slide(m, joints, cracks, inside, up)   ? "sliding"
                                  : as_body                                        ? "rocking in plane"
                                  : cracks.slides > cracks.hinges                  ? "shear"
                                                                                   : "hinges");
    }
  }
  return out;
}

}  // namespace erbs
