#include "lua/reports/accuracy/settings.h"

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <map>

#include "engine/base/spelling.h"
#include "engine/base/text.h"
#include "engine/scene/scene.h"
#include "lua/reading/quality.h"

namespace erbs::lua {
namespace {

bool has_setting(const std::string& key) {
  const auto fields = Analysis::fields();
  return std::any_of(fields.begin(), fields.end(), [&](const auto& field) { return field.name == key; });
}

void add_steps(std::vector<study::Setting>& all, double finest) {
  for (double f = finest; f < 1; f = f < 0.5 ? 2 * f : f + 0.4)
    all.push_back({"time step",
                   fmt::format("dt {:g} of the limit", f),
                   fmt::format("analysis {{ dt_fraction = {} }}", f),
                   {"--dt-fraction", fmt::format("{}", f)},
                   f});
}

void add_points(std::vector<study::Setting>& all, bool fine, bool all_rules) {
  for (const char* rule : {"simpson", "midpoint", "trapezoid", "gauss"})
    for (const int side : {13, 9, 7, 5, 3, 2, 1}) {
      const std::string_view name = rule;
      if ((side > 7 && !fine) || (name != "simpson" && !all_rules)) continue;
      if (side == 1 && name != "midpoint") continue;  // the other rules need at least two points
      if (side > 3 && name == "gauss") continue;      // exact in bending from two points on: more points gain nothing
      const int n = side * side;
      all.push_back({fmt::format("points, {}", rule),
                     fmt::format("{}, {}", counted(n, "point"), rule),
                     fmt::format("joint {{ rule = \"{}\", points = {} }}", rule, n),
                     {"--rule", rule, "--points", std::to_string(n)},
                     name == "trapezoid" ? 1.0 / (side - 1) : 1.0 / side});  // the error is a power of this size
    }
}

void add_lazy(std::vector<study::Setting>& all) {
  for (const double angle : {1e-6, 1e-4, 1e-3, 1e-2})
    all.push_back({"lazy rotation",
                   fmt::format("lazy_rotation {:g}", angle),
                   fmt::format("analysis {{ lazy_rotation = {:g} }}", angle),
                   {"--set", fmt::format("lazy_rotation={:g}", angle)},
                   angle});
}

// The solver of Gu and Miao and its repairs. They are here for comparison only; nobody should use them for results.
void add_sequential(std::vector<study::Setting>& all) {
  static const struct {
    const char *name, *variant, *order;
  } kinds[] = {{"literal", "literal", "random"}, {"centred", "centred", "random"}, {"coloured", "literal", "coloured"}};
  for (const auto& kind : kinds)
    for (const int n : {1, 2, 4, 8})
      all.push_back({fmt::format("sequential, {}", kind.name),
                     fmt::format("sequential {}, {} iterations", kind.name, n),
                     fmt::format("analysis {{ solver = \"sequential\", variant = \"{}\", order = \"{}\", iterations = {} }}", kind.variant,
                                 kind.order, n),
                     {"--allow-unstable", "--set", "solver=sequential", "--set", fmt::format("variant={}", kind.variant), "--set",
                      fmt::format("order={}", kind.order), "--set", fmt::format("iterations={}", n)},
                     1.0 / n,
                     false});
}

// The settings that each word of `quality` stands for. A setting that the scene fixes itself is left out.
void add_qualities(std::vector<study::Setting>& all, bool steps, bool points) {
  for (const Quality& q : qualities) {
    study::Setting s{study::quality_knob,
                     fmt::format("quality {}", q.name),
                     fmt::format("analysis {{ quality = \"{}\" }}", q.name),
                     {},
                     q.dt_fraction / (q.points * q.points)};
    if (steps) s.words.insert(s.words.end(), {"--dt-fraction", fmt::format("{}", q.dt_fraction)});
    if (points) s.words.insert(s.words.end(), {"--rule", "simpson", "--points", std::to_string(q.points * q.points)});
    all.push_back(std::move(s));
  }
}

std::string define(const std::string& param, double value) { return fmt::format("{}={}", param, value); }

// The setting of some values of the knobs, in their order.
study::Setting setting_of(const std::vector<study::Knob>& knobs, const std::vector<double>& values, const std::string& knob,
                          const std::string& name, double size) {
  study::Setting s{knob, name, "", {}, size};
  s.declared = true;
  for (std::size_t k = 0; k < knobs.size(); ++k) {
    s.line += (s.line.empty() ? "-D " : " -D ") + define(knobs[k].param, values[k]);
    s.words.insert(s.words.end(), {"-D", define(knobs[k].param, values[k])});
  }
  return s;
}

std::string name_of(const study::Knob& knob, double value) {
  const std::string brief = fmt::format("{:g}", value);  // 1e+12, not 1000000000000
  return fmt::format("{} {}", knob.name, std::strtod(brief.c_str(), nullptr) == value ? brief : fmt::format("{}", value));
}

// Each knob alone, the others at their finest values; then all of them from coarse to fine together, which is how one would use them.
void add_knobs(std::vector<study::Setting>& all, const std::vector<study::Knob>& knobs) {
  std::vector<double> finest;
  std::size_t most = 0;
  for (const study::Knob& knob : knobs) finest.push_back(knob.values.back()), most = std::max(most, knob.values.size());
  for (std::size_t k = 0; k < knobs.size(); ++k)
    for (const double value : knobs[k].values) {
      std::vector<double> values = finest;
      values[k] = value;
      study::Setting s = setting_of(knobs, values, knobs[k].name, name_of(knobs[k], value), knobs[k].size(value));
      for (std::size_t j = 0; j < knobs.size() && knobs.size() > 1; ++j) s.parts.push_back(name_of(knobs[j], values[j]));
      all.push_back(std::move(s));
    }
  for (std::size_t level = 0; knobs.size() > 1 && level < most; ++level) {
    std::vector<double> values;
    std::vector<std::string> parts;
    std::string name;
    for (const study::Knob& knob : knobs) {
      values.push_back(knob.values[level * (knob.values.size() - 1) / (most - 1)]);
      parts.push_back(name_of(knob, values.back()));
      name += (name.empty() ? "" : ", ") + parts.back();
    }
    study::Setting s = setting_of(knobs, values, study::together_knob, name, double(most - level));
    s.parts = parts;
    all.push_back(std::move(s));
  }
}

const Param* param_of(const Scene& scene, const std::string& name) {
  for (const Param& param : scene.params)
    if (param.name == name) return &param;
  return nullptr;
}

// --knob kn=1e10,1e11,1e12
study::Knob knob_of(const Scene& scene, const std::string& word) {
  const std::size_t equals = word.find('=');
  study::Knob knob{word.substr(0, equals), word.substr(0, equals), {}, "", {}};
  std::vector<std::string> params;
  for (const Param& param : scene.params) params.push_back(param.name);
  if (!param_of(scene, knob.param))
    throw Error(fmt::format("--knob {}: the scene has no param \"{}\"{}", shown(word, 60), shown(knob.param, 60),
                            params.empty() ? "; write param(\"name\", default) there" : did_you_mean(knob.param, params)));
  std::string rest = word.substr(equals + 1) + ",";
  for (std::size_t comma; (comma = rest.find(',')) != std::string::npos; rest.erase(0, comma + 1)) {
    const std::string text = rest.substr(0, comma);
    double value = 0;
    const auto [end, wrong] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (wrong != std::errc() || end != text.data() + text.size())
      throw Error(fmt::format("--knob {}: \"{}\" is no number; write numbers in SI units, such as --knob {}=1e10,1e11", shown(word, 60),
                              shown(text, 60), knob.param));
    knob.values.push_back(value);
  }
  if (const std::string mistake = study::mistake_in(knob.values); !mistake.empty())
    throw Error(fmt::format("--knob {}: {}", shown(word, 60), mistake));
  return knob;
}

// The knobs of the scene, those of the command line, and the size of blocks where a param has the name that stands for it.
std::vector<study::Knob> knobs_of(const Script& script, const AccuracyCommand& command) {
  std::vector<study::Knob> knobs = script.knobs();
  const auto declared = [&](const std::string& param) {
    return std::find_if(knobs.begin(), knobs.end(), [&](const study::Knob& knob) { return knob.param == param; });
  };
  if (param_of(script.scene(), "unit") && declared("unit") == knobs.end()) knobs.push_back({"unit", "block size", {2, 1, 0.5}, "", {}});
  for (const std::string& word : command.knobs) {
    if (word.find('=') == std::string::npos) continue;
    study::Knob given = knob_of(script.scene(), word);
    if (const auto old = declared(given.param); old == knobs.end()) knobs.push_back(given);
    else old->values = given.values;
  }
  return knobs;
}

// Leaves the settings of the knobs that --knob names, and the scene as it is.
void choose(AccuracyPlan& plan, const std::vector<std::string>& words) {
  if (words.empty()) return;
  std::vector<std::string> known, wanted;
  for (const study::Setting& s : plan.settings)
    if (!s.knob.empty() && std::find(known.begin(), known.end(), s.knob) == known.end()) known.push_back(s.knob);
  for (const std::string& word : words) {
    std::string name = word.substr(0, word.find('='));
    for (const study::Knob& knob : plan.knobs)
      if (knob.param == name) name = knob.name;
    if (std::find(known.begin(), known.end(), name) == known.end())
      throw Error(fmt::format("--knob {}: the scene has no such knob{}", shown(word, 60), did_you_mean(name, known)));
    wanted.push_back(name);
  }
  std::erase_if(plan.settings, [&](const study::Setting& s) {
    return !s.knob.empty() && std::find(wanted.begin(), wanted.end(), s.knob) == wanted.end();
  });
}

// Rough cost of a run relative to the scene as it is. Points cost time only in cracked joints; one sweep costs about six steps.
double dearness(const study::Setting& s) {
  if (s.knob.empty()) return 0;  // the unit of this measure
  if (s.declared) return 4 / s.size;
  if (s.knob == "time step") return 0.9 / s.size;
  if (s.knob == study::quality_knob) return 0.8 / s.size / 9;
  if (s.knob.starts_with("sequential")) return 6 / s.size;
  return s.knob.starts_with("points") ? 0.5 + 1 / (18 * s.size * s.size) : 1;
}

}  // namespace

AccuracyPlan plan_of(const Script& script, const AccuracyCommand& command) {
  const Scene& scene = script.scene();
  AccuracyPlan plan;
  plan.settings.push_back({"", "the scene as it is", "", {}, 0});
  const auto labelled = [&](const char* label) { return std::find(scene.labels.begin(), scene.labels.end(), label) != scene.labels.end(); };
  const bool steps = !labelled("fixed_dt"), brief = labelled("quality_only");
  if (!steps) plan.not_applicable.emplace_back("time step: the scene fixes it (label \"fixed_dt\")");
  else add_steps(plan.settings, labelled("coarse_study") ? 1.0 / 8 : labelled("fine_study") ? 1.0 / 512 : 1.0 / 32);
  const bool joints = std::any_of(scene.joint_rules.begin(), scene.joint_rules.end(), [](const JointRule& rule) { return !rule.none; });
  if (joints) {
    add_points(plan.settings, labelled("fine_points"), !brief);
    if (!brief) add_lazy(plan.settings);
  } else {
    plan.not_applicable.emplace_back("points, lazy rotation: the scene has no joints");
  }
  if (steps || joints) add_qualities(plan.settings, steps, joints);
  if (!brief && has_setting("solver") && joints && !command.whole_study) add_sequential(plan.settings);
  else if (!brief && !command.whole_study)
    plan.not_applicable.emplace_back(joints ? "solver: this program has one" : "solver: the scene has no joints");
  for (const study::Knob& knob : knobs_of(script, command)) {
    const auto fixed = std::find_if(command.scene.overrides.begin(), command.scene.overrides.end(),
                                    [&](const auto& given) { return given.first == knob.param; });
    if (fixed == command.scene.overrides.end()) plan.knobs.push_back(knob);
    else plan.not_applicable.push_back(fmt::format("{}: -D {}={} fixes it", knob.name, fixed->first, fixed->second));
  }
  add_knobs(plan.settings, plan.knobs);
  // The scene as it is may have values of its knobs whose errors cancel by chance, at any step and points.
  for (const study::Knob& knob : plan.knobs)
    for (const double value : knob.values)
      for (study::Setting& s : plan.settings)
        if (plan.knobs.size() > 1 && !s.declared && param_of(scene, knob.param)->value == value) s.parts.push_back(name_of(knob, value));
  if (plan.knobs.empty())
    plan.not_applicable.emplace_back("further knobs: the scene declares none; write accuracy{ param = ..., values = ... } or --knob");
  choose(plan, command.knobs);
  std::stable_sort(plan.settings.begin(), plan.settings.end(),
                   [](const study::Setting& a, const study::Setting& b) { return dearness(a) < dearness(b); });
  return plan;
}

}  // namespace erbs::lua
