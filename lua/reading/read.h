// Reads the named keys of a table from a script. A mistake is noted with place, cause and remedy, and reading continues, so that the
// user sees all mistakes of a scene at once.
#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/field.h"
#include "lua/reading/context.h"

struct lua_State;

namespace erbs::lua {

// Description of one key, for reading, help and the editor file.
struct Key {
  std::string name;
  std::string type;  // number, integer, boolean, string, vec3, or a type of its function: law, wave, numbers, ...
  std::string unit, text;
  double low = -unbounded, high = unbounded;
  bool required = false;
  std::string words = {};       // of a string with a choice: a|b|c
  std::string fallback = {};    // default value as a script would write it; "" without one
  std::vector<Key> inner = {};  // of a table: its own keys
};

using Keys = std::vector<Key>;

std::string written(double value);  // in the spelling of a script: 0.4, 5e+10, math.huge
std::string written(const Vec3& value);

// The keys of a field list; their defaults are those of a default-constructed T.
template <class T>
Keys keys_of() {
  const T made{};
  Keys keys;
  for (const Field<T>& field : T::fields()) {
    Key key{std::string(field.name),
            "",
            std::string(field.unit),
            std::string(field.text),
            field.low,
            field.high,
            field.required,
            std::string(field.words),
            "",
            {}};
    field.member.visit([&](auto member) {
      using Value = std::decay_t<decltype(made.*member)>;
      if constexpr (std::is_same_v<Value, double>) key.type = "number", key.fallback = written(made.*member);
      if constexpr (std::is_same_v<Value, int>) key.type = "integer", key.fallback = std::to_string(made.*member);
      if constexpr (std::is_same_v<Value, bool>) key.type = "boolean", key.fallback = made.*member ? "true" : "false";
      if constexpr (std::is_same_v<Value, std::string>) key.type = "string", key.fallback = made.*member;
      if constexpr (std::is_same_v<Value, Vec3>) key.type = "vec3", key.fallback = written(made.*member);
    });
    if (field.text.find("(default") != std::string_view::npos || key.required) key.fallback.clear();
    keys.push_back(std::move(key));
  }
  return keys;
}

Keys joined(std::vector<Keys> lists);

// The table argument of a call such as box{ ... }, or a table inside it.
class Arguments {
 public:
  // Reports unknown and missing keys immediately. `label`: name of the table in messages, "box" or "box: initial". `keys` must outlive
  // this object.
  Arguments(Context& context, lua_State* lua, int index, std::string label, Place place, const Keys& keys);

  bool has(const std::string& key) const;
  template <class T>
  void read(T& item) {  // reads all keys of T's field list that are present
    for (const Field<T>& field : T::fields()) field.member.visit([&](auto member) { read(std::string(field.name), item.*member); });
  }
  void read(const std::string& key, double& into);
  void read(const std::string& key, int& into);
  void read(const std::string& key, bool& into);
  void read(const std::string& key, std::string& into);
  void read(const std::string& key, Vec3& into);
  void read(const std::string& key, std::vector<double>& into);
  void read(const std::string& key, std::vector<Vec3>& into);
  void read_pairs(const std::string& key, std::vector<Eigen::Vector2d>& into);  // { {u, v}, ... }
  void read(const std::string& key, std::vector<std::string>& into);            // one string, or a list
  void read(const std::string& key, std::vector<std::vector<int>>& into);       // lists of indices, converted from base 1 to base 0
  void direction(const std::string& key, Vec3& into);                           // "x", "y", "z" or a vector, normalised
  std::optional<Law> law(const std::string& key);
  std::optional<Wave> wave(const std::string& key);                                  // a wave value, or a number for a constant wave
  std::optional<Wave> wave(const std::string& key, double duration, double sample);  // also a Lua function, sampled up to `duration` (s)
  int function(const std::string& key);  // reference in the registry; LUA_NOREF if the key is absent
  bool is_function(const std::string& key) const;
  bool is_table(const std::string& key) const;
  bool is_number(const std::string& key) const;
  // The table under `key`. It stays on the Lua stack until the call ends.
  std::optional<Arguments> table(const std::string& key, const Keys& keys);
  std::vector<Arguments> tables(const std::string& key, const Keys& keys);

  void mistake(const std::string& what) const;  // adds place and label
  const Key& key(const std::string& name) const;
  const Place& place() const { return place_; }
  const std::string& label() const { return label_; }

 private:
  bool push(const std::string& key) const;  // pushes the raw value of the key; false, and nothing pushed, if it is nil
  void wrong_type(const std::string& key, const std::string& path, const char* wanted) const;
  std::optional<double> number_at_top(const std::string& key, const std::string& path) const;
  // Of the value at the top of the stack.
  bool is_filled_list() const;
  void refuse_keys(const std::string& path) const;                                                     // of a list
  void each(const std::string& path, const std::function<void(const std::string& path)>& item) const;  // with the item at the top
  std::optional<Vec3> vector_at_top(const std::string& key, const std::string& path) const;

  Context* context_;
  lua_State* lua_;
  int index_;
  std::string label_;
  Place place_;
  const Keys* keys_;
};

// Laws and waves appear in Lua as small handles.
void push_law(lua_State* lua, Context& context, Law law);
void push_wave(lua_State* lua, Context& context, Wave wave);
void open_values(lua_State* lua);

// Samples a Lua function of time (a reference in the registry) from 0 to `duration`, linear between samples. Throws Error.
struct Samples {
  std::vector<double> times, values;
};
Samples sampled(lua_State* lua, Context& context, int function, double duration, double sample, const Place& place);

// Continues the samples beyond their end along a parabola, so that what moves there does not stop within the last step of a run.
void carry_on(Samples& samples);

// Description of the value at `index`, for messages: 'the string "1800"'.
std::string described(lua_State* lua, int index);

// The mistake in a string that is_plain() refuses.
std::string not_plain(const std::string& text);

}  // namespace erbs::lua
