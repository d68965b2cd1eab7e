// Functions of a script: studies, that is many runs of the scene with one parameter changed, and the figures of their results.
// A run that a study has started evaluates only the question of that study.
#include <algorithm>
#include <cmath>
#include <lua5.4/lua.hpp>

#include "engine/base/spelling.h"
#include "engine/base/text.h"
#include "lua/language/api.h"

namespace erbs::lua {
namespace {

// The param of this name, or nullptr. It must be declared above the study, so that -D of the runs finds it.
const Param* param_of(const Context& context, const std::string& name) {
  for (const Param& param : context.scene.params)
    if (param.name == name) return &param;
  return nullptr;
}

// Registers the question of a study: a function of the scene that each of its runs evaluates like a metric.
void question(Call& call, Arguments& arguments, const char* key, const study::Study& study) {
  const int function = arguments.function(key);
  if (call.context.study == study.name && function != LUA_NOREF)
    call.context.metrics.push_back({"study", "", 0, function, call.place, study::question_words(study)});
}

int add(Call& call, Arguments& arguments, study::Study study, const char* key) {
  Context& context = call.context;
  const Param* param = param_of(context, study.param);
  if (!study.param.empty() && !param)
    arguments.mistake(fmt::format("there is no param \"{}\" yet; write param(\"{}\", ...) above", study.param, study.param));
  if (param && study.kind == study::Study::Kind::bisect) study.unit = param->unit;
  if (!is_name(study.name))
    arguments.mistake(fmt::format("name = \"{}\" becomes that of metrics and a folder: letters, digits, _, + and - only", study.name));
  for (const study::Study& other : context.studies)
    if (other.name == study.name)
      arguments.mistake(fmt::format("a study \"{}\" was given before, at {}; add name = ...", study.name, other.place.text()));
  study.place = call.place;
  question(call, arguments, key, study);
  for (const std::string& name : metric_names(study))
    context.scene.metric_units.emplace_back(name, name.ends_with("_runs") || name.ends_with("_failed") ? "" : study.unit);
  context.studies.push_back(std::move(study));
  return 0;
}

int bisect(Call& call) {
  Arguments arguments = call.arguments();
  study::Study study;
  arguments.read("param", study.param);
  study.name = "collapse_" + study.param;
  arguments.read("name", study.name);
  arguments.read("lo", study.lo);
  arguments.read("hi", study.hi);
  arguments.read("rel", study.rel);
  arguments.read("points", study.points);
  study.collapse = !arguments.has("collapsed_when");
  if (study.lo == study.hi) arguments.mistake("lo and hi are the same, and nothing lies between; give two values");
  return add(call, arguments, std::move(study), "collapsed_when");
}

int converge(Call& call) {
  Arguments arguments = call.arguments();
  study::Study study;
  study.kind = study::Study::Kind::converge;
  arguments.read("param", study.param);
  study.name = "converge_" + study.param;
  arguments.read("name", study.name);
  arguments.read("values", study.values);
  study.finest = arguments.has("value");
  if (study.finest == arguments.has("error"))
    arguments.mistake("give one of error = function(run) (against the known value) and value = function(run) (against the finest run)");
  std::vector<double> sorted = study.values;
  std::sort(sorted.begin(), sorted.end());
  if (sorted.size() < 2 || sorted.front() <= 0 || std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end())
    arguments.mistake("values must be two or more different numbers above zero");
  Expectation least;
  if (arguments.has("slope")) {
    arguments.read("slope", least.value);
    least.key = "metrics." + study.name + "_slope";
    least.kind = Expectation::Kind::above;
    least.source = "least order of convergence";
    least.place = call.place;
    call.context.scene.expectations.push_back(least);
  }
  const char* key = study.finest ? "value" : "error";
  return add(call, arguments, std::move(study), key);
}

int ensemble(Call& call) {
  Arguments arguments = call.arguments();
  study::Study study;
  study.kind = study::Study::Kind::ensemble;
  study.name = "ensemble";
  study.param = "seed";
  arguments.read("name", study.name);
  arguments.read("param", study.param);
  arguments.read("n", study.n);
  arguments.read("seed", study.seed);
  return add(call, arguments, std::move(study), "value");
}

// A param of the scene by which erbs accuracy varies the error; erbs run ignores it.
int accuracy(Call& call) {
  Context& context = call.context;
  Arguments arguments = call.arguments();
  study::Knob knob;
  knob.place = call.place;
  arguments.read("param", knob.param);
  knob.name = knob.param;
  arguments.read("name", knob.name);
  arguments.read("values", knob.values);
  arguments.read("error", knob.error);
  if (!knob.error.empty() && !knob.error.starts_with("metrics.")) knob.error = "metrics." + knob.error;
  std::vector<std::string> params;
  for (const Param& param : context.scene.params) params.push_back(param.name);
  if (!knob.param.empty() && !param_of(context, knob.param))
    arguments.mistake(fmt::format("there is no param \"{0}\" yet{1}; write param(\"{0}\", ...) above", shown(knob.param, 60),
                                  params.empty() ? "" : did_you_mean(knob.param, params)));
  if (const std::string mistake = arguments.is_table("values") ? study::mistake_in(knob.values) : ""; !mistake.empty())
    arguments.mistake(mistake);
  for (const char* taken : {"time step", "points", "lazy rotation", "sequential", study::quality_knob, study::together_knob})
    if (knob.name.starts_with(taken)) arguments.mistake(fmt::format("name = \"{}\" is a knob of every scene; give another one", taken));
  for (const study::Knob& other : context.knobs)
    if (other.param == knob.param || other.name == knob.name)
      arguments.mistake(fmt::format("\"{}\" was given before, at {}; put all values into one call",
                                    other.param == knob.param ? other.param : other.name, other.place.text()));
  context.knobs.push_back(std::move(knob));
  return 0;
}

const Keys& curve_keys() {
  static const Keys keys = {{"label", "string", "", "its label in the legend", -unbounded, unbounded, true},
                            {"study", "string", "", "name of a study above: its results over its param, as points"},
                            {"x", "numbers", "", "or numbers, with y or metrics"},
                            {"y", "numbers", "", "as many as x: a line"},
                            {"metrics", "strings", "", "as many as x: names of metrics, as points"}};
  return keys;
}

int figure(Call& call) {
  Context& context = call.context;
  Arguments arguments = call.arguments();
  Figure item;
  item.place = call.place;
  arguments.read("name", item.name);
  arguments.read("title", item.title);
  arguments.read("x", item.x);
  arguments.read("y", item.y);
  if (!is_name(item.name))
    arguments.mistake(fmt::format("name = \"{}\" becomes that of a file: letters, digits, _, + and - only", item.name));
  for (Arguments& table : arguments.tables("curves", curve_keys())) {
    FigureCurve curve;
    table.read("label", curve.label);
    table.read("study", curve.study);
    table.read("x", curve.x);
    table.read("y", curve.y);
    table.read("metrics", curve.metrics);
    const bool known =
        std::any_of(context.studies.begin(), context.studies.end(), [&](const study::Study& s) { return s.name == curve.study; });
    if (!curve.study.empty() && !known) table.mistake(fmt::format("there is no study \"{}\" yet; give it above", curve.study));
    if (curve.study.empty() == curve.x.empty() || curve.x.size() != curve.y.size() + curve.metrics.size())
      table.mistake("give study = ..., or x with as many y or metrics");
    item.curves.push_back(std::move(curve));
  }
  context.figures.push_back(std::move(item));
  return 0;
}

// The list of values under each param name of the table on top of the stack. `known`: names of the declared params.
std::vector<std::pair<std::string, std::vector<double>>> lists_of(Call& call, const std::vector<std::string>& known) {
  std::vector<std::pair<std::string, std::vector<double>>> lists;
  lua_pushnil(call.lua);
  for (; lua_next(call.lua, 1) != 0; lua_pop(call.lua, 1)) {
    if (lua_type(call.lua, -2) != LUA_TSTRING) {
      call.mistake("it takes the names of params, each with a list of values, such as { kn = { 1e9, 1e10 } }");
      continue;
    }
    const std::string name = shown(lua_tostring(call.lua, -2), 60);
    if (std::find(known.begin(), known.end(), name) == known.end()) {
      call.mistake(fmt::format("there is no param \"{}\" yet{}; write param(\"{}\", ...) above", name, did_you_mean(name, known), name));
      continue;
    }
    std::vector<double> values;
    bool valid = lua_istable(call.lua, -1) && lua_rawlen(call.lua, -1) > 0;
    for (lua_Integer i = 1; valid && i <= static_cast<lua_Integer>(lua_rawlen(call.lua, -1)); ++i) {
      valid = lua_rawgeti(call.lua, -1, i) == LUA_TNUMBER && std::isfinite(lua_tonumber(call.lua, -1));
      values.push_back(lua_tonumber(call.lua, -1));
      lua_pop(call.lua, 1);
    }
    if (!valid) call.mistake(fmt::format("{} must be a list of finite numbers, such as {{ 1, 3, 8 }}", name));
    for (std::size_t i = 1; valid && i < values.size(); ++i)
      if (std::find(values.begin(), values.begin() + std::ptrdiff_t(i), values[i]) != values.begin() + std::ptrdiff_t(i))
        call.mistake(fmt::format("{} has {:g} twice, which would be the same run; leave one out", name, values[i]));
    if (valid) lists.emplace_back(name, values);
  }
  return lists;
}

int family(Call& call) {
  static const Keys keys = {{"combinations", "integer", "", "", 0, 1000}, {"seed", "number", "", "", -1e15, 1e15}};
  ParamFamily& into = call.context.family;
  if (!lua_istable(call.lua, 1))
    throw Error(fmt::format("family takes a table of lists, such as family {{ kn = {{ 1e9, 1e10 }} }}, not {}", described(call.lua, 1)),
                call.place);
  if (into.place.line > 0) call.mistake(fmt::format("one was given before, at {}; put all params into it", into.place.text()));
  into.place = call.place;
  if (!lua_isnoneornil(call.lua, 2)) {
    if (!lua_istable(call.lua, 2))
      throw Error(fmt::format("family: how must be a table, such as {{ combinations = 4 }}, not {}", described(call.lua, 2)), call.place);
    Arguments how(call.context, call.lua, 2, "family", call.place, keys);
    how.read("combinations", into.combinations);
    how.read("seed", into.seed);
  }
  std::vector<std::string> known;
  for (const Param& param : call.context.scene.params) known.push_back(param.name);
  into.values = lists_of(call, known);
  // A table of Lua has no order: sort the params by their declaration.
  const auto place = [&](const auto& list) { return std::find(known.begin(), known.end(), list.first); };
  std::sort(into.values.begin(), into.values.end(), [&](const auto& a, const auto& b) { return place(a) < place(b); });
  return 0;
}

}  // namespace

std::vector<Function> study_functions() {
  const Key param{"param", "string", "", "name of the param that the runs change", -unbounded, unbounded, true};
  return {
      {"bisect",
       bisect,
       "{ ... }",
       "",
       "Finds the value of a param at which the scene collapses, by runs side by side; metrics NAME, NAME_lo, NAME_hi, NAME_runs, "
       "NAME_failed.",
       {param,
        {"lo", "number", "", "value at which the structure stands (it may be the larger one)", -1e300, 1e300, true},
        {"hi", "number", "", "value at which it collapses", -1e300, 1e300, true},
        {"collapsed_when", "question", "", "function(run) that returns true or false (default: collapse.collapsed of the run)"},
        {"rel", "number", "", "width of the last bracket over its larger end, or over a thousandth of hi - lo if that is more", 1e-12, 1,
         false, "", "0.01"},
        {"points", "integer", "",
         "runs between the ends in each round; where the verdict comes and goes, as with rocking, many find its first yes", 1, 1000, false,
         "", "3"},
        {"name", "string", "", "stem of its metrics (default collapse_PARAM)"}}},
      {"converge",
       converge,
       "{ ... }",
       "",
       "Runs the scene with a param at several values and fits the order of its error; metrics NAME_slope, NAME_error (at the smallest), "
       "NAME_least and NAME_most (results), NAME_runs, NAME_failed.",
       {param,
        {"values", "numbers", "", "values of the param, all above zero", -unbounded, unbounded, true},
        {"error", "question", "", "function(run) that returns the error against the known value"},
        {"value", "question", "", "function(run) that returns a number; its error is the difference from the run with the smallest value"},
        {"slope", "number", "", "least expected slope of ln error over ln value (default: no expectation)", 0, 100},
        {"name", "string", "", "stem of its metrics (default converge_PARAM)"}}},
      {"ensemble",
       ensemble,
       "{ ... }",
       "",
       "Runs the scene n times, each time with another seed in a param; metrics NAME_mean, NAME_deviation, NAME_least, NAME_most, "
       "NAME_median, NAME_error (standard error of the mean), NAME_runs, NAME_failed.",
       {{"n", "integer", "", "number of runs", 1, 100000, true},
        {"seed", "number", "", "seed from which the seeds of the runs are drawn; equal seeds give equal studies", -1e300, 1e300, true},
        {"value", "question", "", "function(run) that returns a number; the study reports its scatter", -unbounded, unbounded, true},
        {"param", "string", "", "name of the param that takes the seeds (whole numbers below 2^31)", -unbounded, unbounded, false, "",
         "seed"},
        {"name", "string", "", "stem of its metrics", -unbounded, unbounded, false, "", "ensemble"}}},
      {"family",
       family,
       "params, how",
       "",
       "Params that erbs test --grid varies: each value alone, and some combinations. erbs run ignores the family.",
       {{"params", "family", "", "lists of values by the names of params given above", -unbounded, unbounded, true},
        {"how", "family_how", "", "{ combinations = their number (default 4), seed = seed of their draw (default 1) }"}}},
      {"accuracy",
       accuracy,
       "{ ... }",
       "",
       "Declares a param whose values decide how large the error of the scene is, such as the stiffness of a bed. erbs accuracy varies it, "
       "with the other such params at their finest values, and all of them together; erbs run ignores it.",
       {{"param", "string", "", "name of a param given above", -unbounded, unbounded, true},
        {"values", "numbers", "", "its values from coarse to fine, above zero", -unbounded, unbounded, true},
        {"name", "string", "", "its name in tables and figures (default the param)"},
        {"error", "string", "", "metric that is itself the error of a run, such as NAME_error of ensemble (default: none)"}}},
      {"figure",
       figure,
       "{ ... }",
       "",
       "Draws results of studies beside known values: figures/NAME.svg of the run, also in the book of erbs test.",
       {{"name", "string", "", "name of the file", -unbounded, unbounded, true},
        {"title", "string", "", "title of the figure", -unbounded, unbounded, true},
        {"x", "string", "", "label of the horizontal axis: quantity and unit", -unbounded, unbounded, true},
        {"y", "string", "", "label of the vertical axis: quantity and unit", -unbounded, unbounded, true},
        {"curves", "list", "", "one table per curve", -unbounded, unbounded, true, "", "", curve_keys()}}},
  };
}

}  // namespace erbs::lua
