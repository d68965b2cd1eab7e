// VTK's XML files: whole blocks as polygons, with displacement, velocity and damage, joints with their tractions, and the list of times.
#include <cstdint>
#include <cstring>
#include <filesystem>

#include "engine/base/error.h"
#include "engine/base/text.h"
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

// Values of each owner, once for each of its polygons.
template <class T>
std::vector<T> spread(const std::vector<T>& values, const std::vector<std::int32_t>& owner, std::size_t width) {
  std::vector<T> out;
  for (const std::int32_t one : owner)
    out.insert(out.end(), values.begin() + static_cast<std::ptrdiff_t>(width) * one,
               values.begin() + static_cast<std::ptrdiff_t>(width) * (one + 1));
  return out;
}

std::string head_of(const Polygons& polygons, const std::vector<float>& points, Appended& data) {
  const std::vector<std::uint8_t> kinds(polygons.ends.size(), 7);  // VTK_POLYGON
  std::string xml =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n";
  xml += fmt::format("<UnstructuredGrid>\n<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n", polygons.points, polygons.ends.size());
  xml += "<Points>\n" + data.add(points, "Float32", "points_m", 3) + "</Points>\n<Cells>\n";
  xml += data.add(polygons.corners, "Int64", "connectivity", 1) + data.add(polygons.ends, "Int64", "offsets", 1) +
         data.add(kinds, "UInt8", "types", 1);
  return xml + "</Cells>\n<CellData>\n";
}

std::string tail_of(const Appended& data) {
  return "</CellData>\n</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_" + data.bytes + "\n</AppendedData>\n</VTKFile>\n";
}

std::string grid_of_blocks(const ExportedRun& run, const Polygons& polygons, std::size_t at) {
  const MotionFrame& frame = run.frames[at];
  std::vector<float> moved;
  for (std::size_t b = 0; b < run.scene.blocks.size(); ++b)
    for (int i = 0; i < 3; ++i)
      moved.push_back(frame.poses[7 * b + static_cast<std::size_t>(i)] - static_cast<float>(run.scene.blocks[b].rest[i]));
  Appended data;
  std::string xml = head_of(polygons, block_points(run.scene, frame), data);
  xml += data.add(polygons.owner, "Int32", "block", 1) + data.add(spread(damage_of(run, frame), polygons.owner, 1), "Float32", "damage", 1);
  xml += data.add(spread(moved, polygons.owner, 3), "Float32", "displacement_m", 3);
  xml += data.add(spread(velocity_of(run, at), polygons.owner, 3), "Float32", "velocity_m_s", 3);
  return xml + tail_of(data);
}

std::string grid_of_joints(const ExportedRun& run, const Polygons& polygons, std::size_t at) {
  Appended data;
  std::string xml = head_of(polygons, joint_points(run.scene, run.frames[at]), data);
  xml += data.add(polygons.owner, "Int32", "joint", 1);
  for (const JointField& field : joint_fields(run.frames[at]))
    xml += data.add(spread(field.values, polygons.owner, static_cast<std::size_t>(field.width)), "Float32", field.name, field.width);
  return xml + tail_of(data);
}

// For an attribute in double quotes.
}  // namespace

std::vector<std::string> write_vtu(const ExportedRun& run, const std::string& stem) {
  std::vector<std::string> paths{stem + ".pvd"};
  std::string list = "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n<Collection>\n";
  const Polygons blocks = block_polygons(run.scene), joints = joint_polygons(run.scene);
  const auto add = [&](std::size_t i, const char* kind, const char* part, const std::string& grid) {
    const std::string path = fmt::format("{}{}_{:05}.vtu", stem, kind, i);
    write_whole(path, grid);
    list += fmt::format("<DataSet timestep=\"{:.9g}\"{} file=\"{}\"/>\n", run.frames[i].t, part,
                        for_xml(std::filesystem::path(path).filename().string()));
    paths.push_back(path);
  };
  for (std::size_t i = 0; i < run.frames.size(); ++i) add(i, "", "", grid_of_blocks(run, blocks, i));
  if (!joints.owner.empty())
    for (std::size_t i = 0; i < run.frames.size(); ++i) add(i, "_joints", " part=\"1\"", grid_of_joints(run, joints, i));
  write_whole(paths.front(), list + "</Collection>\n</VTKFile>\n");
  return paths;
}

}  // namespace erbs
