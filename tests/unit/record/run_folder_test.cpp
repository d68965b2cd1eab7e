#include "engine/record/folder/run_folder.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>

#include "engine/model/state.h"
#include "tests/unit/record/two_bricks.h"

using namespace erbs;
namespace fs = std::filesystem;

namespace {

Scene full_scene() {
  Scene scene = test::two_bricks().scene;
  scene.params = {{"pga", 3.924, 1.962, "raised until it falls", "m/s2", {}}};
  scene.inputs = {{"records/elcentro.csv", "00ff"}};
  scene.cameras.push_back({"street", Vec3(1, 2, 3), Vec3(0, 0, 1), Vec3(0, 0, 1), 0.6, {}});
  Mortar mortar;
  mortar.ft = 2e5, mortar.E = 1e9, mortar.thickness = 0.01;
  scene.joint_rules[0].law = mortar;
  Load shake;
  shake.wave = Sine{2, 3, 0, 0, unbounded};
  scene.loads.push_back(shake);
  return scene;
}

void make(const std::string& dir, Existing existing) {
  create_run_folder(dir, existing, "-- A wall\nbox{}", manifest_of(full_scene(), "-- A wall"));
}

}  // namespace

TEST_CASE("a run folder holds the script and what it ran with", "[record][run_folder]") {
  const test::Scratch scratch("folder");
  const std::string dir = scratch.path + "/runs/wall";
  make(dir, Existing::refuse);
  CHECK(is_run_folder(dir));
  std::string line;
  std::getline(std::ifstream(dir + "/scene.lua") >> std::noskipws, line);
  CHECK(line == "-- A wall");
  const Manifest m = read_manifest(dir);
  CHECK(m.title == "A wall");
  REQUIRE(m.params.size() == 1);
  CHECK(m.params[0].value == 3.924);
  CHECK(m.params[0].fallback == 1.962);
  CHECK(m.params[0].unit == "m/s2");
  CHECK(m.inputs.at("records/elcentro.csv") == "00ff");
  REQUIRE(m.cameras.size() == 1);
  CHECK(m.cameras[0].eye == Vec3(1, 2, 3));
  CHECK(m.cameras[0].fov == 0.6);
  CHECK(m.materials.at(0).density == 1800);
  CHECK_FALSE(m.version.empty());
  CHECK_FALSE(m.git_hash.empty());
  const Json json = read_json(dir + "/manifest.json");
  CHECK(*find_key(json, "laws.0.law.ft.value") == 2e5);
  CHECK(*find_key(json, "laws.0.law.ft.unit") == "Pa");
  CHECK(*find_key(json, "laws.0.law.in_force.kn.value") == 1e11);  // E / thickness
  CHECK(*find_key(json, "laws.0.law.in_force.ks.unit") == "Pa/m");
  CHECK(*find_key(json, "loads.0.wave.frequency.value") == 3.0);
  CHECK(*find_key(json, "settings.damping.mass.unit") == "1/s");
}

TEST_CASE("an existing folder is refused and left as it was", "[record][run_folder]") {
  const test::Scratch scratch("existing");
  fs::create_directories(scratch.path);
  std::ofstream(scratch.path + "/letter.txt") << "dear";
  CHECK_THROWS_WITH(make(scratch.path, Existing::refuse), Catch::Contains("exists") && Catch::Contains("--force"));
  CHECK_THROWS_WITH(make(scratch.path, Existing::force), Catch::Contains("no run folder"));
  CHECK_THROWS_WITH(make(scratch.path, Existing::resume), Catch::Contains("checkpoint"));
  CHECK_THROWS_WITH(make(scratch.path + "/letter.txt", Existing::force), Catch::Contains("no folder"));
  CHECK(std::distance(fs::directory_iterator(scratch.path), fs::directory_iterator()) == 1);
  CHECK_THROWS_WITH(make(scratch.path + "/none", Existing::resume), Catch::Contains("no folder"));
}

TEST_CASE("a folder that cannot be made leaves nothing behind", "[record][run_folder]") {
  const test::Scratch scratch("nothing");
  fs::create_directories(scratch.path);
  std::ofstream(scratch.path + "/file") << "x";
  CHECK_THROWS_AS(make(scratch.path + "/file/runs/a", Existing::refuse), Error);
  Manifest bad = manifest_of(full_scene(), "");
  // manifest.json.tmp blocks the manifest. The folder existed before, so it stays with its content.
  fs::create_directories(scratch.path + "/old/manifest.json.tmp");
  CHECK_THROWS_AS(create_run_folder(scratch.path + "/old", Existing::refuse, "", bad), Error);
  CHECK(std::distance(fs::directory_iterator(scratch.path), fs::directory_iterator()) == 2);
}

TEST_CASE("force empties a run folder of its own files only", "[record][run_folder]") {
  const test::Scratch scratch("force");
  const std::string dir = scratch.path;
  make(dir, Existing::force);
  for (const char* name : {"/metrics.json", "/motion.h5", "/notes.txt", "/checkpoint.bin"}) std::ofstream(dir + name) << "x";
  fs::create_directories(dir + "/frames");
  std::ofstream(dir + "/frames/0.png") << "x";
  make(dir, Existing::resume);
  CHECK(fs::exists(dir + "/metrics.json"));
  make(dir, Existing::force);
  for (const char* name : {"/metrics.json", "/motion.h5", "/frames", "/checkpoint.bin"}) CHECK_FALSE(fs::exists(dir + name));
  CHECK(fs::exists(dir + "/notes.txt"));
  CHECK(is_run_folder(dir));
}

