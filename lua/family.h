// What a scene lets erbs test --grid vary besides the step: lists of values of its params.
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "engine/base/error.h"

namespace erbs {

struct ParamFamily {
  std::vector<std::pair<std::string, std::vector<double>>> values;  // of each param, in the order of their declaration
  int combinations = 4;
  double seed = 1;  // of the combinations
  Place place;
};

using Choice = std::vector<std::pair<std::string, double>>;  // a value of each param it names

// Each value of each param, alone.
std::vector<Choice> one_at_a_time(const ParamFamily& family);
// The i-th combination: a value of every param, drawn.
Choice combination(const ParamFamily& family, int i);

}  // namespace erbs
