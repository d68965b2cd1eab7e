// The lines that erbs run prints at the end: collapse or capacity, metrics of the scene, and expectations that failed.
#pragma once
#include <string>
#include <vector>

#include "engine/record/format/json.h"
#include "engine/scene/scene.h"
#include "lua/reports/expectations.h"

namespace erbs::lua {

// `without_answer`: how many studies of the scene found none.
void print_summary(const Scene& scene, const std::string& directory, const Json& metrics, const std::vector<Verdict>& verdicts,
                   std::size_t without_answer);

}  // namespace erbs::lua
