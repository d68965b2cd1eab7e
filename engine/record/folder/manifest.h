// manifest.json: the scene, program, settings and input files of a run.
#pragma once
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "engine/record/format/json.h"
#include "engine/scene/scene.h"

namespace erbs {

struct Manifest {
  std::string version, git_hash, compiler, isa;
  int threads = 1;
  std::string started;                                    // UTC, ISO 8601
  std::string scene_name, scene_file, scene_hash, title;  // title: the first comment line of the script
  std::vector<std::string> labels;
  std::vector<Param> params;
  std::vector<std::string> notes;             // Scene::notes
  std::map<std::string, std::string> inputs;  // path of each input file -> its hash
  std::vector<std::string> effects_on, effects_off;
  double duration = 0, output_dt = 0, frame_dt = 0;    // s
  double dt = 0, dt_critical = 0, dt_block_bound = 0;  // s
  std::string scene_path;                              // absolute
  std::vector<std::string> arguments;                  // command-line options besides overrides that a resumption needs
  std::vector<std::string> override_arguments;         // command-line overrides of the scene
  std::string dt_rule;
  Vec3 gravity = Vec3::Zero();  // m/s2
  std::vector<Camera> cameras;
  std::vector<Material> materials;                                // name, density, contact properties, colour; index in motion.h5
  std::vector<std::pair<std::string, std::string>> metric_units;  // name and unit of the scene's own metrics
  Json laws, loads, settings;                                     // all other parameters of the scene with units, from the field lists
};

// Fills in everything known from scene and program. The caller adds threads, effects, time step and its rule.
Manifest manifest_of(const Scene& scene, const std::string& script);
void write_manifest(const std::string& dir, const Manifest& manifest);  // DIR/manifest.json, atomically
Manifest read_manifest(const std::string& dir);                         // script places are not read back

// What is known of an event that a row or frame at the time t (s) showed first: "between 3.36 and 3.37 s" (results/collapse.h).
std::string span_of_event(const Manifest& manifest, double t);

std::string program_version();                    // "0.1.0 (1a2b3c4)"
std::string machine_isa();                        // vector instructions the kernels use: avx512f, avx2, sse2
std::string title_of(const std::string& script);  // first comment line of the script; "" if the script does not begin with one

}  // namespace erbs
