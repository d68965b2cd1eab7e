// THE LIST of recorders. A new recorder is one header and one entry here.
#pragma once
#include <variant>

#include "engine/record/recorders/displacement.h"
#include "engine/record/recorders/ground.h"
#include "engine/record/recorders/joint.h"
#include "engine/record/recorders/momentum.h"
#include "engine/record/recorders/reaction.h"

namespace erbs {

using AnyRecorder = std::variant<BlockMotion, Momentum, Reaction, JointQuantity, GroundMotion, Count>;

}  // namespace erbs
