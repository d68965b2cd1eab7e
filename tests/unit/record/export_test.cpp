// Runs as files of other programs, read back.
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <assimp/Importer.hpp>
#include <catch2/catch.hpp>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "engine/base/error.h"
#include "engine/record/export/export.h"
#include "engine/record/format/h5.h"
#include "engine/record/format/json.h"
#include "tests/support/folder.h"
#include "tests/unit/record/two_bricks.h"

using namespace erbs;

namespace {

std::string bytes_of(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream out;
  out << in.rdbuf();
  return out.str();
}

std::uint32_t number_at(const std::string& bytes, std::size_t at) {
  std::uint32_t value = 0;
  std::memcpy(&value, bytes.data() + at, 4);
  return value;
}

// Three frames of a fixed base and of a brick that moves and turns.
ExportedRun bricks_that_move() {
  ExportedRun run;
  run.manifest.scene_name = "two \"bricks\" & <more>";
  run.manifest.materials.resize(1);
  run.manifest.materials[0].name = "red brick";
  const Polyhedron p = test::brick();
  MotionShape shape;
  for (const Vec3& v : p.vertices)
    for (int i = 0; i < 3; ++i) shape.vertices.push_back(static_cast<float>(v[i]));
  for (const auto& face : p.faces) shape.faces.emplace_back(face.begin(), face.end());
  run.scene.shapes = {shape};
  run.scene.blocks = {{"base", "", 0, true, Vec3::Zero(), {0}}, {"Ziegel, ä", "", 0, false, Vec3(0, 0, 0.1), {0}}};
  run.scene.joints.resize(1);
  run.scene.joints[0].b = 1;
  run.joint_area = {0.02F};
  const float s = std::sqrt(0.5F);
  run.frames = {{0.5, {0, 0, 0, 1, 0, 0, 0, 0, 0, 0.1F, 1, 0, 0, 0}, {0}, {0}},
                {0.6, {0, 0, 0, 1, 0, 0, 0, 0.2F, 0, 0.1F, s, 0, 0, s}, {51}, {0}},
                {0.8, {0, 0, 0, 1, 0, 0, 0, 0.3F, 0, 0.1F, s, 0, 0, s}, {255}, {0}}};
  for (int i = 3; i < 7; ++i) run.frames[2].poses[7 + static_cast<std::size_t>(i)] *= -1;  // the same rotation
  return run;
}

}  // namespace

TEST_CASE("a binary glTF describes its own bytes, and gives back the poses", "[record][export]") {
  const test::Folder dir;
  const ExportedRun run = bricks_that_move();
  const std::string path = dir.file("run.glb");
  write_gltf(run, path);
  const std::string bytes = bytes_of(path);
  REQUIRE(bytes.size() > 28);
  CHECK(bytes.substr(0, 4) == "glTF");
  CHECK(number_at(bytes, 4) == 2);
  CHECK(number_at(bytes, 8) == bytes.size());
  const std::uint32_t length = number_at(bytes, 12);
  CHECK(length % 4 == 0);
  const Json json = Json::parse(bytes.substr(20, length));
  const std::size_t data = 20 + length + 8;
  CHECK(number_at(bytes, 20 + length) == bytes.size() - data);
  CHECK(json["buffers"][0]["byteLength"] <= bytes.size() - data);
  CHECK(json["meshes"].size() == 1);  // shared
  CHECK(json["nodes"].size() == 3);
  CHECK(json["nodes"][2]["name"] == "Ziegel, ä");
  CHECK(json["animations"][0]["channels"].size() == 2);  // the base stands
  for (const Json& accessor : json["accessors"]) {
    const Json& view = json["bufferViews"][accessor["bufferView"].get<std::size_t>()];
    const std::size_t width = accessor["type"] == "VEC4" ? 4 : accessor["type"] == "VEC3" ? 3 : 1;
    CHECK(accessor["count"].get<std::size_t>() * width * 4 == view["byteLength"].get<std::size_t>());
    CHECK(view["byteOffset"].get<std::size_t>() % 4 == 0);
    CHECK(view["byteOffset"].get<std::size_t>() + view["byteLength"].get<std::size_t>() <=
          json["buffers"][0]["byteLength"].get<std::size_t>());
  }
  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFile(path, 0);
  REQUIRE(scene);
  REQUIRE(scene->mNumAnimations == 1);
  REQUIRE(scene->mAnimations[0]->mNumChannels == 1);
  const aiNodeAnim& track = *scene->mAnimations[0]->mChannels[0];
  REQUIRE(track.mNumPositionKeys == 3);
  CHECK(track.mPositionKeys[2].mValue.x == 0.3F);
  CHECK(track.mPositionKeys[2].mTime == Approx(300).margin(0.1));  // ms since the first frame
  CHECK(track.mRotationKeys[1].mValue.z == Approx(std::sqrt(0.5)));
  CHECK(track.mRotationKeys[2].mValue.z == Approx(std::sqrt(0.5)));  // not by the long way
  const aiMesh& mesh = *scene->mMeshes[0];
  CHECK(mesh.mNumFaces == 12);
  double volume = 0;
  for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
    const auto at = [&](unsigned k) {
      const aiVector3D& v = mesh.mVertices[mesh.mFaces[i].mIndices[k]];
      return Vec3(v.x, v.y, v.z);
    };
    volume += at(0).dot(at(1).cross(at(2))) / 6;
  }
  CHECK(volume == Approx(0.2 * 0.1 * 0.1));
}

