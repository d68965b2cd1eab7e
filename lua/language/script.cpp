#include "lua/language/script.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <limits>
#include <lua5.4/lua.hpp>
#include <set>
#include <sstream>
#include <utility>

#include "engine/base/spelling.h"
#include "engine/base/text.h"
#include "engine/model/build/build.h"
#include "engine/record/recorders/recorder.h"
#include "engine/record/results/metrics.h"
#include "lua/language/api.h"
#include "lua/language/language.h"
#include "lua/reading/quality.h"

namespace erbs::lua {
namespace {

// The text of a scene as Lua can read it: without the byte order mark of some editors and without a first line for a shell.
std::string readable(const std::string& text, const std::string& name) {
  if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF")) throw Error("the file is in UTF-16; save it as UTF-8", {name, 1});
  const std::string bare = text.starts_with("\xEF\xBB\xBF") ? text.substr(3) : text;
  const std::size_t first = bare.find_first_not_of(" \t\r\n");
  if (bare.find('\0') != std::string::npos || (first != std::string::npos && std::strchr("{[<", bare[first]) != nullptr))
    throw Error("this is no Lua script, as a scene is one; name the scene that made it, or begin with scenes/first.lua", {name, 1});
  return bare.starts_with("#") ? "--" + bare : bare;
}

// "scene.lua:12:" of "scene.lua:12: box: ..."; "" if the message names no place.
std::string place_of(const std::string& message) {
  size_t digits = 0;
  for (size_t colon = message.find(':'); colon != std::string::npos; colon = message.find(':', colon + 1)) {
    for (digits = 0; std::isdigit(static_cast<unsigned char>(message[colon + 1 + digits])); ++digits) {}
    if (digits > 0) return message.substr(0, colon + 1 + digits) + ":";
  }
  return {};
}

// True if the message names a block that was made at `place`, as in: ... 'b3' (scene.lua:12) ...
bool contains_place(const std::string& message, const std::string& place) { return message.find("(" + place + ")") != std::string::npos; }

// Sort key of a message: 12 of "scene.lua:12: box: ...". Messages without a line (-D) come first, those on the whole file last.
int line_in(const std::string& file, const std::string& message) {
  if (!message.starts_with(file + ":")) return 0;
  const int line = std::atoi(message.c_str() + file.size() + 1);
  return line > 0 ? line : std::numeric_limits<int>::max();
}

// Splits a message of several lines (a masonry function reports all its mistakes at once) and gives each line the place.
void add_messages(std::vector<std::string>& mistakes, const std::string& message) {
  const std::string place = place_of(message);
  for (const auto& line : lines_of(message)) {
    const std::string whole = place.empty() || line.starts_with(place) ? line : place + " " + line;
    if (std::find(mistakes.begin(), mistakes.end(), whole) == mistakes.end()) mistakes.push_back(whole);
  }
}

// Such as tension, b.csv and -x.
bool is_bare_word(const std::string& text) {
  const std::size_t first = text.starts_with('-') ? 1 : 0;
  return text.size() > first && std::isalpha(static_cast<unsigned char>(text[first])) != 0 &&
         std::ranges::all_of(text, [](unsigned char c) { return std::isalnum(c) != 0 || std::strchr("_.-+", c) != nullptr; });
}

// Leaves the value of an expression on the stack.
void evaluate(lua_State* lua, Context& context, const std::string& expression, const std::string& name) {
  load_chunk(lua, context, "return " + expression, name);
  call_script(lua, context, 0, 2);
  const bool two = !lua_isnil(lua, -1);
  lua_pop(lua, two ? 2 : 1);
  if (two) throw Error(name + ": a comma parts two values; write one, with a decimal point: 0.4, not 0,4");
}

void evaluate_overrides(lua_State* lua, Context& context) {
  for (Override& item : context.overrides) {
    const std::string name = "-D " + item.name + "=" + item.expression;
    try {
      evaluate(lua, context, item.expression, name);
      item.is_word = lua_type(lua, -1) == LUA_TSTRING && is_plain(lua_tostring(lua, -1));
      if (!item.is_word && (lua_type(lua, -1) != LUA_TNUMBER || !std::isfinite(lua_tonumber(lua, -1))))
        throw Error(fmt::format("{}: the value must be a finite number, such as 0.8*g, not {}", name, described(lua, -1)));
      if (item.is_word) item.word = lua_tostring(lua, -1);
      else item.value = lua_tonumber(lua, -1);
      item.valid = true;
      lua_pop(lua, 1);
    } catch (const Error& error) {
      const std::string message = error.what(), place = name + ":1:";  // an expression has one line
      std::string said = message.starts_with(place) ? name + ":" + message.substr(place.size()) : message;
      if (is_bare_word(item.expression)) item.trouble = std::move(said);  // none for a param that takes a word: -D trend=tension
      else context.mistakes.push_back(said + (said.find("malformed number") == std::string::npos ? "" : "; a unit is a factor: 0.8*g"));
    }
  }
}

// Samples the waves that are Lua functions; the duration is known now. What a block is made to follow must be smooth.
void sample_waves(lua_State* lua, Context& context) {
  for (const Sampling& one : context.samplings) {
    if (!(one.sample > 0)) continue;  // a mistake that is told already
    Load& load = context.scene.loads[one.load];
    Samples s = sampled(lua, context, one.function, context.scene.analysis.duration, one.sample, one.place);
    const bool path = load.kind == Load::Kind::motion || load.kind == Load::Kind::turning;
    if (path) {
      carry_on(s);
      Curve curve = make_curve(std::move(s.times), std::move(s.values), false);
      curve.hold = true;
      load.wave = std::move(curve);
    } else load.wave = make_table(std::move(s.times), std::move(s.values), true);
  }
}

void resolve_groups(Context& context) {
  for (const GroupRecorder& item : context.group_recorders) {
    Recorder& recorder = context.scene.recorders[item.recorder];
    std::vector<std::string>& blocks = item.others ? recorder.others : recorder.blocks;
    const size_t named = blocks.size();  // by their own names
    std::vector<std::string> groups;
    for (const Block& block : context.scene.blocks) {
      if (block.group == item.group) blocks.push_back(block.name);
      else if (std::find(groups.begin(), groups.end(), block.group) == groups.end()) groups.push_back(block.group);
    }
    if (blocks.size() == named)
      context.mistake(recorder.place, fmt::format("recorder \"{}\": group \"{}\" has no blocks{}", recorder.name, item.group,
                                                  did_you_mean(item.group, groups)));
  }
}

// Names in -D and expect must exist, and the metrics of a study must have names of their own.
void check_names(Context& context) {
  std::vector<std::string> params, metrics;
  for (const Param& param : context.scene.params) params.push_back(param.name);
  for (const WordParam& param : context.words) params.push_back(param.name);
  for (const Metric& metric : context.metrics) metrics.push_back("metrics." + metric.name);
  for (const study::Study& study : context.studies)
    for (const std::string& name : metric_names(study)) {
      if (std::find(metrics.begin(), metrics.end(), "metrics." + name) != metrics.end())
        context.mistake(study.place,
                        fmt::format("the study answers metric \"{}\", which is there already; give the study another name = ...", name));
      metrics.push_back("metrics." + name);
    }
  for (const Override& item : context.overrides)
    if (!item.used && !context.study_file)
      context.mistake({}, fmt::format("-D {}={}: the scene has no param \"{}\"{}", item.name, item.expression, item.name,
                                      did_you_mean(item.name, params)));
  for (const study::Knob& knob : context.knobs)
    if (!knob.error.empty() && std::find(metrics.begin(), metrics.end(), knob.error) == metrics.end())
      context.mistake(knob.place, fmt::format("accuracy: error = \"{}\" is no metric of the scene{}", knob.error.substr(8),
                                              did_you_mean(knob.error, metrics)));
  const std::vector<std::string> keys = known_keys(context.scene);
  for (const Expectation& item : context.scene.expectations) {
    if (item.key.starts_with("metrics.")) {
      if (std::find(metrics.begin(), metrics.end(), item.key) == metrics.end())
        context.mistake(item.place,
                        fmt::format("expect: there is no metric \"{}\"{}", item.key.substr(8), did_you_mean(item.key, metrics)));
    } else if (std::find(keys.begin(), keys.end(), without_index(item.key)) == keys.end()) {
      context.mistake(item.place, fmt::format("expect: metrics.json has no key \"{}\"{}", item.key, did_you_mean(item.key, keys)));
    }
  }
}

// A study file makes no scene of its own. -D that it does not declare is for its scene.
void check_study(Context& context) {
  const Place place{context.scene.file, 0};
  if (!context.plan)
    context.mistake(place, "it calls neither study{ ... } nor calibration{ ... }, so it is no study; erbs run runs a scene");
  else if (!context.scene.blocks.empty())
    context.mistake(context.scene.blocks.front().place, "a study makes no blocks; they belong into its scene");
}

// Stored pictures name a camera of the scene, or an elevation, and a time within the run.
void check_pictures(Context& context) {
  std::vector<std::string> cameras{"from_-x", "from_+x", "from_-y", "from_+y", "from_above"};
  for (const Camera& camera : context.scene.cameras) cameras.push_back(camera.name);
  if (context.scene.cameras.empty()) cameras.insert(cameras.end(), {"corner", "side"});  // those of the renderer (render/run/framing.cpp)
  for (const PictureExpectation& item : context.scene.pictures) {
    if (std::find(cameras.begin(), cameras.end(), item.camera) == cameras.end())
      context.mistake(item.place,
                      fmt::format("expect_image: there is no camera \"{}\"{}", item.camera, did_you_mean(item.camera, cameras)));
    if (!context.scene.push.quasi_static() && item.t > context.scene.analysis.duration)
      context.mistake(item.place, fmt::format("expect_image: t = {} s is past the end of the run, {} s; choose an earlier time", item.t,
                                              context.scene.analysis.duration));
  }
}

// Applies the quality to values that the scene leaves open. Values of the scene take precedence.
void take_quality(Context& context) {
  for (const Quality& quality : qualities) {
    if (context.quality != quality.name) continue;
    if (!context.own_step) context.scene.analysis.dt_fraction = quality.dt_fraction;
    for (const size_t i : context.plain_rules)
      context.scene.joint_rules[i].points_long = context.scene.joint_rules[i].points_short = quality.points;
  }
}

}  // namespace

void load_chunk(lua_State* lua, Context& context, const std::string& text, const std::string& name) {
  // Lua shortens long paths in its messages
  const std::string name_shown = name.size() > 55 ? std::filesystem::path(name).filename().string() : name;
  if (std::find(context.files.begin(), context.files.end(), name_shown) == context.files.end()) context.files.push_back(name_shown);
  if (luaL_loadbufferx(lua, text.data(), text.size(), ("@" + name_shown).c_str(), "t") != LUA_OK) {
    const std::string message = printable(lua_tostring(lua, -1)).substr(0, 1000);
    lua_pop(lua, 1);
    if (message.starts_with(name_shown + ":")) throw Error(message);
    if (message.find("binary chunk") != std::string::npos) throw Error("attempt to load a binary chunk; a scene is text", {name_shown, 0});
    throw Error(message + "; is something nested too deeply?", {name_shown, 0});
  }
  lua_getfield(lua, LUA_REGISTRYINDEX, scene_key);
  lua_setupvalue(lua, -2, 1);
}

Script::Script() : Script(Options{}) {}

Script::Script(const Options& options) : context_(std::make_unique<Context>()) {
  context_->limits.seconds = options.seconds;
  context_->limits.bytes = options.bytes;
  context_->allowed = options.allow;
  context_->scene.most_blocks = options.most_blocks;
  context_->scene.most_points = options.most_points;
  context_->quiet = options.quiet;
  context_->study_file = options.study_file;
  context_->study = options.study;
  context_->quality = options.quality;
  context_->quality_set = !options.quality.empty();
  lua_ = open_sandbox(*context_);
  const Cap uncapped(context_->limits, false);
  open_language(lua_, *context_, options.noise);
}

Script::~Script() {
  if (lua_) lua_close(lua_);
}

const Scene& Script::load(const std::string& path, const Overrides& overrides) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) throw Error(fmt::format("{} is a folder; name the scene file in it", path));
  if (!std::filesystem::exists(path, ignored)) throw Error(fmt::format("there is no scene {}; check the path", path));
  if (std::filesystem::is_character_file(path, ignored) || std::filesystem::is_block_file(path, ignored))
    throw Error(fmt::format("{} is a device, not a scene; name a Lua script", path));  // some never end
  const std::string text = read_input(*context_, path, {});
  run(text, path, overrides);
  return context_->scene;
}

