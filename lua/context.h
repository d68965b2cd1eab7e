// What a script has said so far: the Scene and all that is settled only when the script has ended.
#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "engine/scene/scene.h"
#include "engine/study/study.h"
#include "lua/family.h"
#include "lua/sandbox.h"

namespace erbs {

// x -> turn x + shift: where the things built inside transform{} go.
struct Frame {
  Quat turn = Quat::Identity();
  Vec3 shift = Vec3::Zero();  // m
  Vec3 point(const Vec3& x) const { return turn * x + shift; }
  Vec3 vector(const Vec3& x) const { return turn * x; }
};

// A number a run is asked for: given, or a function called after the run.
struct Metric {
  std::string name, unit;
  double value = 0;
  int function = -2;  // reference in the Lua registry; LUA_NOREF where the value is given
  Place place;
};

// Curves that a scene draws of its studies, beside what is known.
struct FigureCurve {
  std::string label, study;          // the answers of a study over its param, ...
  std::vector<std::string> metrics;  // ... or metrics over x, ...
  std::vector<double> x, y;          // ... or numbers
  bool measured() const { return y.empty(); }
};
struct Figure {
  std::string name, title, x, y;  // x, y: of the axes
  std::vector<FigureCurve> curves;
  Place place;
};

// A load whose wave is a Lua function, sampled once the duration of the run is known.
struct Sampling {
  size_t load = 0;       // index into Scene::loads
  int function = -2;     // reference in the Lua registry
  double sample = 1e-3;  // s
  Place place;
};

struct Override {
  std::string name, expression;  // of -D name=expression
  double value = 0;
  bool sound = false;  // the expression gave a number; else a mistake is noted and the default holds
  bool used = false;
};

// A recorder of a group: its blocks are known when the script has ended.
struct GroupRecorder {
  size_t recorder = 0;  // index into Scene::recorders
  std::string group;
  bool others = false;  // the other side of its joints
};

struct RunResults;

struct Context {
  Limits limits;
  Scene scene;
  std::vector<std::string> mistakes;
  std::vector<Frame> frames{Frame{}};  // of the transform{} calls being built; the last holds
  std::vector<int> materials;          // those of material{}, not the ones ground{} makes for itself
  std::vector<Law> laws;               // values of mortar{} and dry{}: a script holds an index
  std::vector<Wave> waves;             // values of sine{} ... record{}
  std::vector<Override> overrides;
  std::vector<Metric> metrics;
  std::vector<Sampling> samplings;
  std::vector<Study> studies;
  std::vector<Figure> figures;
  ParamFamily family;
  std::string study;  // the one that started this run; "" where none did
  std::vector<GroupRecorder> group_recorders;
  std::string quality;              // of analysis{}, or of the command line, which comes first; "": none is asked for
  bool quality_set = false;         // by the command line
  bool own_step = false;            // analysis{} says dt or dt_fraction
  std::vector<size_t> plain_rules;  // joint rules that say neither rule nor points
  std::vector<std::string> output;  // what the script printed
  size_t printed = 0;               // bytes of it
  std::filesystem::path folder;     // of the scene file
  std::vector<std::string> allowed;  // further folders that the scene may read
  std::vector<std::string> files;   // names of the chunks that are the user's
  bool incomplete = false;          // masonry with mistakes was left out: what follows from its absence is no mistake
  const RunResults* run = nullptr;  // while metrics are evaluated
  int includes = 0;                 // depth of include at the moment
  bool quiet = false;               // print writes to output only
  int repeated = 0;                 // mistakes that were noted before
  size_t taken = 0, calls = 0;      // bytes and calls of the language since memory was looked at

  const Frame& frame() const { return frames.back(); }
  // Adds one mistake of the user's; the script goes on, so that all are reported at once. Ends the script when there are very many.
  void mistake(const Place& place, const std::string& message);
  // Counts what a call of the language keeps outside of Lua; throws Error where all memory together is past its limit.
  void took(size_t bytes);
};

Context& context_of(lua_State* lua);

// The script line being run: the innermost that belongs to the user's files, not to the parts of the language written in Lua.
Place current_place(lua_State* lua);

}  // namespace erbs
