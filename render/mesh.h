// Triangles of a scene: bricks with chamfered edges, mortar, and the cracks that open in it.
#pragma once
#include <cstdint>
#include <vector>

#include "engine/record/motion_file.h"

namespace erbs {

// A corner of a brick or of the mortar that sticks to it.
struct Vertex {
  float p[3];           // m, relative to the centroid of its block, world axes at rest
  float n[3];           // unit outward normal of the face
  std::uint32_t block;  // the block it moves with
  std::uint32_t joint;  // the joint whose mortar it is; no_joint on a brick
};
inline constexpr std::uint32_t no_joint = 0xffffffff;

// A corner of the dark band shown in a broken joint. It spans from the mortar of a to that of b, wherever these have gone.
struct CrackVertex {
  float pa[3];      // m, the same point of the joint at rest, relative to the centroid of a ...
  float pb[3];      // m, ... and of b
  float out[3];     // unit, in the plane of the joint, out of the wall (axes at rest)
  float normal[3];  // unit, from a to b (axes at rest)
  std::uint32_t a, b, joint;
  float side;  // -1 on a, +1 on b
};

struct Mesh {
  std::vector<Vertex> vertices;
  std::vector<std::uint32_t> index;
  std::vector<CrackVertex> cracks;
  std::vector<std::uint32_t> crack_index;
};

// A convex part with its edges cut off at `chamfer` (m). Normals are those of the faces, so a chamfer is shaded round.
void add_part(Mesh& mesh, const MotionShape& shape, std::uint32_t block, double chamfer);

// `hidden[block]`: not drawn (the ground is a plane of its own). chamfer in m.
Mesh build_mesh(const MotionScene& scene, const std::vector<bool>& hidden, double chamfer);

// Unit normal of the joint from a to b.
Vec3 joint_normal(const MotionScene& scene, const MotionJoint& joint);

}  // namespace erbs
