// Triangles of a scene: bricks with chamfered edges, mortar, and opening cracks in it.
#pragma once
#include <cstdint>
#include <vector>

#include "engine/record/folder/motion_file.h"

namespace erbs::render {

// A vertex of a brick, or of mortar that sticks to it.
struct Vertex {
  float p[3];           // m, relative to the centroid of its block, world axes at rest
  float n[3];           // unit outward normal of the face
  std::uint32_t block;  // the block it moves with
  std::uint32_t joint;  // the joint of this mortar; no_joint on a brick
};
inline constexpr std::uint32_t no_joint = 0xffffffff;

// A vertex of the dark band that shows a broken joint. The band spans from the mortar of a to the mortar of b at their present poses.
struct CrackVertex {
  float pa[3];      // m, a point of the joint at rest, relative to the centroid of a ...
  float pb[3];      // m, ... and the same point relative to the centroid of b
  float out[3];     // in the plane of the joint, out of the wall; at the ends of a side between the directions of both sides (axes at rest)
  float facing[3];  // unit, the direction of its own side (axes at rest)
  float normal[3];  // unit, from a to b (axes at rest)
  std::uint32_t a, b, joint;
  float side;  // -1 on a, +1 on b
};

// A range of triangles, as positions in an index.
struct Span {
  std::uint32_t begin = 0, end = 0;
};

// Triangles of whole faces, and of their chamfers, which are about a pixel wide.
template <class T>
struct Surface {
  T faces, edges;
};

// Sides of the mortar of a joint at the wall's surface, and those that other blocks cover as long as nothing moves.
struct Sides {
  Span open, covered;
};

// Most of an intact wall is invisible: faces inside it, and mortar behind the pointing. These triangles are kept separate and drawn only
// around joints that have moved.
struct Mesh {
  std::vector<Vertex> vertices;
  std::vector<std::uint32_t> index;
  std::vector<Surface<Span>> open, buried;  // of each block [blocks]
  // Whole faces up to the edges of a block, for one so far away that its chamfers are hardly to be seen: they are most of its triangles.
  std::vector<std::uint32_t> plain_index;
  std::vector<Span> plain_open, plain_buried;  // in plain_index; empty where there are no chamfers [blocks]
  std::vector<Sides> sides;                    // of the mortar of a closed joint [joints]
  std::vector<Surface<Span>> beds;             // mortar bed of a moved joint, half of it on each block: its faces, and its sides [joints]
  // Shadow casters: bare blocks, enlarged until they meet across their joints, so that no light passes through mortar.
  std::vector<Vertex> shades;
  std::vector<std::uint32_t> shade_index;
  // A block whose joints are closed casts the shadow of its free faces and of the rims that its buried faces turn to the open, in which
  // mortar lies in the shade. Deeper in the wall no light is seen, and there are the most faces. [blocks]
  std::vector<Span> whole_shade, rim_shade;
  std::vector<CrackVertex> cracks;
  std::vector<std::uint32_t> crack_index;
  std::vector<Span> crack;  // of each joint, in crack_index [joints]
};

// `hidden[block]`: not drawn, since the ground is a plane of its own. `chamfer`: m, width cut off each edge; 0: sharp edges. Normals are
// those of the faces, so a chamfer is shaded round.
Mesh build_mesh(const MotionScene& scene, const std::vector<bool>& hidden, double chamfer);

// Fills mesh.shades. `grow`: m, outward offset of each face; `rim`: m, width of the rims.
void add_shades(Mesh& mesh, const MotionScene& scene, const std::vector<bool>& hidden, double grow, double rim);

// Is this point (m) within the block at rest, or on its surface?
bool is_inside(const MotionScene& scene, std::size_t block, const Vec3& world);

// Unit normal of the joint from a to b.
Vec3 joint_normal(const MotionScene& scene, const MotionJoint& joint);

// Parts of build_mesh.
using Loop = std::vector<Vec3>;
Vec3 area_normal(const Loop& loop);                     // Newell's normal; its length is twice the area
Loop inset(const Loop& loop, const Vec3& n, double d);  // sides moved inwards by d, or less on a narrow face
std::uint32_t add_vertex(Mesh& mesh, const Vec3& p, const Vec3& n, std::uint32_t block, std::uint32_t joint);
void add_fan(std::vector<std::uint32_t>& index, const std::vector<std::uint32_t>& loop);
// Adds a convex part. Its triangles go to `open`, or to `buried` if they touch only faces with buried_face.
void add_part(Mesh& mesh, const MotionShape& shape, std::uint32_t block, double chamfer, const std::vector<bool>& buried_face,
              Surface<std::vector<std::uint32_t>>& open, Surface<std::vector<std::uint32_t>>& buried);
// touching[block]: joints of each block.
void add_joints(Mesh& mesh, const MotionScene& scene, const std::vector<std::vector<int>>& touching, double chamfer);

}  // namespace erbs::render
