#include "engine/model/build.h"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <string_view>
#include <tuple>
#include <unordered_map>

#include "engine/base/hash.h"
#include "engine/base/units.h"
#include "engine/geometry/mass.h"
#include "engine/geometry/quadrature.h"
#include "engine/model/batches.h"
#include "engine/model/interface.h"

namespace erbs {
namespace {

constexpr double most_overlap = 1e-3;  // of the smaller edge
constexpr double infinite = std::numeric_limits<double>::infinity();
std::size_t z(int i) { return std::size_t(i); }

std::vector<InterfaceBlock> interface_blocks(const Scene& scene) {
  std::vector<InterfaceBlock> blocks;
  for (const Block& b : scene.blocks) blocks.push_back({b.parts, b.group, b.fixed});
  return blocks;
}

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
    std::vector<Polyhedron> own;
    for (const Polyhedron& part : block.parts) {
      edge = std::min(edge, thickness(part));
      own.push_back(translated(part, -p.centroid));
    }
    m.smallest_edge.push_back(edge);
    m.shapes.push_back(std::move(own));
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
        m.pushes.push_back({load.wave, load.direction, b, load.has_point ? Vec3(load.point - m.rest[z(b)]) : Vec3(Vec3::Zero()), false});
        break;
      case Load::Kind::moment:
        m.pushes.push_back({load.wave, load.direction, b, Vec3::Zero(), true});
        break;
      case Load::Kind::motion:
        m.drives.push_back({load.wave, load.direction, b, false, Vec3::Zero()});
        m.kind[z(b)] = Kind::driven;
        break;
      case Load::Kind::turning:
        m.drives.push_back(
            {load.wave, load.direction.normalized(), b, true, load.has_point ? Vec3(m.rest[z(b)] - load.point) : Vec3(Vec3::Zero())});
        m.kind[z(b)] = Kind::driven;
        break;
    }
  }
}

// Integrals over a loop, by triangles about the origin: Int s s = A/12 ((sum s)^2 + sum s^2) over each.
Cell cell_of(const std::vector<Vec2>& loop) {
  Cell c;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Vec2 &a = loop[i], &b = loop[(i + 1) % loop.size()];
    const double area = 0.5 * (a.x() * b.y() - b.x() * a.y());
    c.s += area / 3 * (a.x() + b.x());
    c.t += area / 3 * (a.y() + b.y());
    c.ss += area / 6 * (a.x() * a.x() + a.x() * b.x() + b.x() * b.x());
    c.tt += area / 6 * (a.y() * a.y() + a.y() * b.y() + b.y() * b.y());
    c.st += area / 12 * (2 * a.x() * a.y() + a.x() * b.y() + b.x() * a.y() + 2 * b.x() * b.y());
  }
  return c;
}

// Bending of the true overlap, against that of its points.
void set_face(const Model& m, const PointLaw& law, Joint& joint) {
  const Cell whole = cell_of({m.corner.begin() + joint.first_corner, m.corner.end()});
  const double face[3] = {law.kn * whole.tt, law.kn * whole.ss, law.kn * whole.st}, round_off = 1e-9 * (face[0] + face[1]);
  const bool exact = std::fabs(face[0] - joint.stiffness[3]) + std::fabs(face[1] - joint.stiffness[4]) + std::fabs(face[2]) < round_off;
  for (int i = 0; i < 3; ++i) joint.face[i] = !exact ? face[i] : i < 2 ? joint.stiffness[3 + i] : 0;
}

// b = 2 xi / omega: of the frequency asked for, or of the joint's own, both its blocks moving against each other.
void set_viscous(const Damping& damping, const Model& m, Joint& joint) {
  const auto inverse = [&](int b) { return m.kind[z(b)] == Kind::moving ? 1 / m.mass[z(b)] : 0.0; };
  const double own = std::sqrt(joint.stiffness[2] * (inverse(joint.a) + inverse(joint.b)));
  const double omega = damping.at > 0 ? 2 * pi * damping.at : own;
  joint.viscous = damping.stiffness + (omega > 0 ? 2 * damping.joint_ratio / omega : 0);
  const bool sequential = m.analysis.solver == "sequential";  // knows no dashpots
  joint.viscous_cracked = std::max(joint.viscous, own > 0 && !sequential ? 2 * m.laws[z(joint.law)].damping / own : 0);
}

