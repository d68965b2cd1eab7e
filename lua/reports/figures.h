// The figures of a scene: results of its studies beside known values.
#pragma once
#include <string>
#include <vector>

#include "lua/language/script.h"

namespace erbs::lua {

// A figure that a run has left as a gnuplot script, to be drawn later.
struct LeftFigure {
  std::string name, title, script;  // script: for gnuplot
};

// Writes figures/NAME.gnuplot of every figure, with its numbers, into the run folder; if `draw`, also figures/NAME.svg.
void write_figures(const Script& script, const std::string& directory, bool draw);
std::vector<LeftFigure> figures_of(const std::string& directory);  // sorted by name

}  // namespace erbs::lua
