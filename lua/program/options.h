// Options of the command line.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "engine/loads/record/record.h"
#include "lua/language/script.h"

namespace erbs {

struct Options {
  std::vector<std::string> words;  // arguments of the verb: scenes, folders, files
  Overrides overrides;             // -D name=value
  std::string directory;           // -o; "": runs/<scene name>
  bool force = false, quiet = false;
  int threads = 0;              // 0: as many as the machine has
  std::optional<double> until;  // s, simulated
  bool resume = false;
  std::optional<double> max_wall;          // s, of wall clock
  std::optional<double> checkpoint_every;  // s, of wall clock
  bool video = false, log_json = false, allow_unstable = false, fail_on_collapse = false;
  int jobs = 0;                        // 0: as many as the machine has
  Record record;                       // of erbs record: --dt, --unit, --column
  std::string study;                   // name of the study that started this run
  bool figures = true;                 // draw the curves of a run
  bool figure_scripts = false;         // write the figures of figure{} as gnuplot scripts, which a book draws later
  std::vector<std::string> allow;      // folders that a scene may read besides its own
  int max_blocks = 0, max_points = 0;  // limits of a scene; 0: the limits of Scene

  // of erbs run: overrides of the scene
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
  double twin_noise = 0;              // m and rad, further noise from another seed, which makes a twin
  bool twin = false;

  // of erbs test
  bool quick = false, grid = false;
  int seeds = 0;      // every scene with seeds 1 to this number; 0: as the scene says
  std::string book;   // path of the book; "": none is written
  double budget = 0;  // s: of erbs test, wall clock of all runs together; of erbs accuracy, of one run; 0: none

  // of erbs accuracy
  double target = 0;         // wanted relative error; 0: none
  double within = 120;       // s, wall clock of all runs of a scene together; 0: no limit
  std::string quantity;      // the quantity of the figure; "": chosen by the program
  bool whole_study = false;  // all problems of a folder
  bool map = false;          // stability map of step, stiffness and damping
  double window = 0;         // s around the peak of the ground motion, for a map; 0: 2 s
};

// The overrides of this run as arguments for another run of erbs.
std::vector<std::string> override_arguments(const Options& options);

// The arguments that let another run of erbs read the same folders and build as large a scene.
std::vector<std::string> permissions(const Options& options);
// The options under which a script is read.
Script::Options script_options(const Options& options, bool quiet);

// "30m", "90s", "1.5h", "500ms" or plain seconds; throws Error naming the option.
double seconds_of(const std::string& text, const std::string& option);
// "1%" or "0.01"; throws Error naming the option.
double share_of(const std::string& text, const std::string& option);

// The verbs; each returns the exit code of the program.
int verb_run(const Options& options);
int verb_check(const Options& options);
int verb_record(const Options& options);
int verb_render(const Options& options);
int verb_test(const Options& options);
int verb_accuracy(const Options& options);
int verb_map(const Options& options);
int verb_bench(const Options& options);
int verb_effects(const Options& options);
int verb_help(const Options& options, const std::string& usage);
int verb_version();

// Exit codes that users rely on.
enum Exit { exit_ok = 0, exit_numbers = 1, exit_usage = 2, exit_stopped = 3, exit_expectation = 4, exit_interrupted = 130 };

}  // namespace erbs
