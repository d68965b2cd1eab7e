// Functions of a study file, which erbs sweep runs: study{}, and the words for what it varies.
#include <algorithm>
#include <cmath>
#include <lua5.4/lua.hpp>
#include <set>

#include "engine/base/spelling.h"
#include "engine/base/text.h"
#include "lua/language/api.h"
#include "lua/language/sweep/fragility.h"
#include "lua/language/sweep/ranges.h"
#include "lua/language/sweep/with_unit.h"

namespace erbs::lua {
namespace {

using study::Axis;
using study::Value;

constexpr const char* axis_type = "axis";  // a handle of what grid{} ... records{} return: the number of its group of axes

int push_axes(Call& call, std::vector<Axis> axes) {
  Context& context = call.context;
  ++context.axis_groups;
  for (Axis& axis : axes) {
    axis.group = context.axis_groups;
    axis.place = call.place;
    context.axes.push_back(std::move(axis));
  }
  *static_cast<int*>(lua_newuserdatauv(call.lua, sizeof(int), 0)) = context.axis_groups;
  if (luaL_newmetatable(call.lua, axis_type) != 0) {
    lua_pushliteral(call.lua, "locked");
    lua_setfield(call.lua, -2, "__metatable");
  }
  lua_setmetatable(call.lua, -2);
  return 1;
}

// The table argument; its keys are names of params, which the scene will tell.
void need_table(const Call& call, const char* example) {
  if (!lua_istable(call.lua, 1))
    throw Error(fmt::format("{} takes a table, not {}; write {}", call.function.name, described(call.lua, 1), example), call.place);
}

// The number or word on top of the stack; none, and a mistake, if it is neither.
std::optional<Value> value_at_top(Call& call, const std::string& name) {
  if (lua_type(call.lua, -1) == LUA_TNUMBER && std::isfinite(lua_tonumber(call.lua, -1))) return lua_tonumber(call.lua, -1);
  if (lua_type(call.lua, -1) == LUA_TSTRING && is_plain(lua_tostring(call.lua, -1))) return std::string(lua_tostring(call.lua, -1));
  call.mistake(
      fmt::format("{}: its values must be finite numbers, or words such as names of files, not {}", name, described(call.lua, -1)));
  return std::nullopt;
}

// The same point twice is the same run twice, and would count twice in a fit.
void refuse_repeated(Call& call, const Axis& axis) {
  std::set<std::vector<Value>> seen;
  for (const std::vector<Value>& row : axis.rows) {
    if (seen.insert(row).second) continue;
    std::vector<std::string> words;
    for (std::size_t k = 0; k < row.size(); ++k) words.push_back(axis.params[k] + " = " + study::expression_of(row[k]));
    return call.mistake(fmt::format("{} is there twice; give it once", fmt::join(words, ", ")));
  }
}

int grid(Call& call) {
  need_table(call, "grid{ amplitude = { 1, 2, 3 } }");
  std::vector<Axis> axes;
  for (const std::string& name : names_of(call, 1)) {
    Axis axis;
    axis.params = {name};
    axis.by_scene = true;
    lua_getfield(call.lua, 1, name.c_str());
    if (lua_istable(call.lua, -1)) {
      for (lua_Integer i = 1; i <= lua_Integer(lua_rawlen(call.lua, -1)); ++i) {
        lua_rawgeti(call.lua, -1, i);
        if (auto value = value_at_top(call, name)) axis.rows.push_back({std::move(*value)});
        lua_pop(call.lua, 1);
      }
      if (lua_rawlen(call.lua, -1) == 0)
        call.mistake(fmt::format("{} has no values; write {} = {{ 1, 2, 3 }}, or leave it out", name, name));
    } else if (auto value = value_at_top(call, name)) {
      axis.rows.push_back({std::move(*value)});
    }
    lua_pop(call.lua, 1);
    refuse_repeated(call, axis);
    axes.push_back(std::move(axis));
  }
  if (axes.empty()) call.mistake("it is empty; give the values of a param, such as grid{ amplitude = { 1, 2, 3 } }");
  return push_axes(call, std::move(axes));
}

int list(Call& call) {
  need_table(call, "list{ { ft = 1e5, mu = .5 }, { ft = 2e5, mu = .6 } }");
  Axis axis;
  const auto items = lua_Integer(lua_rawlen(call.lua, 1));
  for (lua_pushnil(call.lua); lua_next(call.lua, 1) != 0; lua_pop(call.lua, 1))
    if (lua_isinteger(call.lua, -2) == 0 || lua_tointeger(call.lua, -2) < 1 || lua_tointeger(call.lua, -2) > items)
      call.mistake("it takes tables one after the other, without keys; write list{ { ft = 1e5 }, { ft = 2e5 } }");
  for (lua_Integer i = 1; i <= items; ++i) {
    if (lua_rawgeti(call.lua, 1, i) != LUA_TTABLE)
      throw Error(fmt::format("list: its item {} must be a table of values by the names of params, not {}", i, described(call.lua, -1)),
                  call.place);
    const std::vector<std::string> names = names_of(call, -1);
    if (i == 1) axis.params = names;
    if (names != axis.params)
      throw Error(fmt::format("list: its item {} gives {}, the first gives {}; give the same params in each", i, fmt::join(names, ", "),
                              fmt::join(axis.params, ", ")),
                  call.place);
    std::vector<Value> row;
    for (const std::string& name : names) {
      lua_getfield(call.lua, -1, name.c_str());
      row.push_back(value_at_top(call, name).value_or(0.0));
      lua_pop(call.lua, 1);
    }
    axis.rows.push_back(std::move(row));
    lua_pop(call.lua, 1);
  }
  if (axis.rows.empty() || axis.params.empty())
    call.mistake("it is empty; give tables of values by the names of params, such as list{ { ft = 1e5, mu = .5 } }");
  refuse_repeated(call, axis);
  return push_axes(call, {std::move(axis)});
}

// latin{ n =, seed =, PARAM = { lo, hi } }
std::vector<study::Range> ranges_of(Call& call, int& n, double& seed) {
  need_table(call, fmt::format("{}{{ n = 100, seed = 1, ft = {{ 1e5, 3e5 }} }}", call.function.name).c_str());
  const auto number = [&](const char* key, double low, double high, double fallback) {
    lua_getfield(call.lua, 1, key);
    const double value = lua_type(call.lua, -1) == LUA_TNUMBER ? lua_tonumber(call.lua, -1) : std::nan("");
    const bool absent = lua_isnil(call.lua, -1) && std::isfinite(fallback);
    lua_pop(call.lua, 1);
    if (absent) return fallback;
    const bool valid = value >= low && value <= high && (std::isfinite(fallback) || value == std::floor(value));
    if (!valid)
      call.mistake(fmt::format("{} must be a {}number from {:g} to {:g}", key, std::isfinite(fallback) ? "" : "whole ", low, high));
    return valid ? value : low;
  };
  n = int(number("n", 1, 1e6, std::nan("")));
  seed = number("seed", -1e15, 1e15, 1);
  std::vector<study::Range> ranges;
  bool any = false;  // also of those that are wrong, which are told
  for (const std::string& name : names_of(call, 1)) {
    if (name == "n" || name == "seed") continue;
    any = true;
    if (auto one = range_of(call, 1, name)) ranges.push_back(*one);
  }
  if (!any) call.mistake(fmt::format("it varies nothing; give ranges, such as {}{{ n = 100, ft = {{ 1e5, 3e5 }} }}", call.function.name));
  return ranges;
}

int latin(Call& call) {
  int n = 0;
  double seed = 1;
  const auto ranges = ranges_of(call, n, seed);
  return push_axes(call, {study::latin_hypercube(ranges, n, seed)});
}

int random(Call& call) {
  int n = 0;
  double seed = 1;
  const auto ranges = ranges_of(call, n, seed);
  return push_axes(call, {study::random_points(ranges, n, seed)});
}

int records(Call& call) {
  Arguments arguments = call.arguments();
  Axis files, scales;
  std::vector<std::string> names;
  std::vector<double> peaks;
  files.params.resize(1);
  scales.params.resize(1);
  arguments.read("param", files.params[0]);
  arguments.read("files", names);
  arguments.read("scale", scales.params[0]);
  arguments.read("scales", peaks);
  if (names.empty()) arguments.mistake("files is empty; name the records, as the scene would");
  if (arguments.has("scale") != arguments.has("scales") || (arguments.has("scales") && peaks.empty()))
    arguments.mistake(
        "give scale, the param of the peak acceleration, together with scales, its values; or neither, and bisect that param");
  for (const std::string& name : names) files.rows.push_back({name});
  for (const double peak : peaks) scales.rows.push_back({peak});
  refuse_repeated(call, files);
  refuse_repeated(call, scales);
  std::vector<Axis> axes{std::move(files)};
  if (!peaks.empty()) axes.push_back(std::move(scales));
  return push_axes(call, std::move(axes));
}

struct Perturbations {
  int n = 0;
  double size = 1e-9;  // m and rad

