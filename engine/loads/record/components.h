// Components of one ground motion, from a file each: one time axis and one scale.
#pragma once
#include <array>
#include <string>

#include "engine/loads/record/record.h"

namespace erbs {

struct Components {
  std::array<Record, 3> of;  // along x, y, z; a component without a file is absent
  std::string note;          // scale and lengths, in a sentence
};

// Reads the files of `wanted` and scales all by one factor: wanted[..].peak becomes the peak of the component `named` ("x", "y", "z"), or
// of the "strongest". Their steps must agree; a shorter component does not accelerate after its end. The other members of `wanted` should
// be alike. `place`: the script line.
Components read_components(const std::array<Record, 3>& wanted, const std::string& named, const Place& place);

}  // namespace erbs
