// What the program prints for its user.
#pragma once
#include <cstdio>
#include <utility>

#include "engine/base/error.h"
#include "engine/base/text.h"

namespace erbs {

// To stdout, as fmt::print does, but names of files and scenes in it control no terminal, and a stdout that is full throws nothing:
// main() tells at the end.
template <class... A>
void say(fmt::format_string<A...> text, A&&... values) {
  const std::string all = printable(fmt::format(text, std::forward<A>(values)...));
  std::fwrite(all.data(), 1, all.size(), stdout);
}

}  // namespace erbs
