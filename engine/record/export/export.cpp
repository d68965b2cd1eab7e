#include "engine/record/export/export.h"

#include <cmath>
#include <filesystem>
#include <fstream>

#include "engine/base/error.h"
#include "engine/record/folder/colors.h"
#include "engine/record/folder/run_folder.h"

namespace erbs {
namespace {

namespace fs = std::filesystem;

double area_of(const std::vector<Vec3>& polygon) {
  Vec3 twice = Vec3::Zero();
  for (std::size_t i = 0; i < polygon.size(); ++i) twice += polygon[i].cross(polygon[(i + 1) % polygon.size()]);
  return 0.5 * twice.norm();
}

// Keeps what is not finite out of files that other programs read.
void hold_last_pose(MotionFrame& frame, const MotionFrame* before, const MotionScene& scene) {
  for (std::size_t b = 0; b < scene.blocks.size(); ++b) {
    float* p = &frame.poses[7 * b];
    bool finite = true;
    for (int i = 0; i < 7; ++i) finite = finite && std::isfinite(p[i]);
    if (finite) continue;
    const Eigen::Vector3f rest = scene.blocks[b].rest.cast<float>();
    const float at_rest[7] = {rest.x(), rest.y(), rest.z(), 1, 0, 0, 0};
    std::copy_n(before ? &before->poses[7 * b] : at_rest, 7, p);
  }
}

}  // namespace

Vec3 ExportedRun::color(int block) const {
  const int m = scene.blocks[static_cast<std::size_t>(block)].material;
  if (m < 0 || m >= static_cast<int>(manifest.materials.size())) return Vec3::Constant(0.4);
  return manifest.materials[static_cast<std::size_t>(m)].color.cwiseMax(0).cwiseMin(1).array().pow(2.2);
}

std::string ExportedRun::name(int block) const {
  const std::string& own = scene.blocks[static_cast<std::size_t>(block)].name;
  return own.empty() ? fmt::format("block {}", block) : own;
}

ExportedRun read_exported_run(const std::string& dir, double from, double to, int every) {
  if (!fs::is_directory(dir)) throw Error("no such folder; give the folder of a run, e.g. runs/first", {dir, 0});
  if (!fs::exists(run_file(dir, "manifest.json")))
    throw Error("no manifest.json in it; give the folder of a run, e.g. runs/first", {dir, 0});
  ExportedRun run;
  run.manifest = read_manifest(dir);
  tell_apart(run.manifest.materials);
  const MotionReader reader(dir);
  run.scene = reader.scene();
  const std::vector<double>& times = reader.times();
  int within = 0;
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (times[i] < from - 1e-9 || times[i] > to + 1e-9) continue;
    const bool last = i + 1 == times.size() || times[i + 1] > to + 1e-9;
    if (within++ % every != 0 && !last) continue;
    run.frames.push_back(reader.read(static_cast<int>(i)));
    const std::size_t n = run.frames.size();
    hold_last_pose(run.frames.back(), n > 1 ? &run.frames[n - 2] : nullptr, run.scene);
  }
  if (times.empty()) throw Error("the run has no frames yet; run it longer than its frame_dt", {dir, 0});
  run.first = times.front(), run.last = times.back();
  if (run.frames.empty())
    throw Error(
        fmt::format("--time {:g}:{:g} holds no frame; the run has {} frames from {:.6g} s to {:.6g} s: choose a span that holds some", from,
                    to, times.size(), run.first, run.last),
        {dir, 0});
  for (const MotionJoint& joint : run.scene.joints) run.joint_area.push_back(static_cast<float>(area_of(joint.polygon)));
  return run;
}

DrawnTriangles triangles_of(const MotionScene& scene, const std::vector<int>& parts) {
  DrawnTriangles out;
  for (int part : parts) {
    const MotionShape& shape = scene.shapes[static_cast<std::size_t>(part)];
    for (const std::vector<int>& loop : shape.faces) {
      const auto point = [&](std::size_t i) {
        return Eigen::Vector3f(Eigen::Map<const Eigen::Vector3f>(&shape.vertices[3 * static_cast<std::size_t>(loop[i])]));
      };
      Eigen::Vector3f normal = Eigen::Vector3f::Zero();
      for (std::size_t i = 0; i < loop.size(); ++i) normal += (point(i) - point(0)).cross(point((i + 1) % loop.size()) - point(0));
      if (!(normal.norm() > 0)) continue;
      normal.normalize();
      const auto first = static_cast<std::uint32_t>(out.vertices.size() / 3);
      for (std::size_t i = 0; i < loop.size(); ++i) {
        const Eigen::Vector3f p = point(i);
        out.vertices.insert(out.vertices.end(), p.data(), p.data() + 3);
        out.normals.insert(out.normals.end(), normal.data(), normal.data() + 3);
      }
      for (std::uint32_t i = 1; i + 1 < loop.size(); ++i) out.index.insert(out.index.end(), {first, first + i, first + i + 1});
    }
  }
  return out;
}

Eigen::Vector3f placed(const MotionFrame& frame, int block, const Eigen::Vector3f& point) {
  const float* p = &frame.poses[7 * static_cast<std::size_t>(block)];
  return Eigen::Vector3f(p[0], p[1], p[2]) + Eigen::Quaternionf(p[3], p[4], p[5], p[6]).normalized() * point;
}

void write_whole(const std::string& path, const std::string& bytes) {
  const std::string unfinished = path + ".part";
  std::ofstream file(unfinished, std::ios::binary);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  file.close();
  std::error_code failed;
  if (file) fs::rename(unfinished, path, failed);
  if (file && !failed) return;
  fs::remove(unfinished, failed);
  throw Error("it cannot be written; is the disk full, and may you write there?", {path, 0});
}

}  // namespace erbs
