// The function of a study file that erbs calibrate runs: calibration{}, which fits params of a scene to known values.
#include <algorithm>
#include <cmath>
#include <lua5.4/lua.hpp>

#include "engine/base/text.h"
#include "engine/study/calibrate/calibrate.h"
#include "lua/language/api.h"
#include "lua/language/sweep/ranges.h"

namespace erbs::lua {
namespace {

const Keys& stage_keys() {
  static const Keys keys = {{"fit", "table", "", "ranges of params to fit by least squares: { kn = { 1e9, 1e12, log = true } }"},
                            {"raise", "table", "", "instead: the range of one param, raised until `key` is below `below`"},
                            {"key", "string", "", "with raise: a dotted key of metrics.json"},
                            {"below", "number", "", "with raise: the number", -1e300, 1e300}};
  return keys;
}

const Keys& target_keys() {
  static const Keys keys = {
      {"label", "string", "", "what they are, with the unit: label of the axis", -unbounded, unbounded, true},
      {"keys", "strings", "", "dotted keys of metrics.json", -unbounded, unbounded, true},
      {"values", "numbers", "", "wanted, as many as keys", -unbounded, unbounded, true},
      {"scale", "number", "", "a residual is (got - wanted) / scale (default: the largest of the values)", 1e-300, 1e300}};
  return keys;
}

const Keys& history_keys() {
  static const Keys keys = {{"column", "string", "", "column of histories.csv", -unbounded, unbounded, true},
                            {"label", "string", "", "label of its axis: quantity and unit", -unbounded, unbounded, true},
                            {"known", "string", "", "name of the known curve", -unbounded, unbounded, false, "", "known"},
                            {"t", "numbers", "s", "its times, rising", -unbounded, unbounded, true},
                            {"values", "numbers", "", "as many as t", -unbounded, unbounded, true}};
  return keys;
}

// The ranges in the table `key` of the table on top of the stack.
std::vector<study::Range> ranges_in(Call& call, const char* key) {
  std::vector<study::Range> ranges;
  lua_getfield(call.lua, -1, key);
  if (lua_istable(call.lua, -1)) {
    const int index = lua_absindex(call.lua, -1);
    for (const std::string& name : names_of(call, index))
      if (auto range = range_of(call, index, name)) ranges.push_back(*range);
  }
  lua_pop(call.lua, 1);
  return ranges;
}

study::CalibrationStage read_stage(Call& call, Arguments& table, int number) {
  study::CalibrationStage stage;
  table.read("key", stage.key);
  table.read("below", stage.below);
  lua_getfield(call.lua, 1, "stages");
  lua_rawgeti(call.lua, -1, number);
  const bool fits = table.has("fit"), raises = table.has("raise");
  stage.params = ranges_in(call, raises ? "raise" : "fit");
  lua_pop(call.lua, 2);
  if (fits == raises) table.mistake("give fit or raise, one of them, such as { fit = { kn = { 1e9, 1e12, log = true } } }");
  else if (raises && (!table.has("key") || !table.has("below")))
    table.mistake("raise goes on until key is below a number; give key and below");
  else if (fits && (table.has("key") || table.has("below")))
    table.mistake("key and below belong to raise; remove them from a stage that fits");
  else if (raises && stage.params.size() > 1) table.mistake("raise takes one param; write a stage for each");
  else if (stage.params.empty())
    table.mistake(fmt::format("{} names no param; give ranges, such as {{ kn = {{ 1e9, 1e12, log = true }} }}", raises ? "raise" : "fit"));
  return stage;
}

study::CalibrationTarget read_target(Arguments& table) {
  study::CalibrationTarget target;
  table.read("label", target.label);
  table.read("keys", target.keys);
  table.read("values", target.values);
  if (target.keys.size() != target.values.size() || target.keys.empty()) table.mistake("give as many values as keys, at least one");
  double largest = 0;
  for (const double value : target.values) {
    if (!std::isfinite(value)) table.mistake("its values must be finite");
    largest = std::max(largest, std::fabs(value));
  }
  target.scale = largest > 0 ? largest : 1;
  table.read("scale", target.scale);
  return target;
}

study::KnownHistory read_history(Arguments& table) {
  study::KnownHistory known;
  known.known = "known";
  table.read("column", known.column);
  table.read("label", known.label);
  table.read("known", known.known);
  table.read("t", known.t);
  table.read("values", known.values);
  if (known.t.size() != known.values.size() || known.t.size() < 2) table.mistake("give as many values as times t, at least two");
  else if (!std::is_sorted(known.t.begin(), known.t.end())) table.mistake("its times t must rise");
  return known;
}

// The ends of all ranges, so that params and words are checked as those of a sweep.
std::vector<study::Axis> ends_of(const study::Calibration& calibration, const Place& place) {
  std::vector<study::Axis> axes;
  for (const study::CalibrationStage& stage : calibration.stages)
    for (const study::Range& range : stage.params) {
      if (std::any_of(axes.begin(), axes.end(), [&](const study::Axis& axis) { return axis.params.front() == range.param; })) continue;
      study::Axis axis;
      axis.params = {range.param};
      axis.rows = {{range.lo}, {range.hi}};
      axis.place = place;
      axes.push_back(std::move(axis));
    }
  return axes;
}

int calibrate(Call& call) {
  Context& context = call.context;
  Arguments arguments = call.arguments();
  if (context.plan) arguments.mistake(fmt::format("one was given before, at {}; write one a file", context.plan->place.text()));
  study::Plan plan;
  study::Calibration calibration;
  plan.place = call.place;
  plan.keep = "none";
  plan.max_wall = 3600;
  arguments.read("scene", plan.scene);
  arguments.read("title", plan.title);
  arguments.read("max_wall", plan.max_wall);
  arguments.read("rel", calibration.rel);
  calibration.rel_given = arguments.has("rel");
  arguments.read("rounds", calibration.rounds);
  int number = 0;
  for (Arguments& table : arguments.tables("stages", stage_keys())) calibration.stages.push_back(read_stage(call, table, ++number));
  for (Arguments& table : arguments.tables("targets", target_keys())) calibration.targets.push_back(read_target(table));
  if (auto table = arguments.table("history", history_keys())) calibration.history = read_history(*table);
  if (calibration.stages.empty()) arguments.mistake("it fits nothing; give stages = { { fit = { kn = { 1e9, 1e12, log = true } } } }");
  if (calibration.targets.empty())
    arguments.mistake("it has no targets; give targets = { { label = \"...\", keys = { ... }, values = { ... } } }");
  if (!context.study_file) arguments.mistake("put it into a file of its own, which erbs calibrate runs");
  plan.collect = calibrated_keys(calibration);
  plan.axes = ends_of(calibration, call.place);
  plan.calibration = std::move(calibration);
  context.plan = std::move(plan);
  return 0;
}

}  // namespace

std::vector<Function> calibration_functions() {
  return {{"calibration",
           calibrate,
           "{ ... }",
           "",
           "Fits params of a scene to known values by least squares, by erbs calibrate.",
           {{"scene", "string", "", "the scene, a path from the folder of this file", -unbounded, unbounded, true},
            {"stages", "list", "", "one after the other, each with what those before it have found", -unbounded, unbounded, true, "", "",
             stage_keys()},
            {"targets", "list", "", "known values of metrics", -unbounded, unbounded, true, "", "", target_keys()},
            {"history", "table", "", "a known history to draw beside that of the fitted run", -unbounded, unbounded, false, "", "",
             history_keys()},
            {"title", "string", "", "title of calibration.svg"},
            {"rel", "number", "", "smallest step of a fit and last bracket of a raise (0.02 without rel), shares of the range of a param",
             1e-9, 0.5, false, "", "0.001"},
            {"rounds", "integer", "", "steps of a stage, at most", 1, 1000, false, "", "20"},
            {"max_wall", "number", "s", "longest time of a run", 1e-3, 1e7, false, "", "3600"}}}};
}

}  // namespace erbs::lua
