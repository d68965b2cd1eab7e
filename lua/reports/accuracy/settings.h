// The settings that a study of accuracy gives to a scene: step, points, solver, and the knobs that the scene declares.
#pragma once
#include <string>
#include <vector>

#include "engine/study/accuracy.h"
#include "lua/language/script.h"
#include "lua/program/options.h"

namespace erbs::lua {

struct AccuracyPlan {
  std::vector<study::Setting> settings;     // cheap ones first
  std::vector<study::Knob> knobs;           // of the scene or of --knob, without those that -D fixes
  std::vector<std::string> not_applicable;  // kinds of settings that do not apply to the scene, each with the reason
};

// Throws Error for a --knob that the scene has not.
AccuracyPlan plan_of(const Script& script, const AccuracyCommand& command);

}  // namespace erbs::lua
