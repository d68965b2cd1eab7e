// One scene with each of its knobs turned: its runs, its table, its figure.
#pragma once
#include "engine/study/accuracy.h"
#include "lua/options.h"

namespace erbs {

struct AccuracyStudy {
  std::string scene, name, title, directory, command;  // command: of a run, but for its setting
  std::vector<Goal> quantities;
  std::size_t main = 0;  // the quantity of the figure
  std::vector<Measured> all;
  std::vector<std::string> not_applicable;  // knobs the scene does not have, with the reason
  int waiting = 0;                          // runs that did not fit in the time of all
  double wall = 0, cpu = 0;                 // s
  const Goal& quantity() const { return quantities[main]; }
};

// Makes the runs that are not done. Throws Error where the scene gives no number to be accurate in.
AccuracyStudy carry_out_accuracy(const std::string& scene, const std::string& directory, const Options& options);

void write_accuracy_csv(const AccuracyStudy& study, const std::string& path);
// Work-precision figure by gnuplot; the ending of the path, svg or png, says which.
void draw_accuracy(const AccuracyStudy& study, const std::string& path);
// All problems of a study, a panel each.
void draw_accuracies(const std::vector<AccuracyStudy>& studies, const std::string& path);

}  // namespace erbs
