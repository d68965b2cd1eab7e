// THE LIST of recorders. A new recorder is one header and one entry here.
#pragma once
#include <variant>

#include "engine/record/displacement.h"
#include "engine/record/ground.h"
#include "engine/record/joint.h"
#include "engine/record/momentum.h"
#include "engine/record/reaction.h"

namespace erbs {

using AnyRecorder = std::variant<BlockMotion, Momentum, Reaction, JointQuantity, GroundMotion, Count>;

}  // namespace erbs
