// histories.svg and energy.svg from the CSV files beside them, by the program gnuplot.
#pragma once
#include "engine/record/run_folder.h"
#include "render/run.h"

namespace erbs::render {

// Writes what there is data for; the paths written.
std::vector<std::string> write_figures(const Run& run);

// One panel of curves that share a unit.
struct Panel {
  std::string label;         // of the vertical axis, with the unit shown
  double factor = 1;         // from SI to that unit
  std::vector<int> columns;  // of the table
  bool directed = false;     // along one axis: there may be a panel for each of the others
};
// Ground motion first, then the others by unit in the order of the table. With `left_out`, panels whose curves stay below 2 % of
// the same quantity in another direction are named there instead.
std::vector<Panel> history_panels(const CsvTable& table, std::vector<std::string>* left_out = nullptr);

// The unit at the end of a column's name ("m_s2"), "" where there is none; the rest of the name in plain words.
std::string unit_of(const std::string& column);
std::string words_of(const std::string& column);

}  // namespace erbs::render
