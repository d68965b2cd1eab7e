// Course of a collapse, as an engineer tells it: which groups of blocks fell, one after the other, where the structure gave way, and to
// which side it fell.
#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "engine/record/results/collapse.h"

namespace erbs {

// A group of blocks (`Block::group`, a wall for example) of which a tenth of the mass has fallen.
struct GroupFall {
  std::string group;
  double time = 0;   // s, at which a tenth of its mass had fallen
  double share = 0;  // of its mass, fallen by the end
};

struct Course {
  std::vector<GroupFall> groups;                // in the order of their times
  std::optional<std::array<double, 2>> height;  // m above the lowest support: of the middle 80 % of the joints that moved
  std::string text;                             // "gives way between 0.1 and 1.4 m; falls in the order east (2.12 s), ..., towards -x"
};

// `group`: of each block. Empty without a collapse. With more than `names` groups the text ends in a number.
Course course_of(const Collapse& collapse, const Model& model, const std::vector<std::string>& group,
                 const std::optional<std::array<double, 2>>& direction, int names = 6);

}  // namespace erbs
