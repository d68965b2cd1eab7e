// Checks of the joints found at rest: blocks without support, rules without joints, rules whose joints differ from their specification.
#pragma once
#include <string>
#include <vector>

#include "engine/model/build/interface.h"
#include "engine/model/model.h"

namespace erbs {

// Adds one message per mistake and per warning. Cases of one script line or of one rule share a message with a count.
void check_joined(const Scene& scene, const Interfaces& found, const std::vector<Kind>& kind, std::vector<std::string>& errors,
                  std::vector<std::string>& warnings);

}  // namespace erbs
