// motion.h5: shapes of the blocks, and their poses in each frame. Only h5.cpp includes HDF5.
//
//   /block_name /group_name /block_group /block_material /block_fixed /block_rest [blocks,3] /block_size [blocks,3]
//   /shape_* (drawn parts, shared between equal blocks)  /joint_* (the blocks of each joint, and its polygon)
//   /time [frames]  /poses [frames,blocks,7]  /joint_damage [frames,joints]  /joint_opening [frames,joints]
//   /joint_normal_stress [frames,joints]  /joint_shear_stress [frames,joints]
//   /ground_displacement [frames,3], m, if the ground moves
//   /joint_force [frames,joints,3]  /joint_force_at [frames,joints,3], these four if the scene asks for stresses
//   attributes of /: scene, scene_hash, program (identity.h), of the manifest.json in whose folder the file was begun
//
// HDF5's single-writer mode and a flush after every frame keep each whole frame readable, even if the run is killed. Another program may
// read while the file grows. motion.xdmf beside it shows the blocks in ParaView: 3D glyphs, a box scaled by block_size and rotated by the
// quaternion `rotation`.
#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "engine/base/count.h"
#include "engine/base/vec.h"

namespace erbs {

// A convex part as drawn. Blocks of equal shape share one.
struct MotionShape {
  std::vector<float> vertices;          // m, world axes at rest, relative to the centroid of the whole block at rest  [nv*3]
  std::vector<std::vector<int>> faces;  // vertex loops, counter-clockwise seen from outside                           [nf]
  bool operator==(const MotionShape&) const = default;
};

struct MotionBlock {
  std::string name, group;
  int material = 0;          // index into `materials` of the manifest
  bool fixed = false;        // belongs to the ground
  Vec3 rest = Vec3::Zero();  // m, centroid at rest
  std::vector<int> parts;    // indices into MotionScene::shapes
};

// The joint of two blocks. The polygon lies at mid-thickness of the mortar, or in the common face of a dry joint.
struct MotionJoint {
  int a = 0, b = 0;            // block indices
  std::vector<Vec3> polygon;   // m, world axes at rest, relative to the centroid of a at rest
  Vec3 normal = Vec3::Zero();  // unit vector from a to b; zero: the reader derives it from the polygon
  double thickness = 0;        // m, of the mortar; 0 for a dry joint
};

struct MotionScene {
  std::vector<MotionShape> shapes;
  std::vector<MotionBlock> blocks;
  std::vector<MotionJoint> joints;
};

// Index of `shape` in scene.shapes; adds the shape if no equal one is present.
int share_shape(MotionScene& scene, MotionShape shape);

struct MotionFrame {
  double t = 0;                      // s
  std::vector<float> poses;          // centroid x,y,z (m, frame of the ground), then w,x,y,z of the rotation from rest [blocks*7]
  std::vector<std::uint8_t> damage;  // 0 intact .. 255 broken [joints]
  std::vector<float> opening;        // m, largest opening over the joint's corners [joints]
  std::vector<float> derived{};      // m/s, J or Pa: speed, energy or stress; not in the file, empty unless a reader derives it [blocks]
  std::vector<float> normal_stress{}, shear_stress{};  // Pa, means, tension positive; empty without [joints]
  // N, of b on a, and m, where its normal part acts in the plane of the joint; world axes, empty without [joints*3]
  std::vector<float> force{}, force_at{};
  std::vector<double> ground{};  // m, displacement of the ground; empty without [3]
};

inline Vec3 position_of(const MotionFrame& f, std::size_t block) {  // m
  return Eigen::Map<const Eigen::Vector3f>(&f.poses[7 * block]).cast<double>();
}
inline Quat rotation_of(const MotionFrame& f, std::size_t block) {
  const float* p = &f.poses[7 * block];
  return Quat(p[3], p[4], p[5], p[6]).normalized();
}
inline Vec3 corner_of(const MotionShape& shape, int i) {  // m
  return Eigen::Map<const Eigen::Vector3f>(&shape.vertices[3 * z(i)]).cast<double>();
}

class MotionWriter {
 public:
  // Starts a new DIR/motion.h5 and replaces an old one.
  // `stress`: with those of the joints; `ground`: with the displacement of the ground.
  MotionWriter(const std::string& dir, const MotionScene& scene, bool stress = false, bool ground = false);
  // Continues DIR/motion.h5 and keeps its first `keep_frames` frames; a file left by a killed writer will do.
  MotionWriter(const std::string& dir, int keep_frames);
  ~MotionWriter();
  MotionWriter(MotionWriter&&) noexcept;
  MotionWriter& operator=(MotionWriter&&) noexcept;

  void write(const MotionFrame& frame);  // on return the frame is in the file
  int frames() const;
  void close();  // the destructor closes too

 private:
  struct File;
  std::unique_ptr<File> file_;
};

class MotionReader {
 public:
  // Error for a file of another run than the manifest.json or metrics.json beside it.
  explicit MotionReader(const std::string& dir);
  ~MotionReader();
  MotionReader(MotionReader&&) noexcept;
  MotionReader& operator=(MotionReader&&) noexcept;

  const MotionScene& scene() const;
  const std::vector<double>& times() const;  // s  [frames]
  bool has_stress() const;
  bool has_forces() const;
  // From now on read() gives poses, and points of forces, as one sees them who does not move with the ground. Error if the run has kept no
  // displacement of the ground.
  void stand_beside_the_ground();
  MotionFrame read(int frame) const;

 private:
  struct File;
  std::unique_ptr<File> file_;
};

}  // namespace erbs
