// glTF 2.0, binary (Khronos Group 2021): a JSON chunk that describes, and one buffer that holds meshes, times, positions and rotations.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <map>

#include "engine/base/error.h"
#include "engine/record/export/export.h"
#include "engine/record/format/json.h"

namespace erbs {
namespace {

enum : int { unsigned_int = 5125, floating = 5126, array_buffer = 34962, element_array_buffer = 34963 };

// The buffer, and the views and accessors that describe it.
struct Buffer {
  std::string bytes;
  Json views = Json::array(), accessors = Json::array();

  // `target`: 0 for animation data, which has none. Returns the index of the accessor.
  template <class T>
  int add(const std::vector<T>& values, const char* type, int width, int component, int target, bool bounds) {
    Json view{{"buffer", 0}, {"byteOffset", bytes.size()}, {"byteLength", values.size() * sizeof(T)}};
    if (target) view["target"] = target;
    Json accessor{{"bufferView", views.size()},
                  {"componentType", component},
                  {"count", values.size() / static_cast<std::size_t>(width)},
                  {"type", type}};
    if (bounds) {
      std::vector<T> low(values.begin(), values.begin() + width), high = low;
      for (std::size_t i = 0; i < values.size(); ++i) {
        const std::size_t k = i % static_cast<std::size_t>(width);
        low[k] = std::min(low[k], values[i]);
        high[k] = std::max(high[k], values[i]);
      }
      accessor["min"] = low;
      accessor["max"] = high;
    }
    bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
    views.push_back(std::move(view));
    accessors.push_back(std::move(accessor));
    return static_cast<int>(accessors.size()) - 1;
  }
};

// Positions [n*3] and rotations x,y,z,w [n*4] of a block in all frames. Successive rotations have one sign: the way between is the short
// one.
struct Track {
  std::vector<float> place, rotation;
  bool moves = false;
};

Track track_of(const ExportedRun& run, std::size_t block) {
  Track track;
  Eigen::Quaternionf last(1, 0, 0, 0);
  for (const MotionFrame& frame : run.frames) {
    const float* p = &frame.poses[7 * block];
    Eigen::Quaternionf q = Eigen::Quaternionf(p[3], p[4], p[5], p[6]).normalized();
    if (q.dot(last) < 0) q.coeffs() = -q.coeffs();
    last = q;
    track.place.insert(track.place.end(), p, p + 3);
    track.rotation.insert(track.rotation.end(), {q.x(), q.y(), q.z(), q.w()});
    track.moves = track.moves || !std::equal(p, p + 7, &run.frames.front().poses[7 * block]);
  }
  return track;
}

void put_number(std::string& out, std::uint32_t value) {
  for (int i = 0; i < 4; ++i) out.push_back(static_cast<char>(value >> (8 * i) & 255U));
}

std::string with_header(std::string json, std::string bytes) {
  while (json.size() % 4) json.push_back(' ');
  while (bytes.size() % 4) bytes.push_back('\0');
  const std::size_t whole = 12 + 8 + json.size() + 8 + bytes.size();
  if (whole > 0xffffffffU)
    throw Error(fmt::format("the file would have {} bytes, more than glTF can; export fewer frames with --every", whole));
  std::string out = "glTF";
  put_number(out, 2);
  put_number(out, static_cast<std::uint32_t>(whole));
  put_number(out, static_cast<std::uint32_t>(json.size()));
  out += "JSON" + json;
  put_number(out, static_cast<std::uint32_t>(bytes.size()));
  out += std::string("BIN\0", 4) + bytes;
  return out;
}

}  // namespace

std::vector<std::string> write_gltf(const ExportedRun& run, const std::string& path) {
  Buffer buffer;
  Json nodes = Json::array(), meshes = Json::array(), materials = Json::array(), channels = Json::array(), samplers = Json::array();
  std::map<std::pair<std::vector<int>, int>, int> mesh_of;  // parts and material
  std::map<int, int> material_of;
  std::vector<float> times;
  for (const MotionFrame& frame : run.frames) times.push_back(static_cast<float>(frame.t - run.frames.front().t));
  const int time = times.size() > 1 ? buffer.add(times, "SCALAR", 1, floating, 0, true) : -1;
  const double half = std::sqrt(0.5);
  nodes.push_back({{"name", run.manifest.scene_name}, {"rotation", {-half, 0, 0, half}}, {"children", Json::array()}});
  for (std::size_t b = 0; b < run.scene.blocks.size(); ++b) {
    const MotionBlock& block = run.scene.blocks[b];
    const Track track = track_of(run, b);
    const Json place{track.place[0], track.place[1], track.place[2]};
    const Json rotation{track.rotation[0], track.rotation[1], track.rotation[2], track.rotation[3]};
    Json node{{"name", run.name(static_cast<int>(b))}, {"translation", place}, {"rotation", rotation}};
    const auto [mesh, fresh] = mesh_of.try_emplace({block.parts, block.material}, static_cast<int>(meshes.size()));
    if (fresh) {
      const auto [material, unused] = material_of.try_emplace(block.material, static_cast<int>(materials.size()));
      if (unused) {
        const Vec3 c = run.color(static_cast<int>(b));
        materials.push_back(
            {{"pbrMetallicRoughness", {{"baseColorFactor", {c.x(), c.y(), c.z(), 1}}, {"metallicFactor", 0}, {"roughnessFactor", 0.9}}}});
      }
      const DrawnTriangles t = triangles_of(run.scene, block.parts);
      if (t.index.empty()) {
        mesh->second = -1;
      } else {
        const int position = buffer.add(t.vertices, "VEC3", 3, floating, array_buffer, true);
        const int normal = buffer.add(t.normals, "VEC3", 3, floating, array_buffer, false);
        const int index = buffer.add(t.index, "SCALAR", 1, unsigned_int, element_array_buffer, false);
        const Json attributes{{"POSITION", position}, {"NORMAL", normal}};
        meshes.push_back({{"primitives", {{{"attributes", attributes}, {"indices", index}, {"material", material->second}}}}});
      }
    }
    if (mesh->second >= 0) node["mesh"] = mesh->second;
    const std::size_t index = nodes.size();
    nodes[0]["children"].push_back(index);
    nodes.push_back(std::move(node));
    if (time < 0 || !track.moves) continue;
    const std::pair<const char*, int> outputs[] = {{"translation", buffer.add(track.place, "VEC3", 3, floating, 0, false)},
                                                   {"rotation", buffer.add(track.rotation, "VEC4", 4, floating, 0, false)}};
    for (const auto& [what, output] : outputs) {
      channels.push_back({{"sampler", samplers.size()}, {"target", {{"node", index}, {"path", what}}}});
      samplers.push_back({{"input", time}, {"output", output}, {"interpolation", "LINEAR"}});
    }
  }
  if (nodes[0]["children"].empty()) nodes[0].erase("children");
  Json file{{"asset", {{"version", "2.0"}, {"generator", "ERBS " + run.manifest.version}}},
            {"scene", 0},
            {"scenes", {{{"nodes", {0}}}}},
            {"nodes", nodes}};
  if (!meshes.empty()) file["meshes"] = meshes, file["materials"] = materials;
  if (!channels.empty()) file["animations"] = {{{"name", "run"}, {"channels", channels}, {"samplers", samplers}}};
  if (!buffer.bytes.empty()) {
    file["buffers"] = {{{"byteLength", buffer.bytes.size()}}};
    file["bufferViews"] = buffer.views;
    file["accessors"] = buffer.accessors;
  }
  write_whole(path, with_header(file.dump(-1, ' ', false, Json::error_handler_t::replace), buffer.bytes));
  const std::filesystem::path own(path), script = own.parent_path() / (own.stem().string() + "_blender.py");
  write_whole(script.string(), blender_script(own.filename().string(), script.filename().string()));
  return {path, script.string()};
}

}  // namespace erbs