void add_cell(const std::vector<Vec2>& loop, Model& m) {
  Cell cell = cell_of(loop);
  cell.first = int(m.cell_corner.size());
  cell.corners = int(loop.size());
  m.cell.push_back(cell);
  m.cell_corner.insert(m.cell_corner.end(), loop.begin(), loop.end());
}

// Flat geometry that joints share: bricks of one bond give the same numbers again and again. By a hash of them, joints that have them.
using Places = std::unordered_multimap<std::uint64_t, int>;

template <class T>
std::string_view bytes_of(const std::vector<T>& items, int first, int count) {
  return {reinterpret_cast<const char*>(items.data() + first), z(count) * sizeof(T)};
}

int loops(const Model& m, const Joint& joint) {  // corners of its cells
  int sum = 0;
  for (int i = 0; i < joint.points; ++i) sum += m.cell[z(joint.first_place + i)].corners;
  return sum;
}

// What says all of a joint's flat geometry, in pieces; cells follow from their loops.
std::array<std::string_view, 4> flat_geometry(const Model& m, const Joint& joint) {
  const int first = m.cell[z(joint.first_place)].first, count = loops(m, joint);
  return {bytes_of(m.point, joint.first_place, joint.points), bytes_of(m.corner, joint.first_corner, joint.corners),
          bytes_of(m.cell_corner, first, count), bytes_of(m.cell_watch, first, count)};
}

// Takes away the geometry just added for this joint if an earlier one has the same to the last bit.
void share_geometry(Model& m, Joint& joint, Places& places) {
  const auto own = flat_geometry(m, joint);
  std::uint64_t key = z(joint.points);
  for (const std::string_view piece : own) key = fnv1a(piece, key);
  for (auto [at, end] = places.equal_range(key); at != end; ++at) {
    const Joint& other = m.joint[z(at->second)];
    if (other.points != joint.points || flat_geometry(m, other) != own) continue;
    bool same = true;
    for (int i = 0; i < joint.points; ++i) same = same && m.cell[z(joint.first_place + i)].corners == m.cell[z(other.first_place + i)].corners;
    if (!same) continue;
    const auto first_loop = m.cell[z(joint.first_place)].first;
    m.point.resize(z(joint.first_place));
    m.cell_corner.resize(z(first_loop));
    m.cell_watch.resize(z(first_loop));
    m.cell.resize(z(joint.first_place));
    m.corner.resize(z(joint.first_corner));
    joint.first_place = other.first_place;
    joint.first_corner = other.first_corner;
    return;
  }
  places.emplace(key, int(m.joint.size()));
}