TEST_CASE("a VTU holds whole blocks with their damage and velocity", "[record][export]") {
  const test::Folder dir;
  const std::vector<std::string> paths = write_vtu(bricks_that_move(), dir.file("run"));
  REQUIRE(paths.size() == 4);
  CHECK(bytes_of(paths[0]).find("<DataSet timestep=\"0.8\" file=\"run_00002.vtu\"/>") != std::string::npos);
  const std::string bytes = bytes_of(paths[3]);
  CHECK(bytes.find("NumberOfPoints=\"16\" NumberOfCells=\"12\"") != std::string::npos);
  const std::size_t start = bytes.find("encoding=\"raw\">\n_") + 17;
  // Value k of an array of floats; its length must be that of `count` values.
  const auto value = [&](const std::string& name, std::size_t count, std::size_t k) {
    const std::size_t head = bytes.find("Name=\"" + name + "\""), offset = bytes.find("offset=\"", head) + 8;
    const std::size_t at = start + std::stoul(bytes.substr(offset));
    std::uint64_t length = 0;
    std::memcpy(&length, bytes.data() + at, 8);
    CHECK(length == 4 * count);
    float out = 0;
    std::memcpy(&out, bytes.data() + at + 8 + 4 * k, 4);
    return out;
  };
  CHECK(value("points_m", 48, 0) == Approx(-0.1));
  CHECK(value("points_m", 48, 24) == Approx(0.3 + 0.05));  // corner (-.1, -.05) turned by 90 degrees
  CHECK(value("damage", 12, 11) == 1);
  CHECK(value("displacement_m", 36, 33) == Approx(0.3));
  CHECK(value("velocity_m_s", 36, 33) == Approx(-0.5));  // of the parabola, at .8 s
  CHECK(value("velocity_m_s", 36, 0) == 0);
}

TEST_CASE("velocities of a free flight are exact at frames of any spacing", "[record][export]") {
  ExportedRun run = bricks_that_move();
  const double v = 3, a = -9.81;
  for (MotionFrame& frame : run.frames) frame.poses[9] = static_cast<float>(v * (frame.t - 0.5) + a / 2 * std::pow(frame.t - 0.5, 2));
  for (std::size_t f = 0; f < 3; ++f) CHECK(velocity_of(run, f)[5] == Approx(v + a * (run.frames[f].t - 0.5)).epsilon(1e-5));
  run.frames.pop_back();
  for (std::size_t f = 0; f < 2; ++f) CHECK(velocity_of(run, f)[5] == Approx(v + a * 0.05).epsilon(1e-5));
  run.frames.pop_back();
  CHECK(velocity_of(run, 0) == std::vector<float>(6));
}

