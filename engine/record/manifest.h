// manifest.json: what was run, with what.
#pragma once
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "engine/record/json.h"
#include "engine/scene/scene.h"

namespace erbs {

struct Manifest {
  std::string version, git_hash, compiler, isa;
  int threads = 1;
  std::string started;                                    // UTC, ISO 8601
  std::string scene_name, scene_file, scene_hash, title;  // title: the first comment line of the script
  std::vector<std::string> labels;
  std::vector<Param> params;
  std::map<std::string, std::string> inputs;  // path of each file read -> its hash
  std::vector<std::string> effects_on, effects_off;
  double duration = 0, output_dt = 0, frame_dt = 0;    // s
  double dt = 0, dt_critical = 0, dt_block_bound = 0;  // s
  std::vector<std::string> departures;  // words of the command line by which the run departs from its scene
  std::string dt_rule;
  Vec3 gravity = Vec3::Zero();  // m/s2
  std::vector<Camera> cameras;
  std::vector<Material> materials;                                // name, density, debris, colour; motion.h5 names them by index
  std::vector<std::pair<std::string, std::string>> metric_units;  // of the scene's own metrics: name, unit
  Json laws, loads, settings;                                     // every other parameter of the scene with its unit, from the field lists
};

// All that the scene and the program know; the caller adds threads, effects, dt and its rule.
Manifest manifest_of(const Scene& scene, const std::string& script);
void write_manifest(const std::string& dir, const Manifest& manifest);  // DIR/manifest.json, atomically
Manifest read_manifest(const std::string& dir);                         // places are not read back

std::string program_version();                    // "0.1.0 (1a2b3c4)"
std::string machine_isa();                        // the vector instructions that the kernels run on: avx512f, avx2, sse2
std::string title_of(const std::string& script);  // its first comment line, "" where it opens with none

}  // namespace erbs
