// What a run may cost before anybody has run it: from counts, as a range.
#pragma once
#include <string>

#include "engine/model/model.h"

namespace erbs {

struct Cost {
  double least, most;      // s of one core
  std::string least_text;  // "if all joints stay sound", ...
  std::string most_text;
  double cracked = 0;  // s, if all joints crack and no block comes loose; 0: that says no more
};

// `steps`: at the step of the start. `debris`: blocks that come loose meet (Analysis::debris).
Cost estimated_cost(const Model& model, double steps, bool debris);
std::string cost_text(const Cost& cost);

}  // namespace erbs
