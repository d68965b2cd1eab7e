// Accuracy study: one scene is run with one setting changed at a time. Its runs, its table and its figure.
#pragma once
#include "engine/study/accuracy.h"
#include "lua/program/options.h"

namespace erbs::lua {

struct AccuracyStudy {
  std::string scene, name, title, directory, command;  // command: of a run without its setting
  std::vector<study::Goal> quantities;
  std::size_t main = 0;  // index of the quantity that the figure shows
  std::vector<study::Measured> all;
  std::vector<std::string> not_applicable;  // kinds of settings that do not apply to the scene, each with the reason
  int waiting = 0;                          // runs that the time limit of the study left out
  double wall = 0, cpu = 0;                 // s
  const study::Goal& quantity() const { return quantities[main]; }
};

// Makes the runs that are still missing. Throws Error if the scene has no number whose error can be measured.
AccuracyStudy carry_out_accuracy(const std::string& scene, const std::string& directory, const AccuracyCommand& command);

void write_accuracy_csv(const AccuracyStudy& study, const std::string& path);
// Work-precision figure by gnuplot; the file extension, svg or png, selects the format.
void draw_accuracy(const AccuracyStudy& study, const std::string& path);
// One figure for several studies, one panel each.
void draw_accuracies(const std::vector<AccuracyStudy>& studies, const std::string& path);

}  // namespace erbs::lua
