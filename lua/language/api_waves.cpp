// Functions of a script: waves (functions of time), made from their field lists.
#include <algorithm>
#include <filesystem>
#include <lua5.4/lua.hpp>

#include "lua/language/api.h"

namespace erbs::lua {
namespace {

void finish(Call&, Arguments&, auto&) {}

void finish(Call&, Arguments& arguments, Table& wave) {
  std::vector<double> times, values;
  arguments.read("times", times);
  arguments.read("values", values);
  try {
    wave = make_table(std::move(times), std::move(values), wave.hold);
  } catch (const Error& error) { arguments.mistake(error.what()); }
}

void finish(Call& call, Arguments& arguments, Record& wave) {
  if (arguments.has("peak") && arguments.has("scale")) arguments.mistake("\"peak\" and \"scale\" exclude each other; keep one");
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
size_t points_of(const Table& wave) { return wave.line.times.size(); }

template <class W>
int make_wave(Call& call) {
  Arguments arguments = call.arguments();
  W wave;
  arguments.read(wave);
  try {
    finish(call, arguments, wave);
  } catch (const Error& error) {  // a mistake in the file names file and line of that file; the script continues with a zero wave
    if (error.place.file == call.place.file) call.context.mistake({}, error.what());
    else call.mistake(error.what());
    push_wave(call.lua, call.context, Pulse{0, 0, 0});
    return 1;
  }
  if constexpr (std::is_same_v<W, Table> || std::is_same_v<W, Record>) call.context.took(4 * sizeof(double) * points_of(wave));
  push_wave(call.lua, call.context, std::move(wave));
  return 1;
}

template <class W>
Keys wave_keys() {
  if constexpr (std::is_same_v<W, Table>)
    return joined({{{"times", "numbers", "s", "increasing, at least two", -1e9, 1e9, true},
                    {"values", "numbers", "", "one for each time, in the unit of the load", -unbounded, unbounded, true}},
                   keys_of<W>()});
  return keys_of<W>();
}

template <class... W>
void add_waves(std::vector<Function>& functions, const std::variant<W...>*) {
  (functions.push_back({std::string(W::wave_name), make_wave<W>, "{ ... }", "wave: for a load; wave(t) is its value at time t",
                        std::string(W::help), wave_keys<W>()}),
   ...);
}

}  // namespace

void note_record(Context& context, const Record& record, const Place& place) {
  if (record.note.empty()) return;
  const std::string note = fmt::format("{}: {}: {}", place.text(), std::filesystem::path(record.file).filename().string(), record.note);
  if (std::find(context.scene.notes.begin(), context.scene.notes.end(), note) == context.scene.notes.end())
    context.scene.notes.push_back(note);
}

std::vector<Function> wave_functions() {
  std::vector<Function> functions;
  add_waves(functions, static_cast<const Wave*>(nullptr));
  return functions;
}

}  // namespace erbs::lua
