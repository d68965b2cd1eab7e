// The Model: all data that stay constant after the run is prepared. All data that change are in state.h. A step is a function of both.
#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "engine/laws/interlock.h"
#include "engine/laws/laws.h"
#include "engine/model/joint_pack.h"
#include "engine/model/owner_schedule.h"
#include "engine/scene/scene.h"

namespace erbs {

enum class Kind : std::uint8_t { moving, fixed, driven };

// A joint is the interface of two faces that touch at rest. In its frame (s, t, n) the axis n points from a to b; s and t are the principal
// axes of its contact points about their weighted centre. The elastic resultant is diagonal in this frame.
// JointType holds the data that joints share if all numbers are equal to the last bit, as bricks of one bond do.
struct JointType {
  int law = 0;                        // index into Model::laws
  int rule = 0;                       // index into Scene::joint_rules
  int first_cell = 0, points = 0;     // into Model::point and cell
  int first_corner = 0, corners = 0;  // into Model::overlap_corner
  Mat3 frame;                         // columns s, t, n at rest
  double area = 0;                    // m2
  double stiffness[6] = {};           // N/m (s, t, n), N m (about s, t, n): elastic resultant = stiffness * q
  // N m, kn times Int t2, Int s2, Int s t over the overlap: bending stiffness of a cracked joint in compression over its whole face. For
  // rules that are exact in bending, and where points bear the face: stiffness[3], stiffness[4] and 0.
  double face[3] = {};
  bool inset = false;             // its cells check tension inside of their corners: no points on the edge
  double half_s = 0, half_t = 0;  // m, largest |s| and |t| of the corners
  double radius = 0;              // m, largest distance of a corner from the centre
};
struct Joint {
  const JointType* type = nullptr;  // one of Model::joint_types
  int a = 0, b = 0;
  int part_a = 0, part_b = 0;  // of the blocks
  int face_a = 0, face_b = 0;  // of the parts
  int first_point = 0;         // first of its points in JointState::history
  bool owned_by_b = false;     // owner of the intact joint, in whose lane it is evaluated: b, else a (`choose_owners`)
  Vec3 arm_a, arm_b;           // m, from the centroids to the weighted centre of its contact points, at rest
  double viscous = 0;          // s, dashpot coefficient b of the intact joint, c = b k
  double viscous_cracked = 0;  // s, the same of the cracked joint
  double gap = 0;              // m, between the faces at rest
  Hop hop;                     // laws/interlock.h
};

// A contact point in the joint frame: position and share of the area.
struct Point {
  double s, t;    // m
  double weight;  // m2
};

// The part of the overlap that a contact point represents (geometry/quadrature.h), joint frame. Where a point bears its share of the face
// alone, all of it lies at the point: the loop has one corner.
struct Cell {
  int first = 0, corners = 0;  // into Model::cell_loop and tension_loop
  bool lumped() const { return corners == 1; }
  double s = 0, t = 0, ss = 0, st = 0, tt = 0;  // m3, m4: integrals of s, t, s2, s t, t2 over it
};

struct Model {
  int nblock = 0, njoint = 0, npoint = 0;
  // blocks                                                              [nblock]
  std::vector<std::string> block_name;
  std::vector<Kind> kind;
  std::vector<double> mass;           // kg
  std::vector<double> inverse_mass;   // 1/kg; 0 for fixed and driven
  std::vector<Mat3> inertia;          // kg m2, about the centroid, axes at rest
  std::vector<Mat3> inverse_inertia;  // 0 for fixed and driven
  std::vector<Vec3> rest;             // m, centroid at rest
  // Gravity and the acceleration of the ground act on a block with this factor: its weight over g times `mass`, where a relaxation has
  // scaled the masses (analysis/quasi_static). Empty: 1.
  std::vector<double> gravity_factor;
  std::vector<double> smallest_edge;  // m, thinnest extent of a part: the scale of penetration
  std::vector<double> thickness;      // m, thinnest extent of the whole block: the scale of falling
  std::vector<int> material;
  // joints, sorted by lower block, higher block and their parts         [njoint]
  std::vector<Joint> joint;
  std::vector<std::shared_ptr<const JointType>> joint_types;
  std::vector<Point> point;                              // of all joint types
  std::vector<Eigen::Vector2d> overlap_corner;           // m, of the overlap polygon in the joint frame
  std::vector<Cell> cell;                                // one for each of `point`
  std::vector<Eigen::Vector2d> cell_loop, tension_loop;  // m, joint frame: loops of the cells, and the loops on which they check tension
  std::vector<PointLaw> laws;                            // one per joint rule, then the strengths of those with scatter
  OwnerSchedule owner_schedule;                          // owner schedule of intact joints
  // Wrench rows, one per joint end. Group g of eight moving blocks owns slots [first_wrench_slot[g], first_wrench_slot[g+1]); a slot has
  // eight rows, one for each block. The rows of other blocks follow behind all slots. The last row is a spare one.
  std::vector<int> first_wrench_slot;           // [groups + 1]
  std::vector<int> first_wrench_row;            // first row of each other block [nblock + 1]
  std::vector<int> wrench_row_a, wrench_row_b;  // wrench row of each end       [njoint]
  // loads, resolved to block indices
  struct ForceLoad {
    Wave wave;
    Vec3 direction;
    int block;
    Vec3 arm;
    bool moment;
  };  // arm: m, from the centroid to the point of the force, at rest
  struct PrescribedMotion {
    Wave wave;
    Vec3 direction;
    int block;
    bool rotates;
    Vec3 arm;
  };  // arm: m, from the centre of rotation to the centroid, at rest
  struct Ground {
    Wave wave;
    Vec3 direction;
  };
  struct Tilt {
    Wave wave;
    Vec3 axis;
  };
  std::vector<ForceLoad> force_loads;
  std::vector<PrescribedMotion> prescribed_motions;
  std::vector<Ground> grounds;
  std::vector<Tilt> tilts;
  Vec3 gravity = Vec3::Zero();  // m/s2
  std::vector<double> settles;  // m, of each block on its own bed (model/columns.h) [nblock]; empty: no interlock
  Damping damping;
  double local_damping = 0;  // share of the unbalanced force that brakes a block (Cundall 1987); for relaxations only
  // Of the weight of the lighter block: joined neighbours that meet along an edge are no contact before it could bear this.
  double edge_force = 1e-4;
  int release_every = 8;             // steps between two searches for joints to release to contact; each release searches for pairs anew
  bool crushed_beds_remain = false;  // a closed bed that crushes is not released: stone on stone would bear what the bed does not
  bool dashpots = false;             // some intact joint has dashpots
  bool dashpots_cracked = false;     // some joint has them once cracked
  Analysis analysis;
  bool damping_explicit = false, damping_all = false;
  std::vector<Material> materials;
  std::vector<Parts> parts;  // m, world axes at rest, the scene's own [nblock]

  int spare_wrench_row() const { return first_wrench_row.back(); }
  template <class F>
  void each_wrench_row(int b, F&& f) const {
    const std::size_t g = std::size_t(b / pack_size);
    for (int slot = first_wrench_slot[g]; kind[std::size_t(b)] == Kind::moving && slot < first_wrench_slot[g + 1]; ++slot)
      f(slot * pack_size + b % pack_size);
    for (int row = first_wrench_row[std::size_t(b)]; row < first_wrench_row[std::size_t(b) + 1]; ++row) f(row);
  }
  int owner(int j) const {
    const Joint& one = joint[std::size_t(j)];
    return one.owned_by_b ? one.b : one.a;
  }
  // "lower | upper" by block number; further joints of the same two blocks follow it as "lower | upper #2", ...
  std::string joint_name(int j) const {
    const Joint& one = joint[std::size_t(j)];
    int number = 1;
    for (int i = j; i > 0 && joint[std::size_t(i - 1)].a == one.a && joint[std::size_t(i - 1)].b == one.b; --i) ++number;
    return block_name[std::size_t(one.a)] + " | " + block_name[std::size_t(one.b)] + (number > 1 ? " #" + std::to_string(number) : "");
  }
};

}  // namespace erbs
