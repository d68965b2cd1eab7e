#include "engine/model/build/add_joints.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "engine/base/count.h"
#include "engine/base/hash.h"
#include "engine/base/units.h"
#include "engine/geometry/quadrature.h"
#include "engine/laws/crushing.h"
#include "engine/model/build/strength_field.h"

namespace erbs {
namespace {

// Integrals over a loop, summed over triangles from the origin: Int s s = A/12 ((sum s)^2 + sum s^2) over a triangle. A loop of one corner
// has its weight (m2) there.
Cell cell_of(const std::vector<Vec2>& loop, double weight = 0) {
  Cell c;
  if (loop.size() == 1) {
    const double s = loop[0].x(), t = loop[0].y();
    c.s = weight * s, c.t = weight * t, c.ss = weight * s * s, c.tt = weight * t * t, c.st = weight * s * t;
    return c;
  }
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

// Bending stiffness of the true overlap; that of its points if both agree to round-off, or if they bear it.
void set_face(const Model& m, const PointLaw& law, JointType& joint) {
  const Cell whole = cell_of({m.overlap_corner.begin() + joint.first_corner, m.overlap_corner.end()});
  const double face[3] = {law.kn * whole.tt, law.kn * whole.ss, law.kn * whole.st}, round_off = 1e-9 * (face[0] + face[1]);
  const bool exact = m.cell[z(joint.first_cell)].lumped() ||
                     std::fabs(face[0] - joint.stiffness[3]) + std::fabs(face[1] - joint.stiffness[4]) + std::fabs(face[2]) < round_off;
  for (int i = 0; i < 3; ++i) joint.face[i] = !exact ? face[i] : i < 2 ? joint.stiffness[3 + i] : 0;
}

// b = 2 xi / omega. omega is the specified frequency, or the joint's own: that of its two blocks moving against each other.
void set_viscous(const Damping& damping, const Model& m, Joint& joint) {
  const auto inverse = [&](int b) { return m.kind[z(b)] == Kind::moving ? 1 / m.mass[z(b)] : 0.0; };
  const double own = std::sqrt(joint.type->stiffness[2] * (inverse(joint.a) + inverse(joint.b)));
  const double omega = damping.at > 0 ? 2 * pi * damping.at : own;
  joint.viscous = damping.stiffness + (omega > 0 ? 2 * damping.joint_ratio / omega : 0);
  const bool sequential = m.analysis.solver == "sequential";  // has no dashpots
  joint.viscous_cracked = std::max(joint.viscous, own > 0 && !sequential ? 2 * m.laws[z(joint.type->law)].damping / own : 0);
}

void add_cell(const std::vector<Vec2>& loop, double weight, Model& m) {
  Cell cell = cell_of(loop, weight);
  cell.first = int(m.cell_loop.size());
  cell.corners = int(loop.size());
  m.cell.push_back(cell);
  m.cell_loop.insert(m.cell_loop.end(), loop.begin(), loop.end());
}

// Joint types by a hash of their content.
using Types = std::unordered_multimap<std::uint64_t, const JointType*>;

template <class T>
std::string_view bytes_of(const std::vector<T>& items, int first, int count) {
  return {reinterpret_cast<const char*>(items.data() + first), z(count) * sizeof(T)};
}

// Full content of a type, in pieces: numbers of points and corners, plane geometry, frame. The other members of a type follow from it.
struct Pieces {
  std::vector<int> numbers;
  std::array<std::string_view, 5> bytes;
  bool operator==(const Pieces&) const = default;
};

Pieces pieces_of(const Model& m, const JointType& type) {
  std::vector<int> numbers{type.rule, type.law, type.points, type.corners};
  int corners = 0;
  for (int i = 0; i < type.points; ++i) {
    numbers.push_back(m.cell[z(type.first_cell + i)].corners);
    corners += numbers.back();
  }
  const int first = m.cell[z(type.first_cell)].first;
  return {numbers,
          {bytes_of(m.point, type.first_cell, type.points),
           bytes_of(m.overlap_corner, type.first_corner, type.corners),
           bytes_of(m.cell_loop, first, corners),
           bytes_of(m.tension_loop, first, corners),
           {reinterpret_cast<const char*>(type.frame.data()), sizeof type.frame}}};
}

// Type of the joint whose geometry was added last. If an earlier type is equal to the last bit, it is returned and the new geometry
// removed.
const JointType* shared_type(Model& m, const JointType& type, Types& types) {
  const Pieces own = pieces_of(m, type);
  std::uint64_t key = fnv1a(bytes_of(own.numbers, 0, int(own.numbers.size())));
  for (const std::string_view piece : own.bytes) key = fnv1a(piece, key);
  const auto [first, last] = types.equal_range(key);
  const auto same = std::find_if(first, last, [&](const auto& other) { return pieces_of(m, *other.second) == own; });
  if (same == last) {
    m.joint_types.push_back(std::make_shared<const JointType>(type));
    types.emplace(key, m.joint_types.back().get());
    return m.joint_types.back().get();
  }
  const auto loops = z(m.cell[z(type.first_cell)].first);
  m.point.resize(z(type.first_cell));
  m.cell.resize(z(type.first_cell));
  m.cell_loop.resize(loops);
  m.tension_loop.resize(loops);
  m.overlap_corner.resize(z(type.first_corner));
  return same->second;
}

// The joint of one interface: contact points, principal frame, diagonal stiffness.
void add_joint(const Scene& scene, const Interface& face, Model& m, StrengthField& strength, Types& types) {
  const JointRule& rule = scene.joint_rules[z(face.rule)];
  const Vec3 origin = face.polygon.front(), n = face.normal;
  const Vec3 e1 = (face.polygon[1] - origin).normalized(), e2 = n.cross(e1);
  Polygon2 flat;
  for (const Vec3& p : face.polygon) flat.emplace_back(e1.dot(p - origin), e2.dot(p - origin));
  auto points = quadrature(flat, rule.rule, rule.points_long, rule.points_short);
  if (rule.pressure == "points")
    for (auto& p : points) p.cell = p.tension_loop = {Vec2(p.x, p.y)};
  const PrincipalAxes axes = principal_axes(points);
  const double cosine = std::cos(axes.angle), sine = std::sin(axes.angle);
  const auto local = [&](double x, double y) {
    const double dx = x - axes.centroid.x(), dy = y - axes.centroid.y();
    return Vec2(cosine * dx + sine * dy, cosine * dy - sine * dx);
  };
  JointType type;
  type.rule = face.rule;
  type.frame.col(0) = cosine * e1 + sine * e2;
  type.frame.col(1) = cosine * e2 - sine * e1;
  type.frame.col(2) = n;
  const Vec3 centre = origin + axes.centroid.x() * e1 + axes.centroid.y() * e2;
  type.first_cell = int(m.point.size());
  type.points = int(points.size());
  type.law = strength.law_of(face.rule, int(m.joint.size()), centre);
  const PointLaw& law = m.laws[z(type.law)];
  for (const auto& p : points) {
    const Vec2 x = local(p.x, p.y);
    m.point.push_back({x.x(), x.y(), p.weight});
    std::vector<Vec2> loop;
    for (const Vec2& v : p.cell) loop.push_back(local(v.x(), v.y()));
    add_cell(loop, p.weight, m);
    for (const Vec2& v : p.tension_loop) m.tension_loop.push_back(local(v.x(), v.y()));
    type.inset = type.inset || p.tension_loop != p.cell;
    type.area += p.weight;
    type.stiffness[3] += law.kn * p.weight * x.y() * x.y();
    type.stiffness[4] += law.kn * p.weight * x.x() * x.x();
    type.stiffness[5] += law.ks * p.weight * x.squaredNorm();
  }
  type.stiffness[0] = type.stiffness[1] = law.ks * type.area;
  type.stiffness[2] = law.kn * type.area;
  type.first_corner = int(m.overlap_corner.size());
  type.corners = int(flat.size());
  if (law.crushes() && type.corners > CompressionFace::most_corners)
    throw Error(fmt::format("the joint between {} and {} has {} corners; a law with fc takes up to {}", m.block_name[z(face.a)],
                            m.block_name[z(face.b)], type.corners, CompressionFace::most_corners),
                scene.blocks[z(face.a)].place);
  if (law.crushes() && rule.pressure == "points" && type.points > CrushedFace::most_points)
    throw Error(fmt::format("joint: {} contact points bear the joint between {} and {}; with fc, up to {} do: take fewer points, or "
                            "pressure = \"face\"",
                            type.points, m.block_name[z(face.a)], m.block_name[z(face.b)], CrushedFace::most_points),
                rule.place);
  for (const Vec2& p : flat) {
    const Vec2 x = local(p.x(), p.y());
    m.overlap_corner.push_back(x);
    type.half_s = std::max(type.half_s, std::fabs(x.x()));
    type.half_t = std::max(type.half_t, std::fabs(x.y()));
    type.radius = std::max(type.radius, x.norm());
  }
  set_face(m, law, type);
  Joint joint;
  joint.type = shared_type(m, type, types);
  joint.a = face.a, joint.part_a = face.part_a, joint.face_a = face.face_a;
  joint.b = face.b, joint.part_b = face.part_b, joint.face_b = face.face_b;
  joint.arm_a = centre - m.rest[z(face.a)];
  joint.arm_b = centre - m.rest[z(face.b)];
  joint.gap = face.gap;
  joint.first_point = m.npoint;
  m.npoint += type.points;
  set_viscous(scene.damping, m, joint);
  m.joint.push_back(joint);
}

}  // namespace

void add_joints(const Scene& scene, const std::vector<Interface>& faces, Model& m) {
  Types types;
  StrengthField strength(scene, m);
  m.joint.reserve(faces.size());
  for (const Interface& face : faces) add_joint(scene, face, m, strength, types);
}

void each_contact_part(const Model& m, const std::function<void(int, const Polyhedron&)>& use) {
  std::map<std::pair<int, int>, std::vector<double>> offsets;  // (block, part) -> per face
  const auto note = [&](int block, int part, int face, double half) {
    auto& list = offsets[{block, part}];
    if (list.empty()) list.assign(m.parts[z(block)][z(part)].faces.size(), infinite);
    list[z(face)] = std::min(list[z(face)], half);
  };
  for (const Joint& joint : m.joint) {
    note(joint.a, joint.part_a, joint.face_a, 0.5 * joint.gap);
    note(joint.b, joint.part_b, joint.face_b, 0.5 * joint.gap);
  }
  for (int b = 0; b < m.nblock; ++b)
    for (int i = 0; i < int(m.parts[z(b)].size()); ++i) {
      Polyhedron part = translated(m.parts[z(b)][z(i)], -m.rest[z(b)]);
      const auto at = offsets.find({b, i});
      if (at == offsets.end()) {
        use(b, part);
        continue;
      }
      for (double& x : at->second)
        if (x == infinite) x = 0;
      try {
        part = grown(part, at->second);
      } catch (const Error& error) {
        throw Error(fmt::format("block '{}', grown to the middle of its joints: {}", m.block_name[z(b)], error.what()));
      }
      use(b, part);
    }
}

}  // namespace erbs
