#include "engine/model/build/build.h"

#include <algorithm>
#include <limits>
#include <map>
#include <utility>

#include "engine/base/count.h"
#include "engine/base/units.h"
#include "engine/geometry/mass.h"
#include "engine/model/build/add_joints.h"
#include "engine/model/build/check_joined.h"
#include "engine/model/build/check_overlaps.h"
#include "engine/model/build/interface.h"
#include "engine/model/joint_packs.h"
#include "engine/model/owner_schedule.h"

namespace erbs {
namespace {

void add_blocks(const Scene& scene, Model& m) {
  for (const Block& block : scene.blocks) {
    const Material& material = scene.materials[z(block.material)];
    const MassProperties p = mass_properties(block.parts);
    m.block_name.push_back(block.name);
    m.kind.push_back(block.fixed ? Kind::fixed : Kind::moving);
    m.mass.push_back(p.volume * material.density);
    m.inertia.push_back(p.inertia * material.density);
    m.rest.push_back(p.centroid);
    double edge = infinite;
    for (const Polyhedron& part : block.parts) { edge = std::min(edge, thickness(part)); }
    m.smallest_edge.push_back(edge);
    m.thickness.push_back(thickness(block.parts));
    m.parts.push_back(block.parts);
    m.material.push_back(block.material);
  }
  m.nblock = int(scene.blocks.size());
}

void add_loads(const Scene& scene, Model& m) {
  std::map<std::string, int> index;
  for (int b = 0; b < m.nblock; ++b) index[m.block_name[z(b)]] = b;
  for (const Load& load : scene.loads) {
    const int b = load.block.empty() ? -1 : index.at(load.block);
    switch (load.kind) {
      case Load::Kind::ground:
        m.grounds.push_back({load.wave, load.direction});
        break;
      case Load::Kind::tilt:
        m.tilts.push_back({load.wave, load.direction.normalized()});
        break;
      case Load::Kind::force:
        m.force_loads.push_back(
            {load.wave, load.direction, b, load.has_point ? Vec3(load.point - m.rest[z(b)]) : Vec3(Vec3::Zero()), false});
        break;
      case Load::Kind::moment:
        m.force_loads.push_back({load.wave, load.direction, b, Vec3::Zero(), true});
        break;
      case Load::Kind::motion:
        m.prescribed_motions.push_back({load.wave, load.direction, b, false, Vec3::Zero()});
        m.kind[z(b)] = Kind::driven;
        break;
      case Load::Kind::turning:
        m.prescribed_motions.push_back(
            {load.wave, load.direction.normalized(), b, true, load.has_point ? Vec3(m.rest[z(b)] - load.point) : Vec3(Vec3::Zero())});
        m.kind[z(b)] = Kind::driven;
        break;
    }
  }
}

void index_wrench_rows(Model& m) {
  m.njoint = int(m.joint.size());
  m.wrench_row_a.resize(z(m.njoint)), m.wrench_row_b.resize(z(m.njoint));
  const auto moving = [&](int b) { return m.kind[z(b)] == Kind::moving; };
  std::vector<int> ends(z(m.nblock), 0);
  for (const Joint& j : m.joint) ++ends[z(j.a)], ++ends[z(j.b)];
  m.first_wrench_slot.assign(1, 0);
  for (int g = 0; g < int(block_groups(m.nblock)); ++g) {
    int most = 0;
    for (int b = g * pack_size; b < std::min((g + 1) * pack_size, m.nblock); ++b)
      if (moving(b)) most = std::max(most, ends[z(b)]);
    m.first_wrench_slot.push_back(m.first_wrench_slot.back() + most);
  }
  m.first_wrench_row.assign(1, pack_size * m.first_wrench_slot.back());
  for (int b = 0; b < m.nblock; ++b) m.first_wrench_row.push_back(m.first_wrench_row.back() + (moving(b) ? 0 : ends[z(b)]));
  std::vector<int> next(z(m.nblock));
  for (int b = 0; b < m.nblock; ++b)
    next[z(b)] = moving(b) ? m.first_wrench_slot[z(b / pack_size)] * pack_size + b % pack_size : m.first_wrench_row[z(b)];
  const auto take = [&](int b) { return std::exchange(next[z(b)], next[z(b)] + (moving(b) ? pack_size : 1)); };
  for (int j = 0; j < m.njoint; ++j) {
    m.wrench_row_a[z(j)] = take(m.joint[z(j)].a);
    m.wrench_row_b[z(j)] = take(m.joint[z(j)].b);
  }
}

// Limits the number of contact points before memory is allocated.
void check_points(const Scene& scene, const Interfaces& found, std::vector<std::string>& errors) {
  double points = 0;
  for (const Interface& face : found.all) {
    const JointRule& rule = scene.joint_rules[z(face.rule)];
    points += double(rule.points_long) * rule.points_short;
  }
  if (points > scene.most_points)
    errors.push_back(
        fmt::format("{}: {} joints have {:.4g} contact points; at most {} are allowed: take fewer points a joint, or say "
                    "--max-points with what the memory bears (about 0.5 KiB each once all is cracked)",
                    scene.file, found.all.size(), points, scene.most_points));
}

void check_blocks(const Scene& scene, const Interfaces& found, Built& out, std::vector<std::string>& errors) {
  check_points(scene, found, errors);
  check_overlaps(scene, found.overlaps, found.cut, errors, out.warnings, out.notes);
  if (found.cut) {
    if (errors.empty())
      errors.push_back(fmt::format("{}: more than {} pairs of blocks overlap; part them", scene.file, found.overlaps.size() - 1));
    return;
  }
  check_joined(scene, found, out.model.kind, errors, out.warnings);
  for (const Interface& face : found.all) {
    const JointRule& rule = scene.joint_rules[z(face.rule)];
    if (rule.points_long * rule.points_short > most_points_per_joint) {
      errors.push_back(fmt::format("{}: {} x {} contact points per joint are more than {}", rule.place.text(), rule.points_long,
                                   rule.points_short, most_points_per_joint));
      break;
    }
  }
}

State start(const Scene& scene, const Model& m) {
  State s;
  const std::size_t n = z(m.nblock) + 1;
  s.pose.u.assign(n, Vec3::Zero());
  s.pose.q.assign(n, Quat::Identity());
  s.motion.v = s.motion.spin_momentum = s.motion.w = s.cache.ref_u = s.pose.u;
  s.cache.ref_q = s.pose.q;
  s.cache.pose_row.assign(block_groups(m.nblock) * pack_size, 0.0);
  s.cache.increment.assign(block_groups(m.nblock), {});
  s.topology.island.assign(n, -1);
  s.topology.grounded.assign(n, 0);
  s.topology.loose.assign(n, 0);
  s.topology.joined.assign(n, 0);
  for (int b = 0; b < m.nblock; ++b) {
    const Initial& i = scene.blocks[z(b)].initial();
    if (i.given) {
      s.pose.q[z(b)] = rotation(i.rotation);
      const Vec3 arm = i.has_about ? Vec3(m.rest[z(b)] - i.about) : Vec3(Vec3::Zero());
      s.pose.u[z(b)] = i.position + s.pose.q[z(b)] * arm - arm;
    }
    if (m.kind[z(b)] != Kind::moving) continue;
    s.motion.v[z(b)] = i.velocity;
    s.motion.w[z(b)] = i.spin;
    const Mat3 r = s.pose.q[z(b)].toRotationMatrix();
    s.motion.spin_momentum[z(b)] = r * (m.inertia[z(b)] * (r.transpose() * i.spin));
  }
  set_slots(m, s);
  s.joints.stage.assign(z(m.njoint), JointStage::intact);
  s.joints.memory.clear(z(m.njoint));
  s.joints.history.clear(z(m.npoint));
  if (std::any_of(m.laws.begin(), m.laws.end(), [](const PointLaw& law) { return law.crushes(); })) s.joints.crushed.clear(z(m.njoint));
  if (std::any_of(m.laws.begin(), m.laws.end(), [](const PointLaw& law) { return law.fades(); })) s.joints.share.resize(z(m.njoint));
  if (m.dashpots_cracked) s.joints.viscous.assign(6 * z(m.njoint), 0.0);
  s.cache.wrench.assign(z(spare_row_of_intact(m, intact_packs(m))) + 1, 0.0);
  s.cache.owner_sum.assign(block_groups(m.nblock), {});
  s.cache.neighbour_force.assign(m.owner_schedule.other.size() + 1, {});
  return s;
}

}  // namespace

Built build(const Scene& scene) {
  Built out;
  Model& m = out.model;
  m.materials = scene.materials;
  m.gravity = scene.gravity;
  m.damping = scene.damping;
  if (scene.damping.scope == "none") m.damping.mass = 0;
  m.damping_explicit = scene.damping.form == "explicit";
  m.damping_all = scene.damping.scope == "all";
  m.analysis = scene.analysis;
  for (const JointRule& rule : scene.joint_rules) m.laws.push_back(rule.none ? PointLaw{} : compile(rule.law));
  add_blocks(scene, m);
  add_loads(scene, m);
  Interfaces found = find_interfaces(interface_blocks(scene), scene.joint_rules, 0.05, most_overlaps(scene));
  std::vector<std::string> errors;
  check_blocks(scene, found, out, errors);
  if (!errors.empty()) throw Errors(errors);
  add_joints(scene, found.all, m);
  found = {};
  each_contact_part(m, [](int, const Polyhedron&) {});  // throws for parts of which no body is left
  m.dashpots = std::any_of(m.joint.begin(), m.joint.end(), [](const Joint& joint) { return joint.viscous > 0; });
  m.dashpots_cracked = std::any_of(m.joint.begin(), m.joint.end(), [](const Joint& joint) { return joint.viscous_cracked > 0; });
  choose_owners(m);
  index_wrench_rows(m);
  m.owner_schedule = make_owner_schedule(m);
  for (int b = 0; b < m.nblock; ++b) {
    const bool moving = m.kind[z(b)] == Kind::moving;
    m.inverse_mass.push_back(moving ? 1 / m.mass[z(b)] : 0);
    m.inverse_inertia.push_back(moving ? Mat3(m.inertia[z(b)].inverse()) : Mat3(Mat3::Zero()));
  }
  out.state = start(scene, m);
  warn_of_pressed_starts(scene, m, out.state, out.warnings);
  return out;
}

}  // namespace erbs
