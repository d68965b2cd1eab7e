// Scene -> Model + State. Reports all mistakes that only geometry can show, at once.
#pragma once
#include "engine/model/model.h"
#include "engine/model/state.h"

namespace erbs {

struct Built {
  Model model;
  State state;
  std::vector<std::string> warnings;
  std::vector<std::string> notes;  // details of a summary warning, for log.txt
};

// Throws Errors with one message per mistake (overlap, block without joint, joint with too many points ...).
Built build(const Scene& scene);

// The overlaps alone, for a scene that cannot be built because of other mistakes. Empty if a shape is not a valid body.
std::vector<std::string> overlap_mistakes(const Scene& scene);

}  // namespace erbs
