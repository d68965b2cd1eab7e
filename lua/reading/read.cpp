#include "lua/reading/read.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <lua5.4/lua.hpp>

#include "engine/base/spelling.h"
#include "engine/base/text.h"

namespace erbs::lua {

std::string written(double x) { return x != x ? "0/0" : !std::isinf(x) ? fmt::format("{:.6g}", x) : x > 0 ? "math.huge" : "-math.huge"; }

std::string written(const Vec3& value) {
  return fmt::format("{{ {}, {}, {} }}", written(value.x()), written(value.y()), written(value.z()));
}

Keys joined(std::vector<Keys> lists) {
  Keys all;
  for (auto& list : lists) std::ranges::move(list, std::back_inserter(all));
  return all;
}

std::string described(lua_State* lua, int index) {
  const int type = lua_type(lua, index);
  if (type == LUA_TNUMBER) return fmt::format("the number {}", written(lua_tonumber(lua, index)));
  if (type == LUA_TSTRING) {
    size_t length = 0;
    const char* text = lua_tolstring(lua, index, &length);
    return fmt::format("the string \"{}\"", shown({text, length}, 40));
  }
  if (type == LUA_TBOOLEAN) return lua_toboolean(lua, index) ? "true" : "false";
  if (type == LUA_TNIL || type == LUA_TNONE) return "nil";
  if (type == LUA_TUSERDATA)
    return luaL_testudata(lua, index, "law") ? "a law" : luaL_testudata(lua, index, "axis") ? "an axis of a study" : "a wave";
  return std::string("a ") + lua_typename(lua, type);
}

std::string not_plain(const std::string& text) {
  return fmt::format("holds control characters or bytes that are no UTF-8, \"{}\"; write it in plain letters", shown(text, 60));
}

namespace {

// The unit of a key, for messages. Values are in SI, because "g = 9.81" of a script is 9.81 m/s2.
std::string in_unit(const Key& key) { return key.unit.empty() ? "" : " " + key.unit; }

std::string range(const Key& key) {
  if (std::isinf(key.high) && std::isinf(key.low)) return "any finite number" + (key.unit.empty() ? "" : " in " + key.unit);
  if (std::isinf(key.high)) return fmt::format("at least {}{}", written(key.low), in_unit(key));
  if (std::isinf(key.low)) return fmt::format("at most {}{}", written(key.high), in_unit(key));
  return fmt::format("{} to {}{}", written(key.low), written(key.high), in_unit(key));
}

std::vector<std::string> split(const std::string& words) {
  std::vector<std::string> list;
  for (size_t begin = 0; begin <= words.size();) {
    const size_t end = std::min(words.find('|', begin), words.size());
    list.push_back(words.substr(begin, end - begin));
    begin = end + 1;
  }
  return list;
}

// Only the duration of a wave may be infinite.
bool endless(const Key& key) { return key.name == "duration" && std::isinf(key.high); }

const char* wanted_number(const Key& key) { return key.type == "integer" ? "a whole number" : "a number"; }

}  // namespace

Arguments::Arguments(Context& context, lua_State* lua, int index, std::string label, Place place, const Keys& keys)
    : context_(&context), lua_(lua), index_(lua_absindex(lua, index)), label_(std::move(label)), place_(std::move(place)), keys_(&keys) {
  std::vector<std::string> known;
  for (const Key& k : *keys_) known.push_back(k.name);
  std::vector<std::string> unknown;
  int positional = 0;
  for (lua_pushnil(lua_); lua_next(lua_, index_) != 0; lua_pop(lua_, 1)) {
    if (lua_type(lua_, -2) == LUA_TSTRING) {
      size_t length = 0;
      const char* text = lua_tolstring(lua_, -2, &length);
      const std::string name = shown({text, length}, 60);
      if (std::find(known.begin(), known.end(), name) == known.end()) unknown.push_back(name);
    } else if (!(lua_isinteger(lua_, -2) &&
                 std::find(known.begin(), known.end(), std::to_string(lua_tointeger(lua_, -2))) != known.end())) {
      ++positional;
    }
  }
  std::sort(unknown.begin(), unknown.end());
  std::vector<std::string> meant;  // keys that a misspelt key stands for: not reported as missing
  for (const auto& name : unknown) {
    mistake(fmt::format("unknown key \"{}\"{}", name, did_you_mean(name, known)));
    meant.push_back(nearest(name, known));
  }
  if (positional > 0)
    mistake(fmt::format("{} value(s) without a key; write them as key = value (keys: {})", positional, fmt::join(known, ", ")));
  for (const Key& k : *keys_)
    if (k.required && !has(k.name) && std::find(meant.begin(), meant.end(), k.name) == meant.end())
      mistake(k.name[0] <= '9' ? fmt::format("value {} is missing ({}); add it behind the others", k.name, k.text)
                               : fmt::format("\"{}\" is missing ({}); add {} = ...", k.name, k.text, k.name));
}

void Arguments::mistake(const std::string& what) const { context_->mistake(place_, fmt::format("{}: {}", label_, what)); }

const Key& Arguments::key(const std::string& name) const {
  for (const Key& k : *keys_)
    if (k.name == name) return k;
  throw std::logic_error("no key " + name + " in the table of " + label_);
}

bool Arguments::push(const std::string& key) const {
  const bool positional = !key.empty() && key.find_first_not_of("0123456789") == std::string::npos;
  if (positional) lua_rawgeti(lua_, index_, std::stoi(key));
  else {
    lua_pushlstring(lua_, key.data(), key.size());
    lua_rawget(lua_, index_);
  }
  if (!lua_isnil(lua_, -1)) return true;
  lua_pop(lua_, 1);
  return false;
}

bool Arguments::has(const std::string& key) const {
  if (!push(key)) return false;
  lua_pop(lua_, 1);
  return true;
}

bool Arguments::is_function(const std::string& key) const {
  if (!push(key)) return false;
  const bool is = lua_isfunction(lua_, -1);
  lua_pop(lua_, 1);
  return is;
}

bool Arguments::is_table(const std::string& key) const {
  if (!push(key)) return false;
  const bool is = lua_istable(lua_, -1);
  lua_pop(lua_, 1);
  return is;
}

bool Arguments::is_number(const std::string& key) const {
  if (!push(key)) return false;
  const bool is = lua_type(lua_, -1) == LUA_TNUMBER;
  lua_pop(lua_, 1);
  return is;
}

void Arguments::wrong_type(const std::string& key, const std::string& path, const char* wanted) const {
  const std::string unit = this->key(key).unit;
  mistake(fmt::format("{} must be {}{}, not {}", path, wanted, unit.empty() ? "" : " in " + unit, described(lua_, -1)));
}

std::optional<double> Arguments::number_at_top(const std::string& key, const std::string& path) const {
  const Key& k = this->key(key);
  if (lua_type(lua_, -1) != LUA_TNUMBER) {
    wrong_type(key, path, wanted_number(k));
    return std::nullopt;
  }
  const double value = lua_tonumber(lua_, -1);
  if (std::isnan(value)) {
    mistake(fmt::format("{} is not a number (0/0?); allowed is {}", path, range(k)));
    return std::nullopt;
  }
  if (std::isinf(value) && !endless(k)) {
    mistake(fmt::format("{} is infinite (1/0?); allowed is {}", path, range(k)));
    return std::nullopt;
  }
  if (value < k.low || value > k.high)
    mistake(fmt::format("{} = {}{} is out of range; allowed is {}", path, written(value), in_unit(k), range(k)));
  return value;
}

void Arguments::read(const std::string& key, double& into) {
  if (!push(key)) return;
  if (const auto value = number_at_top(key, key)) into = *value;
  lua_pop(lua_, 1);
}

void Arguments::read(const std::string& key, int& into) {
  if (!push(key)) return;
  if (const auto value = number_at_top(key, key)) {
    if (*value == std::floor(*value) && std::abs(*value) < 2147483648.0) into = static_cast<int>(*value);
    else mistake(fmt::format("{} = {} must be a whole number", key, written(*value)));
  }
  lua_pop(lua_, 1);
}

void Arguments::read(const std::string& key, bool& into) {
  if (!push(key)) return;
  if (lua_isboolean(lua_, -1)) into = lua_toboolean(lua_, -1);
  else wrong_type(key, key, "true or false");
  lua_pop(lua_, 1);
}

void Arguments::read(const std::string& key, std::string& into) {
  if (!push(key)) return;
  if (lua_type(lua_, -1) != LUA_TSTRING) {
    wrong_type(key, key, "a string");
  } else {
    size_t length = 0;
    const char* text = lua_tolstring(lua_, -1, &length);
    const std::string& words = this->key(key).words;
    const auto allowed = split(words);
    const std::string word(text, std::min<size_t>(length, 4096));
    if (length > 1000) mistake(fmt::format("{} is {} characters long; at most 1000 are allowed", key, length));
    else if (!is_plain(word)) mistake(fmt::format("{} {}", key, not_plain(word)));
    else if (!words.empty() && std::find(allowed.begin(), allowed.end(), word) == allowed.end())
      mistake(fmt::format("{} = \"{}\" is not one of {}{}", key, word, fmt::join(allowed, ", "),
                          nearest(word, allowed).empty() ? "" : did_you_mean(word, allowed)));
    else into = word;
  }
  lua_pop(lua_, 1);
}

bool Arguments::is_filled_list() const { return lua_istable(lua_, -1) && lua_rawlen(lua_, -1) > 0; }

void Arguments::each(const std::string& path, const std::function<void(const std::string& path)>& item) const {
  if (!lua_istable(lua_, -1)) return;
  refuse_keys(path);
  const auto n = static_cast<lua_Integer>(lua_rawlen(lua_, -1));
  for (lua_Integer i = 1; i <= n; ++i) {
    lua_rawgeti(lua_, -1, i);
    item(fmt::format("{}[{}]", path, i));
    lua_pop(lua_, 1);
  }
}

void Arguments::refuse_keys(const std::string& path) const {
  const auto n = static_cast<lua_Integer>(lua_rawlen(lua_, -1));
  for (lua_pushnil(lua_); lua_next(lua_, -2) != 0; lua_pop(lua_, 1)) {
    if (lua_isinteger(lua_, -2) && lua_tointeger(lua_, -2) >= 1 && lua_tointeger(lua_, -2) <= n) continue;
    mistake(lua_type(lua_, -2) == LUA_TSTRING
                ? fmt::format("{} is a list and has a key \"{}\"; write its values alone", path, shown(lua_tostring(lua_, -2), 60))
                : fmt::format("{} is a list with a gap (nil); give every value", path));
    lua_pop(lua_, 2);
    return;
  }
}

std::optional<Vec3> Arguments::vector_at_top(const std::string& key, const std::string& path) const {
  if (!lua_istable(lua_, -1) || lua_rawlen(lua_, -1) != 3) {
    if (lua_istable(lua_, -1)) mistake(fmt::format("{} must be {{ x, y, z }}, not a table of {}", path, lua_rawlen(lua_, -1)));
    else wrong_type(key, path, "a vector { x, y, z }");
    return std::nullopt;
  }
  refuse_keys(path);
  Vec3 vector = Vec3::Zero();
  bool valid = true;
  for (int i = 0; i < 3; ++i) {
    lua_rawgeti(lua_, -1, i + 1);
    if (const auto value = number_at_top(key, fmt::format("{}[{}]", path, i + 1))) vector[i] = *value;
    else valid = false;
    lua_pop(lua_, 1);
  }
  if (!valid) return std::nullopt;
  return vector;
}

void Arguments::read(const std::string& key, Vec3& into) {
  if (!push(key)) return;
  if (const auto value = vector_at_top(key, key)) into = *value;
  lua_pop(lua_, 1);
}

void Arguments::read(const std::string& key, std::vector<double>& into) {
  if (!push(key)) return;
  if (!lua_istable(lua_, -1)) {
    wrong_type(key, key, "a list of numbers");
  } else {
    each(key, [&](const std::string& path) {
      if (const auto value = number_at_top(key, path)) into.push_back(*value);
    });
  }
  lua_pop(lua_, 1);
}

void Arguments::read(const std::string& key, std::vector<Vec3>& into) {
  if (!push(key)) return;
  if (!lua_istable(lua_, -1)) {
    wrong_type(key, key, "a list of vectors { x, y, z }");
  } else {
    each(key, [&](const std::string& path) { into.push_back(vector_at_top(key, path).value_or(Vec3::Zero())); });
  }
  lua_pop(lua_, 1);
}

void Arguments::read_pairs(const std::string& key, std::vector<Eigen::Vector2d>& into) {
  if (!push(key)) return;
  if (!is_filled_list()) wrong_type(key, key, "a list of points { u, v }");
  each(key, [&](const std::string& path) {
    if (!lua_istable(lua_, -1) || lua_rawlen(lua_, -1) != 2) {
      wrong_type(key, path, "a point { u, v }");
      return;
    }
    std::vector<double> pair;
    each(path, [&](const std::string& at) { pair.push_back(number_at_top(key, at).value_or(0.0)); });
    into.emplace_back(pair[0], pair[1]);
  });
  lua_pop(lua_, 1);
}

void Arguments::read(const std::string& key, std::vector<std::string>& into) {
  if (!push(key)) return;
  const auto add = [&](const std::string& path) {
    size_t length = 0;
    const char* text = lua_tolstring(lua_, -1, &length);
    const std::string word(text, std::min<size_t>(length, 1001));
    if (length > 1000) mistake(fmt::format("{} is {} characters long; at most 1000 are allowed", path, length));
    else if (!is_plain(word)) mistake(fmt::format("{} {}", path, not_plain(word)));
    else into.push_back(word);
  };
  if (lua_type(lua_, -1) == LUA_TSTRING) {
    into.clear();
    add(key);
  } else if (lua_istable(lua_, -1)) {
    each(key, [&](const std::string& path) {
      if (lua_type(lua_, -1) == LUA_TSTRING) add(path);
      else wrong_type(key, path, "a string");
    });
  } else {
    wrong_type(key, key, "a string or a list of strings");
  }
  lua_pop(lua_, 1);
}

void Arguments::read(const std::string& key, std::vector<std::vector<int>>& into) {
  if (!push(key)) return;
  if (!is_filled_list()) wrong_type(key, key, "a list of lists of vertex numbers");
  each(key, [&](const std::string& path) {
    std::vector<int> row;
    if (!is_filled_list()) wrong_type(key, path, "a list of vertex numbers");
    each(path, [&](const std::string& at) {
      if (lua_isinteger(lua_, -1) && lua_tointeger(lua_, -1) >= 1 && lua_tointeger(lua_, -1) < 1000000)
        row.push_back(static_cast<int>(lua_tointeger(lua_, -1)) - 1);
      else wrong_type(key, at, "a vertex number (from 1)");
    });
    into.push_back(row);
  });
  lua_pop(lua_, 1);
}

void Arguments::direction(const std::string& key, Vec3& into) {
  if (!push(key)) return;
  std::string word = lua_type(lua_, -1) == LUA_TSTRING ? lua_tostring(lua_, -1) : "";
  const bool back = word.size() == 2 && word[0] == '-';
  if (back) word.erase(0, 1);
  if (word == "x" || word == "y" || word == "z") {
    into = (back ? -1.0 : 1.0) * Vec3::Unit(word[0] - 'x');
  } else if (lua_istable(lua_, -1)) {
    if (const auto vector = vector_at_top(key, key)) {
      if (vector->norm() < 1e-12) mistake(fmt::format("{} has no length; give a vector such as {{ 1, 0, 0 }}", key));
      else into = vector->normalized();
    }
  } else {
    wrong_type(key, key, "\"x\", \"y\", \"z\" or a vector { x, y, z }");
  }
  lua_pop(lua_, 1);
}

std::optional<Arguments> Arguments::table(const std::string& key, const Keys& keys) {
  if (!push(key)) return std::nullopt;
  if (lua_istable(lua_, -1) && lua_checkstack(lua_, 20)) return Arguments(*context_, lua_, -1, label_ + ": " + key, place_, keys);
  wrong_type(key, key, "a table { key = value, ... }");
  lua_pop(lua_, 1);
  return std::nullopt;
}

std::vector<Arguments> Arguments::tables(const std::string& key, const Keys& keys) {
  std::vector<Arguments> list;
  if (!push(key)) return list;
  constexpr size_t most = 1000;  // tables on Lua's stack at once
  if (lua_istable(lua_, -1) && lua_rawlen(lua_, -1) > most) {
    mistake(fmt::format("{} has {} tables; at most {} are allowed", key, lua_rawlen(lua_, -1), most));
    lua_pop(lua_, 1);
    return list;
  }
  const auto n = lua_istable(lua_, -1) ? static_cast<int>(lua_rawlen(lua_, -1)) : 0;
  if (n == 0 || !lua_checkstack(lua_, n + 20)) {
    wrong_type(key, key, "a list of one table or more, { { ... }, { ... } }");
    lua_pop(lua_, 1);
    return list;
  }
  const int outer = lua_absindex(lua_, -1);
  for (int i = 1; i <= n; ++i) {
    lua_rawgeti(lua_, outer, i);
    if (lua_istable(lua_, -1)) {
      list.emplace_back(*context_, lua_, -1, fmt::format("{}: {}[{}]", label_, key, i), place_, keys);
    } else {
      wrong_type(key, fmt::format("{}[{}]", key, i), "a table");
      lua_pop(lua_, 1);
    }
  }
  return list;
}

}  // namespace erbs::lua
