#include "lua/language/sweep/fragility.h"

#include <algorithm>

#include "engine/base/spelling.h"

namespace erbs::lua {
namespace {

struct FragilityKeys {
  std::string im, collapse = "verdict", along;
  double above = 0;
  bool falls = false;

  static Fields<FragilityKeys> fields() {
    return {{"im", &FragilityKeys::im, "",
             "intensity: a param of vary or bisect, such as the peak acceleration, or a key of metrics.json, such as metrics.sa_t1",
             -unbounded, unbounded, true},
            {"collapse", &FragilityKeys::collapse, "", "what tells a collapse: the verdict of bisect, or a key of metrics.json, 1 or 0"},
            {"above", &FragilityKeys::above, "", "collapse is where that key lies above this number, instead"},
            {"along", &FragilityKeys::along, "",
             "the param that grows within a case, where im is a key of metrics.json (default: im; without it each run is a case)"},
            {"falls", &FragilityKeys::falls, "", "whether time and direction of the collapses are wanted: falls.csv, falls.svg"}};
  }
};

}  // namespace

const Keys& fragility_keys() {
  static const Keys keys =
      joined({keys_of<FragilityKeys>(),
              {{"damage", "strings", "", "keys of metrics.json whose 16, 50 and 84 % fractiles over im are wanted"},
               {"by", "strings", "", "params that tell structures apart: one fragility for each; all other params make cases"}}});
  return keys;
}

void read_fragility(Arguments& table, study::Plan& plan) {
  FragilityKeys keys;
  table.read(keys);
  study::FragilityPlan out;
  out.im = keys.im, out.collapse = keys.collapse, out.along = keys.along, out.falls = keys.falls, out.place = table.place();
  if (table.has("above")) out.above = keys.above;
  table.read("damage", out.damage);
  table.read("by", out.by);
  const std::vector<std::string> varied = varied_params(plan);
  const auto is_varied = [&](const std::string& name) { return std::find(varied.begin(), varied.end(), name) != varied.end(); };
  const auto need_param = [&](const std::string& key, const std::string& name) {
    if (!is_varied(name)) table.mistake(fmt::format("{} = \"{}\" is no param of vary{}", key, name, did_you_mean(name, varied)));
  };
  const bool bisected = plan.bisect && plan.bisect->param == out.im;
  if (!bisected && !is_varied(out.im) && !out.im.empty() && out.im.find('.') == std::string::npos)
    table.mistake(fmt::format("im = \"{}\" is no param of vary or bisect, and no dotted key of metrics.json{}", out.im,
                              did_you_mean(out.im, varied)));
  for (const study::Axis& axis : plan.axes)
    for (std::size_t k = 0; k < axis.params.size(); ++k)
      if (axis.params[k] == out.im && !axis.rows.empty() && std::holds_alternative<std::string>(axis.rows.front()[k]))
        table.mistake(
            fmt::format("im = \"{}\" takes words, such as \"{}\", and an intensity is a number; name another param, or a key of "
                        "metrics.json such as \"metrics.sa_t1\"",
                        out.im, std::get<std::string>(axis.rows.front()[k])));
  if (!out.along.empty()) need_param("along", out.along);
  if (!out.along.empty() && out.along != out.im && (bisected || is_varied(out.im)))
    table.mistake(fmt::format("along = \"{}\", and the intensity im = \"{}\" is itself a param; leave along out", out.along, out.im));
  for (const std::string& name : out.by) {
    need_param("by", name);
    if (name == out.im || (!out.along.empty() && name == out.along))
      table.mistake(fmt::format("by = \"{}\" is what grows within a case; name another param, or leave by out", name));
  }
  if (out.along.empty() && is_varied(out.im)) out.along = out.im;
  if (plan.bisect && !bisected && !out.im.empty())
    table.mistake(
        fmt::format("im = \"{}\" is not the bisected param \"{}\"; write that one, or leave bisect out", out.im, plan.bisect->param));
  if (!plan.bisect && out.collapse == "verdict")
    table.mistake("collapse = \"verdict\" is that of a bisection; write a key of metrics.json, such as \"collapse.collapsed\", or bisect");
  const auto collect = [&](const std::string& key) {
    if (std::find(plan.collect.begin(), plan.collect.end(), key) == plan.collect.end()) plan.collect.push_back(key);
  };
  if (!bisected && !is_varied(out.im)) collect(out.im);
  if (out.collapse != "verdict") collect(out.collapse);
  for (const std::string& key : out.damage) collect(key);
  if ((out.collapse == "verdict" && plan.bisect ? plan.bisect->key : out.collapse) == study::collapsed_key) collect(study::moving_key);
  if (out.falls)
    for (const char* key : study::fall_keys) collect(key);
  plan.fragility = std::move(out);
}

}  // namespace erbs::lua
