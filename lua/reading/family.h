// Parameter family of a scene: values of its params that erbs test --grid tries besides other time steps.
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "engine/base/error.h"

namespace erbs::lua {

struct ParamFamily {
  std::vector<std::pair<std::string, std::vector<double>>> values;  // values of each param, in the order of declaration
  int combinations = 4;
  double seed = 1;  // of the random combinations
  Place place;
};

using Choice = std::vector<std::pair<std::string, double>>;  // params by name, each with its value

// One choice for each value of each param; the other params keep their defaults.
std::vector<Choice> one_at_a_time(const ParamFamily& family);
// The i-th random combination: one drawn value for every param.
Choice combination(const ParamFamily& family, int i);

}  // namespace erbs::lua
