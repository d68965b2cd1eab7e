// Evaluation of the metrics of a scene after its run: the metric functions and their argument, the table `run`.
#include <algorithm>
#include <cmath>
#include <limits>
#include <lua5.4/lua.hpp>

#include "engine/base/spelling.h"
#include "engine/record/results/signal.h"
#include "lua/language/api.h"
#include "lua/language/script.h"

namespace erbs::lua {
namespace {

void push_json(lua_State* lua, const Json& value) {
  if (!lua_checkstack(lua, 10)) throw Error("metrics are nested too deeply");
  if (value.is_number()) {
    lua_pushnumber(lua, value.get<double>());
  } else if (value.is_boolean()) {
    lua_pushboolean(lua, value.get<bool>());
  } else if (value.is_string()) {
    lua_pushstring(lua, value.get_ref<const std::string&>().c_str());
  } else if (value.is_array()) {
    lua_createtable(lua, static_cast<int>(value.size()), 0);
    for (size_t i = 0; i < value.size(); ++i) {
      push_json(lua, value[i]);
      lua_rawseti(lua, -2, static_cast<lua_Integer>(i + 1));
    }
  } else if (value.is_object()) {
    lua_newtable(lua);
    for (const auto& [key, item] : value.items()) {
      push_json(lua, item);
      lua_setfield(lua, -2, key.c_str());
    }
  } else {
    lua_pushnil(lua);
  }
}

const RunResults& results_of(lua_State* lua, const Context& context) {
  if (!context.run) throw Error("run can be asked only inside a metric function", current_place(lua));
  return *context.run;
}

// The column named by the first argument of run.peak(column) and similar functions; run:peak(column) works too.
const std::vector<double>& column_of(lua_State* lua, const Context& context) {
  if (lua_istable(lua, 1)) lua_remove(lua, 1);
  const RunResults& run = results_of(lua, context);
  if (lua_type(lua, 1) != LUA_TSTRING)
    throw Error(fmt::format("the column must be a string, not {}; known: {}", described(lua, 1), fmt::join(run.histories.names, ", ")),
                current_place(lua));
  const std::string name = lua_tostring(lua, 1);
  const int found = run.histories.find(name);
  if (found < 0)
    throw Error(fmt::format("histories.csv has no column \"{}\"{}", name, did_you_mean(name, run.histories.names)), current_place(lua));
  const auto& column = run.histories.columns[static_cast<size_t>(found)];
  if (column.empty()) throw Error(fmt::format("column \"{}\" is empty; the run wrote no row", name), current_place(lua));
  return column;
}

const std::vector<double>& times_of(lua_State* lua, const Context& context) { return results_of(lua, context).histories.columns.front(); }

void push_numbers(lua_State* lua, const std::vector<double>& values) {
  lua_createtable(lua, static_cast<int>(values.size()), 0);
  for (size_t i = 0; i < values.size(); ++i) {
    lua_pushnumber(lua, values[i]);
    lua_rawseti(lua, -2, static_cast<lua_Integer>(i + 1));
  }
}

int number(lua_State* lua, double value) {
  lua_pushnumber(lua, value);
  return 1;
}

int history(lua_State* lua, Context& context) {
  push_numbers(lua, column_of(lua, context));
  return 1;
}

// Largest magnitude, without its sign: the number to compare with a spectrum or a drift limit.
int peak(lua_State* lua, Context& context) {
  const auto& column = column_of(lua, context);
  return number(lua, std::abs(erbs::peak(times_of(lua, context), column).value));
}

int peak_time(lua_State* lua, Context& context) {
  const auto& column = column_of(lua, context);
  return number(lua, erbs::peak(times_of(lua, context), column).time);
}

int highest(lua_State* lua, Context& context) {
  const auto& column = column_of(lua, context);
  return number(lua, *std::max_element(column.begin(), column.end()));
}

int lowest(lua_State* lua, Context& context) {
  const auto& column = column_of(lua, context);
  return number(lua, *std::min_element(column.begin(), column.end()));
}

int rms(lua_State* lua, Context& context) {
  const auto& column = column_of(lua, context);
  return number(lua, erbs::rms(times_of(lua, context), column));
}

int mean(lua_State* lua, Context& context) {
  const auto& column = column_of(lua, context);
  return number(lua, erbs::mean(times_of(lua, context), column));
}

int period(lua_State* lua, Context& context) {
  const auto& column = column_of(lua, context);
  return number(lua, erbs::period(times_of(lua, context), column));
}

// run.crossings(column, level, rising): times at which the column crosses the level.
int crossings(lua_State* lua, Context& context) {
  const auto& column = column_of(lua, context);
  const double level = lua_type(lua, 2) == LUA_TNUMBER ? lua_tonumber(lua, 2) : 0;
  push_numbers(lua, erbs::crossings(times_of(lua, context), column, level, lua_toboolean(lua, 3) != 0));
  return 1;
}

int last(lua_State* lua, Context& context) { return number(lua, column_of(lua, context).back()); }
int first(lua_State* lua, Context& context) { return number(lua, column_of(lua, context).front()); }

// run.frequency(column, from, to): frequency of the highest peak of the spectrum, within a band if one is given.
int frequency(lua_State* lua, Context& context) {
  const auto& column = column_of(lua, context);
  const double from = lua_type(lua, 2) == LUA_TNUMBER ? lua_tonumber(lua, 2) : 0;
  const double to = lua_type(lua, 3) == LUA_TNUMBER ? lua_tonumber(lua, 3) : std::numeric_limits<double>::infinity();
  return number(lua, dominant_frequency(times_of(lua, context), column, from, to));
}

// run.at(column, t): value at time t, linear between rows; nil where the run has not come to it.
int at(lua_State* lua, Context& context) {
  const auto& column = column_of(lua, context);
  const auto& time = times_of(lua, context);
  if (lua_type(lua, 2) != LUA_TNUMBER)
    throw Error(fmt::format("run.at: the time must be a number, not {}", described(lua, 2)), current_place(lua));
  const double t = lua_tonumber(lua, 2);
  const auto after = std::upper_bound(time.begin(), time.end(), t);
  const double row = time.size() > 1 ? (time.back() - time.front()) / static_cast<double>(time.size() - 1) : 0;
  if (!(t >= time.front() - 1.5 * row && t <= time.back() + 1.5 * row)) return lua_pushnil(lua), 1;
  if (after == time.begin()) return number(lua, column.front());
  if (after == time.end()) return number(lua, column.back());
  const auto i = static_cast<size_t>(after - time.begin());
  const double share = (t - time[i - 1]) / (time[i] - time[i - 1]);
  return number(lua, column[i - 1] + share * (column[i] - column[i - 1]));
}

constexpr std::pair<const char*, Body> run_functions[] = {
    {"history", history},    {"peak", peak},   {"peak_time", peak_time}, {"max", highest}, {"min", lowest},          {"rms", rms},
    {"mean", mean},          {"first", first}, {"last", last},           {"at", at},       {"frequency", frequency}, {"period", period},
    {"crossings", crossings}};

// run.events: { { time, event, name, value }, ... } in order of time. run.first_crack: { time, name }, or nil without a crack.
void push_events(lua_State* lua, const CsvTable& events) {
  lua_newtable(lua);
  lua_pushnil(lua);
  const int what = events.find("event"), name = events.find("name"), value = events.find("value"), time = events.find("time_s");
  if (what < 0 || name < 0 || value < 0 || time < 0) return;
  const auto& words = events.text[static_cast<size_t>(what)];
  const auto& names = events.text[static_cast<size_t>(name)];
  for (size_t i = 0; i < std::min({events.rows(), words.size(), names.size(), size_t{100000}}); ++i) {
    lua_createtable(lua, 0, 4);
    lua_pushnumber(lua, events.columns[static_cast<size_t>(time)][i]);
    lua_setfield(lua, -2, "time");
    lua_pushstring(lua, words[i].c_str());
    lua_setfield(lua, -2, "event");
    lua_pushstring(lua, names[i].c_str());
    lua_setfield(lua, -2, "name");
    lua_pushnumber(lua, events.columns[static_cast<size_t>(value)][i]);
    lua_setfield(lua, -2, "value");
    if (words[i] == "crack" && lua_isnil(lua, -2)) {
      lua_pushvalue(lua, -1);
      lua_replace(lua, -3);
    }
    lua_rawseti(lua, -3, static_cast<lua_Integer>(i + 1));
  }
}

// run.metrics.NAME of a metric of the scene is nil, as is run.metrics.metrics.NAME of one below. What asks for one is told so if it ends
// without a value.
int absent_key(lua_State* lua, Context& context) {
  if (lua_type(lua, 2) == LUA_TSTRING) {
    const std::string key = lua_tostring(lua, 2);
    const auto is_key = [&](const auto& name) { return name == key; };
    const auto of_study = [&](const study::Study& one) { return std::ranges::any_of(study::metric_names(one), is_key); };
    if (std::ranges::any_of(context.scene.metric_units, is_key, [](const auto& item) { return item.first; }) &&
        std::ranges::none_of(context.studies, of_study))
      context.unseen = key;
  }
  lua_pushnil(lua);
  return 1;
}

void tell_of_absent_keys(lua_State* lua) {
  lua_createtable(lua, 0, 1);
  push_guarded(lua, absent_key);
  lua_setfield(lua, -2, "__index");
  lua_setmetatable(lua, -2);
}

// The table `run`: the keys of metrics.json, then time, metrics, columns and the functions above.
void push_run(lua_State* lua, const RunResults& run) {
  push_json(lua, run.metrics.is_object() ? run.metrics : Json::object());
  push_json(lua, run.metrics);
  if (lua_istable(lua, -1)) {
    if (lua_getfield(lua, -1, "metrics") == LUA_TTABLE) tell_of_absent_keys(lua);
    lua_pop(lua, 1);
    tell_of_absent_keys(lua);
  }
  lua_setfield(lua, -2, "metrics");
  push_numbers(lua, run.histories.columns.empty() ? std::vector<double>{} : run.histories.columns.front());
  lua_setfield(lua, -2, "time");
  push_json(lua, run.histories.names);
  lua_setfield(lua, -2, "columns");
  push_events(lua, run.events);
  lua_setfield(lua, -3, "first_crack");
  lua_setfield(lua, -2, "events");
  for (const auto& [name, body] : run_functions) {
    push_guarded(lua, body);
    lua_setfield(lua, -2, name);
  }
}

std::string called(const Metric& metric) { return metric.question.empty() ? fmt::format("metric \"{}\"", metric.name) : metric.question; }

std::string hint_of(const Context& context) {
  if (context.unseen.empty()) return "";
  return fmt::format("; it asks for metric \"{}\": run.metrics.metrics has those above this one that have a value", context.unseen);
}

// Why the function gave no value; "" if it may be so: a metric of the scene that is nil has none.
std::string why_nil(const Context& context, const Metric& metric) {
  if (metric.question.empty() && context.unseen.empty()) return "";
  const char* remedy = metric.question.empty()                         ? ""
                       : metric.question.starts_with("collapsed_when") ? "; return true or false"
                                                                       : "; return a number";
  return fmt::format("{}: {} gave nil and has no value{}{}", metric.place.text(), called(metric), remedy, hint_of(context));
}

}  // namespace

std::vector<MetricValue> Script::evaluate_metrics(const RunResults& results) {
  Context& context = *context_;
  std::vector<MetricValue> values;
  const Stretch stretch(lua_, context);
  const Cap uncapped(context.limits, false);
  RunResults seen = results;  // with the metrics so far, which later ones may use
  if (seen.metrics.is_object() && !seen.metrics.contains("metrics")) seen.metrics["metrics"] = Json::object();
  context.run = &seen;
  for (const Metric& metric : context.metrics) {
    MetricValue value{metric.name, metric.unit, std::nullopt, "", ""};
    if (metric.function == LUA_NOREF) {
      value.value = metric.value;
    } else {
      context.unseen.clear();
      try {
        lua_rawgeti(lua_, LUA_REGISTRYINDEX, metric.function);
        push_run(lua_, seen);
        call_script(lua_, context, 1, 1);
        if (lua_type(lua_, -1) == LUA_TNUMBER) value.value = lua_tonumber(lua_, -1);
        else if (lua_type(lua_, -1) == LUA_TBOOLEAN) value.value = lua_toboolean(lua_, -1);
        else if (lua_isnil(lua_, -1)) value.warning = why_nil(context, metric);
        else
          value.error =
              fmt::format("{}: {} gave {}; return a number, or nil for none", metric.place.text(), called(metric), described(lua_, -1));
      } catch (const Error& error) { value.error = std::string(error.what()) + hint_of(context); }
      lua_settop(lua_, 0);
    }
    if (value.value && !std::isfinite(*value.value)) {
      value.warning = fmt::format("{}: {} is no finite number ({}) and has no value; return nil where there is none", metric.place.text(),
                                  called(metric), std::isnan(*value.value) ? "0/0?" : "a division by 0?");
      value.value.reset();
    }
    if (!context.study.empty() && metric.name != "study") value.error.clear(), value.warning.clear();  // it may need the studies themselves
    if (value.value && seen.metrics.is_object()) seen.metrics["metrics"][metric.name] = *value.value;
    values.push_back(std::move(value));
  }
  context.run = nullptr;
  return values;
}

Json Script::lua_functions() {
  const Cap uncapped(context_->limits, false);
  lua_getglobal(lua_, "masonry_functions");
  const auto to_json = [this](auto& self, int depth) -> Json {
    if (lua_type(lua_, -1) == LUA_TNUMBER) return lua_tonumber(lua_, -1);
    if (lua_type(lua_, -1) == LUA_TSTRING) return lua_tostring(lua_, -1);
    if (lua_type(lua_, -1) == LUA_TBOOLEAN) return lua_toboolean(lua_, -1) != 0;
    if (!lua_istable(lua_, -1) || depth > 8 || !lua_checkstack(lua_, 10)) return nullptr;
    Json list = Json::array(), named = Json::object();
    const auto n = static_cast<lua_Integer>(lua_rawlen(lua_, -1));
    for (lua_Integer i = 1; i <= n; ++i) {
      lua_rawgeti(lua_, -1, i);
      list.push_back(self(self, depth + 1));
      lua_pop(lua_, 1);
    }
    for (lua_pushnil(lua_); lua_next(lua_, -2) != 0; lua_pop(lua_, 1))
      if (lua_type(lua_, -2) == LUA_TSTRING) named[lua_tostring(lua_, -2)] = self(self, depth + 1);
    return named.empty() ? list : named;
  };
  Json functions = to_json(to_json, 0);
  lua_pop(lua_, 1);
  return functions;
}

}  // namespace erbs::lua