const Scene& Script::load_text(const std::string& text, const std::string& name, const Overrides& overrides) {
  run(text, name, overrides);
  return context_->scene;
}

PerformanceDemand Script::load_spectrum(const std::string& keys, const std::string& name) {
  run("spectrum{ " + keys + "\n}", name, {}, true);
  PerformanceDemand demand = context_->scene.performance;
  std::vector<std::string> mistakes = check_spectrum(demand.spectrum);
  for (std::string& mistake : mistakes) mistake = name + ": " + mistake;
  if (!mistakes.empty()) throw Errors(mistakes);
  return demand;
}

double Script::number(const std::string& expression, const std::string& name) {
  const Stretch stretch(lua_, *context_);
  evaluate(lua_, *context_, expression, name);
  const double value = lua_type(lua_, -1) == LUA_TNUMBER ? lua_tonumber(lua_, -1) : NAN;
  lua_pop(lua_, 1);
  return value;
}

// `part`: of a scene; what only a whole one has is not checked.
void Script::run(const std::string& text, const std::string& name, const Overrides& overrides, bool part) {
  Context& context = *context_;
  context.scene.file = name;
  context.scene.name = std::filesystem::path(name).stem().string();
  context.folder = std::filesystem::path(name).parent_path();
  for (const auto& [param, expression] : overrides) {
    for (const Override& other : context.overrides)
      if (other.name == param)
        context.mistake({}, fmt::format("-D {}={}: {} was given before, as {}; keep one", param, expression, param, other.expression));
    context.overrides.push_back({param, expression});
  }
  const Stretch stretch(lua_, context);
  const Cap uncapped(context.limits, false);
  bool whole = true;
  try {
    evaluate_overrides(lua_, context);
    if (context.limits.expired) throw Errors(context.mistakes);  // no time is left for the script
    load_chunk(lua_, context, readable(text, name), name);
    call_script(lua_, context, 0, 0);
  } catch (const std::exception& error) {
    whole = false;
    if (!context.incomplete || context.limits.expired) add_messages(context.mistakes, error.what());
  }
  finish(whole && !context.incomplete && !part);
  lua_gc(lua_, LUA_GCCOLLECT, 0);  // frees the garbage of reading; functions of metrics stay
}

