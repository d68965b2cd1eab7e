// Words near a misspelt one, for messages.
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace erbs {

// The known word nearest to `word`, "" where none is near.
std::string nearest(std::string_view word, const std::vector<std::string>& known);

// The end of a message: `; did you mean "size"?`, or the known words where none is near.
std::string did_you_mean(std::string_view word, const std::vector<std::string>& known);

}  // namespace erbs
