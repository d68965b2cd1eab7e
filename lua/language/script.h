// A scene script. It is loaded into a Scene and stays alive for the functions that are called after the run.
#pragma once
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/record/format/csv.h"
#include "engine/record/format/json.h"
#include "engine/scene/scene.h"
#include "engine/study/accuracy.h"
#include "engine/study/study.h"
#include "engine/study/sweep/design.h"

struct lua_State;

namespace erbs::lua {

struct Context;
struct ParamFamily;
struct Figure;

// Name and expression of each -D name=expression.
using Overrides = std::vector<std::pair<std::string, std::string>>;

// Results of a run, for metric functions.
struct RunResults {
  Json metrics;        // metrics.json
  CsvTable histories;  // histories.csv; its first column is time_s
  CsvTable events;     // events.csv: time_s, event, name, value, unit
};

struct MetricValue {
  std::string name, unit;
  std::optional<double> value;  // none if the function returned nil or no finite number, or failed
  std::string error;            // reason of the failure, with file and line; "" without one
  std::string warning;          // of a number that is not finite; "" without one
};

class Script {
 public:
  struct Options {
    double seconds = 10;                  // s, time limit of the script
    size_t bytes = size_t{512} << 20;     // memory limit of the script
    bool quiet = false;                   // do not echo print to stderr
    std::string study = {};               // study that started this run; such a run evaluates only its question and no expectations
    std::string quality = {};             // takes precedence over the quality of analysis{}; "": none is given
    std::vector<std::string> allow = {};  // folders it may read besides its own
    int most_blocks = Scene().most_blocks, most_points = Scene().most_points;  // limits of a scene
    bool study_file = false;                                                   // the script is a study for erbs sweep, not a scene
    double noise = 0;  // m and rad, noise in the initial state of every free block: start_noise of the script
  };
  Script();
  explicit Script(const Options& options);
  ~Script();

  // Runs the script once and returns its Scene. Throws Errors with all mistakes.
  const Scene& load(const std::string& path, const Overrides& overrides = {});
  const Scene& load_text(const std::string& text, const std::string& name, const Overrides& overrides = {});

  // A call of spectrum{} by its keys alone, as on a command line: kind = "TBSC 2018", SDS = 0.9, SD1 = 0.25. Throws Errors.
  PerformanceDemand load_spectrum(const std::string& keys, const std::string& name);

  // Value of an expression with units, as on a command line: 2*mm. Not a number if it is something else. Throws Error for no expression.
  double number(const std::string& expression, const std::string& name);

  // The metrics of the scene, in its order.
  std::vector<MetricValue> evaluate_metrics(const RunResults& results);

  const Scene& scene() const;
  Scene take_scene();  // scene() with its blocks, which the script gives up
  const std::vector<study::Study>& studies() const;
  const std::vector<study::Knob>& knobs() const;  // of accuracy{}
  const std::vector<Figure>& figures() const;
  const std::optional<study::Plan>& plan() const;   // of study{}
  Overrides unused_overrides() const;               // -D for params that the script does not declare
  std::vector<std::string> param_names() const;     // in the order of their declaration, those that take words last
  bool takes_word(const std::string& param) const;  // its value is a word, not a number
  const ParamFamily& family() const;                // without values if the scene declares none
  const std::vector<std::string>& output() const;   // lines the script has printed
  // Entries of masonry_functions, the functions written in Lua (walls, arches): name, help, keys.
  Json lua_functions();

 private:
  void run(const std::string& text, const std::string& name, const Overrides& overrides, bool part = false);
  void finish(bool whole);
  std::unique_ptr<Context> context_;
  lua_State* lua_ = nullptr;
};

std::vector<std::string> known_keys(const Scene& scene);  // of metrics.json but for its own metrics
std::string without_index(const std::string& key);        // "collapse.direction.0" -> "collapse.direction"

}  // namespace erbs::lua
