// Limit analysis of the structure that a push has collapsed, beside its capacity.
#pragma once
#include <optional>
#include <string>

#include "engine/model/model.h"
#include "engine/record/results/capacity.h"
#include "engine/scene/scene.h"

namespace erbs::analysis {

// None where `limit` of the push does not ask for it, or asks only if it takes seconds. `why`: what keeps limit analysis from an answer.
std::optional<LimitBeside> limit_beside(const Scene& scene, const Model& model, std::string& why);

}  // namespace erbs::analysis
