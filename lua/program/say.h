// Output for the user.
#pragma once
#include <cstdio>
#include <utility>

#include "engine/base/error.h"
#include "engine/base/text.h"

namespace erbs::lua {

// Prints to stdout like fmt::print, with two differences: names of files and scenes in the text cannot control the terminal, and a
// full stdout throws nothing; main() reports it at the end.
template <class... A>
void say(fmt::format_string<A...> text, A&&... values) {
  const std::string all = printable(fmt::format(text, std::forward<A>(values)...));
  std::fwrite(all.data(), 1, all.size(), stdout);
}

}  // namespace erbs::lua
