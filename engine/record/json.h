// The one door to JSON. Keys keep the order in which they are written; NaN and infinities are written as null.
#pragma once
#include <nlohmann/json.hpp>

#include <string>
#include <string_view>

namespace erbs {

using Json = nlohmann::ordered_json;

// A missing or malformed file is an Error that names it.
Json read_json(const std::string& path);

// Into path.tmp, then renamed: a reader sees the old file or the whole new one.
void write_json(const std::string& path, const Json& json);
void write_text_atomically(const std::string& path, std::string_view text);

// The value at a dotted key ("energy.residual_relative", "collapse.direction.0"); null where there is none.
const Json* find_key(const Json& json, std::string_view dotted);

}  // namespace erbs
