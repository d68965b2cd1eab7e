// Runs as files of other programs: glTF for Blender and the web, VTU and XDMF for ParaView, HDF5, OBJ of an instant, a table of poses.
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
  double first = 0, last = 0;         // s, of the frames that the folder has
  Vec3 color(int block) const;        // linear 0..1, of its material; grey without one
  std::string name(int block) const;  // of the block, or "block 12"
};

// Reads every `every`-th frame from `from` to `to` (s). Error if DIR is no run folder or the span holds no frame.
ExportedRun read_exported_run(const std::string& dir, double from, double to, int every);

// Share of the area of its joints that is broken [blocks].
std::vector<float> damage_of(const ExportedRun& run, const MotionFrame& frame);
// m/s, of the centroids [blocks*3]: the slope of the parabola through this frame and those around it, which is that of free flight.
std::vector<float> velocity_of(const ExportedRun& run, std::size_t frame);

// Whole blocks, or joints with a face, as polygons: the same in all frames but for their points.
struct Polygons {
  std::vector<std::int64_t> corners, ends;  // indices of points; where each polygon ends in `corners`
  std::vector<std::int32_t> owner;          // block or joint of each polygon
  std::size_t points = 0;
};
Polygons block_polygons(const MotionScene& scene);
Polygons joint_polygons(const MotionScene& scene);                                    // each moves with block a of its joint
std::vector<float> block_points(const MotionScene& scene, const MotionFrame& frame);  // m [points*3]
std::vector<float> joint_points(const MotionScene& scene, const MotionFrame& frame);

// A field of joints [joints*width]; `values` empty where the run has not kept it.
struct JointField {
  const char* name;  // with its unit
  int width;
  std::vector<float> values;
};
std::vector<JointField> joint_fields(const MotionFrame& frame);

// Flat triangles of a block's parts, with one normal a face. Relative to its centroid, axes at rest.
struct DrawnTriangles {
  std::vector<float> vertices, normals;  // m and unit [n*3]
  std::vector<std::uint32_t> index;      // [triangles*3]
};
DrawnTriangles triangles_of(const MotionScene& scene, const std::vector<int>& parts);

// A point of a block (m, relative to its centroid, axes at rest) where a frame shows it (m).
Eigen::Vector3f placed(const MotionFrame& frame, int block, const Eigen::Vector3f& point);

// Each returns the paths written. A file appears whole or not at all; Error if it cannot be written.
std::vector<std::string> write_gltf(const ExportedRun& run, const std::string& path);  // binary: .glb, and a script for Blender
std::vector<std::string> write_vtu(const ExportedRun& run,
                                   const std::string& stem);  // stem.pvd, and of each frame .vtu of blocks and of joints
std::vector<std::string> write_hdf5(const ExportedRun& run, const std::string& path);            // .h5, whose names carry the units
std::vector<std::string> write_xdmf(const ExportedRun& run, const std::string& path);            // .xdmf, and the .h5 that it reads
std::vector<std::string> write_obj(const ExportedRun& run, int frame, const std::string& path);  // .obj and .mtl
std::vector<std::string> write_pose_table(const ExportedRun& run, const std::string& path);      // .csv

// Python, for Blender; `glb` and `script`: names of both files.
std::string blender_script(const std::string& glb, const std::string& script);

// Writes a file beside its final name first.
void write_whole(const std::string& path, const std::string& bytes);

}  // namespace erbs
