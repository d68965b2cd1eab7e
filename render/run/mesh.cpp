#include "render/run/mesh.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace erbs::render {
namespace {

Loop loop_of(const MotionShape& shape, const std::vector<int>& face) {
  Loop loop;
  for (int i : face) loop.push_back(corner_of(shape, i));
  return loop;
}

Vec3 middle(const Loop& loop) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& p : loop) sum += p;
  return sum / static_cast<double>(std::max<std::size_t>(1, loop.size()));
}

Span append(std::vector<std::uint32_t>& all, const std::vector<std::uint32_t>& some) {
  const Span span{static_cast<std::uint32_t>(all.size()), static_cast<std::uint32_t>(all.size() + some.size())};
  all.insert(all.end(), some.begin(), some.end());
  return span;
}

// A face is buried if joints cover it, up to the gaps of the mortar.
std::vector<bool> find_buried(const MotionScene& scene, int block, const MotionShape& shape, const std::vector<int>& joints) {
  std::vector<bool> buried;
  const Vec3 rest = scene.blocks[static_cast<std::size_t>(block)].rest;
  for (const std::vector<int>& face : shape.faces) {
    const Loop loop = loop_of(shape, face);
    const Vec3 twice = area_normal(loop), n = twice.normalized();
    double covered = 0;
    for (int j : joints) {
      const MotionJoint& joint = scene.joints[static_cast<std::size_t>(j)];
      if (joint.polygon.size() < 3) continue;
      const Vec3 out = joint_normal(scene, joint) * (joint.a == block ? 1.0 : -1.0);
      const Vec3 at = joint.polygon.front() + scene.blocks[static_cast<std::size_t>(joint.a)].rest - rest;
      const double far = std::abs((at - loop.front()).dot(n));
      if (out.dot(n) > 0.999 && far < 0.6 * joint.thickness + 1e-4) covered += 0.5 * area_normal(joint.polygon).norm();
    }
    buried.push_back(covered > 0.93 * 0.5 * twice.norm());
  }
  return buried;
}

}  // namespace

Vec3 area_normal(const Loop& loop) {
  Vec3 n = Vec3::Zero();
  for (std::size_t i = 0; i < loop.size(); ++i) n += loop[i].cross(loop[(i + 1) % loop.size()]);
  return n;
}

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

Vec3 joint_normal(const MotionScene& scene, const MotionJoint& joint) {
  if (joint.normal.norm() > 0.5) return joint.normal.normalized();
  const Vec3 n = area_normal(joint.polygon);
  if (n.norm() == 0) return Vec3::UnitZ();
  const Vec3 from_a = scene.blocks[static_cast<std::size_t>(joint.b)].rest - scene.blocks[static_cast<std::size_t>(joint.a)].rest;
  return (n.dot(from_a) < 0 ? -n : n).normalized();
}

void add_part(Mesh& mesh, const MotionShape& shape, std::uint32_t block, double chamfer, const std::vector<bool>& buried_face,
              Surface<std::vector<std::uint32_t>>& open, Surface<std::vector<std::uint32_t>>& buried) {
  if (chamfer <= 0) {
    for (std::size_t f = 0; f < shape.faces.size(); ++f) {
      const Loop loop = loop_of(shape, shape.faces[f]);
      const Vec3 n = area_normal(loop).normalized();
      std::vector<std::uint32_t> corners;
      for (const Vec3& p : loop) corners.push_back(add_vertex(mesh, p, n, block, no_joint));
      add_fan((buried_face[f] ? buried : open).faces, corners);
    }
    return;
  }
  // Vertices for each corner of each face. The faces around a corner are found by the directed edge that leaves it.
  std::vector<std::vector<std::uint32_t>> ids;
  std::map<std::pair<int, int>, std::pair<std::size_t, std::size_t>> edge;  // from, to -> face, position in its loop
  for (const std::vector<int>& face : shape.faces) {
    const Loop loop = loop_of(shape, face);
    const Vec3 n = area_normal(loop).normalized();
    ids.emplace_back();
    for (const Vec3& p : inset(loop, n, chamfer)) ids.back().push_back(add_vertex(mesh, p, n, block, no_joint));
    add_fan((buried_face[ids.size() - 1] ? buried : open).faces, ids.back());
    for (std::size_t k = 0; k < face.size(); ++k) edge[{face[k], face[(k + 1) % face.size()]}] = {ids.size() - 1, k};
  }
  const auto next = [&](std::size_t face, std::size_t k) { return (k + 1) % shape.faces[face].size(); };
  std::map<int, bool> done;
  for (const auto& [ends, at] : edge) {
    const auto [i, j] = ends;
    const auto opposite = edge.find({j, i});
    if (opposite == edge.end()) continue;
    const auto [f, k] = at;
    const auto [g, m] = opposite->second;
    if (i < j)
      add_fan((buried_face[f] && buried_face[g] ? buried : open).edges, {ids[f][next(f, k)], ids[f][k], ids[g][next(g, m)], ids[g][m]});
    if (done[i]) continue;
    done[i] = true;
    // Walks around corner i, anticlockwise seen from outside: the edge that enters at this face leaves at the next.
    std::vector<std::uint32_t> around;
    bool all_buried = true;
    auto here = at;
    for (std::size_t iteration = 0; iteration < shape.faces.size(); ++iteration) {
      around.push_back(ids[here.first][here.second]);
      all_buried = all_buried && buried_face[here.first];
      const std::vector<int>& loop = shape.faces[here.first];
      const auto before = edge.find({loop[here.second], loop[(here.second + loop.size() - 1) % loop.size()]});
      if (before == edge.end() || before->second == at) break;
      here = before->second;
    }
    add_fan((all_buried ? buried : open).edges, around);
  }
}

