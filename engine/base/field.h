// Field lists: each parameter is described once by its name, member, unit, meaning and range. Reading, unknown-key errors, range
// checks, help, the manifest and the editor file all use this list.
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
  std::string_view unit;                      // "" for none
  std::string_view text;                      // one sentence
  double low = -unbounded, high = unbounded;  // allowed range, both ends included
  bool required = false;
  std::string_view words = {};  // allowed words of a text, "a|b|c"; empty: any
};

template <class T>
using Fields = std::vector<Field<T>>;

}  // namespace erbs
