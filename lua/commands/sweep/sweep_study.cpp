#include "lua/commands/sweep/sweep_study.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "engine/base/hash.h"
#include "engine/base/spelling.h"
#include "engine/record/folder/manifest.h"
#include "engine/record/results/metrics.h"

namespace erbs::lua {
namespace {

namespace fs = std::filesystem;
using study::Axis;
using study::expression_of;
using study::Plan;
using study::Value;

// "shake" in m/s2: shake_m_s2, as in histories.csv.
std::string column(const std::string& name, const std::string& unit) {
  if (unit.empty() || unit == "-" || unit == "1") return name;
  std::string text = name + "_";
  for (const char c : unit) text += std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '%' ? c : '_';
  return text;
}

class Checker {
 public:
  Checker(Plan& plan, const Script& scene, const Overrides& fixed) : plan_(plan), scene_(scene), fixed_(fixed) {}

  void check() {
    params_ = scene_.param_names();
    for (const Axis& axis : plan_.axes) check_axis(axis);
    if (plan_.bisect) {
      check_param(plan_.bisect->param, plan_.bisect->place);
      if (scene_.takes_word(plan_.bisect->param))
        add(plan_.bisect->place, fmt::format("param \"{}\" of the scene takes a word; only a number can be bisected", plan_.bisect->param));
      check_key(plan_.bisect->key);
    }
    for (const std::string& key : plan_.collect) check_key(key);
    const std::vector<std::string> varied = varied_params(plan_);
    if (!plan_.split.empty() && std::find(varied.begin(), varied.end(), plan_.split) == varied.end())
      add(plan_.place, fmt::format("split = \"{}\" is no param that vary varies{}", plan_.split,
                                   varied.empty() ? "; leave it out" : did_you_mean(plan_.split, varied)));
    if (!mistakes_.empty()) throw Errors(mistakes_);
    order_grids(plan_, params_);
    point_count(plan_);
  }

 private:
  void add(const Place& place, const std::string& what) {
    const std::string message = Error(what, place).what();
    if (std::find(mistakes_.begin(), mistakes_.end(), message) == mistakes_.end()) mistakes_.push_back(message);
  }

  void check_param(const std::string& param, const Place& place) {
    if (std::find(params_.begin(), params_.end(), param) == params_.end())
      add(place, fmt::format("{} has no param \"{}\"{}", scene_.scene().file, param,
                             params_.empty() ? fmt::format("; write param(\"{}\", default) there", param) : did_you_mean(param, params_)));
    if (std::find(varied_.begin(), varied_.end(), param) != varied_.end())
      add(place, fmt::format("param \"{}\" is varied twice; name it once in vary and bisect", param));
    for (const auto& [name, expression] : fixed_)
      if (name == param)
        add(place, fmt::format("param \"{}\" is varied by the study, and -D {}={} sets it; leave one out", param, name, expression));
    varied_.push_back(param);
  }

  void check_axis(const Axis& axis) {
    for (std::size_t k = 0; k < axis.params.size(); ++k) {
      const std::string& param = axis.params[k];
      if (param == study::perturbation) {
        if (std::find(varied_.begin(), varied_.end(), param) != varied_.end())
          add(axis.place, "perturbations{} is given twice; give one, with the n and size that are wanted");
        varied_.push_back(param);
        continue;
      }
      check_param(param, axis.place);
      const bool word = scene_.takes_word(param);
      const auto wrong = std::find_if(axis.rows.begin(), axis.rows.end(),
                                      [&](const auto& row) { return std::holds_alternative<std::string>(row[k]) != word; });
      if (wrong != axis.rows.end())  // one of a million rows says enough
        add(axis.place,
            fmt::format("param \"{}\" of the scene takes {}, not {}", param, word ? "a word" : "a number", expression_of((*wrong)[k])));
    }
  }

  void check_key(const std::string& key) {
    std::vector<std::string> known = known_keys(scene_.scene());
    for (const auto& [name, unit] : scene_.scene().metric_units) known.push_back("metrics." + name);
    if (std::find(known.begin(), known.end(), key) != known.end()) return;
    if (std::find(known.begin(), known.end(), without_index(key)) != known.end()) return;
    add(plan_.place, fmt::format("metrics.json of the scene has no key \"{}\"{}", key, did_you_mean(key, known)));
  }

