// Contact shape of one convex part of a block, laid out for clipping.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "engine/contact/clip.h"
#include "engine/geometry/polyhedron.h"

namespace erbs {

// Of one part. As many faces as so many corners can have, if all were triangles; past the bounds a stone asks for milliseconds a step.
inline constexpr int most_vertices = 256, most_faces = 2 * most_vertices;
using Word = std::uint64_t;  // sets of vertices are bits of a few words
inline constexpr int word_bits = 64, most_words = most_vertices / word_bits;

struct ContactBlock;

struct ContactShape {
  std::vector<Vec3> vertex;         // m, relative to the centroid of the block        [nv]
  std::vector<Vec3> normal;         // unit, outward                                   [nf]
  std::vector<double> offset;       // m, normal . x of the face                       [nf]
  int words = 1;                    // of a set of vertices
  std::vector<Word> mask;           // vertices of each face, word by word             [nf * words]
  std::vector<int> loop_first;      // start of each face's loop in `loop`              [nf + 1]
  std::vector<int> loop;            // vertices counter-clockwise seen from outside
  std::vector<Vec3> edge;           // unit, directions of the edges, parallel ones once
  double volume = 0;                // m3
  double thickness = 0;             // m, smallest distance between two parallel planes that hold it
  double smallest_edge = 0;         // m
  double largest_face = 0;          // m2
  // 1/kg m2: what a face resists with at most, for each Pa/m across and along it, against the mass of the block, as omega^2; 0: not known
  double face_across = 0, face_along = 0;
  double radius = 0;      // m, of the sphere about `centre` that holds it
  double reach = 0;       // m, of the sphere about the block's centroid that holds it
  bool is_small = false;  // few vertices and faces: `small` holds them too
  SmallShape small;
  Vec3 centre, half;  // m, middle and half sides of its box
};

// `part` relative to the centroid of its block, in axes that turn with it (contact_axes). Throws Error where it has more vertices
// or faces than most_vertices or most_faces.
ContactShape contact_shape(const Polyhedron& part);

// The parts of all blocks; those of block b are [first[b], first[b + 1]). Parts that are equal but for round-off share a shape, so that
// what a step reads of a thousand bricks is one brick.
struct ContactShapes {
  std::vector<ContactShape> shape;
  std::vector<int> of;     // shape of each part
  std::vector<int> first;  // [nblock + 1]
  std::vector<int> block;  // of each part

  const ContactShape& part(std::size_t i) const { return shape[std::size_t(of[i])]; }
};
// Sets face_across and face_along of a part of `block`.
void set_face_rates(ContactShape& part, const ContactBlock& block);
// `blocks`: whose parts they are, for set_face_rates(); empty: those rates are not known.
ContactShapes contact_shapes(const std::vector<std::vector<Polyhedron>>& parts_of_blocks, std::span<const ContactBlock> blocks = {});

// Axes, as columns, in which the box about the parts of a block is smallest, of those along its faces and those of the world; the latter
// where they do as well. Congruent blocks that lie in the world in different ways are equal in theirs.
Mat3 contact_axes(const std::vector<Polyhedron>& parts);

// Current pose and motion of a block; fixed blocks have inverse_mass and inverse_inertia 0.
struct alignas(64) ContactBlock {
  Vec3 u = Vec3::Zero();         // m, displacement of the centroid
  Mat3 turn = Mat3::Identity();  // from the axes of its shapes to those of the world
  Vec3 v = Vec3::Zero();         // m/s, of the centroid, at the half step before the pose
  Vec3 w = Vec3::Zero();         // rad/s, world axes, at the same half step
  // what stays: follow() of pair_lanes.h writes what is above
  double inverse_mass = 0;             // 1/kg
  double inverse_inertia = 0;          // 1/(kg m2), of the smallest principal inertia
  Vec3 rest = Vec3::Zero();            // m, centroid at rest
  Mat3 inverse_tensor = Mat3::Zero();  // 1/(kg m2), axes of its shapes
};

}  // namespace erbs
