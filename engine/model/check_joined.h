// What is joined at rest and what is not: blocks that nothing holds, rules that join nothing or something else than they say.
#pragma once
#include <string>
#include <vector>

#include "engine/model/interface.h"
#include "engine/model/model.h"

namespace erbs {

// Adds one message per mistake and per thing to know; what is of one script line or of one rule is one message with a count.
void check_joined(const Scene& scene, const Interfaces& found, const std::vector<Kind>& kind, std::vector<std::string>& errors,
                  std::vector<std::string>& warnings);

}  // namespace erbs