// The joint of one interface: contact points, principal frame, diagonal stiffness.
void add_joint(const Scene& scene, const Interface& face, Model& m, Places& places) {
  const JointRule& rule = scene.joint_rules[z(face.rule)];
  const Vec3 origin = face.polygon.front(), n = face.normal;
  const Vec3 e1 = (face.polygon[1] - origin).normalized(), e2 = n.cross(e1);
  Polygon2 flat;
  for (const Vec3& p : face.polygon) flat.emplace_back(e1.dot(p - origin), e2.dot(p - origin));
  const auto points = quadrature(flat, rule.rule, rule.points_long, rule.points_short);
  const PrincipalAxes axes = principal_axes(points);
  const double cosine = std::cos(axes.angle), sine = std::sin(axes.angle);
  const auto local = [&](double x, double y) {
    const double dx = x - axes.centroid.x(), dy = y - axes.centroid.y();
    return Vec2(cosine * dx + sine * dy, cosine * dy - sine * dx);
  };
  Joint joint;
  joint.a = face.a, joint.part_a = face.part_a;
  joint.b = face.b, joint.part_b = face.part_b;
  joint.law = joint.rule = face.rule;
  joint.frame.col(0) = cosine * e1 + sine * e2;
  joint.frame.col(1) = cosine * e2 - sine * e1;
  joint.frame.col(2) = n;
  const Vec3 centre = origin + axes.centroid.x() * e1 + axes.centroid.y() * e2;
  joint.arm_a = centre - m.rest[z(face.a)];
  joint.arm_b = centre - m.rest[z(face.b)];
  joint.gap = face.gap;
  joint.first_point = m.npoint;
  joint.first_place = int(m.point.size());
  joint.points = int(points.size());
  m.npoint += joint.points;
  const PointLaw& law = m.laws[z(face.rule)];
  for (const auto& p : points) {
    const Vec2 x = local(p.x, p.y);
    m.point.push_back({x.x(), x.y(), p.weight});
    std::vector<Vec2> loop;
    for (const Vec2& v : p.cell) loop.push_back(local(v.x(), v.y()));
    add_cell(loop, m);
    for (const Vec2& v : p.watch) m.cell_watch.push_back(local(v.x(), v.y()));
    joint.inset = joint.inset || p.watch != p.cell;
    joint.area += p.weight;
    joint.stiffness[3] += law.kn * p.weight * x.y() * x.y();
    joint.stiffness[4] += law.kn * p.weight * x.x() * x.x();
    joint.stiffness[5] += law.ks * p.weight * x.squaredNorm();
  }
  joint.stiffness[0] = joint.stiffness[1] = law.ks * joint.area;
  joint.stiffness[2] = law.kn * joint.area;
  joint.first_corner = int(m.corner.size());
  joint.corners = int(flat.size());
  if (law.fc > 0 && joint.corners > Bed::most_corners)
    throw Error(fmt::format("the joint between {} and {} has {} corners; a law with fc takes up to {}", m.block_name[z(face.a)],
                            m.block_name[z(face.b)], joint.corners, Bed::most_corners));
  for (const Vec2& p : flat) {
    const Vec2 x = local(p.x(), p.y());
    m.corner.push_back(x);
    joint.half_s = std::max(joint.half_s, std::fabs(x.x()));
    joint.half_t = std::max(joint.half_t, std::fabs(x.y()));
    joint.radius = std::max(joint.radius, x.norm());
  }
  set_face(m, law, joint);
  set_viscous(scene.damping, m, joint);
  share_geometry(m, joint, places);
  m.joint.push_back(joint);
}

// Contact polyhedra: each jointed face moved out by half its bed, so that a stress-free joint is a closed contact.
void grow_shapes(const Scene& scene, const Interfaces& found, Model& m) {
  std::map<std::pair<int, int>, std::vector<double>> offsets;  // (block, part) -> per face
  const auto note = [&](int block, int part, int face, double half) {
    auto& list = offsets[{block, part}];
    if (list.empty()) list.assign(scene.blocks[z(block)].parts[z(part)].faces.size(), infinite);
    list[z(face)] = std::min(list[z(face)], half);
  };
  for (const Interface& face : found.all) {
    note(face.a, face.part_a, face.face_a, 0.5 * face.gap);
    note(face.b, face.part_b, face.face_b, 0.5 * face.gap);
  }
  for (auto& [key, list] : offsets) {
    for (double& x : list)
      if (x == infinite) x = 0;
    auto& shape = m.shapes[z(key.first)][z(key.second)];
    shape = grown(shape, list);
  }
}

void index_rows(Model& m) {
  m.njoint = int(m.joint.size());
  m.first_row.assign(z(m.nblock) + 1, 0);
  for (const Joint& j : m.joint) ++m.first_row[z(j.a) + 1], ++m.first_row[z(j.b) + 1];
  for (int b = 0; b < m.nblock; ++b) m.first_row[z(b) + 1] += m.first_row[z(b)];
  std::vector<int> next(m.first_row.begin(), m.first_row.end() - 1);
  for (const Joint& j : m.joint) {
    m.row_a.push_back(next[z(j.a)]++);
    m.row_b.push_back(next[z(j.b)]++);
  }
}

