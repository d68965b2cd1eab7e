// Suggestions for misspelt words in messages.
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace erbs {

// The known word closest to `word`; "" if none is close.
std::string nearest(std::string_view word, const std::vector<std::string>& known);

// End of a message: `; did you mean "size"?`, or a list of the known words if none is close.
std::string did_you_mean(std::string_view word, const std::vector<std::string>& known);

}  // namespace erbs
