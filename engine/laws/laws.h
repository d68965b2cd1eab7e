// THE LIST of joint laws. A new law is one file (law.h says what it contains) and one entry here.
#pragma once
#include "engine/laws/dilatant.h"
#include "engine/laws/dry_friction.h"
#include "engine/laws/mortar.h"

namespace erbs {

template <class... L>
struct LawList {
  static constexpr int count = sizeof...(L);
};

using Laws = LawList<DryFriction, Mortar, Dilatant>;

}  // namespace erbs

#ifdef ERBS_HOST
#include <variant>

namespace erbs {

template <class... L>
std::variant<L...> variant_of(LawList<L...>);
using Law = decltype(variant_of(Laws{}));

// The numbers of the inner loops.
inline PointLaw compile(const Law& law) {
  PointLaw out = std::visit([](const auto& l) { return l.compile(); }, law);
  out.type = int(law.index());
  return out;
}

// Calls f with the kernel part (face.h) of a law.
template <class F, class... L>
void with_face(const PointLaw& law, F&& f, LawList<L...>) {
  int type = 0;
  ((type++ == law.type ? f(typename ERBS_TARGET::FaceOf<L>::type{}) : void()), ...);
}
template <class F>
void with_face(const PointLaw& law, F&& f) {
  with_face(law, f, Laws{});
}

}  // namespace erbs
#endif
