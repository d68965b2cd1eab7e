// Effects that a scene calls for, derived from the scene alone. A scene pays neither time nor memory for other effects.
#pragma once
#include <string>
#include <vector>

#include "engine/scene/scene.h"

namespace erbs {

struct Effect {
  std::string name;
  bool on = false;
  std::string because;  // the script line that calls for it
};

std::vector<Effect> effects_of(const Scene& scene);

// Removes an effect from the scene, to measure its cost and its influence. Throws Error for an unknown name.
void switch_off(Scene& scene, const std::string& name);

// What in the scene evaluates all joints in every step, so that contacts have one level only (`Analysis::levels`); null: nothing.
const char* one_level_only(const Scene& scene);

}  // namespace erbs
