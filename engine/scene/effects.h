// Which effects a scene calls for, from the scene alone. A scene does not pay for what it does not call for.
#pragma once
#include <string>
#include <vector>

#include "engine/scene/scene.h"

namespace erbs {

struct Effect {
  std::string name;
  bool on = false;
  std::string because;  // the script line that called for it
};

std::vector<Effect> effects_of(const Scene& scene);

// Takes an effect out of the scene, to see what it costs and how much it matters. Error for a name that is none of effects_of.
void switch_off(Scene& scene, const std::string& name);

}  // namespace erbs
