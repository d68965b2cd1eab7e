// Options of the command line.
#pragma once
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/loads/record/record.h"
#include "lua/language/script.h"

namespace erbs::lua {

// How a scene is read.
struct SceneOptions {
  Overrides overrides;                 // -D name=value
  std::vector<std::string> allow;      // folders that a scene may read besides its own
  int max_blocks = 0, max_points = 0;  // limits of a scene; 0: the limits of Scene
  bool allow_unstable = false;
};

// Where results go.
struct OutputOptions {
  std::string directory;  // -o; "": chosen by the verb
  bool force = false, quiet = false;
};

// How runs are made side by side.
struct BatchOptions {
  int jobs = 0;                    // runs at once; 0: as many as the machine has
  int threads = 0;                 // of each; 0: chosen by their number
  std::optional<double> max_wall;  // s, wall clock of each
  double budget = 0;               // s, wall clock of all; 0: none
  bool resume = false;             // keep finished runs
  bool quiet = false;
};

// Changes of a scene.
struct SceneChanges {
  std::optional<double> dt_fraction;  // of dt_critical
  int points = 0;                     // contact points per joint, a square number; 0: as the scene says
  std::string rule;                   // quadrature rule of the contact points; "": as the scene says
  std::vector<std::string> settings;  // key=value of analysis{}
  std::optional<double> stiffness;    // factor on the stiffness of every joint
  std::optional<double> damping;      // 1/s, mass damping
  std::string damping_form;           // "": as the scene says
  std::optional<double> from;         // s, time at which the loads begin
  std::vector<std::string> without;   // effects that are switched off
  double noise = 0;                   // m and rad, noise in the initial state of every free block
  int noise_seed = 1;
  double push_to = 0;  // m, displacement of the monitored point at which a pushover ends; 0: as the scene says
};

// What each verb reads; words: its arguments, such as scenes, folders, files.
struct RunCommand {
  std::vector<std::string> words;
  OutputOptions output;
  SceneOptions scene;
  SceneChanges changes;
  int threads = 0;              // 0: as many as the machine has
  int jobs = 0;                 // runs of its studies at once; 0: as many as threads, else one per processor
  std::optional<double> until;  // s, simulated
  bool resume = false;
  std::optional<double> max_wall, checkpoint_every;  // s, wall clock
  bool video = false, log_json = false, profile = false, fail_on_collapse = false;
  bool figures = true;          // draw the curves of a run
  bool figure_scripts = false;  // write the figures of figure{} as gnuplot scripts, which a book draws later
  std::string study;            // name of the study that started this run
  bool studies = true;          // make the runs of the scene's studies
  bool twin = false;
  double twin_noise = 0;  // m and rad, further noise from another seed, which makes a twin
};
struct CheckCommand {
  std::vector<std::string> words;
  SceneOptions scene;
  bool quiet = false;
};
struct RecordCommand {
  std::vector<std::string> words;
  OutputOptions output;
  Record record;  // --dt, --unit, --column
};
struct ExportCommand {
  std::vector<std::string> words, formats, short_forms;  // formats: of --format; short_forms: further ones; none: gltf
  OutputOptions output;
  std::string time;  // --time T0:T1
  int every = 1;
  double at = NAN;  // s, of an OBJ
};
struct PlotCommand {
  std::vector<std::string> words, y;
  std::string x = "time_s";
  OutputOptions output;  // directory: the picture
  std::string time;      // --time T0:T1
  bool spectrum = false, response = false, envelope = false, drift = false, list = false, png = false;
  int levels = 24;                // of --drift
  std::string histogram;          // --histogram: normal_stress or shear_stress
  std::string group;              // of --drift; "": all blocks
  std::optional<double> damping;  // ratio, of --response
};
struct ReportCommand {
  std::vector<std::string> words;
  OutputOptions output;  // directory: the page
};
struct CompareCommand {
  std::vector<std::string> words, columns;  // words: run and reference; columns: RUN=REFERENCE
  OutputOptions output;
  std::string align, expect;      // align: none, first-motion, correlation; "": as the reference asks
  double reach = 5;               // s, largest lag
  std::string time;               // --time T0:T1
  std::vector<std::string> film;  // options for erbs-render, each with its value
};
struct SweepCommand {
  std::vector<std::string> words;
  OutputOptions output;
  SceneOptions scene;
  int jobs = 0;  // runs at once, or tasks of the job array; 0: chosen by the verb
  bool resume = false, slurm = false;
};
struct CalibrateCommand {
  std::vector<std::string> words;
  OutputOptions output;
  SceneOptions scene;
  int jobs = 0;  // runs at once; 0: one per processor
  bool resume = false;
};
struct TestCommand {
  std::vector<std::string> words;
  SceneOptions scene;
  BatchOptions batch;
  std::string directory;
  bool quick = false, grid = false;
  bool bless = false;  // store pictures and values of the runs beside the scenes, where they differ from those stored
  int seeds = 0;       // every scene with seeds 1 to this number; 0: as the scene says
  std::string book;    // path of the book; "": none is written
};
struct AccuracyCommand {
  std::vector<std::string> words;
  OutputOptions output;
  SceneOptions scene;
  BatchOptions batch;
  double target = 0;               // wanted relative error; 0: none
  double budget = 0;               // s, wall clock of one run; of all runs of a map; 0: none
  double within = 120;             // s, wall clock of all runs of a scene together; 0: no limit
  std::string quantity;            // the quantity of the figure; "": chosen by the program
  std::vector<std::string> knobs;  // chosen ones by their names, or PARAM=V1,V2,... from coarse to fine; empty: all
  bool whole_study = false;        // all problems of a folder
  bool map = false;                // stability map of step, stiffness and damping
  double window = 0;               // s around the peak of the ground motion, for a map; 0: 2 s
};
struct LimitCommand {
  std::vector<std::string> words;
  OutputOptions output;  // directory: "" writes no files
  SceneOptions scene;
  std::string direction;  // "": the scene's
  int facets = 0;         // of friction cones; 0: round cones
  bool no_tension = false, associated = false;
};
struct CapacityCommand {
  std::vector<std::string> words;  // run folder, and keys of spectrum{} as in a scene
  OutputOptions output;            // directory: the JSON file
  bool figures = true;
};
struct BenchCommand {
  std::vector<std::string> words;
  OutputOptions output;
  SceneOptions scene;
};
struct EffectsCommand {
  std::vector<std::string> words;
  OutputOptions output;
  SceneOptions scene;
  BatchOptions batch;
};

// The changes as arguments for another run of erbs.
std::vector<std::string> override_arguments(const RunCommand& command);
// The arguments that let another run of erbs read the same folders and build as large a scene; with -D as well.
std::vector<std::string> permissions(const SceneOptions& options);
std::vector<std::string> scene_arguments(const SceneOptions& options);
// The options under which a script is read.
Script::Options script_options(const SceneOptions& options, bool quiet);

// "30m", "90s", "1.5h", "500ms" or plain seconds; throws Error naming the option.
double seconds_of(const std::string& text, const std::string& option);
// "1%" or "0.01"; throws Error naming the option.
double share_of(const std::string& text, const std::string& option);

// The verbs; each returns the exit code of the program.
int verb_run(const RunCommand& command);
int verb_check(const CheckCommand& command);
int verb_record(const RecordCommand& command);
int verb_export(const ExportCommand& command);
int verb_limit(const LimitCommand& command);
int verb_capacity(const CapacityCommand& command);
int verb_plot(const PlotCommand& command);
int verb_report(const ReportCommand& command);
int verb_compare(const CompareCommand& command);
std::vector<std::pair<std::string, std::string>> film_options();  // names and texts of CompareCommand::film
int verb_render(const std::vector<std::string>& words);
int verb_test(const TestCommand& command);
int verb_sweep(const SweepCommand& command);
int verb_calibrate(const CalibrateCommand& command);
int verb_accuracy(const AccuracyCommand& command);
int verb_map(const AccuracyCommand& command);
int verb_bench(const BenchCommand& command);
int verb_effects(const EffectsCommand& command);
int verb_help(const std::vector<std::string>& words, const std::string& usage);
int verb_version();

// Exit codes that users rely on.
enum Exit { exit_ok = 0, exit_numbers = 1, exit_usage = 2, exit_stopped = 3, exit_expectation = 4, exit_interrupted = 130 };

}  // namespace erbs::lua
