// Text files: the blocks of an instant as OBJ, and the poses of all frames as a table.
#include <filesystem>

#include "engine/base/error.h"
#include "engine/record/export/export.h"

namespace erbs {
namespace {

// Names that programs split at blanks are kept in one word.
std::string one_word(std::string name) {
  for (char& c : name)
    if (static_cast<unsigned char>(c) <= ' ') c = '_';
  return name;
}

std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string out = "\"";
  for (char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + "\"";
}

}  // namespace

std::vector<std::string> write_obj(const ExportedRun& run, int frame, const std::string& path) {
  const MotionFrame& f = run.frames[static_cast<std::size_t>(frame)];
  const std::string colors = std::filesystem::path(path).replace_extension(".mtl").string();
  std::string mtl = "# linear colours of the materials\n";
  for (std::size_t m = 0; m < run.manifest.materials.size(); ++m) {
    const Vec3 c = run.manifest.materials[m].color.cwiseMax(0).cwiseMin(1).array().pow(2.2);
    mtl += fmt::format("newmtl material{}_{}\nKd {:.4f} {:.4f} {:.4f}\n", m, one_word(run.manifest.materials[m].name), c.x(), c.y(), c.z());
  }
  std::string obj = fmt::format("# {} at {:.6g} s, in m, z up\nmtllib {}\n", one_word(run.manifest.scene_name), f.t,
                                std::filesystem::path(colors).filename().string());
  int first = 1;
  for (std::size_t b = 0; b < run.scene.blocks.size(); ++b) {
    const MotionBlock& block = run.scene.blocks[b];
    obj += fmt::format("o {}\n", one_word(run.name(static_cast<int>(b))));
    if (const auto m = static_cast<std::size_t>(block.material); block.material >= 0 && m < run.manifest.materials.size())
      obj += fmt::format("usemtl material{}_{}\n", m, one_word(run.manifest.materials[m].name));
    for (int part : block.parts) {
      const MotionShape& shape = run.scene.shapes[static_cast<std::size_t>(part)];
      for (std::size_t i = 0; i + 2 < shape.vertices.size(); i += 3) {
        const Eigen::Vector3f p = placed(f, static_cast<int>(b), Eigen::Map<const Eigen::Vector3f>(&shape.vertices[i]));
        obj += fmt::format("v {:.7g} {:.7g} {:.7g}\n", p.x(), p.y(), p.z());
      }
      for (const std::vector<int>& loop : shape.faces) {
        obj += "f";
        for (int corner : loop) obj += fmt::format(" {}", first + corner);
        obj += "\n";
      }
      first += static_cast<int>(shape.vertices.size() / 3);
    }
  }
  write_whole(colors, mtl);
  write_whole(path, obj);
  return {path, colors};
}

std::vector<std::string> write_pose_table(const ExportedRun& run, const std::string& path) {
  std::string table = "time_s,block,name,x_m,y_m,z_m,qw,qx,qy,qz\n";
  for (const MotionFrame& frame : run.frames)
    for (std::size_t b = 0; b < run.scene.blocks.size(); ++b) {
      const float* p = &frame.poses[7 * b];
      table += fmt::format("{:.9g},{},{},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g}\n", frame.t, b,
                           quoted(run.name(static_cast<int>(b))), p[0], p[1], p[2], p[3], p[4], p[5], p[6]);
    }
  write_whole(path, table);
  return {path};
}

}  // namespace erbs
