// Functions of a script: params, metrics, expectations, labels, limits of use, and included files.
#include <algorithm>
#include <cmath>
#include <lua5.4/lua.hpp>

#include "engine/base/text.h"
#include "lua/language/api.h"

namespace erbs::lua {

const Keys& tolerance_keys() {
  static const Keys keys = {
      {"rel", "number", "", "largest relative error", 0, 1e9}, {"abs", "number", "", "largest absolute error", 0, unbounded},
      {"below", "boolean", "", "the value is an upper bound"}, {"above", "boolean", "", "the value is a lower bound"},
      {"between", "numbers", "", "{ lowest, highest }"},       {"source", "string", "", "where the number is from"}};
  return keys;
}
namespace {

// "share of the peak, assumed [g]" -> text "share of the peak, assumed", unit "g"
void split_unit(const std::string& text, Param& param) {
  const size_t open = text.rfind('[');
  if (open == std::string::npos || !text.ends_with("]")) {
    param.text = text;
    return;
  }
  param.unit = text.substr(open + 1, text.size() - open - 2);
  param.text = text.substr(0, open);
  while (param.text.ends_with(' ')) param.text.pop_back();
}

// param("motion", "a.AT2"): a word, such as the name of a record.
int word_param(Call& call) {
  WordParam item{call.text(1, "name"), call.text(2, "default"), call.place};
  if (!is_name(item.name)) call.mistake(fmt::format("name = \"{}\" becomes a word of -D: letters, digits, _, + and - only", item.name));
  const std::string text = lua_isnoneornil(call.lua, 3) ? "" : "  -- " + call.text(3, "text");
  for (Override& given : call.context.overrides) {
    if (given.name != item.name) continue;
    given.used = true;
    if (given.is_word) item.value = given.word;
    else if (!given.trouble.empty()) item.value = given.expression;  // a word without quotes
    else if (given.valid) call.mistake(fmt::format("\"{0}\" takes a word, not a number; write -D '{0}=\"{1}\"'", item.name, item.value));
  }
  if (call.context.study.empty()) call.context.scene.notes.push_back(fmt::format("param {} = \"{}\"{}", item.name, item.value, text));
  lua_pushlstring(call.lua, item.value.data(), item.value.size());
  call.context.words.push_back(std::move(item));
  return 1;
}

int param(Call& call) {
  const std::string name = call.text(1, "name");
  for (const WordParam& other : call.context.words)
    if (other.name == name) call.mistake(fmt::format("\"{}\" was declared before, at {}; use another name", name, other.place.text()));
  if (lua_type(call.lua, 2) == LUA_TSTRING) return word_param(call);
  Param item;
  item.name = name;
  item.place = call.place;
  if (lua_type(call.lua, 2) != LUA_TNUMBER)
    throw Error(fmt::format("param \"{}\": the default must be a number, or a word, not {}", item.name, described(call.lua, 2)),
                call.place);
  item.value = item.fallback = lua_tonumber(call.lua, 2);
  if (!is_name(item.name)) call.mistake(fmt::format("name = \"{}\" becomes a word of -D: letters, digits, _, + and - only", item.name));
  if (!std::isfinite(item.value))
    call.mistake(fmt::format("\"{}\" is {} (0/0? 1/0?); the default must be a finite number", item.name, written(item.value)));
  if (!lua_isnoneornil(call.lua, 3)) split_unit(call.text(3, "text"), item);
  auto& params = call.context.scene.params;
  for (const Param& other : params)
    if (other.name == item.name)
      call.mistake(fmt::format("\"{}\" was declared before, at {}; use another name", item.name, other.place.text()));
  bool given = false;
  for (Override& override_ : call.context.overrides)
    if (override_.name == item.name) {
      given = override_.valid && !override_.is_word;
      if (!override_.trouble.empty()) call.context.mistakes.push_back(override_.trouble);
      if (given) item.value = override_.value;
      if (override_.is_word)
        call.context.mistake({}, fmt::format("-D {}={}: the value must be a finite number, such as 0.8*g, not the string \"{}\"", item.name,
                                             shown(override_.expression, 60), shown(override_.word, 60)));
      override_.used = true;
    }
  // An integer stays an integer, because scripts make names of it.
  const bool whole = lua_isinteger(call.lua, 2) && item.value == std::floor(item.value) && std::fabs(item.value) < 1e15;
  if (given && whole) lua_pushinteger(call.lua, static_cast<lua_Integer>(item.value));
  else if (given) lua_pushnumber(call.lua, item.value);
  else lua_pushvalue(call.lua, 2);
  params.push_back(std::move(item));
  return 1;
}

int metric(Call& call) {
  Metric item;
  item.name = call.text(1, "name");
  item.unit = call.text(2, "unit");
  item.place = call.place;
  if (!is_name(item.name))
    call.mistake(fmt::format("name = \"{}\" becomes a key of metrics.json: letters, digits, _, + and - only", item.name));
  for (const Metric& other : call.context.metrics)
    if (other.name == item.name)
      call.mistake(fmt::format("\"{}\" was given before, at {}; use another name", item.name, other.place.text()));
  lua_settop(call.lua, 3);
  if (lua_type(call.lua, 3) == LUA_TNUMBER && !std::isfinite(lua_tonumber(call.lua, 3)))
    call.mistake(fmt::format("\"{}\" is {}, no finite number (0/0 or 1/0?); correct it", item.name, written(lua_tonumber(call.lua, 3))));
  if (lua_type(call.lua, 3) == LUA_TNUMBER) item.value = lua_tonumber(call.lua, 3), item.function = LUA_NOREF;
  else if (lua_isfunction(call.lua, 3)) item.function = luaL_ref(call.lua, LUA_REGISTRYINDEX);
  else throw Error(fmt::format("metric \"{}\" must be a number or a function(run), not {}", item.name, described(call.lua, 3)), call.place);
  call.context.scene.metric_units.emplace_back(item.name, item.unit);
  call.context.metrics.push_back(std::move(item));
  return 0;
}

void read_tolerance(Arguments& arguments, Expectation& item, bool has_number) {
  using Kind = Expectation::Kind;
  int kinds = 0;
  bool flag = false;
  for (const auto& [key, kind] : {std::pair{"rel", Kind::rel}, {"abs", Kind::abs}})
    if (arguments.has(key)) item.kind = kind, arguments.read(key, item.tolerance), ++kinds;
  for (const auto& [key, kind] : {std::pair{"below", Kind::below}, {"above", Kind::above}})
    if (arguments.has(key)) {
      arguments.read(key, flag);
      if (!flag) arguments.mistake(fmt::format("of \"{}\": {} = false says nothing; write {} = true, or leave it out", item.key, key, key));
      item.kind = kind;
      item.tolerance = item.value;
      ++kinds;
    }
  if (arguments.has("between")) {
    std::vector<double> bounds;
    arguments.read("between", bounds);
    item.kind = Kind::between;
    ++kinds;
    if (bounds.size() == 2 && bounds[0] <= bounds[1]) item.low = bounds[0], item.high = bounds[1];
    else arguments.mistake("between must be { lowest, highest }");
  }
  arguments.read("source", item.source);
  if (kinds != 1 && (has_number || kinds > 1))
    arguments.mistake(fmt::format("of \"{}\": give one of rel, abs, below, above, between", item.key));
}

int expect(Call& call) {
  Expectation item;
  item.key = call.text(1, "key");
  item.place = call.place;
  const int type = lua_type(call.lua, 2);
  if (type == LUA_TNUMBER) {
    item.value = lua_tonumber(call.lua, 2);
    if (std::isnan(item.value)) call.mistake(fmt::format("of \"{}\": the value is not a number (0/0?)", item.key));
  } else if (type == LUA_TSTRING || type == LUA_TBOOLEAN) {
    item.kind = Expectation::Kind::equal;
    item.text_value = type == LUA_TSTRING ? call.text(2, "the value") : lua_toboolean(call.lua, 2) ? "true" : "false";
  } else if (type != LUA_TNIL) {
    throw Error(fmt::format("expect \"{}\": the value must be a number, a word, true or false, not {}", item.key, described(call.lua, 2)),
                call.place);
  }
  if (lua_istable(call.lua, 3)) {
    Arguments arguments(call.context, call.lua, 3, "expect", call.place, tolerance_keys());
    read_tolerance(arguments, item, type == LUA_TNUMBER);
    if (type == LUA_TNIL && item.kind != Expectation::Kind::between)
      arguments.mistake(fmt::format("of \"{}\": the value is nil", item.key));
  } else if (type == LUA_TNUMBER || type == LUA_TNIL) {
    call.mistake(fmt::format("of \"{}\": add how near it must be, such as {{ rel = 0.01 }}", item.key));
  }
  call.context.scene.expectations.push_back(std::move(item));
  return 0;
}

int label(Call& call) {
  const int n = lua_gettop(call.lua);
  if (n == 0) call.mistake("name at least one label, such as label(\"quick\")");
  auto& labels = call.context.scene.labels;
  for (int i = 1; i <= n; ++i) {
    std::string name = call.text(i, "a label");
    const bool valid = !name.empty() && name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_") == std::string::npos;
    if (!valid) call.mistake(fmt::format("\"{}\" must be small letters, digits and _ only, such as \"quick\"", name));
    if (valid && std::find(labels.begin(), labels.end(), name) == labels.end()) labels.push_back(std::move(name));
  }
  return 0;
}

int use_limit(Call& call) {
  Arguments arguments = call.arguments();
  call.context.scene.use_limit.place = call.place;
  arguments.read(call.context.scene.use_limit);
  return 0;
}

int include(Call& call) {
  namespace fs = std::filesystem;
  Context& context = call.context;
  const std::string file = call.text(1, "file");
  const fs::path folder = readable_folders(context).front(), path = folder / file;
  std::error_code failed;
  if (!may_read({folder}, path))
    throw Error(fmt::format("include \"{}\" leaves the folder of the scene; put the file beside the scene", file), call.place);
  if (!fs::is_regular_file(path, failed))
    throw Error(fmt::format("include \"{}\": there is no such file in {}; correct the name", file, folder.string()), call.place);
  if (context.includes >= 20)
    throw Error(fmt::format("include \"{}\" is nested more than 20 deep; does a file include itself?", file), call.place);
  const std::string text = read_input(context, path, call.place);
  lua_settop(call.lua, 1);
  load_chunk(call.lua, context, text, (context.folder / file).lexically_normal().string());
  ++context.includes;
  struct Leave {
    int& depth;
    ~Leave() { --depth; }
  } leave{context.includes};
  call_script(call.lua, context, 0, LUA_MULTRET);
  return lua_gettop(call.lua) - 1;
}

}  // namespace

std::vector<Function> result_functions() {
  return {
      {"param",
       param,
       "name, default, text",
       "number: the default, or the value of -D name=value",
       "Declares a number, or a word such as the name of a record, that -D and studies may change.",
       {{"name", "string", "", "its name", -unbounded, unbounded, true},
        {"default", "number", "", "its value unless -D gives one; or a word: -D motion=b.AT2", -unbounded, unbounded, true},
        {"text", "string", "", "meaning or assumption, with the unit at the end: \"density of brick, assumed [kg/m3]\""}}},
      {"metric",
       metric,
       "name, unit, value",
       "",
       "Adds a number to metrics.json; a function is called after the run with a table `run`.",
       {{"name", "string", "", "key under \"metrics\"", -unbounded, unbounded, true},
        {"unit", "string", "", "its unit, \"\" for none", -unbounded, unbounded, true},
        {"value", "metric", "", "a number, or function(run) that returns one", -unbounded, unbounded, true}}},
      {"expect",
       expect,
       "key, value, how",
       "",
       "States the expected value of a key of metrics.json; erbs test checks it.",
       {{"key", "string", "", "dotted key: \"metrics.x\", \"energy.residual_relative\", \"status\"", -unbounded, unbounded, true},
        {"value", "expected", "", "a number, a word, true or false", -unbounded, unbounded, true},
        {"how", "tolerance", "", "{ rel = | abs = | below = true | above = true | between = { lo, hi }, source = \"...\" }"}}},
      {"label",
       label,
       "...",
       "",
       "Labels that select scenes: erbs test --quick runs scenes with \"quick\"; a scene with \"fixed_dt\" keeps its time step in "
       "erbs test --grid and erbs accuracy. The smallest step of erbs accuracy is 1/32 of the limit, 1/8 with \"coarse_study\", 1/512 with "
       "\"fine_study\".",
       {{"...", "string", "", "one label or several", -unbounded, unbounded, true}}},
      {"use_limit", use_limit, "{ ... }", "", "Limits of use of the scene; erbs check and erbs run refuse a coarser one.",
       keys_of<UseLimit>()},
      {"include",
       include,
       "file",
       "any: what the file returns",
       "Runs another script of the scene's folder in the same scene.",
       {{"file", "string", "", "path, relative to the scene", -unbounded, unbounded, true}}},
  };
}

}  // namespace erbs::lua
