// The only access to JSON. Keys keep their order of writing. NaN and infinities are written as null.
#pragma once
#include <nlohmann/json.hpp>

#include <string>
#include <string_view>

namespace erbs {

using Json = nlohmann::ordered_json;

// Error with the file's name if the file is missing or malformed.
Json read_json(const std::string& path);

// Writes to path.tmp, then renames: a reader sees the old file or the whole new one.
void write_json(const std::string& path, const Json& json);
std::string whole_text(const std::string& path);  // of a file; "" if it cannot be read
void write_text_atomically(const std::string& path, std::string_view text);

// Value at a dotted key ("energy.residual_relative", "collapse.direction.0"); null if there is none.
const Json* find_key(const Json& json, std::string_view dotted);
double number_at(const Json& json, std::string_view dotted);  // 0 if it is no number

}  // namespace erbs
