// Field lists: each parameter is described once by its name, member, unit, meaning and range. Reading, unknown-key errors, range
// checks, help, the manifest and the editor file all use this list.
#pragma once
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/vec.h"

namespace erbs {

inline constexpr double unbounded = std::numeric_limits<double>::infinity();

// Pointer to a member of one of five types; the others are null. A std::variant of them, in each of some thirty structs of headers that
// most files read, took an eighth of the time of the compiler.
template <class T>
struct Member {
  double T::*number = nullptr;
  int T::*count = nullptr;
  bool T::*flag = nullptr;
  std::string T::*word = nullptr;
  Vec3 T::*vector = nullptr;

  constexpr Member(double T::*m) : number(m) {}
  constexpr Member(int T::*m) : count(m) {}
  constexpr Member(bool T::*m) : flag(m) {}
  constexpr Member(std::string T::*m) : word(m) {}
  constexpr Member(Vec3 T::*m) : vector(m) {}

  template <class Use>
  decltype(auto) visit(Use&& use) const {
    if (number != nullptr) return use(number);
    if (count != nullptr) return use(count);
    if (flag != nullptr) return use(flag);
    if (word != nullptr) return use(word);
    return use(vector);
  }
};

template <class T>
struct Field {
  std::string_view name;
  Member<T> member;
  std::string_view unit;                      // "" for none
  std::string_view text;                      // one sentence
  double low = -unbounded, high = unbounded;  // allowed range, both ends included
  bool required = false;
  std::string_view words = {};  // allowed words of a text, "a|b|c"; empty: any
};

template <class T>
using Fields = std::vector<Field<T>>;

}  // namespace erbs
