// Mesh of mortar and cracks.
#include <algorithm>
#include <array>

#include "render/run/mesh.h"

namespace erbs::render {

bool is_inside(const MotionScene& scene, std::size_t block, const Vec3& world) {
  const MotionBlock& b = scene.blocks[block];
  const Vec3 p = world - b.rest;
  for (int part : b.parts) {
    const MotionShape& s = scene.shapes[static_cast<std::size_t>(part)];
    bool within = true;
    for (std::size_t f = 0; f < s.faces.size() && within; ++f) {
      Loop loop;
      for (int i : s.faces[f])
        loop.emplace_back(s.vertices[3 * static_cast<std::size_t>(i)], s.vertices[3 * static_cast<std::size_t>(i) + 1],
                          s.vertices[3 * static_cast<std::size_t>(i) + 2]);
      within = area_normal(loop).dot(p - loop.front()) <= 0;
    }
    if (within) return true;
  }
  return false;
}

namespace {

std::uint32_t end_of(const std::vector<std::uint32_t>& index) { return static_cast<std::uint32_t>(index.size()); }

// Outward direction, in the plane of the joint, of the side from p to q; the loop is anticlockwise about n.
Vec3 outward(const Vec3& p, const Vec3& q, const Vec3& n) { return (q - p).cross(n).normalized(); }

// A strip of mortar along one side, from `from` to `to` (m) along n.
void add_strip(Mesh& mesh, const Vec3& p, const Vec3& q, const Vec3& n, double from, double to, std::uint32_t block, std::uint32_t joint) {
  const Vec3 out = outward(p, q, n);
  std::vector<std::uint32_t> side;
  for (const Vec3& v : {Vec3(p + from * n), Vec3(q + from * n), Vec3(q + to * n), Vec3(p + to * n)})
    side.push_back(add_vertex(mesh, v, out, block, joint));
  add_fan(mesh.index, side);
}

// The half of the mortar that stays on one block: from mid-thickness by `half` (m, signed) along n to the block's face.
void add_bed(Mesh& mesh, std::vector<std::uint32_t>& faces, const Loop& base, const Vec3& n, double half, std::uint32_t block,
             std::uint32_t joint) {
  std::vector<std::uint32_t> cap;
  for (const Vec3& p : base) cap.push_back(add_vertex(mesh, p, half > 0 ? Vec3(-n) : n, block, joint));
  if (half > 0) std::reverse(cap.begin(), cap.end());
  add_fan(faces, cap);
  for (std::size_t i = 0; i < base.size(); ++i)
    add_strip(mesh, base[i], base[(i + 1) % base.size()], n, std::min(0.0, half), std::max(0.0, half), block, joint);
}

// Which sides of a joint blocks cover, as long as nothing moves; the loop is relative to block a.
std::vector<bool> covered_sides(const MotionScene& scene, const std::vector<std::vector<int>>& touching, const MotionJoint& joint,
                                const Loop& base, const Vec3& n) {
  std::vector<bool> covered;
  std::vector<int> near{joint.a, joint.b};
  for (int block : {joint.a, joint.b})
    for (int j : touching[static_cast<std::size_t>(block)])
      for (int other : {scene.joints[static_cast<std::size_t>(j)].a, scene.joints[static_cast<std::size_t>(j)].b})
        if (std::find(near.begin(), near.end(), other) == near.end()) near.push_back(other);
  const Vec3 origin = scene.blocks[static_cast<std::size_t>(joint.a)].rest;
  const double t = joint.thickness;
  for (std::size_t i = 0; i < base.size(); ++i) {
    const Vec3 &p = base[i], &q = base[(i + 1) % base.size()];
    const Vec3 beyond = origin + 0.5 * (p + q) + outward(p, q, n) * (2.2 * t);
    const auto filled = [&](const Vec3& at) {
      return std::any_of(near.begin(), near.end(), [&](int b) { return is_inside(scene, static_cast<std::size_t>(b), at); });
    };
    covered.push_back(filled(beyond + n * t) && filled(beyond - n * t));
  }
  return covered;
}

// Band of a crack. `polygon` is relative to a; subtracting `to_b` makes it relative to b.
void add_crack(Mesh& mesh, const Loop& polygon, const Vec3& n, const Vec3& to_b, const MotionJoint& joint, std::uint32_t index) {
  const std::size_t count = polygon.size();
  for (std::size_t i = 0; i < count; ++i) {
    const std::array<Vec3, 2> ends{polygon[i], polygon[(i + 1) % count]};
    const Vec3 before = outward(polygon[(i + count - 1) % count], ends[0], n), here = outward(ends[0], ends[1], n);
    const Vec3 after = outward(ends[1], polygon[(i + 2) % count], n);
    const auto first = static_cast<std::uint32_t>(mesh.cracks.size());
    for (int k = 0; k < 4; ++k) {  // a,start  a,end  b,end  b,start
      const bool at_end = k == 1 || k == 2;
      const Vec3 p = ends[at_end ? 1 : 0], other = at_end ? after : before;
      const Vec3 miter = (here + other) / std::max(0.3, 1 + here.dot(other));
      CrackVertex v{
          {}, {}, {}, {}, {}, static_cast<std::uint32_t>(joint.a), static_cast<std::uint32_t>(joint.b), index, k < 2 ? -1.0F : 1.0F};
      for (int c = 0; c < 3; ++c) {
        v.pa[c] = static_cast<float>(p[c]);
        v.pb[c] = static_cast<float>(p[c] - to_b[c]);
        v.out[c] = static_cast<float>(miter[c]);
        v.facing[c] = static_cast<float>(here[c]);
        v.normal[c] = static_cast<float>(n[c]);
      }
      mesh.cracks.push_back(v);
    }
    mesh.crack_index.insert(mesh.crack_index.end(), {first, first + 1, first + 2, first, first + 2, first + 3});
  }
}

}  // namespace

void add_joints(Mesh& mesh, const MotionScene& scene, const std::vector<std::vector<int>>& touching, double chamfer) {
  for (std::size_t j = 0; j < scene.joints.size(); ++j) {
    const MotionJoint& joint = scene.joints[j];
    const auto index = static_cast<std::uint32_t>(j);
    const std::uint32_t begin = end_of(mesh.index), begin_crack = end_of(mesh.crack_index);
    std::uint32_t between = begin, shut = begin;
    std::vector<std::uint32_t> faces;
    if (joint.polygon.size() >= 3) {
      const Vec3 n = joint_normal(scene, joint);
      const Vec3 to_b = scene.blocks[static_cast<std::size_t>(joint.b)].rest - scene.blocks[static_cast<std::size_t>(joint.a)].rest;
      Loop polygon = joint.polygon;
      if (area_normal(polygon).dot(n) < 0) std::reverse(polygon.begin(), polygon.end());
      add_crack(mesh, polygon, n, to_b, joint, index);
      if (joint.thickness > 0) {
        Loop base = inset(polygon, n, 0.5 * chamfer);  // slightly raked
        const std::vector<bool> covered = covered_sides(scene, touching, joint, base, n);
        const double half = 0.5 * (joint.thickness + chamfer);  // as far as the chamfers that are raked with it
        const auto add_side = [&](std::size_t i) {
          add_strip(mesh, base[i], base[(i + 1) % base.size()], n, -half, half, static_cast<std::uint32_t>(joint.a), index);
        };
        for (std::size_t i = 0; i < base.size(); ++i)
          if (!covered[i]) add_side(i);
        shut = end_of(mesh.index);
        for (std::size_t i = 0; i < base.size(); ++i)
          if (covered[i]) add_side(i);
        between = end_of(mesh.index);
        add_bed(mesh, faces, base, n, -0.5 * joint.thickness, static_cast<std::uint32_t>(joint.a), index);
        for (Vec3& p : base) p -= to_b;
        add_bed(mesh, faces, base, n, 0.5 * joint.thickness, static_cast<std::uint32_t>(joint.b), index);
      }
    }
    mesh.sides.push_back({{begin, shut}, {shut, between}});
    const std::uint32_t sides = end_of(mesh.index);
    mesh.index.insert(mesh.index.end(), faces.begin(), faces.end());
    mesh.beds.push_back({{sides, end_of(mesh.index)}, {between, sides}});
    mesh.crack.push_back({begin_crack, end_of(mesh.crack_index)});
  }
}

}  // namespace erbs::render
