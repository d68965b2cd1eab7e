// What the command line says.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "engine/loads/record.h"
#include "lua/script.h"

namespace erbs {

struct Options {
  std::vector<std::string> words;  // scenes, folders, files: what the verb is about
  Overrides overrides;             // -D name=value
  std::string directory;           // -o; "": runs/<scene name>
  bool force = false, quiet = false;
  int threads = 0;              // 0: as many as the machine has
  std::optional<double> until;  // s, simulated
  bool resume = false;
  std::optional<double> max_wall;          // s, of wall clock
  std::optional<double> checkpoint_every;  // s, of wall clock
  bool video = false, log_json = false, allow_unstable = false, fail_on_collapse = false;
  int jobs = 0;         // 0: as many as the machine has
  Record record;        // of erbs record: --dt, --unit, --column
  std::string study;    // the study that started this run
  bool figures = true;  // curves of a run
  bool figure_scripts = false;            // those of figure{} as scripts, which a book draws later
  std::vector<std::string> allow;         // folders that a scene may read besides its own
  int max_blocks = 0, max_points = 0;     // of a scene; 0: the limits of Scene

  // of erbs run: how it departs from its scene
  std::optional<double> dt_fraction;  // of dt_critical
  int points = 0;                     // contact points of a joint, a square; 0: as the scene says
  std::string rule;                   // how they are laid out; "": as the scene says
  std::vector<std::string> settings;  // key=value of analysis{}
  std::optional<double> stiffness;    // factor on that of every joint
  std::optional<double> damping;      // 1/s, mass damping
  std::string damping_form;           // "": as the scene says
  std::optional<double> from;         // s: the loads begin there
  std::vector<std::string> without;   // effects switched off
  double noise = 0;                   // m and rad, in the start of every free block
  double twin_noise = 0;              // the same again from another seed: what makes a twin
  bool twin = false;

  // of erbs test
  bool quick = false, grid = false;
  int seeds = 0;      // of every scene: 1 to this many; 0: as the scene says
  std::string book;   // file; "": none is written
  double budget = 0;  // s: of test, of the clock for all runs together; of accuracy, of a run; 0: none

  // of erbs accuracy
  double target = 0;         // relative error asked for; 0: none
  double within = 120;       // s, of the clock for all runs of a scene together; 0: no limit
  std::string quantity;      // the metric the figure is about; "": the first
  bool whole_study = false;  // every problem of a folder
  bool map = false;          // of step, stiffness and damping
  double window = 0;         // s around the peak of the ground, of a map; 0: 2
};

// The words that make another run of erbs depart from its scene as this one does.
std::vector<std::string> departures(const Options& options);

// The words that let another run of erbs read and build what this one may.
std::vector<std::string> permissions(const Options& options);
// How a script is to be read.
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

// Exit codes of the contract.
enum Exit { exit_ok = 0, exit_numbers = 1, exit_usage = 2, exit_stopped = 3, exit_expectation = 4, exit_interrupted = 130 };

}  // namespace erbs
