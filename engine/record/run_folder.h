// The run folder: what a run leaves behind, and all that the renderer, reports and studies know of it.
#pragma once
#include <string>

#include "engine/record/csv.h"
#include "engine/record/manifest.h"
#include "engine/record/metrics.h"

namespace erbs {

enum class Existing { refuse, force, resume };  // what to do with a folder that is there

// Checks that `dir` may be written and touches nothing: refuse: nothing of that name exists; force: absent, empty or a run
// folder; resume: a run folder with a checkpoint. Error (with the remedy) otherwise. To be called before the work of a run starts.
void check_run_folder(const std::string& dir, Existing existing);

// After check_run_folder: makes the folder (force: removes what an earlier run left there, and only that), writes scene.lua and
// manifest.json. With resume only the manifest is written again.
void create_run_folder(const std::string& dir, Existing existing, const std::string& script, const Manifest& manifest);

bool is_run_folder(const std::string& dir);

std::string run_file(const std::string& dir, const std::string& name);  // DIR/name

}  // namespace erbs
