#include "engine/solve/contacts/bodies.h"

#include <algorithm>

#include "engine/base/count.h"
#include "engine/contact/broad/search.h"
#include "engine/contact/law/frame.h"
#include "engine/model/build/add_joints.h"

namespace erbs {
namespace {

double largest_inverse_inertia(const Mat3& inverse) {
  // Gershgorin's bound by rows, exact for a block along its principal axes.
  return inverse.cwiseAbs().rowwise().sum().maxCoeff();
}

}  // namespace

std::vector<std::uint64_t> jointed_pairs(const Model& model, const State& state) {
  std::vector<std::uint64_t> out;
  for (int j = 0; j < model.njoint; ++j)
    if (state.joints.stage[z(j)] != JointStage::contact) out.push_back(pair_key(model.joint[z(j)].a, model.joint[z(j)].b));
  return out;
}

void ContactBodies::initialise() {
  if (!block.empty()) return;
  std::vector<std::vector<Polyhedron>> parts(z(model.nblock));
  each_contact_part(model, [&](int b, const Polyhedron& part) { parts[z(b)].push_back(part); });
  block.resize(z(model.nblock));
  for (int b = 0; b < model.nblock; ++b) {
    ContactBlock& one = block[z(b)];
    one.rest = model.rest[z(b)];
    one.inverse_mass = model.inverse_mass[z(b)];
    one.inverse_inertia = largest_inverse_inertia(model.inverse_inertia[z(b)]);
    const Mat3 to = contact_axes(parts[z(b)]);
    one.inverse_tensor = to.transpose() * model.inverse_inertia[z(b)] * to;
    if (to == Mat3::Identity()) continue;
    set_axes(b, to);
    for (Polyhedron& part : parts[z(b)])
      for (Vec3& v : part.vertices) v = to.transpose() * v;
  }
  shapes = contact_shapes(parts, block);
  reach.assign(block_groups(model.nblock) * pack_size, 0.0);
  for (std::size_t i = 0; i < shapes.of.size(); ++i) {
    double& farthest = reach[z(shapes.block[i])];
    farthest = std::max(farthest, shapes.part(i).reach);
  }
  neighbours.resize(z(model.nblock));
  for (int j = 0; j < model.njoint; ++j) {
    const auto key = pair_key(model.joint[z(j)].a, model.joint[z(j)].b);
    if (!joined.empty() && joined.back() == key) continue;
    joined.push_back(key);
    first_joint.push_back(j);
    neighbours[z(model.joint[z(j)].a)].push_back(model.joint[z(j)].b);
    neighbours[z(model.joint[z(j)].b)].push_back(model.joint[z(j)].a);
  }
}

void ContactBodies::set_axes(int b, const Mat3& to) {
  axes.resize(block_groups(model.nblock));
  Axes& group = axes[z(b / pack_size)];
  for (int l = 0; l < pack_size && !group.any; ++l)
    for (int i = 0; i < 3; ++i) group.row.x[4 * i][l] = 1;
  group.any = true;
  for (int i = 0; i < 9; ++i) group.row.x[i][b % pack_size] = to(i / 3, i % 3);
}

Mat3 ContactBodies::axes_of(int b) const {
  Mat3 out = Mat3::Identity();
  if (const Axes* group = axes_of_group(z(b / pack_size)))
    for (int i = 0; i < 9; ++i) out(i / 3, i % 3) = group->row.x[i][b % pack_size];
  return out;
}

Mat3 ContactBodies::rotation_of(int b) const {
  const Mat3& rotation = block[z(b)].rotation;
  return axes_of_group(z(b / pack_size)) ? Mat3(rotation * axes_of(b).transpose()) : rotation;
}

PairLaw ContactBodies::law(int a, int b) const {
  return pair_law(model.materials[z(model.material[z(a)])], model.materials[z(model.material[z(b)])]);
}

bool ContactBodies::were_joined(int a, int b) const {
  return std::binary_search(joined.begin(), joined.end(), a < b ? pair_key(a, b) : pair_key(b, a));
}

int ContactBodies::first_joint_of(const ContactPair& p) const {
  const auto at = std::lower_bound(joined.begin(), joined.end(), pair_key(p.a, p.b));
  int first = first_joint[std::size_t(at - joined.begin())];
  while (model.joint[z(first)].part_a != p.part_a || model.joint[z(first)].part_b != p.part_b)
    first = end_of_same_parts(first, model.njoint);
  return first;
}

int ContactBodies::end_of_same_parts(int first, int end) const {
  const Joint& one = model.joint[z(first)];
  int last = first + 1;
  while (last < end && model.joint[z(last)].a == one.a && model.joint[z(last)].b == one.b && model.joint[z(last)].part_a == one.part_a &&
         model.joint[z(last)].part_b == one.part_b)
    ++last;
  return last;
}

EdgeAtRest ContactBodies::edge_of(const ContactPair& pair) const {
  if (were_joined(pair.a, pair.b) || std::ranges::none_of(neighbours[z(pair.a)], [&](int c) { return were_joined(c, pair.b); })) return {};
  ContactBlock a = block[z(pair.a)], b = block[z(pair.b)];
  a.u = b.u = Vec3::Zero();
  a.rotation = axes_of(pair.a), b.rotation = axes_of(pair.b);
  return edge_at_rest(pair, pair_frame(pair, shapes, a, b), model.edge_force);
}

}  // namespace erbs
