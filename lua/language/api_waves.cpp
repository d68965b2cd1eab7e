// Functions of a script: waves (functions of time), made from their field lists.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <lua5.4/lua.hpp>

#include "engine/loads/earlier.h"
#include "engine/loads/record/response_spectrum.h"
#include "lua/language/api.h"

namespace erbs::lua {
namespace {

void finish(Call&, Arguments&, auto&) {}

void note_once(Context& context, const std::string& note) {
  std::vector<std::string>& notes = context.scene.notes;
  if (std::find(notes.begin(), notes.end(), note) == notes.end()) notes.push_back(note);
}

// A smooth curve through points that turn sharply swings beyond them.
void note_swings(Call& call, const Curve& wave) {
  constexpr int samples = 16;   // of a segment
  constexpr double most = 0.1;  // of the range of the values
  const std::vector<double>&times = wave.line.times, &values = wave.line.values;
  const auto [low, high] = std::ranges::minmax(values);
  double least = low, greatest = high;
  for (size_t i = 0; i + 1 < times.size(); ++i)
    for (int k = 1; k < samples; ++k) {
      const double x = value(wave, times[i] + (times[i + 1] - times[i]) * k / samples);
      least = std::min(least, x), greatest = std::max(greatest, x);
    }
  if (std::max(low - least, greatest - high) > most * (high - low))
    note_once(
        call.context,
        fmt::format("{}: between its points this curve reaches from {:.4g} to {:.4g}, its values lie from {:g} to {:g}; give more points "
                    "where it turns, or take table_wave",
                    call.place.text(), least, greatest, low, high));
}

// Waves through given points.
template <class W>
constexpr bool has_points = std::is_same_v<W, Table> || std::is_same_v<W, Curve>;

template <class W>
W through(std::vector<double> times, std::vector<double> values, bool hold) {
  if constexpr (std::is_same_v<W, Table>) return make_table(std::move(times), std::move(values), hold);
  else return make_curve(std::move(times), std::move(values), hold);
}

template <class W>
requires has_points<W>
void finish(Call& call, Arguments& arguments, W& wave) {
  std::vector<double> times, values;
  const auto mistakes = [&] { return call.context.told() + size_t(call.context.repeated); };
  const size_t before = mistakes();
  arguments.read("times", times);
  arguments.read("values", values);
  try {
    if (mistakes() > before) times = {0, 1}, values = {0, 0};  // what is left of the points would only make a second mistake
    wave = through<W>(std::move(times), std::move(values), wave.hold);
    if constexpr (std::is_same_v<W, Curve>) note_swings(call, wave);
  } catch (const Error& error) {
    arguments.mistake(error.what());
    wave = through<W>({0, 1}, {0, 0}, wave.hold);  // the script goes on, and may ask it for values
  }
}

void finish(Call& call, Arguments& arguments, Record& wave) {
  check_scale(arguments, wave);
  if (wave.file.empty()) {
    if (arguments.has("file")) arguments.mistake("file = \"\" names no file; give one");
    wave.acceleration = make_polyline({0, 1}, {0, 0});
    return;
  }
  wave.file = find_input(call.context, wave.file, call.place).string();
  wave = read_record(std::move(wave), call.place);
  call.context.scene.inputs[wave.file] = wave.hash;
  note_record(call.context, wave, call.place);
}

size_t points_of(const Record& wave) { return wave.acceleration.times.size(); }
template <class W>
requires has_points<W> size_t points_of(const W& wave) { return wave.line.times.size(); }

template <class W>
int make_wave(Call& call) {
  Arguments arguments = call.arguments();
  W wave;
  arguments.read(wave);
  try {
    finish(call, arguments, wave);
    if constexpr (has_points<W>) wave.says_hold = arguments.has("hold");
  } catch (const Error& error) {  // a mistake in the file names file and line of that file; the script continues with a zero wave
    if (error.place.file == call.place.file) call.context.mistake({}, error.what());
    else call.mistake(error.what());
    push_wave(call.lua, call.context, Pulse{0, 0, 0});
    return 1;
  }
  if constexpr (has_points<W> || std::is_same_v<W, Record>) call.context.took(5 * sizeof(double) * points_of(wave));
  push_wave(call.lua, call.context, std::move(wave));
  return 1;
}

template <class W>
Keys wave_keys() {
  if constexpr (has_points<W>)
    return joined({{{"times", "numbers", "s", "increasing, at least two", -1e9, 1e9, true},
                    {"values", "numbers", "", "one for each time, in the unit of the load", -unbounded, unbounded, true}},
                   keys_of<W>()});
  return keys_of<W>();
}

// The acceleration of a wave as a line through its points. Waves with a formula are sampled 320 times a period, and as finely at their
// features, so that chords lie within 2e-5. The line begins and ends with the wave: beyond it there is nothing, and jumps there are exact.
Polyline line_of(const Wave& wave, double period, const Call& call) {
  if (const auto* record = std::get_if<Record>(&wave)) return record->acceleration;
  if (const auto* table = std::get_if<Table>(&wave)) return table->line;
  const Wave moved = earlier(wave, start_time(wave));
  const double end = end_time(moved), step = std::min(period / 40, resolution(moved)) / 8;
  if (end == 0) return make_polyline({0, 1}, {0, 0});
  if (!(end / step < 1e7))
    throw Error("spectral_acceleration: this wave has no end, or is too long for the period; give one of finite duration", call.place);
  std::vector<double> times, values;
  const auto n = std::max<std::size_t>(2, static_cast<std::size_t>(std::ceil(end / step)));
  for (std::size_t i = 0; i <= n; ++i) {
    times.push_back(end * static_cast<double>(i) / static_cast<double>(n));
    values.push_back(value(moved, i < n ? times.back() : std::nextafter(end, 0.0)));  // at a jump the value before it
  }
  return make_polyline(times, values);
}

struct Oscillator {
  double period = 1, damping = 0.05;  // s, ratio

