// VTK's XML files: whole blocks as polygons, with displacement, speed and damage of their block, and the list of times.
#include <cstdint>
#include <cstring>
#include <filesystem>

#include "engine/base/error.h"
#include "engine/record/export/export.h"

namespace erbs {
namespace {

// Arrays appended as raw bytes, each after its length.
struct Appended {
  std::string bytes;
  template <class T>
  std::string add(const std::vector<T>& values, const char* type, const char* name, int width) {
    const std::string head =
        fmt::format("<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"appended\" offset=\"{}\"/>\n", type, name, width,
                    bytes.size());
    const std::uint64_t length = values.size() * sizeof(T);
    bytes.append(reinterpret_cast<const char*>(&length), sizeof length);
    bytes.append(reinterpret_cast<const char*>(values.data()), length);
    return head;
  }
};

// Share of the area of its joints that is broken [blocks].
std::vector<float> damage_of(const ExportedRun& run, const MotionFrame& frame) {
  std::vector<float> broken(run.scene.blocks.size()), area(broken.size());
  for (std::size_t j = 0; j < run.scene.joints.size(); ++j)
    for (int block : {run.scene.joints[j].a, run.scene.joints[j].b}) {
      broken[static_cast<std::size_t>(block)] += run.joint_area[j] * static_cast<float>(frame.damage[j]) / 255.0F;
      area[static_cast<std::size_t>(block)] += run.joint_area[j];
    }
  for (std::size_t b = 0; b < broken.size(); ++b) broken[b] = area[b] > 0 ? broken[b] / area[b] : 0;
  return broken;
}

std::string grid_of(const ExportedRun& run, std::size_t at) {
  const MotionFrame& frame = run.frames[at];
  const MotionFrame& before = run.frames[at > 0 ? at - 1 : 0];
  const auto seconds = static_cast<float>(frame.t - before.t);
  const std::vector<float> damage = damage_of(run, frame);
  std::vector<float> points, moved, velocity, broken;
  std::vector<std::int64_t> corners, ends;
  std::vector<std::int32_t> owner;
  for (std::size_t b = 0; b < run.scene.blocks.size(); ++b) {
    const MotionBlock& block = run.scene.blocks[b];
    const Eigen::Map<const Eigen::Vector3f> here(&frame.poses[7 * b]), there(&before.poses[7 * b]);
    const Eigen::Vector3f displacement = here - block.rest.cast<float>();
    const Eigen::Vector3f v = seconds > 0 ? Eigen::Vector3f((here - there) / seconds) : Eigen::Vector3f::Zero();
    for (int part : block.parts) {
      const MotionShape& shape = run.scene.shapes[static_cast<std::size_t>(part)];
      const auto first = static_cast<std::int64_t>(points.size() / 3);
      for (std::size_t i = 0; i + 2 < shape.vertices.size(); i += 3) {
        const Eigen::Vector3f p = placed(frame, static_cast<int>(b), Eigen::Map<const Eigen::Vector3f>(&shape.vertices[i]));
        points.insert(points.end(), p.data(), p.data() + 3);
      }
      for (const std::vector<int>& loop : shape.faces) {
        for (int corner : loop) corners.push_back(first + corner);
        ends.push_back(static_cast<std::int64_t>(corners.size()));
        owner.push_back(static_cast<std::int32_t>(b));
        broken.push_back(damage[b]);
        moved.insert(moved.end(), displacement.data(), displacement.data() + 3);
        velocity.insert(velocity.end(), v.data(), v.data() + 3);
      }
    }
  }
  const std::vector<std::uint8_t> kinds(ends.size(), 7);  // VTK_POLYGON
  Appended data;
  std::string xml =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n";
  xml += fmt::format("<UnstructuredGrid>\n<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n", points.size() / 3, ends.size());
  xml += "<Points>\n" + data.add(points, "Float32", "points_m", 3) + "</Points>\n<Cells>\n";
  xml += data.add(corners, "Int64", "connectivity", 1) + data.add(ends, "Int64", "offsets", 1) + data.add(kinds, "UInt8", "types", 1);
  xml += "</Cells>\n<CellData>\n" + data.add(owner, "Int32", "block", 1) + data.add(broken, "Float32", "damage", 1);
  xml += data.add(moved, "Float32", "displacement_m", 3) + data.add(velocity, "Float32", "velocity_m_s", 3);
  xml += "</CellData>\n</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_";
  return xml + data.bytes + "\n</AppendedData>\n</VTKFile>\n";
}

// For an attribute in double quotes.
std::string escaped(const std::string& text) {
  std::string out;
  for (char c : text) out += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '"' ? "&quot;" : std::string(1, c);
  return out;
}

}  // namespace

std::vector<std::string> write_vtu(const ExportedRun& run, const std::string& stem) {
  std::vector<std::string> paths{stem + ".pvd"};
  std::string list = "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n<Collection>\n";
  for (std::size_t i = 0; i < run.frames.size(); ++i) {
    const std::string path = fmt::format("{}_{:05}.vtu", stem, i);
    write_whole(path, grid_of(run, i));
    list += fmt::format("<DataSet timestep=\"{:.9g}\" file=\"{}\"/>\n", run.frames[i].t,
                        escaped(std::filesystem::path(path).filename().string()));
    paths.push_back(path);
  }
  write_whole(paths.front(), list + "</Collection>\n</VTKFile>\n");
  return paths;
}

}  // namespace erbs
