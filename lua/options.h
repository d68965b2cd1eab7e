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
  int jobs = 0;  // 0: as many as the machine has
  Record record;  // of erbs record: --dt, --unit, --column
  std::string study;  // the study that started this run
};

// "30m", "90s", "1.5h", "500ms" or plain seconds; throws Error naming the option.
double seconds_of(const std::string& text, const std::string& option);

// The verbs; each returns the exit code of the program.
int verb_run(const Options& options);
int verb_check(const Options& options);
int verb_record(const Options& options);
int verb_render(const Options& options);
int verb_test(const Options& options);
int verb_help(const Options& options, const std::string& usage);
int verb_version();

// Exit codes of the contract.
enum Exit { exit_ok = 0, exit_numbers = 1, exit_usage = 2, exit_stopped = 3, exit_expectation = 4, exit_interrupted = 130 };

}  // namespace erbs
