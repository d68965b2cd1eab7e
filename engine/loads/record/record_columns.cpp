// Records as columns of text: values alone, time and value, or CSV with named columns.
#include <algorithm>
#include <cctype>
#include <cmath>

#include "engine/base/text.h"
#include "engine/loads/record/record_file.h"

namespace erbs {
namespace {

struct Column {
  std::string name, unit;
};

// "acceleration_m_s2", "acc (g)", "a [cm/s2]": the unit stands in brackets or after an underscore or blank.
Column parse_name(std::string_view text) {
  text = trim(text);
  if (text.size() >= 2 && text.front() == '"' && text.back() == '"') text = text.substr(1, text.size() - 2);
  const size_t open = text.find_first_of("([");
  if (open != std::string_view::npos) {
    const size_t close = std::min(text.find_first_of(")]", open), text.size());
    return {std::string(trim(text.substr(0, open))), std::string(text.substr(open + 1, close - open - 1))};
  }
  for (size_t at = text.find_first_of("_ "); at != std::string_view::npos; at = text.find_first_of("_ ", at + 1)) {
    const std::string_view unit = text.substr(at + 1);
    if (!quantity_of_unit(unit).empty() || unit == "s" || unit == "ms") return {std::string(text.substr(0, at)), std::string(unit)};
  }
  return {std::string(text), ""};
}

std::vector<Column> parse_names(std::string_view line) {
  const bool semicolons = line.find(';') != std::string_view::npos, tabs = line.find('\t') != std::string_view::npos;
  const char parted = semicolons ? ';' : tabs ? '\t' : ',';
  std::vector<Column> columns;
  while (true) {
    const size_t end = line.find(parted);
    columns.push_back(parse_name(line.substr(0, end)));
    if (end == std::string_view::npos) return columns;
    line.remove_prefix(end + 1);
  }
}

// A line of names begins with a letter or a quotation mark, a line of data with a digit, a sign or a point.
bool is_names(std::string_view line) {
  const char first = trim(line)[0];
  return first == '"' || std::isalpha(static_cast<unsigned char>(first)) != 0;
}

struct RecordRows {
  std::vector<std::vector<double>> cells;
  std::vector<int> lines;       // line of the file, for each row
  std::vector<Column> columns;  // from the line of names; empty without one
  int names_line = 0;
  std::string title;
};

// Commas as decimal marks. A step in the script says that each line holds one number; then a lone comma is a mark too.
bool decimal_commas(const RecordText& text, const Record& wanted) {
  if (wanted.decimal != "auto") return wanted.decimal == "comma";
  size_t first = 0;
  while (first < text.lines.size() && (is_blank(text.lines[first]) || is_comment(text.lines[first]))) ++first;
  if (first < text.lines.size() && is_names(text.lines[first])) {
    const bool by_commas = text.lines[first].find_first_of(";\t") == std::string::npos && text.lines[first].find(',') != std::string::npos;
    if (by_commas) return false;
    ++first;
  }
  return has_decimal_commas(text, first, text.lines.size(), wanted.dt > 0);
}

RecordRows parse_rows(RecordText& text, const Record& wanted) {
  RecordRows rows;
  const bool commas = decimal_commas(text, wanted);
  for (size_t i = 0; i < text.lines.size(); ++i) {
    const std::string& line = text.lines[i];
    if (is_blank(line)) continue;
    if (is_comment(line)) {
      if (rows.title.empty()) rows.title = line.substr(std::min(line.find_first_not_of(" \t#%!/"), line.size()));
      continue;
    }
    if (rows.cells.empty() && rows.columns.empty() && is_names(line)) {
      rows.columns = parse_names(line);
      rows.names_line = static_cast<int>(i) + 1;
      continue;
    }
    rows.cells.emplace_back();
    rows.lines.push_back(static_cast<int>(i) + 1);
    if (commas) replace_decimal_commas(text, i, i + 1);
    append_numbers(text, i, false, rows.cells.back());
  }
  return rows;
}

void check_widths(const RecordText& text, const RecordRows& rows) {
  const size_t width = rows.columns.empty() ? rows.cells.front().size() : rows.columns.size();
  for (size_t r = 0; r < rows.cells.size(); ++r) {
    const size_t count = rows.cells[r].size();
    if (count == width) continue;
    const bool commas = text.given.empty() && text.lines[static_cast<size_t>(rows.lines[r]) - 1].find(',') != std::string::npos;
    const char* remedy = count < width ? "complete the line"
                         : commas ? "take out what is too much; for commas that are decimal marks say decimal = \"comma\" in the scene, "
                                    "or --decimal comma to erbs record"
                                  : "take out what is too much";
    throw Error(fmt::format("{} where the lines before have {}; {}", counted(count, "number"), width, remedy), {text.path, rows.lines[r]});
  }
}

// Values without times, one or several per line, read line by line.
RecordFile parse_values(const RecordText& text, const RecordRows& rows, const Record& wanted) {
  const Place place{text.path, rows.lines.front()};
  if (wanted.dt <= 0)
    throw Error("the file has no times; say the step between its values, such as dt = 0.01 in the scene, or --dt 0.01 to erbs record",
                place);
  const std::string unit = rows.columns.empty() ? "" : rows.columns[0].unit;
  const double factor = factor_to_si(unit, wanted, {text.path, rows.names_line > 0 ? rows.names_line : rows.lines.front()});
  RecordFile file{rows.title, rows.cells.front().size() == 1 ? "text, values" : "text, values along the lines", {}, {}, {}};
  for (const std::vector<double>& row : rows.cells)
    for (const double value : row) file.values.push_back(value * factor);
  for (size_t i = 0; i < file.values.size(); ++i) file.times.push_back(wanted.first_time + static_cast<double>(i) * wanted.dt);
  return file;
}

// A unit of time in brackets tells the column of times in any language: "Zeit [s]".
double seconds_per(const std::string& unit) { return unit == "s" || unit == "sec" ? 1 : unit == "ms" ? 1e-3 : 0; }

size_t time_column(const RecordRows& rows) {
  for (size_t c = 0; c < rows.columns.size(); ++c) {
    const std::string name = lower(rows.columns[c].name);
    if (name == "t" || name.rfind("time", 0) == 0) return c;
  }
  for (size_t c = 0; c < rows.columns.size(); ++c)
    if (seconds_per(lower(trim(rows.columns[c].unit))) > 0) return c;
  return 0;
}

// Seconds per unit of the times. An unknown name such as time_h is an Error, not a guess.
double time_factor(const RecordText& text, const RecordRows& rows, size_t column) {
  if (rows.columns.empty()) return 1;
  const std::string name = lower(rows.columns[column].name), unit = lower(trim(rows.columns[column].unit));
  if (const double seconds = seconds_per(unit); seconds > 0) return seconds;
  if (unit.empty() && (name == "t" || name == "time")) return 1;
  throw Error(fmt::format("the column of times is named \"{}\" [{}]; name it time_s or time_ms", shown(rows.columns[column].name, 24),
                          shown(unit, 24)),
              {text.path, rows.names_line});
}

RecordFile parse_time_and_value(const RecordText& text, const RecordRows& rows, const Record& wanted) {
  check_widths(text, rows);
  const size_t width = rows.cells.front().size(), time = time_column(rows);
  const int head = rows.names_line > 0 ? rows.names_line : rows.lines.front();
  const size_t column = wanted.column > 0 ? static_cast<size_t>(wanted.column) - 1 : time == 0 ? 1 : 0;
  if (column >= width)
    throw Error(fmt::format("there is no column {}, the file has {}; choose 1 to {}", wanted.column, width, width), {text.path, head});
  if (column == time) throw Error(fmt::format("column {} holds the times; choose another", column + 1), {text.path, head});
  if (wanted.dt > 0) throw Error("the file has its own times; leave dt out (time_factor stretches time)", {text.path, head});
  const double seconds = time_factor(text, rows, time);
  const double factor = factor_to_si(rows.columns.empty() ? "" : rows.columns[column].unit, wanted, {text.path, head});
  RecordFile file{rows.title, rows.columns.empty() ? fmt::format("text, {} columns", width) : "CSV", {}, {}, {}};
  for (size_t r = 0; r < rows.cells.size(); ++r) {
    const double t = rows.cells[r][time] * seconds;
    const Place place{text.path, rows.lines[r]};
    if (t < 0) throw Error(fmt::format("time {} s is negative; count time from 0", t), place);
    if (r > 0 && t <= file.times.back())
      throw Error(fmt::format("time {} s does not come after {} s; times must increase", t, file.times.back()), place);
    file.times.push_back(t);
    file.lines.push_back(rows.lines[r]);
    file.values.push_back(rows.cells[r][column] * factor);
  }
  return file;
}

}  // namespace

RecordFile parse_columns(RecordText& text, const Record& wanted) {
  const RecordRows rows = parse_rows(text, wanted);
  if (rows.cells.empty()) throw Error("the record file holds no numbers; give a file with values", {text.path});
  const size_t width = rows.cells.front().size();
  if (width == 1 || (width > 2 && wanted.dt > 0 && rows.columns.empty() && wanted.column == 0)) {
    if (width == 1) check_widths(text, rows);
    return parse_values(text, rows, wanted);
  }
  return parse_time_and_value(text, rows, wanted);
}

}  // namespace erbs
