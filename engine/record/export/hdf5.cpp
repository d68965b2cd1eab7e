// HDF5 for scripts, and XDMF 3 over the same file for ParaView: whole blocks as polygons, and joints with their tractions.
//
//   /time_s [frames]
//   /blocks/name, group, material, fixed [blocks]; position_m [frames,blocks,3], rotation_wxyz [frames,blocks,4] (from rest),
//           displacement_m, velocity_m_s [frames,blocks,3], damage [frames,blocks]
//   /joints/block_a, block_b, area_m2 [joints]; damage, opening_m, and where the scene says frame_stress = true normal_stress_Pa,
//           shear_stress_Pa [frames,joints], force_N [frames,joints,3], of block b on a
//   /block_mesh, /joint_mesh: points_m [frames,points,3]; topology, as XDMF writes polygons: 3, count, points, ...; owner of each polygon
#include <filesystem>

#include "engine/base/error.h"
#include "engine/base/text.h"
#include "engine/record/export/export.h"
#include "engine/record/format/h5.h"

namespace erbs {
namespace {

namespace fs = std::filesystem;
using Row = std::vector<std::size_t>;

std::vector<int> topology_of(const Polygons& polygons) {
  std::vector<int> out;
  std::int64_t begin = 0;
  for (const std::int64_t end : polygons.ends) {
    out.push_back(3);  // XDMF_POLYGON
    out.push_back(static_cast<int>(end - begin));
    for (; begin < end; ++begin) out.push_back(static_cast<int>(polygons.corners[static_cast<std::size_t>(begin)]));
  }
  return out;
}

void put_blocks(const h5::File& file, const ExportedRun& run) {
  std::vector<std::string> names, groups;
  std::vector<int> material, fixed;
  for (std::size_t b = 0; b < run.scene.blocks.size(); ++b) {
    names.push_back(run.name(static_cast<int>(b)));
    groups.push_back(run.scene.blocks[b].group);
    material.push_back(run.scene.blocks[b].material), fixed.push_back(run.scene.blocks[b].fixed ? 1 : 0);
  }
  file.put_names("/blocks/name", names);
  file.put_names("/blocks/group", groups);
  file.put("/blocks/material", material);
  file.put("/blocks/fixed", fixed);
  const std::size_t n = names.size();
  if (n == 0) return;
  h5::Rows<float> position(file, "/blocks/position_m", Row{n, 3}, 1), rotation(file, "/blocks/rotation_wxyz", Row{n, 4}, 1),
      moved(file, "/blocks/displacement_m", Row{n, 3}, 1), velocity(file, "/blocks/velocity_m_s", Row{n, 3}, 1),
      damage(file, "/blocks/damage", Row{n}, 1);
  for (std::size_t f = 0; f < run.frames.size(); ++f) {
    std::vector<float> at, turn, way;
    for (std::size_t b = 0; b < n; ++b) {
      const float* p = &run.frames[f].poses[7 * b];
      at.insert(at.end(), p, p + 3), turn.insert(turn.end(), p + 3, p + 7);
      for (int i = 0; i < 3; ++i) way.push_back(p[i] - static_cast<float>(run.scene.blocks[b].rest[i]));
    }
    position.append(at.data()), rotation.append(turn.data()), moved.append(way.data());
    velocity.append(velocity_of(run, f).data()), damage.append(damage_of(run, run.frames[f]).data());
  }
}

void put_joints(const h5::File& file, const ExportedRun& run) {
  const std::size_t n = run.scene.joints.size();
  if (n == 0) return;
  std::vector<int> a, b;
  for (const MotionJoint& joint : run.scene.joints) a.push_back(joint.a), b.push_back(joint.b);
  file.put("/joints/block_a", a);
  file.put("/joints/block_b", b);
  file.put("/joints/area_m2", run.joint_area);
  const std::vector<JointField> like = joint_fields(run.frames.front());
  for (std::size_t k = 0; k < like.size(); ++k) {
    const Row row = like[k].width == 1 ? Row{n} : Row{n, static_cast<std::size_t>(like[k].width)};
    h5::Rows<float> rows(file, std::string("/joints/") + like[k].name, row, 1);
    for (const MotionFrame& frame : run.frames) rows.append(joint_fields(frame)[k].values.data());
  }
}

template <class PointsOf>
void put_mesh(const h5::File& file, const std::string& name, const ExportedRun& run, const Polygons& polygons, PointsOf&& points_of) {
  if (polygons.owner.empty()) return;
  file.put(name + "/topology", topology_of(polygons));
  file.put(name + "/owner", std::vector<int>(polygons.owner.begin(), polygons.owner.end()));
  h5::Rows<float> points(file, name + "/points_m", Row{polygons.points, 3}, 1);
  for (const MotionFrame& frame : run.frames) points.append(points_of(run.scene, frame).data());
}

// The XML of one kind of polygons.
class Grid {
 public:
  Grid(std::string file, std::string name, const Polygons& polygons, std::size_t frames)
      : file_(for_xml(file)), name_(std::move(name)), polygons_(polygons), frames_(frames), topology_(topology_of(polygons).size()) {}

