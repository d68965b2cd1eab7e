// The figures a scene asks for: curves of its studies beside what is known.
#pragma once
#include <string>
#include <vector>

#include "lua/script.h"

namespace erbs {

// A figure that a run left behind, ready to be drawn.
struct LeftFigure {
  std::string name, title, script;  // script: for gnuplot
};

// Writes figures/NAME.gnuplot of every figure into the run folder, its numbers inside, and figures/NAME.svg where `draw`.
void write_figures(const Script& script, const std::string& directory, bool draw);
std::vector<LeftFigure> figures_of(const std::string& directory);  // sorted by name

}  // namespace erbs