namespace {

// Joints of each block.
std::vector<std::vector<int>> joints_of_blocks(const MotionScene& scene) {
  std::vector<std::vector<int>> joints(scene.blocks.size());
  for (std::size_t j = 0; j < scene.joints.size(); ++j)
    for (int block : {scene.joints[j].a, scene.joints[j].b}) joints[static_cast<std::size_t>(block)].push_back(static_cast<int>(j));
  return joints;
}

// Corners moved so that all their faces move by `grow`; approximately if more than three faces meet.
std::vector<Vec3> grown(const MotionShape& shape, double grow) {
  const std::size_t count = shape.vertices.size() / 3;
  std::vector<Mat3> planes(count, Mat3::Zero());
  std::vector<Vec3> sums(count, Vec3::Zero()), result;
  for (const std::vector<int>& face : shape.faces) {
    const Vec3 n = area_normal(loop_of(shape, face)).normalized();
    for (int i : face) {
      planes[static_cast<std::size_t>(i)] += n * n.transpose();
      sums[static_cast<std::size_t>(i)] += n;
    }
  }
  for (std::size_t i = 0; i < count; ++i)
    result.push_back(corner_of(shape, static_cast<int>(i)) + grow * (planes[i] + 1e-6 * Mat3::Identity()).inverse() * sums[i]);
  return result;
}

}  // namespace

void add_shades(Mesh& mesh, const MotionScene& scene, const std::vector<bool>& hidden, double grow, double rim) {
  const std::vector<std::vector<int>> joints = joints_of_blocks(scene);
  for (std::size_t b = 0; b < scene.blocks.size(); ++b) {
    std::vector<std::uint32_t> whole, rims;
    for (int part : scene.blocks[b].parts) {
      if (hidden[b]) continue;
      const MotionShape& shape = scene.shapes[static_cast<std::size_t>(part)];
      const auto first = static_cast<std::uint32_t>(mesh.shades.size());
      const auto add = [&](const Vec3& p) {
        Vertex v{{}, {}, static_cast<std::uint32_t>(b), no_joint};
        for (int k = 0; k < 3; ++k) v.p[k] = static_cast<float>(p[k]);
        mesh.shades.push_back(v);
        return static_cast<std::uint32_t>(mesh.shades.size() - 1);
      };
      const std::vector<Vec3> corners = grown(shape, grow);
      for (const Vec3& p : corners) add(p);
      const std::vector<bool> buried = find_buried(scene, static_cast<int>(b), shape, joints[b]);
      std::set<std::pair<int, int>> open;  // edges of faces that can be seen, in their sense
      for (std::size_t f = 0; f < shape.faces.size(); ++f)
        for (std::size_t k = 0; !buried[f] && k < shape.faces[f].size(); ++k)
          open.emplace(shape.faces[f][k], shape.faces[f][(k + 1) % shape.faces[f].size()]);
      for (std::size_t f = 0; f < shape.faces.size(); ++f) {
        Loop loop;
        std::vector<std::uint32_t> ids;
        for (int i : shape.faces[f])
          loop.push_back(corners[static_cast<std::size_t>(i)]), ids.push_back(first + static_cast<std::uint32_t>(i));
        add_fan(whole, ids);
        if (!buried[f]) add_fan(rims, ids);
        if (!buried[f]) continue;
        const Loop inner = inset(loop, area_normal(loop).normalized(), rim);
        for (std::size_t k = 0, next = 1; k < loop.size(); ++k, next = (k + 1) % loop.size())
          if (open.contains({shape.faces[f][next], shape.faces[f][k]})) add_fan(rims, {ids[k], ids[next], add(inner[next]), add(inner[k])});
      }
    }
    mesh.whole_shade.push_back(append(mesh.shade_index, whole));
    mesh.rim_shade.push_back(append(mesh.shade_index, rims));
  }
}

Mesh build_mesh(const MotionScene& scene, const std::vector<bool>& hidden, double chamfer) {
  Mesh mesh;
  const std::vector<std::vector<int>> touching = joints_of_blocks(scene);
  for (std::size_t b = 0; b < scene.blocks.size(); ++b) {
    Surface<std::vector<std::uint32_t>> open, buried, plain_open, plain_buried;
    for (int part : scene.blocks[b].parts) {
      if (hidden[b]) continue;
      const MotionShape& shape = scene.shapes[static_cast<std::size_t>(part)];
      const std::vector<bool> covered = find_buried(scene, static_cast<int>(b), shape, touching[b]);
      add_part(mesh, shape, static_cast<std::uint32_t>(b), chamfer, covered, open, buried);
      if (chamfer > 0) add_part(mesh, shape, static_cast<std::uint32_t>(b), 0, covered, plain_open, plain_buried);
    }
    const auto appended = [&](const Surface<std::vector<std::uint32_t>>& s) -> Surface<Span> {
      const Span faces = append(mesh.index, s.faces);
      return {faces, append(mesh.index, s.edges)};
    };
    mesh.open.push_back(appended(open));
    mesh.buried.push_back(appended(buried));
    mesh.plain_open.push_back(append(mesh.plain_index, plain_open.faces));
    mesh.plain_buried.push_back(append(mesh.plain_index, plain_buried.faces));
  }
  add_joints(mesh, scene, touching, chamfer);
  return mesh;
}

}  // namespace erbs::render
