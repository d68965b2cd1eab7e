// A parameter is described once: its name, member, unit, meaning and range. Reading, unknown-key errors, range checks,
// help, the manifest and the editor file all come from this list.
#pragma once
#include <limits>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "engine/base/vec.h"

namespace erbs {

inline constexpr double unbounded = std::numeric_limits<double>::infinity();

template <class T>
struct Field {
  std::string_view name;
  std::variant<double T::*, int T::*, bool T::*, std::string T::*, Vec3 T::*> member;
  std::string_view unit;  // "" where the number has none
  std::string_view text;  // one sentence
  double low = -unbounded, high = unbounded;  // allowed range, ends included
  bool required = false;
  std::string_view words = {};  // of a text: the words allowed, "a|b|c"; empty is any
};

template <class T>
using Fields = std::vector<Field<T>>;

}  // namespace erbs
