#include "render/mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace erbs {
namespace {

using Loop = std::vector<Vec3>;

Vec3 corner(const MotionShape& s, int i) {
  const std::size_t k = 3 * static_cast<std::size_t>(i);
  return {s.vertices[k], s.vertices[k + 1], s.vertices[k + 2]};
}

// Newell's normal; its length is twice the area.
Vec3 area_normal(const Loop& loop) {
  Vec3 n = Vec3::Zero();
  for (std::size_t i = 0; i < loop.size(); ++i) n += loop[i].cross(loop[(i + 1) % loop.size()]);
  return n;
}

Vec3 middle(const Loop& loop) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& p : loop) sum += p;
  return sum / static_cast<double>(std::max<std::size_t>(1, loop.size()));
}

// The loop with each side moved inwards by d, or by less where the face is too narrow for that.
Loop inset(const Loop& loop, const Vec3& n, double d) {
  const std::size_t count = loop.size();
  const Vec3 c = middle(loop);
  std::vector<Vec3> inward(count);
  for (std::size_t i = 0; i < count; ++i) {
    inward[i] = n.cross(loop[(i + 1) % count] - loop[i]).normalized();
    d = std::min(d, 0.3 * std::abs(inward[i].dot(c - loop[i])));
  }
  Loop result(count);
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 &before = inward[(i + count - 1) % count], &after = inward[i];
    // The point at distance d from both sides.
    result[i] = loop[i] + (before + after) * (d / std::max(0.05, 1 + before.dot(after)));
  }
  return result;
}

std::uint32_t add_vertex(Mesh& mesh, const Vec3& p, const Vec3& n, std::uint32_t block, std::uint32_t joint) {
  Vertex v{{}, {}, block, joint};
  for (int k = 0; k < 3; ++k) v.p[k] = static_cast<float>(p[k]), v.n[k] = static_cast<float>(n[k]);
  mesh.vertices.push_back(v);
  return static_cast<std::uint32_t>(mesh.vertices.size() - 1);
}

void add_fan(std::vector<std::uint32_t>& index, const std::vector<std::uint32_t>& loop) {
  for (std::size_t i = 2; i < loop.size(); ++i) index.insert(index.end(), {loop[0], loop[i - 1], loop[i]});
}

// Mortar between `base` (in the middle of the joint) and the face of the block, `half` (m, signed) along n.
void add_mortar(Mesh& mesh, const Loop& base, const Vec3& n, double half, std::uint32_t block, std::uint32_t joint) {
  const std::size_t count = base.size();
  const Vec3 to_face = half * n;
  std::vector<std::uint32_t> cap;
  for (const Vec3& p : base) cap.push_back(add_vertex(mesh, p, half > 0 ? Vec3(-n) : n, block, joint));
  if (half > 0) std::reverse(cap.begin(), cap.end());
  add_fan(mesh.index, cap);
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 &p = base[i], &q = base[(i + 1) % count];
    const Vec3 out = (q - p).cross(n).normalized();
    std::vector<std::uint32_t> side;
    for (const Vec3& v : {p, q, Vec3(q + to_face), Vec3(p + to_face)}) side.push_back(add_vertex(mesh, v, out, block, joint));
    if (half < 0) std::reverse(side.begin(), side.end());
    add_fan(mesh.index, side);
  }
}

// polygon relative to a; to_b: what to subtract to have it relative to b.
void add_crack(Mesh& mesh, const Loop& polygon, const Vec3& n, const Vec3& to_b, const MotionJoint& joint, std::uint32_t index) {
  const std::size_t count = polygon.size();
  for (std::size_t i = 0; i < count; ++i) {
    const std::array<Vec3, 2> ends{polygon[i], polygon[(i + 1) % count]};
    const Vec3 before = (polygon[i] - polygon[(i + count - 1) % count]).cross(n).normalized();
    const Vec3 here = (ends[1] - ends[0]).cross(n).normalized();
    const Vec3 after = (polygon[(i + 2) % count] - ends[1]).cross(n).normalized();
    const auto first = static_cast<std::uint32_t>(mesh.cracks.size());
    for (int k = 0; k < 4; ++k) {  // a,start  a,end  b,end  b,start
      const bool at_end = k == 1 || k == 2;
      const Vec3 p = ends[at_end ? 1 : 0], out = here + (at_end ? after : before);
      const Vec3 miter = out / std::max(0.3, 1 + here.dot(at_end ? after : before));
      CrackVertex v{{}, {}, {}, {}, static_cast<std::uint32_t>(joint.a), static_cast<std::uint32_t>(joint.b), index, k < 2 ? -1.0F : 1.0F};
      for (int c = 0; c < 3; ++c) {
        v.pa[c] = static_cast<float>(p[c]);
        v.pb[c] = static_cast<float>(p[c] - to_b[c]);
        v.out[c] = static_cast<float>(miter[c]);
        v.normal[c] = static_cast<float>(n[c]);
      }
      mesh.cracks.push_back(v);
    }
    mesh.crack_index.insert(mesh.crack_index.end(), {first, first + 1, first + 2, first, first + 2, first + 3});
  }
}