// Settles all items that need the whole script, checks the scene and throws all mistakes at once.
void Script::finish(bool whole) {
  Context& context = *context_;
  const Doing doing(context.limits, context.scene.file + ": checking the scene", true);
  take_quality(context);
  if (whole) try {
      resolve_groups(context);
      check_names(context);
      if (context.study_file) check_study(context);
      check_pictures(context);
      sample_waves(lua_, context);
    } catch (const std::exception& error) { add_messages(context.mistakes, error.what()); }
  if (whole && !context.study_file) {
    // Drops messages on lines that reading has already reported.
    const std::vector<std::string> read = context.mistakes;
    std::vector<std::string> found = check(context.scene);
    for (auto& message : check_recorders(context.scene)) found.push_back(std::move(message));
    for (const auto& message : found) {
      const std::string place = place_of(message);
      const auto same = [&](const std::string& other) { return !place.empty() && place_of(other) == place; };
      if (std::none_of(read.begin(), read.end(), same)) context.mistakes.push_back(message);
    }
    // The build reports overlaps of a correct scene; a scene with mistakes never gets there, so its overlaps are reported here. A block
    // from a line with a mistake may stand in the wrong place: its overlaps are left out.
    if (!context.mistakes.empty()) {
      const std::vector<std::string> said = context.mistakes;
      for (const auto& message : overlap_mistakes(context.scene)) {
        const auto doubtful = [&](const std::string& other) {
          const std::string place = place_of(other);
          return !place.empty() && contains_place(message, place.substr(0, place.size() - 1));
        };
        if (std::none_of(said.begin(), said.end(), doubtful)) context.mistakes.push_back(message);
      }
    }
  }
  if (!context.study.empty()) {
    context.scene.expectations.clear();
    context.scene.pictures.clear();
    const auto asked = std::ranges::find(context.metrics, "study", &Metric::name);  // it may use those above it
    context.metrics.erase(asked == context.metrics.end() ? context.metrics.begin() : asked + 1, context.metrics.end());
  }
  if (context.mistakes.empty()) return;
  std::stable_sort(context.mistakes.begin(), context.mistakes.end(), [&](const std::string& a, const std::string& b) {
    return line_in(context.scene.file, a) < line_in(context.scene.file, b);
  });
  throw Errors(context.mistakes);
}

