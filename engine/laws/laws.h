// THE LIST of joint laws. A new law is one header and one entry here.
#pragma once
#include <variant>

#include "engine/laws/dry_friction.h"
#include "engine/laws/mortar.h"

namespace erbs {

using Law = std::variant<DryFriction, Mortar>;

}  // namespace erbs
