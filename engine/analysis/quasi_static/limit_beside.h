// Limit analysis of the structure that a push has collapsed, beside its capacity.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/model/model.h"
#include "engine/record/results/capacity.h"
#include "engine/scene/scene.h"

namespace erbs::analysis {

// `borne`: the capacity, if the push has found it. `fell`: blocks that had fallen off before the push and are left out [nblock]. None where
// `limit` of the push does not ask for it, or asks only if it takes seconds. `why`: what keeps limit analysis from an answer.
std::optional<LimitBeside> limit_beside(const Scene& scene, const Model& model, std::optional<double> borne,
                                        const std::vector<std::uint8_t>& fell, std::string& why);

}  // namespace erbs::analysis
