// Refuses loads whose size no structure could mean: a slip of units, or a function that grows without end.
#pragma once
#include <string>

#include "engine/scene/scene.h"

namespace erbs {

// How a script calls loads of this kind.
const char* load_word(Load::Kind kind);

// What is wrong with the size of a load within a run of `duration` (s), with the remedy; "" if nothing is.
std::string load_size_mistake(const Load& load, double duration);

}  // namespace erbs
