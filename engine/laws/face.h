// What a joint law does to a whole face, beyond its points. Most laws do nothing: `ElasticFace`.
//
// A law names its own with a specialisation of `FaceOf` in its file. The kernels of cracked joints are compiled once for each law of the
// list (laws.h), so a law pays for its own effects only.
#pragma once
#include "engine/laws/slip.h"

namespace erbs::ERBS_TARGET {

struct ElasticFace {
  static constexpr int numbers = 0;        // history of a joint: doubles
  static constexpr bool has_bond = false;  // its points may have a bond
  static constexpr bool yields = false;    // it yields in compression, place by place: `CrushedFace`
  static constexpr bool lifts = false;     // asperities lift the faces: the four functions of `DilatantFace`
};

template <class Law>
struct FaceOf {
  using type = ElasticFace;
};

}  // namespace erbs::ERBS_TARGET
