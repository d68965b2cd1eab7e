// What limits the time step, for the progress line and the profile.
#pragma once
#include <compare>

namespace erbs {

struct StepLimit {
  enum class By { structure, joints, contacts, impact, slip, event, passing, growth } by = By::structure;
  int block = -1;  // in the model; -1: none in particular

  auto operator<=>(const StepLimit&) const = default;
};

}  // namespace erbs
