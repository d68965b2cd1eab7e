// The study of erbs sweep, read and checked: every mistake is known before the first run.
#pragma once
#include <string>

#include "engine/record/format/json.h"
#include "engine/study/sweep/sweep.h"
#include "lua/program/options.h"

namespace erbs::lua {

inline constexpr const char* identity_file = "study.json";  // in the folder of a study

struct SweepStudy {
  std::string name;  // of the study file
  study::Sweep sweep;
  Json identity;  // what the key of the study consists of, for study.json
};

enum class StudyKind { sweep, calibration };  // of study{} and of calibration{}

// Reads the study file and its scene. Throws Error or Errors: a study of the other kind, a param that the scene does not declare, an
// unknown key, a file that is not there.
SweepStudy read_sweep_study(const std::string& path, const SceneOptions& options, bool quiet, StudyKind kind = StudyKind::sweep);

}  // namespace erbs::lua