  // Fields live on owners; each polygon takes that of its owner by the coordinates of `owner`.
  std::string text(std::size_t f, const std::string& fields) const {
    const std::size_t cells = polygons_.owner.size();
    return fmt::format(
        "<Grid Name=\"{}s\"><Topology TopologyType=\"Mixed\" NumberOfElements=\"{}\"><DataItem Format=\"HDF\" NumberType=\"Int\" "
        "Dimensions=\"{}\">{}:/{}_mesh/topology</DataItem></Topology>\n<Geometry GeometryType=\"XYZ\">{}</Geometry>\n"
        "<Attribute Name=\"{}\" Center=\"Cell\"><DataItem Format=\"HDF\" NumberType=\"Int\" Dimensions=\"{}\">{}:/{}_mesh/owner</DataItem>"
        "</Attribute>\n{}</Grid>\n",
        name_, cells, topology_, file_, name_, slab(f, name_ + "_mesh/points_m", polygons_.points, 3), name_, cells, file_, name_, fields);
  }
  // A field of the polygons in /NAME_mesh.
  std::string field(std::size_t f, const std::string& name, int width) const {
    return fmt::format("<Attribute Name=\"{}\" Center=\"Cell\" AttributeType=\"{}\">{}</Attribute>\n", name,
                       width == 3 ? "Vector" : "Scalar", slab(f, name_ + "_mesh/" + name, polygons_.owner.size(), width));
  }

 private:
  // Frame f of an array [frames, rows, width].
  std::string slab(std::size_t f, const std::string& name, std::size_t rows, int width) const {
    const std::string row = width == 1 ? fmt::format("{}", rows) : fmt::format("{} {}", rows, width);
    const std::string form = width == 1 ? "3 2" : "3 3", start = width == 1 ? fmt::format("{} 0", f) : fmt::format("{} 0 0", f),
                      stride = width == 1 ? "1 1" : "1 1 1";
    return fmt::format(
        "<DataItem ItemType=\"HyperSlab\" Dimensions=\"{0}\"><DataItem Dimensions=\"{1}\" Format=\"XML\">{2} {3} 1 {0}</DataItem>"
        "<DataItem Format=\"HDF\" NumberType=\"Float\" Precision=\"4\" Dimensions=\"{4} {0}\">{5}:/{6}</DataItem></DataItem>",
        row, form, start, stride, frames_, file_, name);
  }

