// Contact shape of one convex part of a block, laid out for clipping.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "engine/contact/overlap/clip.h"
#include "engine/geometry/polyhedron.h"

namespace erbs {

// Limits for one part. The number of faces is that of a body with so many corners if all its faces are triangles. Beyond these limits a
// stone takes milliseconds per step.
inline constexpr int most_vertices = 256, most_faces = 2 * most_vertices;
using Word = std::uint64_t;  // sets of vertices, as bits of a few words
inline constexpr int word_bits = 64, most_words = most_vertices / word_bits;

struct ContactBlock;

struct ContactShape {
  std::vector<Vec3> vertex;     // m, relative to the centroid of the block        [nv]
  std::vector<Vec3> normal;     // unit, outward                                   [nf]
  std::vector<double> offset;   // m, normal . x of the face                       [nf]
  int words = 1;                // per set of vertices
  std::vector<Word> mask;       // vertices of each face, word by word             [nf * words]
  std::vector<int> loop_first;  // start of each face's loop in `loop`              [nf + 1]
  std::vector<int> loop;        // vertices counter-clockwise seen from outside
  std::vector<Vec3> edge;       // unit, distinct directions of the edges
  double volume = 0;            // m3
  double thickness = 0;         // m, least distance between two parallel planes that enclose it
  double smallest_edge = 0;     // m
  double largest_face = 0;      // m2
  // m2/kg, omega^2 of the block by a contact on any one face, at most, per Pa/m of stiffness across and along the face; 0: unknown
  double face_across = 0, face_along = 0;
  double radius = 0;      // m, of the enclosing sphere about `centre`
  double reach = 0;       // m, of the enclosing sphere about the block's centroid
  bool is_small = false;  // few vertices and faces: `small` has them too
  SmallShape small;
  Vec3 centre, half;  // m, centre and half sides of its box
};

// `part`: relative to the centroid of its block, in axes that rotate with the block (`contact_axes()`). Throws Error for more vertices or
// faces than `most_vertices` or `most_faces`.
ContactShape contact_shape(const Polyhedron& part);

// The parts of all blocks; block b has `[first[b], first[b + 1])`. Parts that are equal up to round-off share a shape, so that a step with
// a thousand equal bricks reads one brick.
struct ContactShapes {
  std::vector<ContactShape> shape;
  std::vector<int> of;     // shape of each part
  std::vector<int> first;  // [nblock + 1]
  std::vector<int> block;  // of each part

  const ContactShape& part(std::size_t i) const { return shape[std::size_t(of[i])]; }
};
// Sets `face_across` and `face_along` of a part of `block`.
void set_face_omega2(ContactShape& part, const ContactBlock& block);
// `blocks`: the blocks of these parts, for `set_face_omega2()`; empty: the rates are unknown.
ContactShapes contact_shapes(const std::vector<std::vector<Polyhedron>>& parts_of_blocks, std::span<const ContactBlock> blocks = {});

// Axes (columns) of the smallest box about the parts of a block, among axes along its faces and the world axes; world axes if equally good.
// Congruent blocks in different attitudes have equal shapes in these axes.
Mat3 contact_axes(const std::vector<Polyhedron>& parts);

// Present pose and motion of a block; `inverse_mass` and `inverse_inertia` of fixed blocks are 0.
struct alignas(64) ContactBlock {
  Vec3 u = Vec3::Zero();             // m, displacement of the centroid
  Mat3 rotation = Mat3::Identity();  // from the axes of its shapes to world axes
  Vec3 v = Vec3::Zero();             // m/s, of the centroid, at the half step before the pose
  Vec3 w = Vec3::Zero();             // rad/s, world axes, at the same half step
  // constants; `track()` of `pair_lanes.h` writes the members above
  double inverse_mass = 0;             // 1/kg
  double inverse_inertia = 0;          // 1/(kg m2), of the smallest principal inertia
  Vec3 rest = Vec3::Zero();            // m, centroid at rest
  Mat3 inverse_tensor = Mat3::Zero();  // 1/(kg m2), axes of its shapes
};

}  // namespace erbs
