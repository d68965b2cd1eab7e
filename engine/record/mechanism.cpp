#include "engine/record/mechanism.h"

#include <algorithm>
#include <cmath>

#include "engine/base/error.h"
#include "engine/base/units.h"
#include "engine/record/joint_look.h"

namespace erbs {
namespace {

constexpr double share_of_most = 0.1, share_of_size = 1e-3;

// Movement of one joint. A joint without corners keeps a zero movement.
MovedJoint look(const Model& model, const State& state, int j) {
  const Joint& joint = model.joint[std::size_t(j)];
  const auto a = std::size_t(joint.a), b = std::size_t(joint.b);
  const Mat3 frame = joint_frame(model, state, j);
  MovedJoint moved;
  moved.joint = j;
  std::vector<Vec3> gap, place;
  for (int i = joint.type->first_corner; i < joint.type->first_corner + joint.type->corners; ++i) {
    const Eigen::Vector2d& c = model.corner[std::size_t(i)];
    const Vec3 across = joint.type->frame.col(0) * c.x() + joint.type->frame.col(1) * c.y();
    gap.push_back(frame.transpose() *
                  (state.u[b] - state.u[a] + turn_minus(state.q[b], joint.arm_b + across) - turn_minus(state.q[a], joint.arm_a + across)));
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
  moved.rotation = rotation_vector(state.q[b] * state.q[a].conjugate()).norm();
  const double most = std::max({moved.gap, moved.opening, moved.slip});
  moved.kind = most == moved.gap ? Movement::part : most == moved.opening ? Movement::hinge : Movement::slide;
  return moved;
}

double movement(const MovedJoint& m) { return std::max({m.gap, m.opening, m.slip}); }

std::string plural(int n, const char* word) { return fmt::format("{} {}{}", n, word, n == 1 ? "" : "s"); }

}  // namespace

const char* word(Movement kind) { return kind == Movement::hinge ? "hinge" : kind == Movement::slide ? "slide" : "part"; }

Mechanism mechanism_of(const Model& model, const State& state, double t) {
  Mechanism out;
  out.time = t;
  double most = 0;
  for (int j = 0; j < model.njoint; ++j) {
    MovedJoint moved = look(model, state, j);
    if (movement(moved) <= share_of_size * 2 * model.joint[std::size_t(j)].type->radius) continue;
    most = std::max(most, movement(moved));
    out.moved.push_back(moved);
  }
  std::erase_if(out.moved, [most](const MovedJoint& m) { return movement(m) < share_of_most * most; });
  return out;
}

int count(const Mechanism& mechanism, Movement kind) {
  return int(std::count_if(mechanism.moved.begin(), mechanism.moved.end(), [kind](const MovedJoint& m) { return m.kind == kind; }));
}

std::string summary(const Mechanism& mechanism, const Model& model, int names) {
  std::string text;
  for (const Movement kind : {Movement::hinge, Movement::slide, Movement::part}) {
    const int n = count(mechanism, kind);
    if (n == 0) continue;
    if (!text.empty()) text += "; ";
    text += plural(n, kind == Movement::part ? "parted joint" : word(kind)) + ":";
    std::vector<const MovedJoint*> of_kind;
    for (const MovedJoint& m : mechanism.moved)
      if (m.kind == kind) of_kind.push_back(&m);
    std::stable_sort(of_kind.begin(), of_kind.end(), [](const MovedJoint* x, const MovedJoint* y) { return movement(*x) > movement(*y); });
    for (int i = 0; i < std::min(n, names); ++i) {
      const MovedJoint& m = *of_kind[std::size_t(i)];
      const std::string size =
          kind == Movement::hinge ? fmt::format("{:.2g} deg", m.rotation * 180 / pi) : fmt::format("{:.2g} mm", 1e3 * movement(m));
      text += fmt::format("{} {} ({})", i == 0 ? "" : ",", model.joint_name(m.joint), size);
    }
    if (n > names) text += fmt::format(" and {} more", n - names);
  }
  return text;
}

}  // namespace erbs
