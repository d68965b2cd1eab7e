#include "engine/analysis/limit/outcome.h"

#include <algorithm>
#include <cmath>

#include "engine/base/count.h"
#include "engine/base/text.h"
#include "engine/model/state.h"

namespace erbs::analysis {
namespace {

constexpr double still = 1e-3;  // share of the fastest block's speed

// Direction of component k of the force at a contact point on block b.
Vec3 direction_of(const LimitProblem& p, const ContactPoint& c, int k) {
  const int side = c.body[1] >= 0 ? 1 : 0;
  Vec3 out = Vec3::Zero();
  for (int i = 0; i < (p.plane ? 2 : 3); ++i) out += c.on[side](i, k) * p.axes[i];
  return side == 1 ? out : Vec3(-out);
}

double speed(const LimitResult& r, const Model& m, int b) {
  return r.velocity[z(b)].linear.norm() + 0.5 * m.smallest_edge[z(b)] * r.velocity[z(b)].angular.norm();
}

// Extent of the moving blocks along `axis`, m.
double extent(const LimitResult& r, const Model& m, const Vec3& axis) {
  double low = 1e300, high = -1e300;
  for (int b = 0; b < m.nblock; ++b) {
    if (speed(r, m, b) <= still) continue;
    for (const Polyhedron& part : m.parts[z(b)])
      for (const Vec3& v : part.vertices) low = std::min(low, axis.dot(v)), high = std::max(high, axis.dot(v));
  }
  return std::max(0.0, high - low);
}

// "in-plane ", "out-of-plane " or "": whether the moving part is long or thin in the direction in which it moves.
std::string plane_word(const LimitResult& r, const Model& m, const Vec3& drift) {
  if (drift.norm() == 0) return "";
  const double along = extent(r, m, drift), across = extent(r, m, Vec3::UnitZ().cross(drift));
  return along > 2 * across ? "in-plane " : across > 2 * along ? "out-of-plane " : "";
}

// Whether all moving blocks move as one rigid body.
bool rigid(const LimitResult& r, const Model& m) {
  int first = -1;
  for (int b = 0; b < m.nblock; ++b) {
    if (speed(r, m, b) <= still) continue;
    if (first < 0) first = b;
    const Twist &a = r.velocity[z(first)], &v = r.velocity[z(b)];
    const Vec3 expected = a.linear + a.angular.cross(m.rest[z(b)] - m.rest[z(first)]);
    if ((v.linear - expected).norm() > 0.02 || (v.angular - a.angular).norm() * m.smallest_edge[z(b)] > 0.02) return false;
  }
  return true;
}

std::string names(const Model& m, const Mechanism& joints, Movement kind, const char* verb) {
  constexpr int shown = 4;
  const auto size = [](const MovedJoint& j) { return std::max({j.gap, j.opening, j.slip}); };
  std::vector<MovedJoint> all = joints.moved;  // the largest movement first
  std::stable_sort(all.begin(), all.end(), [&](const MovedJoint& a, const MovedJoint& b) { return size(a) > size(b) * (1 + 1e-6); });
  std::string text;
  int n = 0;
  for (const MovedJoint& moved : all) {
    if (moved.kind != kind || ++n > shown) continue;
    text += (n == 1 ? "" : ", ") + m.joint_name(moved.joint);
  }
  if (n == 0) return "";
  return fmt::format("; {} joint{}: {}{}", n, n == 1 ? fmt::format(" {}s", verb) : fmt::format("s {}", verb), text,
                     n > shown ? ", ..." : "");
}

std::string kind_of(const LimitResult& r, const Model& m, const LimitMechanism& found) {
  const int hinges = count(found.joints, Movement::hinge), slides = count(found.joints, Movement::slide);
  const int parted = count(found.joints, Movement::part);
  const std::string plane = plane_word(r, m, found.drift);
  if (hinges == 0) return plane + (slides > 0 ? "sliding" : parted > 0 ? "falling" : "no movement of joints");
  if (rigid(r, m)) return plane + "overturning" + (slides > 0 ? " of a part that slides off its neighbours" : " as one piece");
  // A chain of bodies: every block has at most two joints, or at most two of few that move.
  constexpr int few = 8;
  std::vector<int> joints(z(m.nblock), 0), moved = joints;
  for (const Joint& joint : m.joint) ++joints[z(joint.a)], ++joints[z(joint.b)];
  for (const MovedJoint& one : found.joints.moved) ++moved[z(m.joint[z(one.joint)].a)], ++moved[z(m.joint[z(one.joint)].b)];
  const auto two_at_most = [&](const std::vector<int>& count) {
    return std::ranges::all_of(r.problem.block_of, [&](int b) { return count[z(b)] <= 2; });
  };
  const bool chain = two_at_most(joints) || (parted == 0 && hinges + slides <= few && two_at_most(moved));
  if (chain) return slides == 0 ? fmt::format("{} hinges", hinges) : fmt::format("{} hinges and {} sliding joints", hinges, slides);
  return plane + (slides > 0 ? "overturning with sliding" : "overturning of several parts");
}

}  // namespace

Vec3 load_direction(const PushSettings& push, const Vec3& gravity) {
  const Vec3 along = push.direction.normalized();
  if (!push.tilts() || gravity.norm() == 0) return along;
  const Vec3 down = gravity.normalized(), level = along - along.dot(down) * down;
  return level.norm() > 1e-9 ? Vec3(level.normalized()) : Vec3(Vec3::Zero());
}

LimitLoad limit_load(const Scene& scene, const Model& model) {
  LimitLoad out;
  out.direction = load_direction(scene.push, scene.gravity);
  out.tilt = scene.push.tilts();
  for (const PatternForce& one : scene.push.pattern) {
    std::vector<int> blocks;
    double mass = 0;
    for (int b = 0; b < model.nblock; ++b) {
      if (model.kind[z(b)] != Kind::moving) continue;
      if (one.block.empty() ? scene.blocks[z(b)].group != one.group : model.block_name[z(b)] != one.block) continue;
      blocks.push_back(b);
      mass += model.mass[z(b)];
    }
    for (const int b : blocks) out.pattern.push_back({b, model.mass[z(b)] / mass * one.force, Vec3::Zero()});
  }
  return out;
}

std::vector<Thrust> thrusts(const LimitResult& r, const Model& m) {
  std::vector<Thrust> out(z(m.njoint));
  std::vector<double> pressed(z(m.njoint), 0);
  std::vector<Vec3> shear(z(m.njoint), Vec3::Zero());
  for (std::size_t i = 0; i < r.force.size(); ++i) {
    const ContactPoint& c = r.problem.contacts[i];
    Thrust& one = out[z(c.joint)];
    const double n = std::max(0.0, r.force[i].x());
    one.at += n * c.at;
    pressed[z(c.joint)] += n;
    one.normal += r.force[i].x();
    one.force += r.force[i].x() * direction_of(r.problem, c, 0);
    for (int k = 1; k < r.problem.columns; ++k) shear[z(c.joint)] += r.force[i][k] * direction_of(r.problem, c, k);
  }
  for (int j = 0; j < m.njoint; ++j) {
    Thrust& one = out[z(j)];
    one.shear = shear[z(j)].norm();
    one.force += shear[z(j)];
    const Joint& joint = m.joint[z(j)];
    one.at = pressed[z(j)] > 1e-9 * r.problem.force ? Vec3(one.at / pressed[z(j)]) : Vec3(m.rest[z(joint.a)] + joint.arm_a);
  }
  return out;
}

BlockPoses poses_of(const LimitResult& r, const Model& m, double way) {
  BlockPoses out;
  out.u.assign(z(m.nblock), Vec3::Zero()), out.q.assign(z(m.nblock), Quat::Identity());
  for (int b = 0; b < m.nblock; ++b) {
    const Twist v = r.velocity.empty() ? Twist{} : r.velocity[z(b)];
    out.u[z(b)] = way * v.linear;
    out.q[z(b)] = rotation(way * v.angular);
  }
  return out;
}

LimitMechanism limit_mechanism(const LimitResult& r, const Model& m) {
  LimitMechanism out;
  if (r.velocity.empty()) return out;
  double most = 0;  // largest movement of a joint relative to its size, for 1 m of the fastest block
  for (const Joint& joint : m.joint) {
    const Twist &a = r.velocity[z(joint.a)], &b = r.velocity[z(joint.b)];
    const Vec3 way = b.linear + b.angular.cross(joint.arm_b) - a.linear - a.angular.cross(joint.arm_a);
    most = std::max(most, way.norm() / joint.type->radius + (b.angular - a.angular).norm());
  }
  if (most > 0) out.joints = mechanism_of(m, poses_of(r, m, 0.02 / most), 0);
  Vec3 momentum = Vec3::Zero();
  double size = 0;
  for (int b = 0; b < m.nblock; ++b) {
    if (speed(r, m, b) <= still) continue;
    ++out.moving;
    const Vec3 v(r.velocity[z(b)].linear.x(), r.velocity[z(b)].linear.y(), 0);
    momentum += m.mass[z(b)] * v;
    size += m.mass[z(b)] * v.norm();
  }
  if (momentum.norm() > 0.1 * size && size > 0) out.drift = momentum.normalized();
  out.kind = kind_of(r, m, out);
  out.words = fmt::format("{}: {} of {} move{}{}{}{}", out.kind, out.moving, counted(r.problem.nbody, "block"), out.moving == 1 ? "s" : "",
                          names(m, out.joints, Movement::hinge, "open"), names(m, out.joints, Movement::slide, "slide"),
                          names(m, out.joints, Movement::part, "part"));
  return out;
}

}  // namespace erbs::analysis
