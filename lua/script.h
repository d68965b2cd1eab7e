// A scene script: loaded into a Scene, and kept alive for the functions called after the run.
#pragma once
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/record/csv.h"
#include "engine/record/json.h"
#include "engine/scene/scene.h"
#include "engine/study/study.h"

struct lua_State;

namespace erbs {

struct Context;
struct ParamFamily;
struct Figure;

// What -D name=expression says.
using Overrides = std::vector<std::pair<std::string, std::string>>;

// What a run left behind, for metric functions.
struct RunResults {
  Json metrics;        // metrics.json
  CsvTable histories;  // histories.csv; its first column is time_s
  CsvTable events;     // events.csv: time_s, event, name, value, unit
};

struct MetricValue {
  std::string name, unit;
  std::optional<double> value;  // none: the function gave nil, or failed
  std::string error;            // why it failed, with file and line; "" where it did not
};

class Script {
 public:
  struct Options {
    double seconds = 10;               // a script may run this long
    size_t bytes = size_t{512} << 20;  // and use this much
    bool quiet = false;                // do not echo print to stderr
    std::string study = {};            // the study that started this run: only its question is asked, nothing expected
    std::string quality = {};          // instead of that of analysis{}; "": as the scene says
    std::vector<std::string> allow = {};  // folders it may read besides its own
    int most_blocks = Scene().most_blocks, most_points = Scene().most_points;  // of a scene
    double noise = 0;                  // in the start of every free block [m and rad]: start_noise of the script
  };
  Script();
  explicit Script(const Options& options);
  ~Script();

  // Runs the script once and gives its Scene. Throws Errors with every mistake.
  const Scene& load(const std::string& path, const Overrides& overrides = {});
  const Scene& load_text(const std::string& text, const std::string& name, const Overrides& overrides = {});

  // The numbers the scene asks for by metric{}, in its order.
  std::vector<MetricValue> evaluate_metrics(const RunResults& results);

  const Scene& scene() const;
  Scene take_scene();  // scene() with its blocks, of which the script keeps none
  const std::vector<Study>& studies() const;
  const std::vector<Figure>& figures() const;
  const ParamFamily& family() const;  // no values: the scene declares none
  const std::vector<std::string>& output() const;  // what it printed
  // The functions written in Lua (walls, arches): name, line of help, keys; from the list masonry_functions.
  Json lua_functions();

 private:
  void run(const std::string& text, const std::string& name, const Overrides& overrides);
  void finish(bool whole);
  std::unique_ptr<Context> context_;
  lua_State* lua_ = nullptr;
};

}  // namespace erbs
