// Draws histories.svg and energy.svg, or curve.svg of a push, from the CSV files beside them, with gnuplot.
#pragma once
#include <utility>

#include "engine/record/folder/run_folder.h"
#include "engine/record/plot/unit.h"
#include "render/run/run.h"

namespace erbs::render {

// Writes each figure with data; returns the paths written.
std::vector<std::string> write_figures(const Run& run);

// One panel of curves that share a unit.
struct Panel {
  std::string label;         // of the vertical axis, with the displayed unit
  double factor = 1;         // from SI to the displayed unit
  std::vector<int> columns;  // columns of the table
  bool directed = false;     // along one axis; other axes may have a panel each
};
// Panels: ground motion first, then by unit in the order of the table. Panels whose curves stay below 2 % of the same quantity in another
// direction are dropped if `left_out` is given, and named in it.
std::vector<Panel> history_panels(const CsvTable& table, std::vector<std::string>* left_out = nullptr);

// From where to where the vertical axis of a panel reaches, in the displayed unit: the curves fill it.
std::pair<double, double> shown_range(const CsvTable& table, const Panel& panel);

using plot::unit_of, plot::words_of;

}  // namespace erbs::render
