// Loads of a time history that are probably not meant so: such as never act, or strike what they should move.
#pragma once
#include <string>
#include <vector>

#include "engine/model/model.h"
#include "engine/scene/scene.h"

namespace erbs::analysis {

std::vector<std::string> warnings_of_loads(const Scene& scene, const Model& model);

}  // namespace erbs::analysis
