#include "engine/scene/mesh_file.h"

#include <assimp/DefaultIOSystem.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <assimp/Importer.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "engine/base/error.h"
#include "engine/base/text.h"
#include "engine/geometry/mass.h"

namespace erbs {
namespace {

constexpr unsigned most_vertices = 20000;  // per mesh, before equal vertices are joined; the work grows with their square

Vec3 placed(const aiMatrix4x4& where, const aiVector3D& v) {
  const aiVector3D p = where * v;
  return {static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z)};
}

std::string text_of(const Vec3& v) { return fmt::format("({:.4g}, {:.4g}, {:.4g})", v.x(), v.y(), v.z()); }

// Names a triangle of no height: the library makes such ones of faces with three corners on a line, where they do no harm, and files have
// them where a corner stands twice. Faces have no numbers after they were cut into triangles, so that the message gives a corner.
std::string flat_face(const Polyhedron& triangles) {
  for (const std::vector<int>& loop : triangles.faces) {
    const auto corner = [&](size_t i) { return triangles.vertices[static_cast<size_t>(loop[i])]; };
    const Vec3 a = corner(1) - corner(0), b = corner(2) - corner(0);
    if (a.cross(b).norm() <= 1e-7 * std::max(a.squaredNorm(), b.squaredNorm()))
      return fmt::format(" (a face at {} is flat, without area: remove it first)", text_of(corner(0)));
  }
  return "";
}

// A closed surface uses each edge once in each direction. Two uses in one direction are a face that is inside out.
std::string open_edge(const Polyhedron& triangles) {
  std::map<std::pair<int, int>, int> uses;
  for (const std::vector<int>& loop : triangles.faces)
    for (size_t i = 0; i < 3; ++i) ++uses[{loop[i], loop[(i + 1) % 3]}];
  for (const auto& [edge, count] : uses) {
    const auto back = uses.find({edge.second, edge.first});
    const int others = back == uses.end() ? 0 : back->second;
    if (count == 1 && others == 1) continue;
    const std::string where = fmt::format("at its edge from {} to {}", text_of(triangles.vertices[static_cast<size_t>(edge.first)]),
                                          text_of(triangles.vertices[static_cast<size_t>(edge.second)]));
    if (count + others > 2)
      return fmt::format("is no simple surface: {} faces meet {}; remove faces that lie twice or inside, or split it", count + others,
                         where);
    if (count == 2) return fmt::format("has a face that is inside out {}; turn it, so that all faces look outward", where);
    return fmt::format("is not a closed surface {}; close its holes", where);
  }
  return "";
}

Polyhedron solid(const std::vector<Vec3>& corners, const std::string& what) {
  try {
    return hull(corners);
  } catch (const Error& error) { throw Error(fmt::format("{}: {}", what, error.what())); }
}

Polyhedron convex_part(const aiMesh& mesh, const aiMatrix4x4& where, const std::string& what) {
  Polyhedron triangles;
  Faces::List loops;
  if (mesh.mNumVertices > most_vertices)
    throw Error(fmt::format("{} has {} corners; a block's part is convex and has at most 64: simplify it", what, mesh.mNumVertices));
  for (unsigned v = 0; v < mesh.mNumVertices; ++v) {
    triangles.vertices.push_back(placed(where, mesh.mVertices[v]));
    if (!triangles.vertices.back().allFinite()) throw Error(fmt::format("{}: corner {} is no finite number; correct it", what, v + 1));
  }
  for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
    if (mesh.mFaces[f].mNumIndices != 3)
      throw Error(fmt::format("{} has a face of {} corners; give it faces of three and more", what, mesh.mFaces[f].mNumIndices));
    const auto* i = mesh.mFaces[f].mIndices;
    loops.push_back({static_cast<int>(i[0]), static_cast<int>(i[1]), static_cast<int>(i[2])});
  }
  triangles.faces = std::move(loops);
  if (const std::string defect = open_edge(triangles); !defect.empty()) throw Error(what + " " + defect + flat_face(triangles));
  const Polyhedron whole = solid(triangles.vertices, what);
  const double volume = std::abs(mass_properties(triangles).volume), full = mass_properties(whole).volume;
  // Coordinates in these files are floats, exact to 1e-7 of the size. The volume may therefore be wrong by 1e-5.
  if (std::abs(volume - full) > 1e-5 * full)
    throw Error(fmt::format("{} is not convex (its volume is {:.4g} of its hull's); split it into convex meshes", what, volume / full));
  return whole;
}