  std::string file_, name_;
  const Polygons& polygons_;
  std::size_t frames_, topology_;
};

// Fields of owners as fields of their polygons, in /NAME_mesh.
void put_cells(const h5::File& file, const std::string& name, const Polygons& polygons, int width,
               const std::vector<std::vector<float>>& frames) {
  const std::size_t cells = polygons.owner.size(), w = static_cast<std::size_t>(width);
  h5::Rows<float> rows(file, name, width == 1 ? Row{cells} : Row{cells, w}, 1);
  for (const std::vector<float>& values : frames) {
    std::vector<float> out;
    for (const std::int32_t owner : polygons.owner)
      for (std::size_t i = 0; i < w; ++i) out.push_back(values[w * static_cast<std::size_t>(owner) + i]);
    rows.append(out.data());
  }
}

struct Written {
  std::vector<std::pair<std::string, int>> block_fields, joint_fields;  // name, width
};

Written put_all(const std::string& path, const ExportedRun& run, const Polygons& blocks, const Polygons& joints, bool cells) {
  Written written;
  const h5::File file(path, h5::File::Mode::create);
  std::vector<double> times;
  for (const MotionFrame& frame : run.frames) times.push_back(frame.t);
  file.put("/time_s", times);
  put_blocks(file, run);
  put_joints(file, run);
  put_mesh(file, "/block_mesh", run, blocks, block_points);
  put_mesh(file, "/joint_mesh", run, joints, joint_points);
  if (!cells) return written;
  std::vector<std::vector<float>> damage, velocity;
  for (std::size_t f = 0; f < run.frames.size(); ++f)
    damage.push_back(damage_of(run, run.frames[f])), velocity.push_back(velocity_of(run, f));
  if (!blocks.owner.empty()) {
    put_cells(file, "/block_mesh/damage", blocks, 1, damage);
    put_cells(file, "/block_mesh/velocity_m_s", blocks, 3, velocity);
    written.block_fields = {{"damage", 1}, {"velocity_m_s", 3}};
  }
  if (joints.owner.empty()) return written;
  const std::vector<JointField> like = joint_fields(run.frames.front());
  for (std::size_t k = 0; k < like.size(); ++k) {
    std::vector<std::vector<float>> values;
    for (const MotionFrame& frame : run.frames) values.push_back(joint_fields(frame)[k].values);
    put_cells(file, std::string("/joint_mesh/") + like[k].name, joints, like[k].width, values);
    written.joint_fields.emplace_back(like[k].name, like[k].width);
  }
  return written;
}

// Writes beside the final name first.
Written put_file(const std::string& path, const ExportedRun& run, bool cells) {
  const std::string unfinished = path + ".part";
  std::error_code failed;
  try {
    const Written written = put_all(unfinished, run, block_polygons(run.scene), joint_polygons(run.scene), cells);
    fs::rename(unfinished, path, failed);
    if (!failed) return written;
  } catch (const Error&) {
    fs::remove(unfinished, failed);
    throw;
  }
  fs::remove(unfinished, failed);
  throw Error("it cannot be written; is the disk full, and may you write there?", {path, 0});
}

}  // namespace

std::vector<std::string> write_hdf5(const ExportedRun& run, const std::string& path) {
  put_file(path, run, false);
  return {path};
}

std::vector<std::string> write_xdmf(const ExportedRun& run, const std::string& path) {
  const std::string data = fs::path(path).replace_extension(".xdmf.h5").string();
  const Written written = put_file(data, run, true);
  const Polygons blocks = block_polygons(run.scene), joints = joint_polygons(run.scene);
  const std::string name = fs::path(data).filename().string();
  const Grid of_blocks(name, "block", blocks, run.frames.size()), of_joints(name, "joint", joints, run.frames.size());
  std::string xml =
      "<?xml version=\"1.0\"?>\n<Xdmf Version=\"3.0\"><Domain>\n<Grid Name=\"run\" GridType=\"Collection\" CollectionType=\"Temporal\">\n";
  for (std::size_t f = 0; f < run.frames.size(); ++f) {
    xml += fmt::format("<Grid Name=\"frame{}\" GridType=\"Collection\" CollectionType=\"Spatial\"><Time Value=\"{:.9g}\"/>\n", f,
                       run.frames[f].t);
    std::string fields;
    for (const auto& [field, width] : written.block_fields) fields += of_blocks.field(f, field, width);
    xml += of_blocks.text(f, fields);
    fields.clear();
    for (const auto& [field, width] : written.joint_fields) fields += of_joints.field(f, field, width);
    if (!joints.owner.empty()) xml += of_joints.text(f, fields);
    xml += "</Grid>\n";
  }
  write_whole(path, xml + "</Grid>\n</Domain></Xdmf>\n");
  return {path, data};
}

}  // namespace erbs