  static Fields<Perturbations> fields() {
    return {{"n", &Perturbations::n, "", "number of runs, each with its own seed", 1, 1000000, true},
            {"size", &Perturbations::size, "m and rad", "largest shift and turn of each free block at the start", 0, 1}};
  }
};

int perturbations(Call& call) {
  Arguments arguments = call.arguments();
  Perturbations wanted;
  arguments.read(wanted);
  Axis axis;
  axis.params = {study::perturbation};
  axis.noise = wanted.size;
  for (int i = 1; i <= std::max(1, wanted.n); ++i) axis.rows.push_back({double(i)});
  return push_axes(call, {std::move(axis)});
}

const Keys& bisect_keys() {
  static const Keys keys = {
      {"param", "string", "", "name of the param", -unbounded, unbounded, true},
      {"lo", "number", "", "value at which the verdict is no (it may be the larger one)", -1e300, 1e300, true},
      {"hi", "number", "", "value at which it is yes", -1e300, 1e300, true},
      {"rel", "number", "", "width of the last bracket over its larger end, or over a thousandth of hi - lo if that is more", 1e-12, 1,
       false, "", "0.01"},
      {"points", "integer", "",
       "runs between the ends in each round; where the verdict comes and goes, as with rocking, many find its first yes", 1, 1000, false,
       "", "1"},
      {"key", "string", "", "the verdict: a dotted key of metrics.json, yes where it is true or not 0", -unbounded, unbounded, false, "",
       "collapse.collapsed"},
      {"above", "number", "", "the verdict is yes where the key is above this number, instead", -1e300, 1e300}};
  return keys;
}

const Keys& plan_curve_keys() {
  static const Keys keys = {{"label", "string", "", "its label in the legend", -unbounded, unbounded, true},
                            {"x", "numbers", "", "along the param of the horizontal axis", -unbounded, unbounded, true},
                            {"y", "numbers", "", "as many as x", -unbounded, unbounded, true}};
  return keys;
}

void read_axes(Call& call, Arguments& arguments, study::Plan& plan) {
  Context& context = call.context;
  lua_getfield(call.lua, 1, "vary");
  const bool one = luaL_testudata(call.lua, -1, axis_type) != nullptr;
  const auto n = lua_istable(call.lua, -1) ? lua_Integer(lua_rawlen(call.lua, -1)) : 0;
  if (!one && !lua_isnil(call.lua, -1) && n == 0)
    arguments.mistake(fmt::format("vary must be a list of grid{{}}, list{{}}, latin{{}}, random{{}} and records{{}}, not {}",
                                  lua_istable(call.lua, -1) ? "an empty table or one of keys" : described(call.lua, -1)));
  for (lua_Integer i = 1; i <= (one ? 1 : n); ++i) {
    if (one) lua_pushvalue(call.lua, -1);
    else lua_rawgeti(call.lua, -1, i);
    if (const auto* group = static_cast<int*>(luaL_testudata(call.lua, -1, axis_type))) {
      for (const Axis& axis : context.axes)
        if (axis.group == *group) {
          plan.axes.push_back(axis);
          if (is_perturbation(axis)) plan.noise = axis.noise;
        }
    } else {
      arguments.mistake(fmt::format("vary: its item {} must be grid{{}}, list{{}}, latin{{}}, random{{}} or records{{}}, not {}", i,
                                    described(call.lua, -1)));
    }
    lua_pop(call.lua, 1);
  }
  lua_pop(call.lua, 1);
}

int study(Call& call) {
  Context& context = call.context;
  Arguments arguments = call.arguments();
  if (context.plan) arguments.mistake(fmt::format("one was given before, at {}; write one study a file", context.plan->place.text()));
  study::Plan plan;
  plan.place = call.place;
  arguments.read("scene", plan.scene);
  arguments.read("title", plan.title);
  arguments.read("x", plan.x);
  arguments.read("y", plan.y);
  arguments.read("split", plan.split);
  arguments.read("collect", plan.collect);
  for (std::size_t i = 0; i < plan.collect.size(); ++i)
    if (std::count(plan.collect.begin(), plan.collect.begin() + static_cast<std::ptrdiff_t>(i), plan.collect[i]) == 1)
      arguments.mistake(fmt::format("collect names \"{}\" twice; name it once", plan.collect[i]));
  arguments.read("keep", plan.keep);
  plan.max_wall = quantity(arguments, call, "max_wall", {{"s", 1}, {"h", 3600}, {"m", 60}});
  if (!arguments.has("max_wall")) plan.max_wall = 3600;
  plan.memory = quantity(arguments, call, "memory", {{"MB", 1e6}, {"GB", 1e9}});
  read_axes(call, arguments, plan);
  for (Arguments& table : arguments.tables("curves", plan_curve_keys())) {
    study::PlanCurve curve;
    table.read("label", curve.label);
    table.read("x", curve.x);
    table.read("y", curve.y);
    if (curve.x.empty()) table.mistake("x has no values; give numbers, and as many y");
    if (curve.x.size() != curve.y.size()) table.mistake("give as many y as x");
    plan.curves.push_back(std::move(curve));
  }
  if (auto table = arguments.table("bisect", bisect_keys())) {
    study::Bisection bisect;
    bisect.place = call.place;
    table->read("param", bisect.param);
    table->read("lo", bisect.lo);
    table->read("hi", bisect.hi);
    table->read("rel", bisect.rel);
    table->read("points", bisect.points);
    table->read("key", bisect.key);
    if (table->has("above")) {
      double above = 0;
      table->read("above", above);
      bisect.above = above;
    }
    if (bisect.lo == bisect.hi) table->mistake("lo and hi are the same, and nothing lies between; give two values");
    plan.bisect = std::move(bisect);
  }
  if (auto table = arguments.table("fragility", fragility_keys())) read_fragility(*table, plan);
  if (plan.axes.empty() && !plan.bisect) arguments.mistake("it varies nothing; give vary = { grid{ ... } }, or bisect = { ... }");
  if (plan.collect.empty() && !plan.bisect)
    arguments.mistake("it collects nothing; give collect = { \"collapse.collapsed\" }, or other keys of metrics.json");
  if (!context.study_file)
    arguments.mistake("it belongs into a file of its own, which erbs sweep runs; use bisect, converge and ensemble in a scene");
  context.plan = std::move(plan);
  return 0;
}

Function of_study(Function function) {
  function.of_study = true;
  return function;
}

const Key n{"n", "integer", "", "number of points", 1, 1000000, true};
const Key seed{"seed", "number", "", "seed of the draw; equal seeds give equal points", -1e15, 1e15, false, "", "1"};
const Key range{"PARAM", "range", "", "range of each param: { lowest, highest }, uniform in its logarithm with log = true"};

}  // namespace

std::vector<Function> sweep_functions() {
  return {
      {"study",
       study,
       "{ ... }",
       "",
       "Many runs of a scene, by erbs sweep: what varies, what is bisected, and the columns of results.csv.",
       {{"scene", "string", "", "the scene, a path from the folder of the study", -unbounded, unbounded, true},
        {"vary", "axes", "",
         "{ grid{}, list{}, latin{}, random{}, records{}, perturbations{} }: every combination, the last changing fastest"},
        {"bisect", "table", "", "threshold of a param at each of these points", -unbounded, unbounded, false, "", "", bisect_keys()},
        {"collect", "strings", "", "keys of metrics.json for the columns; of a bisection, from its run at the upper end"},
        {"max_wall", "duration", "", "longest time of a run: seconds, or \"5m\"; beyond it the run is ended", -unbounded, unbounded, false,
         "", "1h"},
        {"memory", "bytes", "", "most memory of a run: bytes, or \"2GB\" (default: that of the machine over the runs at once)"},
        {"keep", "string", "", "what stays of each run in runs/", -unbounded, unbounded, false, "none|metrics|all", "metrics"},
        {"title", "string", "",
         "title of results.svg, the figure of the bisected param or the first of collect, and of the page of erbs report"},
        {"x", "string", "", "label of its horizontal axis: quantity and unit (default the column)"},
        {"y", "string", "", "label of its vertical axis (default the column)"},
        {"split", "string", "", "a varied param; each of its values has a figure of its own, such as results_method_1.svg"},
        {"curves", "list", "", "known curves for the figure", -unbounded, unbounded, false, "", "", plan_curve_keys()},
        {"fragility", "table", "", "lognormal fragility and fractiles of damage from these runs: fragility.csv and others, with figures",
         -unbounded, unbounded, false, "", "", fragility_keys()}}},
      of_study({"grid",
                grid,
                "{ ... }",
                "axes: for vary of study",
                "In a study: every combination of the values; params change in the order in which the scene declares them.",
                {{"PARAM", "values", "", "values of each param: numbers, or words"}}}),
      of_study({"list",
                list,
                "{ ... }",
                "axes: for vary of study",
                "In a study: points one by one.",
                {{"1", "list", "", "tables of values by the names of the params, all of the same params", -unbounded, unbounded, true}}}),
      of_study({"latin",
                latin,
                "{ ... }",
                "axes: for vary of study",
                "In a study: a Latin hypercube: each of n equal parts of each range holds one of the n points.",
                {n, seed, range}}),
      of_study({"random",
                random,
                "{ ... }",
                "axes: for vary of study",
                "In a study: random points, independent of each other.",
                {n, seed, range}}),
      of_study(
          {"perturbations", perturbations, "{ ... }", "axes: for vary of study",
           "In a study: the same run n times, each free block displaced and turned a little at random at the start (erbs run --noise).",
           keys_of<Perturbations>()}),
      of_study({"records",
                records,
                "{ ... }",
                "axes: for vary of study",
                "In a study: ground motions by peak accelerations: incremental dynamic analysis.",
                {{"param", "string", "", "name of the param that takes the file, such as param(\"motion\", \"a.AT2\")", -unbounded,
                  unbounded, true},
                 {"files", "strings", "", "the records, named as in the scene", -unbounded, unbounded, true},
                 {"scale", "string", "", "name of the param that takes the peak acceleration"},
                 {"scales", "numbers", "", "peak accelerations (m/s2)"}}}),
  };
}

}  // namespace erbs::lua
