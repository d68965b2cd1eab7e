// Three settings of step and points, measured by the study of accuracy (scenes/accuracy/README.md: errors and costs).
#pragma once

namespace erbs::lua {

struct Quality {
  const char* name;
  double dt_fraction;  // of dt_critical
  int points;          // along each side of a joint, by Simpson's rule
};
constexpr Quality qualities[] = {{"draft", 0.9, 2}, {"standard", 0.9, 3}, {"reference", 0.25, 5}};

}  // namespace erbs::lua