void add_joint(Mesh& mesh, const MotionScene& scene, std::size_t j, double chamfer) {
  const MotionJoint& joint = scene.joints[j];
  if (joint.polygon.size() < 3) return;
  const Vec3 n = joint_normal(scene, joint);
  const Vec3 to_b = scene.blocks[static_cast<std::size_t>(joint.b)].rest - scene.blocks[static_cast<std::size_t>(joint.a)].rest;
  Loop polygon = joint.polygon;
  if (area_normal(polygon).dot(n) < 0) std::reverse(polygon.begin(), polygon.end());
  const auto index = static_cast<std::uint32_t>(j);
  add_crack(mesh, polygon, n, to_b, joint, index);
  if (joint.thickness <= 0) return;
  Loop on_a = inset(polygon, n, 0.5 * chamfer);  // raked a little, so that courses read
  add_mortar(mesh, on_a, n, -0.5 * joint.thickness, static_cast<std::uint32_t>(joint.a), index);
  for (Vec3& p : on_a) p -= to_b;
  add_mortar(mesh, on_a, n, 0.5 * joint.thickness, static_cast<std::uint32_t>(joint.b), index);
}

}  // namespace

Vec3 joint_normal(const MotionScene& scene, const MotionJoint& joint) {
  if (joint.normal.norm() > 0.5) return joint.normal.normalized();
  const Vec3 n = area_normal(joint.polygon);
  if (n.norm() == 0) return Vec3::UnitZ();
  const Vec3 from_a = scene.blocks[static_cast<std::size_t>(joint.b)].rest - scene.blocks[static_cast<std::size_t>(joint.a)].rest;
  return (n.dot(from_a) < 0 ? -n : n).normalized();
}

void add_part(Mesh& mesh, const MotionShape& shape, std::uint32_t block, double chamfer) {
  // The vertex of each corner of each face; faces around a corner are found by the directed edge that leaves it.
  std::vector<std::vector<std::uint32_t>> ids;
  std::map<std::pair<int, int>, std::pair<std::size_t, std::size_t>> edge;  // from, to -> face, position in its loop
  for (const std::vector<int>& face : shape.faces) {
    Loop loop;
    for (int i : face) loop.push_back(corner(shape, i));
    const Vec3 n = area_normal(loop).normalized();
    ids.emplace_back();
    for (const Vec3& p : inset(loop, n, chamfer)) ids.back().push_back(add_vertex(mesh, p, n, block, no_joint));
    add_fan(mesh.index, ids.back());
    for (std::size_t k = 0; k < face.size(); ++k) edge[{face[k], face[(k + 1) % face.size()]}] = {ids.size() - 1, k};
  }
  auto next = [&](std::size_t face, std::size_t k) { return (k + 1) % shape.faces[face].size(); };
  std::map<int, bool> done;
  for (const auto& [ends, at] : edge) {
    const auto [i, j] = ends;
    const auto opposite = edge.find({j, i});
    if (opposite == edge.end()) continue;
    const auto [f, k] = at;
    const auto [g, m] = opposite->second;
    if (i < j) add_fan(mesh.index, {ids[f][next(f, k)], ids[f][k], ids[g][next(g, m)], ids[g][m]});
    if (done[i]) continue;
    done[i] = true;
    // Around corner i: from an edge that leaves it to the twin that arrives, whose successor leaves in the next face.
    std::vector<std::uint32_t> around;
    auto here = at;
    for (std::size_t turn = 0; turn < shape.faces.size(); ++turn) {
      around.push_back(ids[here.first][here.second]);
      const std::vector<int>& loop = shape.faces[here.first];
      const auto before = edge.find({loop[here.second], loop[(here.second + loop.size() - 1) % loop.size()]});
      if (before == edge.end() || before->second == at) break;
      here = before->second;
    }
    add_fan(mesh.index, around);
  }
}

Mesh build_mesh(const MotionScene& scene, const std::vector<bool>& hidden, double chamfer) {
  Mesh mesh;
  for (std::size_t b = 0; b < scene.blocks.size(); ++b) {
    if (hidden[b]) continue;
    for (int part : scene.blocks[b].parts)
      add_part(mesh, scene.shapes[static_cast<std::size_t>(part)], static_cast<std::uint32_t>(b), chamfer);
  }
  for (std::size_t j = 0; j < scene.joints.size(); ++j) add_joint(mesh, scene, j, chamfer);
  return mesh;
}

}  // namespace erbs