// Overlaps of blocks made by the same two lines are one mistake: the deepest is named, the others are counted.
struct Overlapping {
  const Overlap* deepest = nullptr;
  int others = 0;
};

void check_overlaps(const Scene& scene, const std::vector<Overlap>& overlaps, std::vector<std::string>& errors,
                    std::vector<std::string>& warnings) {
  std::map<std::tuple<int, std::string, int, std::string, bool>, Overlapping> by_lines;
  for (const Overlap& o : overlaps) {
    const Block &a = scene.blocks[z(o.a)], &b = scene.blocks[z(o.b)];
    if (a.fixed && b.fixed) continue;
    const bool wrong = o.relative > most_overlap && scene.analysis.overlap != "stress_free";
    Overlapping& group = by_lines[{b.place.line, b.place.file, a.place.line, a.place.file, wrong}];
    if (group.deepest) ++group.others;
    if (!group.deepest || o.relative > group.deepest->relative) group.deepest = &o;
  }
  for (const auto& [key, group] : by_lines) {
    const Overlap& o = *group.deepest;
    const Block &a = scene.blocks[z(o.a)], &b = scene.blocks[z(o.b)];
    const std::string more = group.others > 0 ? fmt::format(" ({} more pair(s) of these lines do so, too)", group.others) : "";
    const std::string what = fmt::format("blocks '{}' ({}) and '{}' ({}) overlap by {:.3g} mm, {:.2g} of their smaller edge{}", a.name,
                                         a.place.text(), b.name, b.place.text(), 1e3 * o.depth, o.relative, more);
    if (std::get<bool>(key))
      errors.push_back(fmt::format("{}: {}; at most {:g} is allowed: part them, or say analysis{{ overlap = \"stress_free\" }}",
                                   b.place.text(), what, most_overlap));
    else warnings.push_back(what + "; taken as free of force at rest");
  }
}

// Blocks that no joint holds although they neither start in motion nor say free = true; those of one line are one mistake.
void check_loose(const Scene& scene, const Interfaces& found, const Model& m, std::vector<std::string>& errors) {
  std::vector<int> degree(z(m.nblock), 0);
  for (const Interface& face : found.all) ++degree[z(face.a)], ++degree[z(face.b)];
  std::map<std::pair<int, std::string>, std::pair<const Block*, int>> by_line;
  for (int b = 0; b < m.nblock; ++b) {
    const Block& block = scene.blocks[z(b)];
    if (degree[z(b)] > 0 || m.kind[z(b)] != Kind::moving || block.free || block.initial.given) continue;
    auto& [first, others] = by_line[{block.place.line, block.place.file}];
    if (first) ++others;
    else first = &block;
  }
  for (const auto& [line, group] : by_line) {
    const auto& [block, others] = group;
    const std::string who = others > 0 ? fmt::format("block '{}' and {} more of this line have", block->name, others)
                                       : fmt::format("block '{}' has", block->name);
    errors.push_back(
        fmt::format("{}: {} no joint with any other; let a face meet a neighbour within a joint's thickness and tolerance, "
                    "give a joint{{}} rule for its group, or say free = true",
                    block->place.text(), who));
  }
}

// A rule that joins nothing is legal (a later one may win), but often a slip in its groups or its thickness.
void check_rules(const Scene& scene, const Interfaces& found, std::vector<std::string>& warnings) {
  std::vector<int> faces(scene.joint_rules.size(), 0);
  for (const Interface& face : found.all) ++faces[z(face.rule)];
  for (size_t r = 0; r < faces.size(); ++r) {
    const JointRule& rule = scene.joint_rules[r];
    if (faces[r] > 0 || rule.none) continue;
    warnings.push_back(
        fmt::format("{}: this joint rule joins nothing: between \"{}\" and \"{}\" no faces lie at most {:g} mm apart, or later "
                    "rules take them; look at between, thickness and tolerance",
                    rule.place.text(), rule.group_a, rule.group_b, 1e3 * (rule.thickness + rule.tolerance)));
  }
}

