// Law and wave values. A script holds a handle: an index into the lists of the context.
#include <algorithm>
#include <cmath>
#include <lua5.4/lua.hpp>

#include "lua/language/api.h"

namespace erbs::lua {
namespace {

constexpr const char* law_type = "law";
constexpr const char* wave_type = "wave";

void push_handle(lua_State* lua, const char* type, size_t index) {
  *static_cast<size_t*>(lua_newuserdatauv(lua, sizeof(size_t), 0)) = index;
  luaL_setmetatable(lua, type);
}

// wave(t): its value at time t. Scripts use it to add waves inside a function.
int call_wave(lua_State* lua) {
  const size_t index = *static_cast<size_t*>(luaL_checkudata(lua, 1, wave_type));
  const double t = luaL_checknumber(lua, 2);
  lua_pushnumber(lua, value(context_of(lua).waves[index], t));
  return 1;
}

// The index of the handle on top of the stack; nullptr if it is no handle of this type.
const size_t* handle_at_top(lua_State* lua, const char* type) { return static_cast<size_t*>(luaL_testudata(lua, -1, type)); }

}  // namespace

void open_values(lua_State* lua) {
  for (const char* type : {law_type, wave_type}) {
    luaL_newmetatable(lua, type);
    lua_pushliteral(lua, "locked");  // the result of getmetatable
    lua_setfield(lua, -2, "__metatable");
    if (type == wave_type) {
      lua_pushcfunction(lua, call_wave);
      lua_setfield(lua, -2, "__call");
    }
    lua_pop(lua, 1);
  }
}

void push_law(lua_State* lua, Context& context, Law law) {
  context.laws.push_back(std::move(law));
  push_handle(lua, law_type, context.laws.size() - 1);
}

void push_wave(lua_State* lua, Context& context, Wave wave) {
  context.waves.push_back(std::move(wave));
  push_handle(lua, wave_type, context.waves.size() - 1);
}

std::optional<Law> Arguments::law(const std::string& key) {
  std::optional<Law> law;
  if (!push(key)) return law;
  if (const size_t* index = handle_at_top(lua_, law_type)) law = context_->laws[*index];
  else wrong_type(key, key, "a joint law, such as mortar{ ... } or dry{ ... }");
  lua_pop(lua_, 1);
  return law;
}

std::optional<Wave> Arguments::wave(const std::string& key) {
  std::optional<Wave> wave;
  if (!push(key)) return wave;
  if (const size_t* index = handle_at_top(lua_, wave_type)) wave = context_->waves[*index];
  else if (lua_type(lua_, -1) == LUA_TNUMBER) {
    if (const auto number = number_at_top(key, key)) wave = Pulse{*number, 0, unbounded};
  } else wrong_type(key, key, "a wave, such as sine{ ... } or record{ ... }, a number, or a function of time");
  lua_pop(lua_, 1);
  return wave;
}

std::optional<Wave> Arguments::wave(const std::string& key, double duration, double sample) {
  if (!is_function(key)) return wave(key);
  const int reference = function(key);
  if (!(duration > 0)) return std::nullopt;  // a mistake that is reported elsewhere
  Samples samples = sampled(lua_, *context_, reference, duration, sample, place_);
  luaL_unref(lua_, LUA_REGISTRYINDEX, reference);
  return make_table(std::move(samples.times), std::move(samples.values), true);
}

namespace {

// Between its samples a function is taken as a line. One that turns there acts as another wave: it is lost or aliased.
void check_between(lua_State* lua, Context& context, int function, const Samples& s, const Place& place) {
  constexpr double most_looks = 1000, off = 0.05;  // intervals that are looked into; deviation, of the range of the values
  const double steps = double(s.times.size() - 1), looks = std::min(steps, most_looks), sample = s.times[1] - s.times[0];
  double low = std::ranges::min(s.values), high = std::ranges::max(s.values);
  double worst = 0, when = 0;
  std::vector<double> errors;
  for (double k = 0; k < looks; ++k) {
    const auto i = static_cast<size_t>(steps * k / looks);
    constexpr double within = 0.618;  // of the interval: the middle may be a zero of what the samples miss
    const double t = s.times[i] + within * sample;
    lua_rawgeti(lua, LUA_REGISTRYINDEX, function);
    lua_pushnumber(lua, t);
    call_script(lua, context, 1, 1);
    const double wanted = lua_tonumber(lua, -1);
    lua_pop(lua, 1);
    low = std::min(low, wanted), high = std::max(high, wanted);
    errors.push_back(std::fabs(wanted - (1 - within) * s.values[i] - within * s.values[i + 1]));
    if (errors.back() > worst) worst = errors.back(), when = t;
  }
  // A jump is in one interval; a wave that is sampled too coarsely differs in many.
  const auto wrong = std::ranges::count_if(errors, [&](double e) { return e > off * (high - low) + 1e-12 * std::max(high, -low); });
  if (double(wrong) < std::max(std::min(3.0, looks), looks / 50)) return;
  const std::string warning = fmt::format(
      "{}: between its samples, {:g} s apart, the function of this wave departs from the line through them by up to "
      "{:.0f} % of its range, as at {:.6g} s: the run takes another wave; take a smaller step, such as sample = {:.2g}",
      place.text(), sample, 100 * worst / (high - low), when, sample / 10);
  std::vector<std::string>& warnings = context.scene.warnings;
  if (std::ranges::find(warnings, warning) == warnings.end()) warnings.push_back(warning);  // a line may make many loads
}

}  // namespace

Samples sampled(lua_State* lua, Context& context, int function, double duration, double sample, const Place& place) {
  const double steps = std::max(1.0, std::ceil(duration / sample));
  if (steps > 20e6) throw Error(fmt::format("a wave sampled {:g} times is too long; raise sample", steps), place);
  const auto n = static_cast<size_t>(steps) + 1;
  std::vector<double> times(n), values(n);
  for (size_t i = 0; i < n; ++i) {
    times[i] = static_cast<double>(i) * sample;
    lua_rawgeti(lua, LUA_REGISTRYINDEX, function);
    lua_pushnumber(lua, times[i]);
    call_script(lua, context, 1, 1);
    if (lua_type(lua, -1) != LUA_TNUMBER || !std::isfinite(lua_tonumber(lua, -1)))
      throw Error(
          fmt::format("the wave's function gave {} at t = {} s; it must return a finite number", described(lua, -1), written(times[i])),
          place);
    values[i] = lua_tonumber(lua, -1);
    lua_pop(lua, 1);
  }
  Samples samples{std::move(times), std::move(values)};
  check_between(lua, context, function, samples, place);
  return samples;
}

void carry_on(Samples& samples) {
  auto& [times, values] = samples;
  for (int more = 0; more < 3; ++more) {
    const size_t n = times.size();
    times.push_back(2 * times[n - 1] - times[n - 2]);
    values.push_back(n < 3 ? 2 * values[n - 1] - values[n - 2] : 3 * (values[n - 1] - values[n - 2]) + values[n - 3]);
  }
}

int Arguments::function(const std::string& key) {
  if (!push(key)) return LUA_NOREF;
  if (lua_isfunction(lua_, -1)) return luaL_ref(lua_, LUA_REGISTRYINDEX);
  wrong_type(key, key, "a function");
  lua_pop(lua_, 1);
  return LUA_NOREF;
}

}  // namespace erbs::lua
