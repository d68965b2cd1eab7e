// Overrides: options of the command line that replace values of the scene. Every run of a study gets the same ones.
#include "lua/program/overrides.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>

#include "engine/base/spelling.h"
#include "engine/base/text.h"
#include "engine/loads/earlier.h"
#include "lua/language/api.h"
#include "lua/reading/quality.h"

namespace erbs::lua {
namespace {

constexpr std::string_view quality_is = "quality=";

// A number, an expression such as 2*ms, true or false; not a number if it is none.
double number_of(const std::string& value, const std::string& setting, Script& script) {
  if (value == "true" || value == "false") return value == "true" ? 1 : 0;
  double number = 0;
  const char* const end = value.data() + value.size();
  if (const auto read = std::from_chars(value.data(), end, number); read.ec == std::errc() && read.ptr == end) return number;
  try {
    return script.number(value, "--set " + setting);
  } catch (const Error&) { return NAN; }
}

// Sets a number or a word of a field list; false if it has no such key.
template <class T>
bool set_field(T& values, const std::string& key, const std::string& value, const std::string& setting, Script& script) {
  for (const auto& field : T::fields()) {
    if (field.name != key) continue;
    field.member.visit([&](auto member) {
      using V = std::decay_t<decltype(values.*member)>;
      if constexpr (std::is_same_v<V, std::string>) {
        if (!field.words.empty() && ("|" + std::string(field.words) + "|").find("|" + value + "|") == std::string::npos)
          throw Error(fmt::format("--set {}: must be one of {}", shown(setting), field.words));
        values.*member = value;
      } else if constexpr (std::is_same_v<V, double> || std::is_same_v<V, int> || std::is_same_v<V, bool>) {
        const double number = number_of(value, setting, script);
        constexpr bool whole = !std::is_same_v<V, double>;
        const bool ranged = field.low < field.high && !std::is_same_v<V, bool>;
        const double low = ranged ? field.low : 0, high = ranged ? field.high : 1;
        if (!(number >= low && number <= high) || (whole && number != std::floor(number)))
          throw Error(std::is_same_v<V, bool> ? fmt::format("--set {}: must be true or false", shown(setting))
                                              : fmt::format("--set {}: must be a {}number from {:g} to {:g}", shown(setting),
                                                            whole ? "whole " : "", low, high));
        values.*member = static_cast<V>(number);
      } else {
        throw Error(fmt::format("--set {}: only numbers and words can be set", setting));
      }
    });
    return true;
  }
  return false;
}

// --set key=value of analysis{}.
void set_analysis(Scene& scene, const std::string& setting, Script& script) {
  const size_t equals = setting.find('=');
  const std::string key = setting.substr(0, equals), value = equals == std::string::npos ? "" : setting.substr(equals + 1);
  if (set_field(scene.analysis, key, value, setting, script)) return;
  if (set_field(scene.push, key, value, setting, script)) {
    if (!scene.push.quasi_static() && key != "kind")
      throw Error(fmt::format("--set {}: \"{}\" belongs to a push; the scene has none", setting, key), scene.analysis.place);
    return;
  }
  std::vector<std::string> known;
  for (const Key& one : find_function("analysis")->keys) known.push_back(one.name);
  if (std::ranges::find(known, key) != known.end())
    throw Error(fmt::format("--set {}: {} may be a table, and --set takes numbers and words alone; write it into analysis{{}} of the scene",
                            setting, key));
  throw Error(fmt::format("--set {}: analysis has no key \"{}\"{}", setting, key, did_you_mean(key, known)));
}

// Multiplies every stiffness of a joint rule, whatever its law.
void stiffen(JointRule& rule, double factor) {
  std::visit(
      [&](auto& law) {
        using L = std::decay_t<decltype(law)>;
        for (const auto& field : L::fields())
          if (field.name == "kn" || field.name == "ks" || field.name == "E" || field.name == "G")
            if (field.member.number != nullptr) law.*field.member.number *= factor;
      },
      rule.law);
}

// Of two values for one key the later would win without a word.
void check_settings(const SceneChanges& changes) {
  std::vector<std::string> keys;
  for (const auto& setting : changes.settings) {
    const std::string key = setting.substr(0, setting.find('='));
    if (std::find(keys.begin(), keys.end(), key) != keys.end())
      throw Error(fmt::format("--set {}: {} was set before; keep one", setting, key));
    if (changes.dt_fraction && (key == "dt_fraction" || key == "dt"))
      throw Error(fmt::format("--set {} and --dt-fraction both give the time step; keep one", setting));
    keys.push_back(key);
  }
}

}  // namespace

std::vector<std::string> apply_overrides(Scene& scene, const RunCommand& command, Script& script) {
  const SceneChanges& changes = command.changes;
  check_settings(changes);
  std::vector<std::string> notes;
  if (changes.dt_fraction) {
    scene.analysis.dt = 0;
    scene.analysis.dt_rule = "limit";
    scene.analysis.dt_fraction = *changes.dt_fraction;
    notes.push_back(fmt::format("--dt-fraction {:g}", *changes.dt_fraction));
  }
  for (const auto& setting : changes.settings) {
    if (!setting.starts_with(quality_is)) set_analysis(scene, setting, script);
    notes.push_back("--set " + setting);
  }
  if (!changes.rule.empty()) {
    for (JointRule& rule : scene.joint_rules) rule.rule = changes.rule;
    notes.push_back("--rule " + changes.rule);
  }
  if (changes.points > 0) {
    const int side = static_cast<int>(std::lround(std::sqrt(changes.points)));
    if (side * side != changes.points)
      throw Error(fmt::format("--points {}: not a square number; write 4, 9, 16 or 25 (2, 3, 4 or 5 along each side)", changes.points));
    for (JointRule& rule : scene.joint_rules) rule.points_long = rule.points_short = side;
    notes.push_back(fmt::format("--points {}", changes.points));
  }
  if (changes.stiffness) {
    for (JointRule& rule : scene.joint_rules) stiffen(rule, *changes.stiffness);
    notes.push_back(fmt::format("--stiffness {:g}", *changes.stiffness));
  }
  if (changes.damping) {
    scene.damping.mass = *changes.damping;
    notes.push_back(fmt::format("--damping {:g}", *changes.damping));
  }
  if (!changes.damping_form.empty()) {
    scene.damping.form = changes.damping_form;
    notes.push_back("--damping-form " + changes.damping_form);
  }
  if (changes.from) {
    if (scene.push.quasi_static()) throw Error("--from is a time, and a push has none; leave it out", scene.push.place);
    for (Load& load : scene.loads) load.wave = earlier(load.wave, *changes.from);
    notes.push_back(fmt::format("--from {:g}", *changes.from));
  }
  if (changes.push_to > 0) {
    if (scene.push.kind != "pushover")
      throw Error("--push-to is a displacement of a pushover; take analysis{ kind = \"pushover\" }, or leave it out", scene.push.place);
    scene.push.control = "displacement", scene.push.displacement = changes.push_to, scene.push.displacement_step = 0;
    scene.push.path.clear();
    scene.performance = {};  // of the whole curve
    notes.push_back(fmt::format("--push-to {:g}", changes.push_to));
  }
  if (command.scene.allow_unstable) scene.analysis.unstable = true;
  if (changes.noise > 0)
    notes.push_back(
        fmt::format("--noise {:g}{}", changes.noise, changes.noise_seed != 1 ? fmt::format(" --noise-seed {}", changes.noise_seed) : ""));
  return notes;
}

void read_defines(const std::vector<std::string>& defines, Overrides& overrides) {
  for (const auto& define : defines) {
    const size_t equals = define.find('=');
    if (equals == std::string::npos || equals == 0) throw Error("-D " + shown(define) + ": write -D name=value, such as -D pga=0.8*g");
    overrides.emplace_back(define.substr(0, equals), define.substr(equals + 1));
  }
}

std::string quality_of(const SceneChanges& changes) {
  std::string quality;
  for (const auto& setting : changes.settings) {
    if (!setting.starts_with(quality_is)) continue;
    quality = setting.substr(quality_is.size());
    if (std::none_of(std::begin(qualities), std::end(qualities), [&](const Quality& q) { return quality == q.name; }))
      throw Error(fmt::format("--set {}: must be draft, standard or reference", setting));
  }
  return quality;
}

std::vector<std::string> permissions(const SceneOptions& options) {
  std::vector<std::string> words;
  for (const auto& folder : options.allow) words.insert(words.end(), {"--allow", folder});
  if (options.max_blocks > 0) words.insert(words.end(), {"--max-blocks", std::to_string(options.max_blocks)});
  if (options.max_points > 0) words.insert(words.end(), {"--max-points", std::to_string(options.max_points)});
  return words;
}

std::vector<std::string> scene_arguments(const SceneOptions& options) {
  std::vector<std::string> words = permissions(options);
  for (const auto& [name, value] : options.overrides) words.insert(words.end(), {"-D", name + "=" + value});
  return words;
}

Script::Options script_options(const SceneOptions& options, bool quiet) {
  Script::Options out;
  out.quiet = quiet;
  out.allow = options.allow;
  if (options.max_blocks > 0) out.most_blocks = options.max_blocks;
  if (options.max_points > 0) out.most_points = options.max_points;
  return out;
}

std::vector<std::string> override_arguments(const RunCommand& command) {
  const SceneChanges& changes = command.changes;
  std::vector<std::string> words;
  if (changes.dt_fraction) words.insert(words.end(), {"--dt-fraction", fmt::format("{}", *changes.dt_fraction)});
  if (changes.points > 0) words.insert(words.end(), {"--points", std::to_string(changes.points)});
  if (!changes.rule.empty()) words.insert(words.end(), {"--rule", changes.rule});
  for (const auto& setting : changes.settings) words.insert(words.end(), {"--set", setting});
  for (const auto& effect : changes.without) words.insert(words.end(), {"--without", effect});
  if (changes.stiffness) words.insert(words.end(), {"--stiffness", fmt::format("{}", *changes.stiffness)});
  if (changes.damping) words.insert(words.end(), {"--damping", fmt::format("{}", *changes.damping)});
  if (!changes.damping_form.empty()) words.insert(words.end(), {"--damping-form", changes.damping_form});
  if (changes.from) words.insert(words.end(), {"--from", fmt::format("{}", *changes.from)});
  if (changes.noise > 0) words.insert(words.end(), {"--noise", fmt::format("{}", changes.noise)});
  if (changes.noise > 0 && changes.noise_seed != 1) words.insert(words.end(), {"--noise-seed", std::to_string(changes.noise_seed)});
  if (changes.push_to > 0) words.insert(words.end(), {"--push-to", fmt::format("{}", changes.push_to)});
  if (command.scene.allow_unstable) words.emplace_back("--allow-unstable");
  return words;
}

}  // namespace erbs::lua