void check_blocks(const Scene& scene, const Interfaces& found, const Model& m, std::vector<std::string>& errors,
                  std::vector<std::string>& warnings) {
  check_overlaps(scene, found.overlaps, errors, warnings);
  check_loose(scene, found, m, errors);
  check_rules(scene, found, warnings);
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
  s.u.assign(n, Vec3::Zero());
  s.q.assign(n, Quat::Identity());
  s.v = s.spin_momentum = s.w = s.base_u = s.u;
  s.base_q = s.q;
  s.row.assign(block_groups(m.nblock) * lanes, 0.0);
  s.island.assign(n, -1);
  s.grounded.assign(n, 0);
  s.loose.assign(n, 0);
  s.joined.assign(n, 0);
  for (int b = 0; b < m.nblock; ++b) {
    const Initial& i = scene.blocks[z(b)].initial;
    if (i.given) {
      s.q[z(b)] = rotation(i.rotation);
      const Vec3 arm = i.has_about ? Vec3(m.rest[z(b)] - i.about) : Vec3(Vec3::Zero());
      s.u[z(b)] = i.position + s.q[z(b)] * arm - arm;
    }
    if (m.kind[z(b)] != Kind::moving) continue;
    s.v[z(b)] = i.velocity;
    s.w[z(b)] = i.spin;
    const Mat3 r = s.q[z(b)].toRotationMatrix();
    s.spin_momentum[z(b)] = r * (m.inertia[z(b)] * (r.transpose() * i.spin));
  }
  set_batches(m, s);
  s.tier.assign(z(m.njoint), Tier::intact);
  s.memory.clear(z(m.njoint));
  s.history.clear(z(m.npoint));
  if (std::any_of(m.laws.begin(), m.laws.end(), [](const PointLaw& law) { return law.fc > 0; })) s.crushed.clear(z(m.njoint));
  if (m.dashpots_cracked) s.viscous.assign(6 * z(m.njoint), 0.0);
  s.wrench.assign(2 * z(m.njoint) + 1, 0.0);
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
  const Interfaces found = find_interfaces(interface_blocks(scene), scene.joint_rules);
  std::vector<std::string> errors;
  check_blocks(scene, found, m, errors, m.warnings);
  if (!errors.empty()) throw Errors(errors);
  Places places;
  m.joint.reserve(found.all.size());
  for (const Interface& face : found.all) add_joint(scene, face, m, places);
  m.dashpots = std::any_of(m.joint.begin(), m.joint.end(), [](const Joint& joint) { return joint.viscous > 0; });
  m.dashpots_cracked = std::any_of(m.joint.begin(), m.joint.end(), [](const Joint& joint) { return joint.viscous_cracked > 0; });
  grow_shapes(scene, found, m);
  index_rows(m);
  for (int b = 0; b < m.nblock; ++b) {
    const bool moving = m.kind[z(b)] == Kind::moving;
    m.inverse_mass.push_back(moving ? 1 / m.mass[z(b)] : 0);
    m.inverse_inertia.push_back(moving ? Mat3(m.inertia[z(b)].inverse()) : Mat3(Mat3::Zero()));
  }
  out.state = start(scene, m);
  return out;
}

std::vector<std::string> overlap_mistakes(const Scene& scene) {
  for (const Block& block : scene.blocks)
    for (const Polyhedron& part : block.parts)
      if (!problem_of(part).empty()) return {};
  std::vector<std::string> errors, warnings;
  check_overlaps(scene, find_interfaces(interface_blocks(scene), {}).overlaps, errors, warnings);
  return errors;
}

}  // namespace erbs