TEST_CASE("a run folder that has lost its manifest can be resumed, which writes it anew, or overwritten", "[record][run_folder]") {
  const test::Scratch scratch("lost");
  const std::string dir = scratch.path;
  for (const Existing existing : {Existing::resume, Existing::force}) {
    make(dir, Existing::force);
    std::ofstream(dir + "/checkpoint.bin") << "x";
    fs::remove(dir + "/manifest.json");
    CHECK_NOTHROW(make(dir, existing));
    CHECK(read_manifest(dir).title == "A wall");
  }
  fs::rename(dir + "/manifest.json", dir + "/notes.txt");
  fs::remove(dir + "/scene.lua");
  CHECK_THROWS_WITH(make(dir, Existing::force), Catch::Contains("no run folder"));
}

TEST_CASE("force removes films, comparisons and exports of the former run, and nothing of the user", "[record][run_folder]") {
  const test::Scratch scratch("films");
  const std::string dir = scratch.path;
  Scene scene = full_scene();
  scene.name = "wall";
  const auto make_wall = [&](Existing existing) { create_run_folder(dir, existing, "", manifest_of(scene, "")); };
  make_wall(Existing::force);
  for (const char* folder : {"/compare", "/export", "/twin"}) fs::create_directories(dir + folder);
  const char* former[] = {"/wall_street.mp4",      "/wall_street.webp",   "/twin.log",
                          "/compare/compare.json", "/compare/frames.svg", "/compare/compare_side.mp4",
                          "/export/wall.glb",      "/twin/energy.csv",    "/export/wall_blocks_00001.vtu"};
  const char* users[] = {"/test.mp4", "/logo.webp", "/compare/measured.csv"};
  for (const char* name : former) std::ofstream(dir + name) << "x";
  for (const char* name : users) std::ofstream(dir + name) << "x";
  make_wall(Existing::force);
  for (const char* name : former) CHECK_FALSE(fs::exists(dir + name));
  for (const char* name : users) CHECK(fs::exists(dir + name));
  CHECK_FALSE(fs::exists(dir + "/export"));
}

TEST_CASE("metrics.json has the keys of the contract, unknown numbers are null", "[record][metrics]") {
  const test::Scratch scratch("metrics");
  fs::create_directories(scratch.path);
  Metrics m;
  m.time_s = 4, m.wall_s.solve = 2, m.point_updates = 100;
  Energy energy;
  energy.friction = 3;
  m.energy = energy_terms(energy);
  m.metrics = {{"drift", 0.5}, {"never", std::nan("")}};
  write_metrics(scratch.path, m);
  Json json = read_metrics(scratch.path);
  const char* keys[] = {"status",
                        "time_s",
                        "steps",
                        "dt_s",
                        "dt_critical_s",
                        "dt_block_bound_s",
                        "threads",
                        "blocks",
                        "joints",
                        "contact_points",
                        "joints_broken",
                        "blocks_asleep",
                        "wall_s",
                        "realtime_factor",
                        "point_updates",
                        "point_updates_per_s",
                        "peak_memory_bytes",
                        "effects",
                        "energy",
                        "momentum_residual",
                        "max_penetration_relative",
                        "collapse",
                        "trust",
                        "equilibrium",
                        "state_hash",
                        "expectations",
                        "metrics"};
  std::vector<std::string> found;
  for (const auto& item : json.items()) found.push_back(item.key());
  CHECK(found == std::vector<std::string>(std::begin(keys), std::end(keys)));
  found.clear();
  for (const auto& item : json["energy"].items()) found.push_back(item.key());
  CHECK(found == std::vector<std::string>{"frame", "base_work_J", "external_work_J", "tilt_work_J", "kinetic_J", "gravity_J", "elastic_J",
                                          "friction_J", "fracture_J", "crushing_J", "damping_J", "contact_damping_J", "reset_J", "sleep_J",
                                          "residual_relative"});
  CHECK(json["energy"]["friction_J"] == 3.0);
  CHECK(json["realtime_factor"] == 2.0);
  CHECK(json["point_updates_per_s"] == 50.0);
  CHECK(json["metrics"]["drift"] == 0.5);
  CHECK(json["metrics"]["never"].is_null());
  CHECK(json["collapse"]["time_s"].is_null());
  CHECK(json["collapse"]["direction"].is_null());
  CHECK(find_key(json, "collapse.none") == nullptr);
  m.collapse.time_s = 1.5;
  m.collapse.direction = {0.6, 0.8};
  CHECK(*find_key(to_json(m), "collapse.direction.1") == 0.8);
  CHECK(peak_memory_bytes() > 1000000);
}

TEST_CASE("files that are no JSON are named", "[record][run_folder]") {
  const test::Scratch scratch("json");
  fs::create_directories(scratch.path);
  CHECK_THROWS_WITH(read_manifest(scratch.path), Catch::Contains("manifest.json") && Catch::Contains("missing"));
  std::ofstream(scratch.path + "/manifest.json") << "{ \"program\": ";
  CHECK_THROWS_WITH(read_manifest(scratch.path), Catch::Contains("not valid JSON"));
  std::ofstream(scratch.path + "/manifest.json") << "{ \"program\": \"erbs\" }";
  CHECK_THROWS_WITH(read_manifest(scratch.path), Catch::Contains("not a manifest"));
}