  static Fields<Oscillator> fields() {
    return {{"period", &Oscillator::period, "s", "period of the oscillator", 1e-3, 1e3, true},
            {"damping", &Oscillator::damping, "", "its damping ratio", 0, 0.99}};
  }
};

int spectral_acceleration(Call& call) {
  const std::size_t told_before = call.context.told();
  Arguments arguments = call.arguments();
  Oscillator of;
  arguments.read(of);
  if (arguments.is_function("wave")) {
    arguments.mistake(
        "wave must be a wave, such as sine{ ... } or record{ ... }; put the values of this function into a table_wave{ ... }");
    lua_pushnumber(call.lua, 0);
    return 1;
  }
  const auto wave = arguments.wave("wave");
  const bool sound = wave && call.context.told() == told_before;
  lua_pushnumber(call.lua, sound ? response_spectrum(line_of(*wave, of.period, call), {of.period}, of.damping).front().acceleration : 0);
  return 1;
}

template <class... W>
void add_waves(std::vector<Function>& functions, const std::variant<W...>*) {
  (functions.push_back({std::string(W::wave_name), make_wave<W>, "{ ... }", "wave: for a load; wave(t) is its value at time t",
                        std::string(W::help), wave_keys<W>()}),
   ...);
}

}  // namespace

void check_scale(Arguments& arguments, Record& wave) {
  if (arguments.has("peak") && arguments.has("scale")) arguments.mistake("\"peak\" and \"scale\" exclude each other; keep one");
  if (arguments.has("peak") && wave.peak == 0) wave.scale = 0;
}

void note_record(Context& context, const Record& record, const Place& place) {
  if (record.note.empty()) return;
  const std::string note = fmt::format("{}: {}: {}", place.text(), std::filesystem::path(record.file).filename().string(), record.note);
  note_once(context, note);
}

std::vector<Function> wave_functions() {
  std::vector<Function> functions;
  add_waves(functions, static_cast<const Wave*>(nullptr));
  functions.push_back(
      {"spectral_acceleration", spectral_acceleration, "{ ... }", "number: m/s2",
       "Pseudo-acceleration of an oscillator under a wave as the acceleration of the ground: Sa(T), a measure of intensity.",
       joined({{{"wave", "wave", "m/s2", "the acceleration of the ground", -unbounded, unbounded, true}}, keys_of<Oscillator>()})});
  return functions;
}

}  // namespace erbs::lua
