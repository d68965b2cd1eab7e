// erbs help and the editor file; both come from the table of functions that a script can call.
#include "lua/commands/help.h"

#include <algorithm>
#include <cstdio>

#include "engine/base/spelling.h"
#include "engine/record/recorders/recorder.h"
#include "lua/language/api.h"
#include "lua/program/options.h"
#include "lua/program/say.h"

namespace erbs::lua {
namespace {

// A value of a list in the spelling of a script.
std::string written(const Json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_number()) return lua::written(value.get<double>());
  if (!value.is_array()) return value.dump();
  std::vector<std::string> items;
  for (const Json& item : value) items.push_back(written(item));
  return fmt::format("{{ {} }}", fmt::join(items, ", "));
}

// Keys of a function written in Lua, from its entry in masonry_functions.
Keys keys_of(const Json& list) {
  Keys keys;
  for (const Json& item : list) {
    Key key;
    key.name = item.value("name", "");
    key.type = item.value("type", "any");
    key.unit = item.value("unit", "");
    key.text = item.value("help", "");
    key.required = item.value("required", false);
    if (item.contains("default")) key.fallback = written(item["default"]);
    if (item.contains("low") && item["low"].is_number()) key.low = item["low"].get<double>();
    if (item.contains("above") && item["above"].is_number()) key.low = item["above"].get<double>();
    if (item.contains("high") && item["high"].is_number()) key.high = item["high"].get<double>();
    if (item.contains("choice"))
      for (const Json& word : item["choice"]) key.words += (key.words.empty() ? "" : "|") + word.get<std::string>();
    for (const char* inner : {"keys", "list"})
      if (item.contains(inner)) key.inner = keys_of(item[inner]);
    if (item.contains("list")) key.type = "list";
    keys.push_back(std::move(key));
  }
  return keys;
}

std::string facts(const Key& key) {
  std::vector<std::string> facts;
  if (!key.unit.empty()) facts.push_back(key.unit);
  if (std::isfinite(key.low) && std::isfinite(key.high) && key.low < key.high)
    facts.push_back(fmt::format("{} to {}", written(key.low), written(key.high)));
  else if (std::isfinite(key.low) && std::isinf(key.high)) facts.push_back("at least " + written(key.low));
  if (!key.words.empty()) facts.push_back(key.words);
  if (key.required) facts.push_back("required");
  if (!key.required && !key.fallback.empty()) facts.push_back("default " + key.fallback);
  return fmt::format("{}", fmt::join(facts, "; "));
}

std::string shown_type(const Key& key) {
  static const std::pair<const char*, const char*> names[] = {{"vec3", "{x, y, z}"},
                                                              {"vec", "{x, y, z}"},
                                                              {"list", "list of tables"},
                                                              {"points", "{{x, y, z}, ...}"},
                                                              {"pairs", "{{u, v}, ...}"},
                                                              {"strings", "string(s)"},
                                                              {"numbers", "{number, ...}"},
                                                              {"faces", "{{1, 2, ...}, ...}"},
                                                              {"direction", "\"x\" or {x, y, z}"},
                                                              {"points_per_face", "{int, int} or int"},
                                                              {"metric", "number or function"},
                                                              {"question", "function(run)"},
                                                              {"expected", "number or word"},
                                                              {"tolerance", "table"},
                                                              {"stored", "table"},
                                                              {"picture", "table"},
                                                              {"family", "table"},
                                                              {"family_how", "table"},
                                                              {"axes", "list of axes"},
                                                              {"values", "{value, ...}"},
                                                              {"range", "{lo, hi}"},
                                                              {"duration", "number or text"},
                                                              {"bytes", "number or text"},
                                                              {"initial", "table"},
                                                              {"parts", "list of tables"}};
  for (const auto& [type, shown] : names)
    if (key.type == type) return shown;
  return key.type;
}

// A position in a list stands in brackets.
std::string shown_name(const Key& key) {
  return key.name.find_first_not_of("0123456789") == std::string::npos ? "[" + key.name + "]" : key.name;
}

std::string line_of(const Key& key, size_t name_width, size_t type_width) {
  std::string line = fmt::format("  {:<{}}  {:<{}}  {}", shown_name(key), name_width, shown_type(key), type_width, key.text);
  const std::string more = facts(key);
  if (!more.empty()) line += fmt::format(" ({})", more);
  return line + "\n";
}

// The keys with the keys of inner tables after their table, as brick.length.
Keys flat(const Keys& keys, const std::string& before) {
  Keys all;
  for (const Key& key : keys) {
    all.push_back(key);
    all.back().name = before + key.name;
    for (Key& inner : flat(key.inner, before + key.name + (key.type == "list" ? "[]." : "."))) all.push_back(std::move(inner));
  }
  return all;
}

std::string keys_text(const Keys& given) {
  const Keys keys = flat(given, "");
  size_t name = 4, type = 6;
  for (const Key& key : keys) name = std::max(name, key.name.size()), type = std::max(type, shown_type(key).size());
  std::string text;
  for (const Key& key : keys) text += line_of(key, name, type);
  return text;
}

std::string quantities_text() {
  std::string text = "quantities:\n";
  for (const Quantity& quantity : recorder_quantities()) text += fmt::format("  {:<20} {}\n", quantity.name, quantity.text);
  return text;
}

// Example of a study: the param, the study and an expectation on its result.
std::string example_of(const std::string& name) {
  if (name == "bisect")
    return "  local pga = param(\"pga\", 0.5 * g, \"peak of the ground [m/s2]\")\n"
           "  bisect { param = \"pga\", lo = 0.1 * g, hi = 1.5 * g, rel = 0.01 }  -- the value at which collapse.collapsed becomes true\n"
           "  bisect { param = \"pga\", name = \"slides\", lo = 0, hi = g, collapsed_when = function(run) return run.last \"b_ux_rel_m\" > "
           "1*mm end }\n"
           "  expect(\"metrics.collapse_pga\", 0.37 * g, { rel = 0.02, source = \"limit analysis\" })\n";
  if (name == "converge")
    return "  local share = param(\"share\", 0.2, \"dt over its limit\")\n"
           "  analysis { duration = 1, dt_fraction = share }\n"
           "  converge { param = \"share\", values = { .4, .2, .1 }, slope = 1.9,  -- at least\n"
           "    error = function(run) return math.abs(run.period \"b_uz_rel_m\" / known - 1) end }\n";
  if (name == "study")
    return "  study { scene = \"pier.lua\", collect = { \"collapse.time_s\" },           -- for erbs sweep FILE\n"
           "    vary = { grid { omega = { 1, 2, 4 } }, latin { n = 10, ft = { 1e5, 3e5 } } },  -- 30 points\n"
           "    bisect = { param = \"amplitude\", lo = 0.1 * g, hi = 2 * g, rel = .01 } }      -- at each\n";
  if (name == "calibration")
    return "  calibration { scene = \"block.lua\", stages = {                            -- for erbs calibrate FILE\n"
           "      { raise = { ks = { 1e9, 1e12, log = true } }, key = \"metrics.slip\", below = 1e-3 },\n"
           "      { fit = { kn = { 1e9, 1e13, log = true }, restitution = { .05, .95 } } } },\n"
           "    targets = { { label = \"time of impact [s]\", keys = { \"metrics.t_1\", \"metrics.t_2\" }, values = { .366, 1.039 } } } "
           "}\n";
  if (name == "records")
    return "  records { param = \"motion\", files = { \"a.AT2\", \"b.AT2\" }, scale = \"pga\", scales = { .1 * g, .2 * g } }\n"
           "  ground_motion { wave = record { file = param(\"motion\", \"a.AT2\"), peak = param(\"pga\", g) } }  -- in the scene\n";
  if (name == "ensemble")
    return "  local seed = param(\"seed\", 1)\n"
           "  ensemble { n = 20, seed = 1, name = \"falls_at\", value = function(run) return run.collapse.time_s end }\n"
           "  expect(\"metrics.falls_at_mean\", 1.2, { abs = 0.1, source = \"twenty twins\" })\n";
  if (name == "family")
    return "  local kn, plates = param(\"kn\", 1e10, \"[Pa/m]\"), param(\"plates\", 8, \"\")\n"
           "  family { kn = { 1e9, 1e11, 1e12 }, plates = { 1, 3, 40 } }  -- six runs, and four random combinations\n"
           "  family({ kn = { 1e9, 1e12 } }, { combinations = 0 })\n"
           "If the scene refuses a combination by error(...), another one is drawn. A single value that it refuses is reported.\n";
  return "";
}

std::string function_text(const Function& function) {
  const std::string call =
      takes_table(function) ? function.name + function.parameters : fmt::format("{}({})", function.name, function.parameters);
  std::string text = fmt::format("{}\n  {}\n", call, function.text);
  if (!function.returns.empty()) text += fmt::format("  returns {}\n", function.returns);
  text += (takes_table(function) ? "keys:\n" : "parameters:\n") + keys_text(function.keys);
  if (function.name == "recorder") text += quantities_text();
  if (function.name == "metric") text += std::string(run_help);
  if (const std::string example = example_of(function.name); !example.empty()) text += "example:\n" + example;
  if (function.name == "bisect" || function.name == "converge" || function.name == "ensemble")
    text += "A run that crashes, diverges or gives no number has a row with the reason in studies/NAME.csv.\n";
  return text;
}

// The type of a key in LuaCATS, the annotations that editors read.
std::string editor_type(const Key& key) {
  static const std::pair<const char*, const char*> types[] = {{"vec3", "erbs.vec3"},
                                                              {"vec", "erbs.vec3"},
                                                              {"points", "erbs.vec3[]"},
                                                              {"pairs", "number[][]"},
                                                              {"strings", "string|string[]"},
                                                              {"numbers", "number[]"},
                                                              {"faces", "integer[][]"},
                                                              {"direction", "\"x\"|\"y\"|\"z\"|erbs.vec3"},
                                                              {"points_per_face", "integer|integer[]"},
                                                              {"law", "erbs.law"},
                                                              {"wave", "erbs.wave|number|fun(t: number): number"},
                                                              {"function", "fun(): any"},
                                                              {"parts", "erbs.part[]"},
                                                              {"metric", "number|fun(run: erbs.run): number?"},
                                                              {"question", "fun(run: erbs.run): number|boolean?"},
                                                              {"expected", "number|string|boolean?"},
                                                              {"family", "table<string, number[]>"},
                                                              {"frictions", "table<string, number>"},
                                                              {"family_how", "{ combinations?: integer, seed?: number }"},
                                                              {"axes", "erbs.axes|erbs.axes[]"},
                                                              {"values", "number|string|(number|string)[]"},
                                                              {"range", "number[]"},
                                                              {"duration", "number|string"},
                                                              {"bytes", "number|string"},
                                                              {"tolerance", "erbs.tolerance"},
                                                              {"stored", "erbs.stored"},
                                                              {"picture", "erbs.picture"},
                                                              {"quantity", "erbs.quantity"}};
  if (!key.inner.empty()) {
    std::vector<std::string> members;
    for (const Key& inner : key.inner)
      members.push_back(fmt::format("{}{}: {}", inner.name, inner.required ? "" : "?", editor_type(inner)));
    return fmt::format("{{ {} }}{}", fmt::join(members, ", "), key.type == "list" ? "[]" : "");
  }
  if (key.type == "string" && !key.words.empty()) {
    std::string words;
    for (const char c : key.words) words += c == '|' ? std::string("\"|\"") : std::string(1, c);
    return "\"" + words + "\"";
  }
  for (const auto& [type, shown] : types)
    if (key.type == type) return shown;
  return key.type;
}

std::string editor_text(const Key& key) {
  const std::string more = facts({"", "", key.unit, "", key.low, key.high, false, "", key.fallback, {}});
  return key.text + (more.empty() ? "" : fmt::format(" [{}]", more));
}

std::string editor_fields(const Keys& keys) {
  std::string text;
  for (const Key& key : keys)
    text += fmt::format("---@field {}{} {} {}\n", shown_name(key), key.required ? "" : "?", editor_type(key), editor_text(key));
  return text;
}

std::string editor_function(const Function& function) {
  std::string text;
  if (takes_table(function)) text += fmt::format("---@class erbs.{}_keys\n{}\n", function.name, editor_fields(function.keys));
  text += fmt::format("---{}\n", function.text);
  if (takes_table(function)) {
    text += fmt::format("---@param keys erbs.{}_keys\n", function.name);
  } else {
    for (const Key& key : function.keys)
      text += fmt::format("---@param {}{} {} {}\n", key.name, key.required ? "" : "?", editor_type(key), editor_text(key));
  }
  if (!function.returns.empty()) {
    const size_t colon = function.returns.find(": ");
    const std::string type = function.returns.substr(0, colon);
    text += fmt::format("---@return {} # {}\n", type == "law" || type == "wave" || type == "axes" ? "erbs." + type : type,
                        function.returns.substr(colon + 2));
  }
  return text + fmt::format("function {}({}) end\n\n", function.name, takes_table(function) ? "keys" : function.parameters);
}

Function lua_function(const Json& item) {
  const std::string returns = item.value("returns", "");
  return {item.value("name", ""),
          nullptr,
          "{ ... }",
          returns.empty() ? "" : "table: " + returns,
          item.value("help", ""),
          keys_of(item.value("keys", Json::array()))};
}

}  // namespace

