#include "render/table.h"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <limits>
#include <string_view>

namespace erbs::render {
namespace {

std::vector<std::string_view> split(std::string_view line) {
  std::vector<std::string_view> cells;
  while (!line.empty() && (line.back() == '\r' || line.back() == ' ')) line.remove_suffix(1);
  for (std::size_t comma = line.find(','); comma != std::string_view::npos; comma = line.find(',')) {
    cells.push_back(line.substr(0, comma));
    line.remove_prefix(comma + 1);
  }
  cells.push_back(line);
  return cells;
}

double number(std::string_view cell) {
  double value = 0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  return error == std::errc() && end == cell.data() + cell.size() ? value : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

int Table::find(const std::string& name) const {
  const auto it = std::find(names.begin(), names.end(), name);
  return it == names.end() ? -1 : static_cast<int>(it - names.begin());
}

Table read_table(const std::string& path) {
  Table table;
  std::ifstream in(path);
  std::string line;
  if (!std::getline(in, line)) return table;
  for (std::string_view name : split(line)) table.names.emplace_back(name);
  table.columns.resize(table.names.size());
  while (std::getline(in, line)) {
    if (in.eof()) break;  // no line end: the writer was stopped within the line
    const auto cells = split(line);
    if (cells.size() != table.names.size()) continue;
    for (std::size_t c = 0; c < cells.size(); ++c) table.columns[c].push_back(number(cells[c]));
  }
  return table;
}

}  // namespace erbs::render
