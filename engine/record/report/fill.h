// Texts of a web page.
#pragma once
#include <map>
#include <string>
#include <string_view>

#include "engine/record/format/json.h"

namespace erbs {

// All characters beyond ASCII and each "<" are escapes: no text of a user ends the script element that holds them.
std::string safe_json(const Json& json);
std::string safe_html(const std::string& text);
// Replaces {{name}} in one pass: what is filled in is not read again.
std::string filled(std::string_view html, const std::map<std::string_view, std::string>& values);

}  // namespace erbs