void collect(const aiScene& scene, const aiNode& node, const aiMatrix4x4& above, const std::string& path, std::vector<Polyhedron>& parts) {
  const aiMatrix4x4 where = above * node.mTransformation;
  for (unsigned i = 0; i < node.mNumMeshes; ++i) {
    const aiMesh& mesh = *scene.mMeshes[node.mMeshes[i]];
    const std::string name = mesh.mName.length > 0 ? shown(mesh.mName.C_Str(), 60) : std::to_string(parts.size() + 1);
    parts.push_back(convex_part(mesh, where, fmt::format("mesh \"{}\" in {}", name, path)));
  }
  for (unsigned i = 0; i < node.mNumChildren; ++i) collect(scene, *node.mChildren[i], where, path, parts);
}

// A mesh file may refer to materials and buffers in other files. They are read only where the scene may read.
class Confined : public Assimp::DefaultIOSystem {
 public:
  explicit Confined(std::function<bool(const std::string&)> may_read) : may_read_(std::move(may_read)) {}
  bool Exists(const char* file) const override { return may_read_(file) && DefaultIOSystem::Exists(file); }
  Assimp::IOStream* Open(const char* file, const char* mode) override {
    return may_read_(file) && mode[0] == 'r' ? DefaultIOSystem::Open(file, "rb") : nullptr;
  }

 private:
  std::function<bool(const std::string&)> may_read_;
};

// The ending, in small letters. The library could read other formats too, but they have axes and units of their own.
std::string check_kind(const std::string& path) {
  std::string kind = std::filesystem::path(path).extension().string();
  for (char& c : kind) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  for (const char* known : {".obj", ".stl", ".ply", ".gltf", ".glb"})
    if (kind == known) return kind;
  throw Error(fmt::format("cannot read the mesh {}: its ending is none of .obj, .stl, .ply, .gltf, .glb; export it as one of these", path));
}

// The library reads a .ply as its header says, with numbers of elements that the file cannot hold and without the end of the header too,
// and then takes minutes. Each element needs a byte at least.
void check_ply_header(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  const double bytes = static_cast<double>(std::filesystem::file_size(path));
  std::string line;
  constexpr int most_lines = 1000;
  for (int i = 1; i <= most_lines && std::getline(file, line); ++i) {
    std::istringstream words(line);
    std::string word, name;
    double elements = 0;
    words >> word;
    if (i == 1 && word != "ply") return;  // the library tells that it is of another kind
    if (word == "end_header") return;
    if (word == "element" && words >> name >> elements && elements > bytes)
      throw Error(fmt::format("{}:{}: the header promises {:.15g} elements \"{}\", more than the file has bytes ({:.0f}); export it again",
                              path, i, elements, shown(name, 30), bytes));
  }
  throw Error(fmt::format("{}: its header has no end (end_header), so that the file is cut or damaged; export it again", path));
}

}  // namespace

std::vector<Polyhedron> read_mesh(const std::string& path, const std::function<bool(const std::string&)>& may_read) {
  if (check_kind(path) == ".ply") check_ply_header(path);
  Assimp::Importer importer;
  importer.SetIOHandler(new Confined(may_read));  // the importer deletes it
  // Remove normals and texture coordinates first: vertices that differ in them alone would not be joined.
  importer.SetPropertyInteger(AI_CONFIG_PP_RVC_FLAGS, aiComponent_NORMALS | aiComponent_TANGENTS_AND_BITANGENTS | aiComponent_COLORS |
                                                          aiComponent_TEXCOORDS | aiComponent_BONEWEIGHTS | aiComponent_MATERIALS);
  importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE, aiPrimitiveType_POINT | aiPrimitiveType_LINE);
  const aiScene* scene = importer.ReadFile(path, aiProcess_RemoveComponent | aiProcess_DropNormals | aiProcess_Triangulate |
                                                     aiProcess_JoinIdenticalVertices | aiProcess_SortByPType);
  // The library's own message is left out: it may quote a file that the user may not read.
  if (!scene || !scene->mRootNode)
    throw Error(fmt::format("cannot read the mesh {}: it is damaged, or not of the kind that its ending says; export it again", path));
  std::vector<Polyhedron> parts;
  collect(*scene, *scene->mRootNode, aiMatrix4x4(), path, parts);
  if (parts.empty()) throw Error(fmt::format("{} holds no mesh of triangles; export it again, with its faces", path));
  return parts;
}

}  // namespace erbs
