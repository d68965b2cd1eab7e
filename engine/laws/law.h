// What a file of a joint law contains; `Laws` of laws.h is their list.
//   struct L             its parameters, in a field list, and as far as the law calls for it
//     law_name, help       name of its function in a script, and a sentence on it
//     complete()           sets defaults that depend on other parameters; returns a mistake, or an empty text
//     mistakes()           in the finished parameters: what is wrong and what to do
//     share_thickness()    takes over the thickness (m) of its joint rule, or gives the rule its own; returns as `complete()`
//     compile()            the plain numbers of the inner loops
//     effects()            what can be switched off, to measure its cost (`erbs effects`)
//     strengths()          in Pa, for doubts about units
//     warnings()           of doubtful parameters
//   FaceOf<L>            its kernel part, if it does more than friction: face.h
// The first part is for ordinary files only (ERBS_HOST); kernels never see it.
#pragma once
#include "engine/laws/point.h"
#include "engine/simd/target.h"

#ifdef ERBS_HOST
#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "engine/base/error.h"
#include "engine/base/field.h"
#endif

namespace erbs {

#ifdef ERBS_HOST
template <class L>
struct LawEffect {
  const char* name;
  bool (*on)(const L&);
  void (*off)(L&);
  bool dashpots = false;  // acts by dashpots, which the sequential solver does not have
};
template <class L>
using LawEffects = std::vector<LawEffect<L>>;
#endif

}  // namespace erbs