const std::vector<study::Study>& Script::studies() const { return context_->studies; }
const std::vector<study::Knob>& Script::knobs() const { return context_->knobs; }

const std::optional<study::Plan>& Script::plan() const { return context_->plan; }

Overrides Script::unused_overrides() const {
  Overrides unused;
  for (const Override& item : context_->overrides)
    if (!item.used) unused.emplace_back(item.name, item.expression);
  return unused;
}

std::vector<std::string> Script::param_names() const {
  std::vector<std::string> names;
  for (const Param& param : context_->scene.params) names.push_back(param.name);
  for (const WordParam& param : context_->words) names.push_back(param.name);
  return names;
}

bool Script::takes_word(const std::string& param) const {
  return std::any_of(context_->words.begin(), context_->words.end(), [&](const WordParam& one) { return one.name == param; });
}

const std::vector<Figure>& Script::figures() const { return context_->figures; }
const ParamFamily& Script::family() const { return context_->family; }

const Scene& Script::scene() const { return context_->scene; }

Scene Script::take_scene() {
  std::vector<Block> blocks = std::exchange(context_->scene.blocks, {});
  Scene scene = context_->scene;
  scene.blocks = std::move(blocks);
  return scene;
}

const std::vector<std::string>& Script::output() const { return context_->output; }

std::string without_index(const std::string& key) {
  const size_t dot = key.rfind('.');
  const bool index = dot != std::string::npos && dot + 1 < key.size() && key.find_first_not_of("0123456789", dot + 1) == std::string::npos;
  return index ? key.substr(0, dot) : key;
}

std::vector<std::string> known_keys(const Scene& scene) {
  std::set<std::string> groups;
  for (const Block& block : scene.blocks) groups.insert(block.group);
  groups.erase("");
  return metric_keys({groups.begin(), groups.end()});
}

}  // namespace erbs::lua
