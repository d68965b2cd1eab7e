// Loads a piece of script and returns its scene, or its mistakes.
#pragma once
#include <algorithm>
#include <string>
#include <vector>

#include "lua/language/script.h"

namespace erbs::lua {

inline Script::Options quiet(double seconds = 10, size_t bytes = size_t{256} << 20) {
  Script::Options options;
  options.seconds = seconds;
  options.bytes = bytes;
  options.quiet = true;
  return options;
}

// Lines common to the scenes of these tests.
inline const std::string sound = R"(
material{ name = "brick", density = 1800 }
box{ name = "b", size = {.3, .2, .1}, material = "brick" }
analysis{ duration = 1 }
)";

// `piece` follows the common lines and begins at line 6.
inline Scene scene_of(const std::string& piece, const Overrides& overrides = {}) {
  Script script(quiet());
  return script.load_text(sound + "\n" + piece, "scene.lua", overrides);
}

inline std::vector<std::string> mistakes_of(const std::string& text, const Overrides& overrides = {}, Script::Options options = quiet()) {
  Script script(options);
  try {
    script.load_text(text, "scene.lua", overrides);
  } catch (const Errors& errors) { return errors.messages; }
  return {};
}

// The mistakes of a piece that follows the common lines.
inline std::vector<std::string> mistakes_in(const std::string& piece, const Overrides& overrides = {}) {
  return mistakes_of(sound + "\n" + piece, overrides);
}

inline bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

inline bool mentions(const std::vector<std::string>& messages, const std::string& part) {
  return std::any_of(messages.begin(), messages.end(), [&](const std::string& m) { return contains(m, part); });
}

}  // namespace erbs::lua
