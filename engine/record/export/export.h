// Runs as files of other programs: glTF for Blender and the web, VTU for ParaView, OBJ of an instant, a table of poses.
//
// All lengths are in m, times in s. Axes are those of the scene, z up; a glTF root node turns them to y up, as that format requires.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "engine/record/folder/manifest.h"
#include "engine/record/folder/motion_file.h"

namespace erbs {

// A run to be exported: what its folder holds, and the frames chosen of it.
struct ExportedRun {
  Manifest manifest;
  MotionScene scene;
  std::vector<MotionFrame> frames;    // in order of time; a pose that is not finite is that of the frame before
  std::vector<float> joint_area;      // m2 [joints]
  Vec3 color(int block) const;        // linear 0..1, of its material; grey without one
  std::string name(int block) const;  // of the block, or "block 12"
};

// Reads every `every`-th frame from `from` to `to` (s). Error if DIR is no run folder or the span holds no frame.
ExportedRun read_exported_run(const std::string& dir, double from, double to, int every);

// Flat triangles of a block's parts, with one normal a face. Relative to its centroid, axes at rest.
struct Triangles {
  std::vector<float> vertices, normals;  // m and unit [n*3]
  std::vector<std::uint32_t> index;      // [triangles*3]
};
Triangles triangles_of(const MotionScene& scene, const std::vector<int>& parts);

// A point of a block (m, relative to its centroid, axes at rest) where a frame shows it (m).
Eigen::Vector3f placed(const MotionFrame& frame, int block, const Eigen::Vector3f& point);

// Each returns the paths written. A file appears whole or not at all; Error if it cannot be written.
std::vector<std::string> write_gltf(const ExportedRun& run, const std::string& path);            // binary: .glb
std::vector<std::string> write_vtu(const ExportedRun& run, const std::string& stem);             // stem.pvd and one .vtu a frame
std::vector<std::string> write_obj(const ExportedRun& run, int frame, const std::string& path);  // .obj and .mtl
std::vector<std::string> write_pose_table(const ExportedRun& run, const std::string& path);      // .csv

// Writes a file beside its final name first.
void write_whole(const std::string& path, const std::string& bytes);

}  // namespace erbs
