// Estimate of the cost of a run before it starts: a range, from counts of blocks, joints and contact points.
#pragma once
#include <string>

#include "engine/model/model.h"

namespace erbs::lua {

struct Cost {
  double least, most;      // s on one core
  std::string least_text;  // condition of `least`: "if all joints stay intact", ...
  std::string most_text;   // condition of `most`
  double cracked = 0;      // s, if all joints crack and no block comes loose; 0: `most` says the same
};

// `steps`: at the initial time step. `debris`: loose blocks collide (Analysis::debris).
Cost estimated_cost(const Model& model, double steps, bool debris);
std::string cost_text(const Cost& cost);

}  // namespace erbs::lua
