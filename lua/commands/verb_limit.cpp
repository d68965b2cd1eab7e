// erbs limit SCENE.lua: the multiplier of a load at which the blocks become a mechanism, by limit analysis.
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "engine/analysis/limit/report.h"
#include "engine/base/text.h"
#include "engine/base/units.h"
#include "engine/model/build/build.h"
#include "engine/record/folder/run_folder.h"
#include "lua/program/options.h"
#include "lua/program/say.h"

namespace erbs::lua {
namespace {

namespace fs = std::filesystem;
using namespace analysis;

// "x", "-x", "0.6,0.8,0"
Vec3 direction_of(const std::string& text) {
  const Error wrong(
      fmt::format("--direction {}: it is no direction; write x, -x, y, -y, z, -z, or three numbers such as 1,0.3,0", shown(text, 60)));
  std::string_view word = text;
  const double sign = word.starts_with("-") && word.size() == 2 ? -1 : 1;
  if (sign < 0) word.remove_prefix(1);
  if (word.size() == 1 && word[0] >= 'x' && word[0] <= 'z') return sign * Vec3::Unit(word[0] - 'x');
  Vec3 out;
  const char* at = text.c_str();
  for (int i = 0; i < 3; ++i) {
    char* end = nullptr;
    out[i] = std::strtod(at, &end);
    if (end == at || !std::isfinite(out[i]) || *end != (i < 2 ? ',' : '\0')) throw wrong;
    at = end + 1;
  }
  if (out.norm() < 1e-12) throw Error(fmt::format("--direction {}: it has no length; give one such as 1,0,0", shown(text, 60)));
  return out.normalized();
}

void check_folder(const OutputOptions& output) {
  if (output.directory.empty() || !fs::exists(fs::symlink_status(output.directory))) return;
  if (fs::is_directory(output.directory) && fs::is_empty(output.directory)) return;
  if (!fs::is_regular_file(run_file(output.directory, "limit.json")))
    throw Error(fmt::format("\"{}\" exists and is no folder of erbs limit; choose another with -o DIR", output.directory));
  if (!output.force)
    throw Error(
        fmt::format("\"{}\" holds an earlier analysis; overwrite it with --force, or choose another folder with -o DIR", output.directory));
}

void print_row(const char* name, const Multiplier& m, const std::string& more) {
  say("{:<16} {:>10.5f}   {:.6f} .. {:.6f}{}{}\n", name, m.middle(), m.lower, m.upper, more, m.converged ? "" : "   not converged");
}

void print(const LimitResult& r, const LimitLoad& load, const Model& model, const std::optional<double>& smooth) {
  say("{}, {}, {}; {}; {:.2f} s\n", counted(r.problem.nbody, "block"), counted(model.njoint, "joint"),
      counted(r.problem.contacts.size(), "contact point"), r.method, r.seconds);
  const std::string mechanism = limit_mechanism(r, model).words;
  if (!r.stands) {
    say("does not stand under its constant loads: it carries {:.4g} of them\nmechanism        {}\n", r.standing_share, mechanism);
    return;
  }
  say("{:<16} {:>10}   {}\n", "", "lambda", "lower .. upper");
  print_row("associated", r.associated, fmt::format("   {} iterations", r.associated.iterations));
  if (r.has_nonassociated)
    print_row("non-associated", r.nonassociated, fmt::format("   {} rounds, {} iterations", r.rounds, r.nonassociated.iterations));
  if (smooth && *smooth < (1 - 1e-3) * r.last().middle())
    say("{:<16} {:>10.5f}   without friction of upright joints: a push on stiff beds bears what lies between\n", "smooth uprights",
        *smooth);
  if (load.pattern.empty())
    say("lambda is {} ({:.4g}, {:.4g}, {:.4g})\n", load.tilt ? "the tangent of the tilt towards" : "a share of g along",
        load.direction.x() + 0.0, load.direction.y() + 0.0, load.direction.z() + 0.0);
  else say("lambda multiplies the pattern of forces\n");
  if (const auto tilt = tilt_angle(r, load, model)) say("tilting angle    {:.3f} deg   atan(lambda): a tilted base or gravity\n", *tilt);
  say("mechanism        {}\n", mechanism);
}

// Why there is no multiplier, and what to do about it.
std::string unbounded_text(const LimitLoad& load, const LimitOptions& options, const std::optional<double>& smooth) {
  const std::string never =
      load.tilt ? "the tilt never makes a mechanism: the structure stands at any angle up to 90 degrees"
                : fmt::format("the load never makes a mechanism: the structure carries {:g} times it, and more", options.most);
  if (smooth)
    return fmt::format(
        "{}, held by friction of upright joints, which statics lets press each other as hard as it takes, though nothing need press them "
        "at rest; without it {}; a run with analysis{{ kind = \"{}\" }} finds what lies between",
        never, load.tilt ? fmt::format("to {:.3f} deg", std::atan(*smooth) * 180 / pi) : fmt::format("lambda = {:.5f}", *smooth),
        load.tilt ? "tilt" : "pushover");
  if (load.tilt) return never + "; tilt to another side with direction in analysis{}, or give joints a finite strength";
  return never + "; push in another direction with --direction, or give joints a finite strength";
}

void write_folder(const LimitResult& r, const LimitLoad& load, const Model& model, const std::optional<double>& smooth,
                  const std::string& name, const std::string& folder) {
  try {
    fs::create_directories(folder);
  } catch (const fs::filesystem_error& mistake) {
    throw Error(fmt::format("output folder \"{}\" cannot be made: {}; choose another with -o DIR", folder, mistake.code().message()));
  }
  Json json = limit_json(r, load, model);
  json["scene"] = name;
  json["smooth_uprights"] = smooth ? Json(*smooth) : Json();
  write_json(run_file(folder, "limit.json"), json);
  write_mechanism(r, model, run_file(folder, "mechanism.csv"));
  write_thrusts(r, model, run_file(folder, "thrust.csv"));
  for (const char* file : {"limit.svg", "limit.png"}) draw_limit(r, load, model, name, run_file(folder, file));
}

}  // namespace

int verb_limit(const LimitCommand& command) {
  if (command.facets % 2 != 0 || (command.facets != 0 && command.facets < 4))
    throw Error(fmt::format("--facets {}: a cone has an even number of facets from 4 on; try 8, 16 or 32", command.facets));
  check_folder(command.output);
  Script script(script_options(command.scene, command.output.quiet));
  const Scene scene = script.load(command.words.front(), command.scene.overrides);
  const Built built = build(scene);
  for (const auto& warning : built.warnings) tell(stderr, "warning: " + warning);
  LimitLoad load = limit_load(scene, built.model);
  if (!command.direction.empty()) load = {direction_of(command.direction), {}, false};
  LimitOptions options;
  options.no_tension = command.no_tension, options.associated_only = command.associated, options.facets = command.facets;
  const LimitResult result = limit_analysis(built.model, load, options);
  const std::optional<double> smooth = smooth_multiplier(built.model, load, options, result);
  if (result.unbounded) throw Error(scene.file + ": " + unbounded_text(load, options, smooth));
  if (!command.output.quiet) print(result, load, built.model, smooth);
  if (command.output.directory.empty()) return exit_ok;
  write_folder(result, load, built.model, smooth, scene.name, command.output.directory);
  if (!command.output.quiet) say("{0}/limit.json, mechanism.csv, thrust.csv, limit.svg, limit.png\n", command.output.directory);
  return exit_ok;
}

}  // namespace erbs::lua
