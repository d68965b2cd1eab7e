// Accuracy study: scenes are run with one setting changed at a time. Their runs, their table and their figures.
#pragma once
#include "engine/study/accuracy.h"
#include "lua/program/options.h"

namespace erbs::lua {

struct AccuracyStudy {
  std::string scene, name, title, command;  // command: of a run without its setting
  std::vector<study::Goal> quantities;
  std::size_t main = 0;  // index of the quantity that the figure shows
  std::vector<study::Measured> all;
  std::vector<std::string> not_applicable;  // kinds of settings that do not apply to the scene, each with the reason
  int waiting = 0;                          // settings that the time limit of the study left out
  const study::Goal& quantity() const { return quantities[main]; }
  std::optional<double> error(const study::Measured& m) const;      // of the main quantity, against its reference
  std::optional<double> own_error(const study::Measured& m) const;  // against the limit that the scene itself approaches
};

struct AccuracyResult {
  std::vector<AccuracyStudy> studies;  // one a scene
  std::size_t runs = 0;                // equal settings share one
  double wall = 0, cpu = 0;            // s, of the runs made now; of all runs
};

// Makes the runs that are still missing in the folder. Throws Error if a scene has no number whose error can be measured.
AccuracyResult carry_out_accuracy(const std::vector<std::string>& scenes, const std::string& directory, const AccuracyCommand& command);

void write_accuracy_csv(const std::vector<AccuracyStudy>& studies, const std::string& path);
// Work-precision figure by gnuplot; the file extension, svg or png, selects the format.
void draw_accuracy(const AccuracyStudy& study, const std::string& path);
// One figure for several studies, one panel each.
void draw_accuracies(const std::vector<AccuracyStudy>& studies, const std::string& path);

}  // namespace erbs::lua
