#include "engine/record/results/mechanism.h"

#include <algorithm>
#include <cmath>

#include "engine/base/error.h"
#include "engine/base/text.h"
#include "engine/base/units.h"
#include "engine/record/recorders/joint_condition.h"

namespace erbs {
namespace {

constexpr double share_of_most = 0.1, share_of_size = 1e-3;

// Movement of one joint. A joint without corners keeps a zero movement.
MovedJoint moved_joint(const Model& model, const BlockPoses& pose, int j) {
  const Joint& joint = model.joint[std::size_t(j)];
  const auto a = std::size_t(joint.a), b = std::size_t(joint.b);
  const Mat3 frame = joint_frame(model, pose, j);
  MovedJoint moved;
  moved.joint = j;
  std::vector<Vec3> gap, place;
  for (int i = joint.type->first_corner; i < joint.type->first_corner + joint.type->corners; ++i) {
    const Eigen::Vector2d& c = model.overlap_corner[std::size_t(i)];
    const Vec3 across = joint.type->frame.col(0) * c.x() + joint.type->frame.col(1) * c.y();
    gap.push_back(frame.transpose() * (pose.u[b] - pose.u[a] + rotation_change(pose.q[b], joint.arm_b + across) -
                                       rotation_change(pose.q[a], joint.arm_a + across)));
    place.push_back(model.rest[a] + joint.arm_a + across);
  }
  if (gap.empty()) return moved;
  double low = gap.front().z(), high = low;
  for (const Vec3& g : gap) low = std::min(low, g.z()), high = std::max(high, g.z());
  moved.opening = high - low;
  moved.gap = low;
  Vec3 closed = Vec3::Zero();
  int corners = 0;
  for (std::size_t i = 0; i < gap.size(); ++i) {
    if (gap[i].z() > low + 0.1 * moved.opening) continue;
    moved.slip = corners == 0 ? std::hypot(gap[i].x(), gap[i].y()) : std::min(moved.slip, std::hypot(gap[i].x(), gap[i].y()));
    closed += place[i];
    ++corners;
  }
  closed /= corners;
  std::copy_n(closed.data(), 3, moved.at);
  moved.rotation = rotation_vector(pose.q[b] * pose.q[a].conjugate()).norm();
  const double most = std::max({moved.gap, moved.opening, moved.slip});
  moved.kind = most == moved.gap ? Movement::part : most == moved.opening ? Movement::hinge : Movement::slide;
  return moved;
}

double movement(const MovedJoint& m) { return std::max({m.gap, m.opening, m.slip}); }

// A joint without friction or cohesion bears nothing along itself: it slides in every mechanism, as a plane of symmetry does.
bool guides(const Model& model, const MovedJoint& m) {
  const PointLaw& law = model.laws[std::size_t(model.joint[std::size_t(m.joint)].type->law)];
  return m.kind == Movement::slide && std::max({law.mu, law.mu_residual, law.c}) == 0;
}

// Two digits, but never an exponent: "5.7", "30", "153".
std::string short_number(double x) { return x < 100 ? fmt::format("{:.2g}", x) : fmt::format("{:.0f}", x); }

std::string size_text(const MovedJoint& m) {
  if (m.kind == Movement::hinge) return short_number(m.rotation * 180 / pi) + " deg";
  return movement(m) < 1 ? short_number(1e3 * movement(m)) + " mm" : short_number(movement(m)) + " m";
}

// "between a and b by 30 mm"
std::string place_and_size(const MovedJoint& m, const Model& model) {
  std::string name = model.joint_name(m.joint);
  if (const std::size_t bar = name.find(" | "); bar != std::string::npos) name.replace(bar, 3, " and ");
  return "between " + name + " by " + size_text(m);
}

const char* past_tense(Movement kind, int n) {
  if (kind == Movement::hinge) return n == 1 ? "opened as a hinge" : "opened as hinges";
  return kind == Movement::slide ? "slid" : "separated";
}

}  // namespace

const char* word(Movement kind) { return kind == Movement::hinge ? "hinge" : kind == Movement::slide ? "slide" : "part"; }

Mechanism mechanism_of(const Model& model, const BlockPoses& pose, double t, const std::vector<std::uint8_t>& without) {
  Mechanism out;
  out.time = t;
  for (int j = 0; j < model.njoint; ++j) {
    const Joint& joint = model.joint[std::size_t(j)];
    if (!without.empty() && (without[std::size_t(joint.a)] != 0 || without[std::size_t(joint.b)] != 0)) continue;
    MovedJoint moved = moved_joint(model, pose, j);
    if (movement(moved) > share_of_size * 2 * joint.type->radius) out.moved.push_back(moved);
  }
  const auto guide = [&](const MovedJoint& m) { return guides(model, m); };
  if (!std::all_of(out.moved.begin(), out.moved.end(), guide)) std::erase_if(out.moved, guide);
  double most = 0;
  for (const MovedJoint& m : out.moved) most = std::max(most, movement(m));
  std::erase_if(out.moved, [most](const MovedJoint& m) { return movement(m) < share_of_most * most; });
  return out;
}

int count(const Mechanism& mechanism, Movement kind) {
  return int(std::count_if(mechanism.moved.begin(), mechanism.moved.end(), [kind](const MovedJoint& m) { return m.kind == kind; }));
}

std::string summary(const Mechanism& mechanism, const Model& model, int names) {
  std::string text;
  bool shortened = false;
  for (const Movement kind : {Movement::hinge, Movement::slide, Movement::part}) {
    const int n = count(mechanism, kind);
    if (n == 0) continue;
    if (!text.empty()) text += "; ";
    text += fmt::format("{} {}", counted(n, "joint"), past_tense(kind, n));
    std::vector<const MovedJoint*> of_kind;
    for (const MovedJoint& m : mechanism.moved)
      if (m.kind == kind) of_kind.push_back(&m);
    std::stable_sort(of_kind.begin(), of_kind.end(), [](const MovedJoint* x, const MovedJoint* y) { return movement(*x) > movement(*y); });
    if (n > names) {
      text += ", most of all " + place_and_size(*of_kind.front(), model);
      shortened = true;
      continue;
    }
    for (int i = 0; i < n; ++i) text += (i == 0 ? ": " : ", ") + place_and_size(*of_kind[std::size_t(i)], model);
  }
  return shortened ? text + "; metrics.json lists them all" : text;
}

}  // namespace erbs
