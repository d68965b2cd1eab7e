// Kinds of options that several verbs share: numbers in a range, lengths of time, output folders, how a scene is read.
#pragma once
#include <CLI/CLI.hpp>
#include <cmath>
#include <filesystem>
#include <type_traits>

#include "engine/base/text.h"
#include "lua/program/options.h"
#include "lua/program/overrides.h"

namespace erbs::lua {

// A number in a range, ends included. CLI::Range would accept NaN, which is neither below nor above any number.
template <class T>
CLI::Validator within(T low, T high) {
  const std::string range = fmt::format("{} to {}", low, high);
  return CLI::Validator(
      [=](std::string& text) {
        T value{};
        if (CLI::detail::lexical_cast(text, value) && value >= low && value <= high) return std::string();
        double number = 0;
        if (std::is_integral_v<T> && CLI::detail::lexical_cast(text, number) && std::isfinite(number) && number != std::floor(number))
          return fmt::format("{} is no whole number", shown(text));
        return fmt::format("{} is not in range {}", shown(text), range);
      },
      range);
}

// An option must not be empty: in a shell script an empty word is usually a variable that is not set.
inline CLI::Validator filled() {
  return CLI::Validator(
      [](std::string& text) { return text.empty() ? std::string("it is empty; give it a value, or leave the option out") : ""; }, "");
}

inline CLI::Validator folder() {
  return CLI::Validator(
      [](std::string& text) {
        return std::filesystem::is_directory(text) ? "" : fmt::format("there is no folder {}; check the path", shown(text));
      },
      "");
}

// An option whose value is a length of time, in s.
template <class T>
void add_time(CLI::App& verb, const std::string& name, T& seconds, const std::string& text, const char* example) {
  verb.add_option_function<std::string>(
          name, [&seconds, name](const std::string& value) { seconds = seconds_of(value, name); }, text)
      ->check(filled())
      ->type_name(example);
}

inline void add_max_wall(CLI::App& verb, std::optional<double>& seconds, const std::string& text, const char* example) {
  const auto read = [&seconds](const std::string& value) {
    seconds = seconds_of(value, "--max-wall");
    if (seconds == 0.0) throw Error("--max-wall " + value + ": leaves no time to run; give more, such as 30m");
  };
  verb.add_option_function<std::string>("--max-wall", read, text)->check(filled())->type_name(example);
}

inline void add_output(CLI::App& verb, OutputOptions& output, const std::string& place = "runs/<scene name>") {
  verb.add_option("-o", output.directory, "folder for the results (default " + place + ")")->check(filled())->type_name("DIR");
  verb.add_flag("--force", output.force, "replace an earlier run there");
  verb.add_flag("-q,--quiet", output.quiet, "print warnings and errors only");
}

inline void add_scene(CLI::App& verb, SceneOptions& scene) {
  verb.add_option_function<std::vector<std::string>>(
          "-D", [&scene](const std::vector<std::string>& defines) { read_defines(defines, scene.overrides); },
          "set a param of the scene, with units: -D pga=0.8*g")
      ->type_name("name=value")
      ->expected(1)
      ->take_all();
  verb.add_flag("--allow-unstable", scene.allow_unstable, "allow a time step beyond the limit");
  verb.add_option("--allow", scene.allow, "allow the scene to read files in this folder besides its own")
      ->type_name("DIR")
      ->check(folder())
      ->expected(1)
      ->take_all();
  verb.add_option("--max-blocks", scene.max_blocks, "refuse a scene of more blocks (default 300000)")->check(within(1, 100000000));
  verb.add_option("--max-points", scene.max_points, "refuse a scene of more contact points (default 20000000)")
      ->check(within(1, 2000000000));
}

}  // namespace erbs::lua
