// A CSV file of numbers: the first line names the columns, with their units (`time_s,floor3_ux_rel_m`).
#pragma once
#include <string>
#include <vector>

namespace erbs::render {

struct Table {
  std::vector<std::string> names;            // [columns]
  std::vector<std::vector<double>> columns;  // [columns][rows]; what is no number is NaN
  std::size_t rows() const { return columns.empty() ? 0 : columns.front().size(); }
  int find(const std::string& name) const;  // -1 where there is none
};

// An empty table where the file does not exist. A last line cut short by a kill is left out.
Table read_table(const std::string& path);

}  // namespace erbs::render