TEST_CASE("an OBJ shows an instant, a table all poses", "[record][export]") {
  const test::Folder dir;
  const ExportedRun run = bricks_that_move();
  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFile(write_obj(run, 1, dir.file("run.obj")).front(), aiProcess_JoinIdenticalVertices);
  REQUIRE(scene);
  REQUIRE(scene->mNumMeshes == 2);
  float lowest = 1;
  for (unsigned i = 0; i < scene->mMeshes[1]->mNumVertices; ++i) lowest = std::min(lowest, scene->mMeshes[1]->mVertices[i].x);
  CHECK(lowest == Approx(0.2 - 0.05));
  const std::string table = bytes_of(write_pose_table(run, dir.file("run.csv")).front());
  CHECK(std::count(table.begin(), table.end(), '\n') == 7);
  CHECK(table.find("0.6,1,\"Ziegel, ä\",0.200000003,0,0.100000001,") != std::string::npos);
}

TEST_CASE("what cannot be exported is told, and leaves nothing", "[record][export][bad_input]") {
  const test::Folder dir;
  CHECK_THROWS_WITH(read_exported_run("/nowhere", 0, 1, 1), Catch::Contains("no such folder"));
  std::filesystem::create_directories(dir.path);
  CHECK_THROWS_WITH(read_exported_run(dir.path.string(), 0, 1, 1), Catch::Contains("no manifest.json"));
  CHECK_THROWS_WITH(write_gltf(bricks_that_move(), "/nowhere/run.glb"), Catch::Contains("cannot be written"));
  CHECK_THROWS_AS(write_whole(dir.path.string(), "a folder is no file"), Error);
  CHECK(std::filesystem::is_empty(dir.path));
  CHECK_FALSE(std::filesystem::exists(dir.path.string() + ".part"));
}

TEST_CASE("HDF5 holds frames with units in the names, and XDMF names what is there", "[record][export]") {
  const test::Folder dir;
  const ExportedRun run = bricks_that_move();
  write_hdf5(run, dir.file("run.h5"));
  const h5::File file(dir.file("run.h5"), h5::File::Mode::read);
  CHECK(file.get<double>("/time_s") == std::vector<double>{0.5, 0.6, 0.8});
  CHECK(file.get_names("/blocks/name") == std::vector<std::string>{"base", "Ziegel, ä"});
  CHECK(file.get<float>("/blocks/position_m").size() == 18);
  CHECK(file.get<float>("/blocks/position_m")[9 + 0] == 0.2F);
  const std::vector<float> velocity = file.get<float>("/blocks/velocity_m_s");
  for (const auto& [at, expected] : {std::pair{3, 2.5}, {9, 1.5}, {15, -0.5}})  // of the parabola through the three frames
    CHECK(velocity[std::size_t(at)] == Approx(expected));
  CHECK(file.get<float>("/blocks/damage")[5] == 1);
  CHECK(file.get<float>("/joints/area_m2") == std::vector<float>{0.02F});
  CHECK_FALSE(file.has("/joints/force_N"));  // this run has kept no forces
  CHECK(file.get<float>("/block_mesh/points_m").size() == 3 * 48);
  CHECK(file.get<int>("/block_mesh/topology").size() == 12 * 6);
  const std::vector<std::string> paths = write_xdmf(run, dir.file("run.xdmf"));
  REQUIRE(paths.size() == 2);
  const std::string xml = bytes_of(paths[0]);
  CHECK(xml.find("<Time Value=\"0.8\"/>") != std::string::npos);
  CHECK(xml.find("run.xdmf.h5:/block_mesh/velocity_m_s") != std::string::npos);
  CHECK_THROWS_AS(write_hdf5(run, "/nowhere/run.h5"), Error);
}
