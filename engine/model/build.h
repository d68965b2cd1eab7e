// Scene -> Model + State. Every mistake that only geometry can show is found here, all at once.
#pragma once
#include "engine/model/model.h"
#include "engine/model/state.h"

namespace erbs {

struct Built {
  Model model;
  State state;
};

// Throws Errors with one message per mistake (overlap, a block without joint, a joint with too many points ...).
Built build(const Scene& scene);

// The overlaps alone, for a scene with other mistakes, which cannot be built; none where a shape is no solid.
std::vector<std::string> overlap_mistakes(const Scene& scene);

}  // namespace erbs
