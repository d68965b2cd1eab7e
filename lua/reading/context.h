// State of a script while it runs: the Scene so far, and all items that can be settled only when the script has ended.
#pragma once
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "engine/scene/scene.h"
#include "engine/study/accuracy.h"
#include "engine/study/study.h"
#include "engine/study/sweep/design.h"
#include "lua/reading/family.h"
#include "lua/reading/sandbox.h"

namespace erbs::lua {

// x -> rotation x + shift: the transformation of everything that is built inside transform{}.
struct Frame {
  Quat rotation = Quat::Identity();
  Vec3 shift = Vec3::Zero();  // m
  Vec3 point(const Vec3& x) const { return rotation * x + shift; }
  Vec3 vector(const Vec3& x) const { return rotation * x; }
};

// A number that a run shall report: a given value, or a function called after the run.
struct Metric {
  std::string name, unit;
  double value = 0;
  int function = -2;  // reference in the Lua registry; LUA_NOREF if the value is given
  Place place;
  std::string question;  // of a study: the words of its function, such as: value of ensemble "falls_at"; "" of a metric of the scene
};

// One curve of a figure.
struct FigureCurve {
  std::string label, study;          // the results of a study over its param, ...
  std::vector<std::string> metrics;  // ... or metrics over x, ...
  std::vector<double> x, y;          // ... or given numbers y over x
  bool measured() const { return y.empty(); }
};
struct Figure {
  std::string name, title, x, y;  // x, y: labels of the axes
  std::vector<FigureCurve> curves;
  Place place;
};

// A load whose wave is a Lua function. The function is sampled when the duration of the run is known.
struct Sampling {
  size_t load = 0;       // index into Scene::loads
  int function = -2;     // reference in the Lua registry
  double sample = 1e-3;  // s
  Place place;
};

struct Override {
  std::string name, expression;  // of -D name=expression
  double value = 0;
  std::string word = {};  // instead of a number, for a param that is a word
  bool is_word = false;   // the expression gave a word
  bool valid = false;     // the expression gave a value; otherwise a mistake is reported and the default holds
  bool used = false;
  std::string trouble = {};  // of an expression that may be a word without quotes
};

// A recorder of a group. The blocks of the group are known only when the script has ended.
struct GroupRecorder {
  size_t recorder = 0;  // index into Scene::recorders
  std::string group;
  bool others = false;  // the group of the blocks on the other side of its joints
};

// A param whose value is a word, such as the name of a record.
struct WordParam {
  std::string name, value;
  Place place;
};

struct RunResults;

struct Context {
  Limits limits;
  Scene scene;
  std::vector<std::string> mistakes;
  std::vector<Frame> frames{Frame{}};  // transform{} calls under way; the last one applies
  std::vector<int> materials;          // indices of the materials of material{}, without the ones that ground{} makes for itself
  std::vector<Law> laws;               // values of mortar{} and dry{}; a script holds an index
  std::vector<Wave> waves;             // values of sine{} ... record{}; a script holds an index
  std::vector<Override> overrides;
  std::vector<Metric> metrics;
  std::vector<Sampling> samplings;
  std::vector<study::Study> studies;
  std::vector<study::Knob> knobs;  // of accuracy{}
  std::vector<Figure> figures;
  ParamFamily family;
  Place gravity;  // of gravity()
  std::vector<WordParam> words;
  bool study_file = false;          // the script is a study for erbs sweep, not a scene
  std::optional<study::Plan> plan;  // of study{}
  std::vector<study::Axis> axes;    // values of grid{} ... records{}; a script holds the number of a group of axes
  int axis_groups = 0;
  std::string study;  // name of the study that started this run; "" if no study did
  std::vector<GroupRecorder> group_recorders;
  std::string quality;               // from the command line, otherwise from analysis{}; "": neither gives one
  bool quality_set = false;          // the command line gives the quality
  bool own_step = false;             // analysis{} gives dt or dt_fraction
  bool own_direction = false;        // analysis{} gives the direction of a push
  std::vector<size_t> plain_rules;   // joint rules that give neither rule nor points
  std::vector<std::string> output;   // what the script printed
  size_t printed = 0;                // bytes of `output`
  std::filesystem::path folder;      // of the scene file
  std::vector<std::string> allowed;  // further folders that the scene may read
  std::vector<std::string> files;    // names of the chunks that belong to the user
  bool incomplete = false;           // masonry with mistakes was left out; mistakes that follow from its absence are not reported
  const RunResults* run = nullptr;   // while metrics are evaluated
  std::string unseen;                // a metric of the scene that the one at hand asks `run` for, in vain
  int includes = 0;                  // current depth of include
  bool quiet = false;                // print writes to `output` only
  int repeated = 0;                  // mistakes that were already reported
  size_t taken = 0, calls = 0;       // bytes and calls of the API since the last check of memory

  const Frame& frame() const { return frames.back(); }
  // Adds one mistake of the user. The script continues, so that all mistakes are reported at once; it ends when there are very many.
  void mistake(const Place& place, const std::string& message);
  size_t told() const { return mistakes.size() + static_cast<size_t>(repeated); }
  // Counts the bytes that a call of the API keeps outside Lua. Throws Error if the total memory exceeds its limit.
  void took(size_t bytes);
};

Context& context_of(lua_State* lua);

// The script line that runs now: the innermost one in a file of the user, not in the parts of the language written in Lua.
Place current_place(lua_State* lua);

}  // namespace erbs::lua
