// The run folder: what a run leaves behind, and all that the renderer, reports and studies know of it.
#pragma once
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "engine/record/csv.h"
#include "engine/record/json.h"
#include "engine/scene/scene.h"

namespace erbs {

// manifest.json: what was run, with what.
struct Manifest {
  std::string version, git_hash, compiler, isa;
  int threads = 1;
  std::string started;                                    // UTC, ISO 8601
  std::string scene_name, scene_file, scene_hash, title;  // title: the first comment line of the script
  std::vector<Param> params;
  std::map<std::string, std::string> inputs;  // path of each file read -> its hash
  std::vector<std::string> effects_on, effects_off;
  double duration = 0, output_dt = 0, frame_dt = 0;    // s
  double dt = 0, dt_critical = 0, dt_block_bound = 0;  // s
  std::string dt_rule;
  Vec3 gravity = Vec3::Zero();  // m/s2
  std::vector<Camera> cameras;
  std::vector<Material> materials;                                // name, density, debris, colour; motion.h5 names them by index
  std::vector<std::pair<std::string, std::string>> metric_units;  // of the scene's own metrics: name, unit
  Json laws, loads, settings;                                     // every other parameter of the scene with its unit, from the field lists
};

// All that the scene and the program know; the caller adds threads, effects, dt and its rule.
Manifest manifest_of(const Scene& scene, const std::string& script);

enum class Existing { refuse, force, resume };  // what to do with a folder that is there

// Checks that `dir` may be written and touches nothing: refuse: nothing of that name exists; force: absent, empty or a run
// folder; resume: a run folder with a checkpoint. Error (with the remedy) otherwise. To be called before the work of a run starts.
void check_run_folder(const std::string& dir, Existing existing);

// After check_run_folder: makes the folder (force: removes what an earlier run left there, and only that), writes scene.lua and
// manifest.json. With resume only the manifest is written again.
void create_run_folder(const std::string& dir, Existing existing, const std::string& script, const Manifest& manifest);

bool is_run_folder(const std::string& dir);

Manifest read_manifest(const std::string& dir);  // places and laws are not read back
void write_manifest(const std::string& dir, const Manifest& manifest);
std::string run_file(const std::string& dir, const std::string& name);  // DIR/name

std::string program_version();  // "0.1.0 (1a2b3c4)"
std::string machine_isa();      // widest vector instructions of this processor: avx512f, avx2, ...

}  // namespace erbs