std::vector<Function> all_functions() {
  std::vector<Function> all = api();
  Script script;
  for (const Json& item : script.lua_functions())
    if (item.is_object()) all.push_back(lua_function(item));
  return all;
}

bool is_function(const std::string& name) {
  return std::ranges::any_of(all_functions(), [&](const Function& function) { return function.name == name; });
}

std::string function_help(const std::string& name) {
  std::vector<std::string> known;
  for (const Function& function : all_functions()) {
    if (function.name == name) return function_text(function);
    known.push_back(function.name);
  }
  for (const char* verb : {"run", "check", "render", "export", "plot", "report", "compare", "record", "test", "accuracy", "bench",
                           "effects", "sweep", "calibrate", "help", "version"})
    known.emplace_back(verb);
  throw Error(fmt::format("there is no verb and no function {}{}", name, did_you_mean(name, known)));
}

std::string functions_list() {
  std::string text = "Scene functions (erbs help FUNCTION):\n";
  for (const Function& function : all_functions()) text += fmt::format("  {:<14} {}\n", function.name, function.text);
  return text +
         "Units: m cm mm km  s ms  kg t  N kN MN  Pa kPa MPa GPa  J Hz  deg g pi, as factors: 5*mm, 0.4*g\nstart_noise: noise in the "
         "initial state of every free block (m and rad), "
         "by erbs run --noise or erbs test --grid; 0 without them\n";
}

std::string editor_file() {
  std::string text = std::string(editor_head);
  std::vector<std::string> quantities;
  for (const Quantity& quantity : recorder_quantities()) quantities.push_back(fmt::format("\"{}\"", quantity.name));
  text += fmt::format("---@alias erbs.quantity {}\n\n", fmt::join(quantities, "|"));
  for (const auto& [name, keys] : {std::pair{"part", part_keys()},
                                   {"tolerance", tolerance_keys()},
                                   {"stored", stored_keys()},
                                   {"picture", keys_of<PictureExpectation>()}})
    text += fmt::format("---@class erbs.{}\n{}\n", name, editor_fields(keys));
  for (const Function& function : all_functions()) text += editor_function(function);
  return text;
}

int verb_help(const std::vector<std::string>& words, const std::string& usage) {
  if (words.empty()) say("{}\n{}", usage, functions_list());
  else if (words.front() == "--editor") say("{}", editor_file());
  else
    for (const auto& word : words) say("{}", function_help(word));
  return exit_ok;
}

}  // namespace erbs::lua