  Plan& plan_;
  const Script& scene_;
  const Overrides& fixed_;
  std::vector<std::string> params_, varied_, mistakes_;
};

// Values of the plan, for its key.
Json plan_json(const Plan& plan) {
  Json j{{"axes", Json::array()}, {"collect", plan.collect}};
  for (const Axis& axis : plan.axes)
    if (is_perturbation(axis)) j["noise"] = plan.noise;
  for (const Axis& axis : plan.axes) {
    std::uint64_t hash = fnv1a("");
    for (const auto& row : axis.rows)
      for (const Value& value : row) hash = fnv1a(expression_of(value) + "\n", hash);
    j["axes"].push_back({{"params", axis.params}, {"points", axis.rows.size()}, {"values", hash_text(hash)}});
  }
  if (plan.bisect) {
    const study::Bisection& b = *plan.bisect;
    j["bisect"] = {{"param", b.param}, {"lo", b.lo}, {"hi", b.hi}, {"rel", b.rel}, {"points", b.points}, {"key", b.key}};
    j["bisect"]["above"] = b.above ? Json(*b.above) : Json();
  }
  if (plan.calibration) j["calibration"] = plan.collect;
  return j;
}

// By their places beside the scene: two records may have one name in two folders, and the study may lie elsewhere tomorrow.
void add_inputs(Json& inputs, const Scene& scene, const std::string& path) {
  const fs::path folder = fs::absolute(path).lexically_normal().parent_path();
  for (const auto& [file, hash] : scene.inputs) inputs[fs::absolute(file).lexically_normal().lexically_proximate(folder).string()] = hash;
}

// Loads the scene once with each word of an axis, such as each record: all files must be there, and their contents belong to the key.
void check_words(const Plan& plan, const std::string& scene, const SceneOptions& options, const Overrides& fixed, Json& inputs) {
  for (const Axis& axis : plan.axes)
    for (std::size_t k = 0; k < axis.params.size(); ++k)
      for (const auto& row : axis.rows) {
        if (!std::holds_alternative<std::string>(row[k])) continue;
        Overrides overrides = fixed;
        overrides.emplace_back(axis.params[k], expression_of(row[k]));
        Script script(script_options(options, true));
        try {
          add_inputs(inputs, script.load(scene, overrides), scene);
        } catch (const std::exception& error) {
          throw Error(fmt::format("{} = {} does not do: {}", axis.params[k], expression_of(row[k]), error.what()), axis.place);
        }
      }
}

bool needs_studies(const Plan& plan, const Script& scene) {
  std::vector<std::string> names;
  for (const study::Study& one : scene.studies())
    for (const std::string& name : metric_names(one)) names.push_back("metrics." + name);
  std::vector<std::string> keys = plan.collect;
  if (plan.bisect) keys.push_back(plan.bisect->key);
  return std::any_of(keys.begin(), keys.end(), [&](const auto& key) { return std::find(names.begin(), names.end(), key) != names.end(); });
}

std::string unit_of(const Scene& scene, const std::string& param) {
  for (const Param& one : scene.params)
    if (one.name == param) return one.unit;
  return "";
}

std::string collected_column(const Scene& scene, const std::string& key) {
  for (const auto& [name, unit] : scene.metric_units)
    if (key == "metrics." + name) return column(name, unit);
  return key;
}

}  // namespace

SweepStudy read_sweep_study(const std::string& path, const SceneOptions& options, bool quiet, StudyKind kind) {
  if (!fs::is_regular_file(path)) throw Error(fmt::format("there is no study {}; check the path", path));
  Script::Options how = script_options(options, quiet);
  how.study_file = true;
  Script file(how);
  file.load(path, options.overrides);
  SweepStudy out;
  out.name = fs::path(path).stem().string();
  study::Sweep& sweep = out.sweep;
  sweep.plan = *file.plan();
  Plan& plan = sweep.plan;
  if (plan.calibration.has_value() != (kind == StudyKind::calibration))
    throw Error(plan.calibration ? "the file calibrates a scene; run it by erbs calibrate" : "the file is a sweep; run it by erbs sweep",
                plan.place);
  sweep.scene = (fs::path(path).parent_path() / plan.scene).lexically_normal().string();
  if (!fs::is_regular_file(sweep.scene))
    throw Error(fmt::format("there is no scene {}; scene is a path from the folder of the study", sweep.scene), plan.place);
  if (sweep.scene.starts_with("-")) sweep.scene = "./" + sweep.scene;
  const Overrides fixed = file.unused_overrides();
  Script scene(script_options(options, true));
  scene.load(sweep.scene, fixed);
  Checker(plan, scene, fixed).check();
  Json inputs = Json::object();
  add_inputs(inputs, scene.scene(), sweep.scene);
  check_words(plan, sweep.scene, options, fixed, inputs);
  for (const std::string& param : varied_params(plan)) sweep.params.push_back(column(param, unit_of(scene.scene(), param)));
  for (const std::string& key : plan.collect) sweep.collected.push_back(collected_column(scene.scene(), key));
  if (plan.bisect) sweep.bisected = column(plan.bisect->param, unit_of(scene.scene(), plan.bisect->param));
  sweep.arguments = permissions(options);
  if (options.allow_unstable) sweep.arguments.emplace_back("--allow-unstable");
  if (!needs_studies(plan, scene)) sweep.arguments.emplace_back("--no-studies");
  std::vector<std::string> given;
  for (const auto& [name, expression] : fixed) given.push_back(name + "=" + expression);
  for (const std::string& define : given) sweep.arguments.insert(sweep.arguments.end(), {"-D", define});
  out.identity = {{"scene", fs::path(sweep.scene).filename().string()},
                  {"inputs", inputs},
                  {"given", given},
                  {"study", plan_json(plan)},
                  {"program", program_version()}};
  sweep.key = hash_text(out.identity.dump());
  return out;
}

}  // namespace erbs::lua
